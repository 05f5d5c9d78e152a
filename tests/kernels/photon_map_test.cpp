// SPDX-License-Identifier: Apache-2.0
// kernels/spectral/photon_map.h and grid.cl against a sum over all photons: the same whole numbers, whatever order the photons came in.
#include "spectral/maps/photon_map.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"

namespace nephroid::photon_map_test {

using namespace shared;

const char* const source = R"(
#include "kernels/spectral/photon_map.h"
typedef long4 Sum;
kernel void gather_all(PHOTON_MAP_ARGUMENTS, global const VisiblePoint* points, global Sum* sums, uint count)
{
  const uint i = get_global_id(0);
  if (i >= count) return;
  const PhotonMap map = PHOTON_MAP;
  const VisiblePoint p = points[i];
  const Gathered g = gather_photons(&map, p.position.xyz, p.normal.xyz, p.group, p.position.w);
  sums[i] = (long4)(g.xyz, g.count);
}
)";

struct Sum {
  std::int64_t x = 0, y = 0, z = 0, count = 0;
  bool operator==(const Sum&) const = default;
};

/// Coordinates are multiples of 1/256 and below 4, so that squares of distances are exact in single precision: a photon is inside or not,
/// however a compiler orders the operations.
float lattice(std::mt19937& random, float reach) { return std::floor(random() * 0x1p-32f * 2 * reach * 256 - reach * 256) / 256; }

/// Photons in a cube and on its middle plane, of `groups` groups and some empty slots.
std::vector<StoredPhoton> make_photons(std::size_t count, int groups, std::mt19937& random)
{
  std::vector<StoredPhoton> photons(count);
  for (StoredPhoton& p : photons) {
    for (float& x : p.position) x = lattice(random, 2);
    if (random() % 2) p.position[1] = 0;
    p.group = static_cast<int>(random() % static_cast<unsigned>(groups + 1)) - 1;
    for (int& q : p.xyz) q = static_cast<int>(random() % 16 ? random() % 5000 : random() % ((1u << 24) + 1));
  }
  return photons;
}

std::vector<VisiblePoint> make_points(std::size_t count, int groups, float largest, std::mt19937& random)
{
  const std::array<shared::float4, 4> normals{{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, -1, 0}, {0.75f, -0.5f, 0.25f, 0}}}; // exact, any length
  std::vector<VisiblePoint> points(count);
  for (VisiblePoint& p : points) {
    p.position = {lattice(random, 2.5f), random() % 2 ? 0 : lattice(random, 2), lattice(random, 2.5f), largest};
    if (random() % 2) p.position.w = std::ceil(random() * 0x1p-32f * largest * 64) / 64;
    p.normal = normals[random() % 4];
    p.group = static_cast<int>(random() % static_cast<unsigned>(groups));
  }
  return points;
}

Sum reference(const std::vector<StoredPhoton>& photons, const VisiblePoint& at)
{
  Sum sum;
  for (const StoredPhoton& p : photons) {
    const double dx = p.position[0] - at.position.x, dy = p.position[1] - at.position.y, dz = p.position[2] - at.position.z;
    const double height = dx * at.normal.x + dy * at.normal.y + dz * at.normal.z;
    if (p.group != at.group || !(dx * dx + dy * dy + dz * dz + 16 * height * height < at.position.w * at.position.w)) continue;
    sum.x += p.xyz[0], sum.y += p.xyz[1], sum.z += p.xyz[2], ++sum.count;
  }
  return sum;
}

class PhotonMapTest : public testing::Test {
protected:
  /// Sorts the photons, and hands back the sums at the points.
  static std::vector<Sum> gather(const std::vector<StoredPhoton>& photons, const std::vector<VisiblePoint>& points, double cell)
  {
    static const test::TestKernels kernels(source);
    spectral::PhotonMap map(kernels.context(), static_cast<std::uint32_t>(photons.size()));
    map.stored().write(photons);
    map.build(cell, map.slots());
    const compute::Buffer<VisiblePoint> at(kernels.context(), "points", std::span<const VisiblePoint>(points));
    compute::Buffer<Sum> sums(kernels.context(), "sums", points.size());
    kernels.kernel("gather_all")
        .run(points.size(), 64, map.arguments(), {{"points", at}, {"sums", sums}, {"count", static_cast<std::uint32_t>(points.size())}});
    return sums.read();
  }

  static void expect_reference(const std::vector<StoredPhoton>& photons, const std::vector<VisiblePoint>& points, double cell)
  {
    const std::vector<Sum> sums = gather(photons, points, cell);
    std::int64_t found = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(sums[i], reference(photons, points[i])) << "point " << i << " in cells of " << cell;
      found += sums[i].count;
    }
    EXPECT_GT(found, static_cast<std::int64_t>(points.size()));
  }
};

TEST_F(PhotonMapTest, SumsAreThoseOverAllPhotons)
{
  std::mt19937 random(1);
  const std::vector<StoredPhoton> photons = make_photons(20000, 3, random);
  const std::vector<VisiblePoint> points = make_points(300, 3, 0.5f, random);
  for (const double cell : {1.0, 0.5, 0.3, 0.17}) expect_reference(photons, points, cell);
}

// Fewer buckets than cells in a search: runs wrap round the table, and rows of one search share buckets.
TEST_F(PhotonMapTest, NothingCountsTwiceWhereCellsShareBuckets)
{
  std::mt19937 random(2);
  const std::vector<StoredPhoton> photons = make_photons(1500, 2, random);
  expect_reference(photons, make_points(500, 2, 2.0f, random), 0.7);
  expect_reference(photons, make_points(500, 2, 2.0f, random), 1.9);
  expect_reference(make_photons(40000, 400, random), make_points(200, 400, 1.5f, random), 0.5);
}

// All in one place: every sum of 24-bit quanta has to be widened in time.
TEST_F(PhotonMapTest, ManyLargePhotonsDoNotOverflow)
{
  std::vector<StoredPhoton> photons(100000, {{0.25f, 0, 0.25f}, 0, {1 << 24, (1 << 24) - 1, 1}, 0});
  const VisiblePoint here{{0.25f, 0, 0.25f, 0.125f}, {0, 1, 0, 0}, {}, 0, {}};
  EXPECT_EQ(gather(photons, {here}, 0.25)[0],
            (Sum{(std::int64_t{1} << 24) * 100000, ((std::int64_t{1} << 24) - 1) * 100000, 100000, 100000}));
}

TEST_F(PhotonMapTest, TheOrderOfPhotonsChangesNothing)
{
  std::mt19937 random(3);
  std::vector<StoredPhoton> photons = make_photons(50000, 2, random);
  for (StoredPhoton& p : photons) // no lattice: any positions
    for (float& x : p.position) x += static_cast<float>(random()) * 1e-12f;
  const std::vector<VisiblePoint> points = make_points(500, 2, 0.4f, random);
  const std::vector<Sum> before = gather(photons, points, 0.4);
  std::shuffle(photons.begin(), photons.end(), random);
  EXPECT_EQ(gather(photons, points, 0.4), before);
}

TEST_F(PhotonMapTest, PlacesBeyondEveryCellAndEmptyMapsAreHarmless)
{
  std::vector<StoredPhoton> photons(10, {{3e20f, -3e20f, 1e30f}, 0, {1, 2, 3}, 0});
  const std::vector<VisiblePoint> points{{{3e20f, -3e20f, 1e30f, 1.0f}, {0, 1, 0, 0}, {}, 0, {}},
                                         {{0, 0, 0, 1.0f}, {0, 1, 0, 0}, {}, 0, {}}};
  const std::vector<Sum> sums = gather(photons, points, 1e-3);
  EXPECT_EQ(sums[0].count, 10);
  EXPECT_EQ(sums[1].count, 0);
  for (StoredPhoton& p : photons) p.group = NO_PHOTON;
  EXPECT_EQ(gather(photons, points, 1e-3)[0].count, 0);
}

} // namespace nephroid::photon_map_test
