// SPDX-License-Identifier: Apache-2.0
// Photons against an independent tracer; photon maps.
#include "photons/maps/photon_map.h"
#include "spectral/settings.h"
#include "tests/support/reference_photons.h"
#include "tests/support/render.h"
#include "tests/support/statistics.h"

namespace nephroid::photons_test {

using Float4 = shared::float4;
using namespace shared;

// kernels/photons/photons.cl against an independent tracer on Embree, pixel by pixel within the noise of both.

/// A smooth ball, a diamond and a mirror above a coloured floor, of dispersive glass; a point light.
preset::Preset glass_preset() {
  preset::Preset p = empty_preset(24);
  p.unit = preset::Preset::Unit::cm;
  preset::Material dispersive = glass(1.7);
  dispersive.dispersion.type = preset::Dispersion::Type::cauchy;
  dispersive.dispersion.coefficients = {1.65, 0.03};
  p.scene.materials["glass"] = dispersive;
  p.scene.materials["floor"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["floor"].reflectance.patch = "orange";
  p.scene.materials["mirror"] = check::mirror(1);
  preset::Shape ball, diamond;
  ball.radius = 1;
  diamond.type = preset::Shape::Type::brilliant;
  diamond.radius = 1;
  p.scene.objects = {object("ball", ball, "glass", at({-1.5, 1.5, 0})),
                     object("diamond", diamond, "glass", at({1.5, 1.5, 0}, {20, 0, 15})),
                     object("mirror", quad(2, 2), "mirror", at({0, 1.5, -2}, {75, 0, 0})),
                     object("floor", quad(40, 40), "floor")};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  preset::Light light{.power_w = 10, .position = {0.5, 6, 3}};
  p.scene.lights = {light};
  p.scene.camera.position = {0, 9, 9};
  p.scene.camera.target = {0, 0, -0.5};
  p.scene.camera.fov_deg = 40;
  spectral::settings(p).threshold_deg = 1;
  spectral::settings(p).photons_per_pass = 1 << 16;
  return p;
}

/// What the other scene does not have: flint that absorbs, most of all violet; a core of denser glass and a bubble of
/// air in it, one that overlaps the surface, of three priorities; a coloured mirror; faceted and smooth.
preset::Preset nested_preset() {
  preset::Preset p = glass_preset();
  p.unit = preset::Preset::Unit::m;
  preset::Material& flint = p.scene.materials["flint"];
  flint.type = preset::Material::Type::dielectric;
  flint.dispersion.type = preset::Dispersion::Type::file;
  flint.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml";
  p.scene.materials["dense"] = glass(2.2);
  p.scene.materials["air"] = glass(1);
  p.scene.materials["mirror"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["mirror"].reflectance.patch = "yellow green";
  preset::Shape core, bubble;
  core.radius = 0.5;
  bubble.radius = 0.35;
  preset::Object mirror = p.scene.objects[2], floor = p.scene.objects[3];
  mirror.shape->size = {4, 1, 4};
  p.scene.objects = {p.scene.objects[0],
                     object("block", box(1.6, 1.2, 1.6), "flint", at({1.4, 1.5, 0}, {15, 30, 0})),
                     object("core", core, "dense", at({-1.2, 1.6, 0.4})),
                     object("bubble", bubble, "air", at({1.2, 2.0, 0.2})),
                     mirror,
                     floor};
  p.scene.objects[0].material = "flint";
  p.scene.objects[2].priority = 1;
  p.scene.objects[3].priority = 2;
  p.scene.objects[3].normals = preset::Object::Normals::smooth;
  return p;
}

struct Moments {
  double mean = 0, variance_of_mean = 0;
};

class PhotonKernel : public testing::TestWithParam<preset::Preset (*)()> {};

TEST_P(PhotonKernel, AgreesWithAnIndependentTracerInEveryPixel) {
  preset::Preset p = GetParam()();
  constexpr int runs = 24;
  const std::size_t values = 3 * 24 * 24;
  std::vector<Moments> kernel(values);
  double absorbed = 0;
  for (int run = 0; run < runs; ++run) {
    p.seed = static_cast<std::uint64_t>(run + 1);
    const job::Snapshot snapshot = render(p);
    absorbed = photons::energy_of(snapshot).absorbed_w / photons::energy_of(snapshot).emitted_w;
    const job::Layer& caustic = layer(snapshot, "caustic");
    for (std::size_t i = 0; i < values; i += 3) {
      const optics::Colour xyz = optics::linear_srgb_to_xyz({caustic.rgb[i], caustic.rgb[i + 1], caustic.rgb[i + 2]});
      for (std::size_t c = 0; c < 3; ++c) {
        kernel[i + c].mean += xyz[c] / runs;
        kernel[i + c].variance_of_mean += xyz[c] * xyz[c] / runs;
      }
    }
  }
  for (Moments& m : kernel) m.variance_of_mean = std::max(m.variance_of_mean - m.mean * m.mean, 0.0) / (runs - 1);

  const scene::Scene scene = scene::load_scene(p);
  const photons::RunTables tables =
      photons::make_lit_tables(spectral::settings(p), scene, scene::build_bvh(scene.geometry), {});
  constexpr int photons = 1'500'000;
  const ReferenceFilm film = ReferencePhotons(scene, tables, 99).trace(photons);

  double sum_z2 = 0, smallest_p = 1, sum_kernel = 0, sum_reference = 0;
  int lit = 0;
  for (std::size_t i = 0; i < values; ++i) {
    const double mean = film.sum[i / 3][static_cast<int>(i % 3)];
    const double variance = film.sum_of_squares[i / 3][static_cast<int>(i % 3)] - mean * mean / photons;
    sum_kernel += kernel[i].mean;
    sum_reference += mean;
    const double total = variance + kernel[i].variance_of_mean;
    if (!(variance > 0) || !(kernel[i].variance_of_mean > 0) || mean * mean / variance < 30)
      continue; // fewer than 30 photons
    const double z = (kernel[i].mean - mean) / std::sqrt(total);
    sum_z2 += z * z;
    smallest_p = std::min(smallest_p, bernstein(z, 1, 0, runs - 1));
    ++lit;
  }
  ASSERT_GT(lit, 300);
  // Sums over the picture are known to better than 0.2 %.
  EXPECT_NEAR(sum_kernel / sum_reference, 1, 0.01);
  // Student's t with 23 degrees of freedom has variance 23 / 21, and its square the variance 2.8; the three channels of
  // a pixel move together, so about lit / 3 are independent. Six standard deviations.
  EXPECT_NEAR(sum_z2 / lit, 1.05, 6 * std::sqrt(2.8 * 3 / lit));
  EXPECT_GT(sidak(smallest_p, lit), false_alarm);
  RecordProperty("lit", lit);
  RecordProperty("absorbed_share", std::to_string(absorbed));
  RecordProperty("mean_z2", std::to_string(sum_z2 / lit));
}

INSTANTIATE_TEST_SUITE_P(Scenes, PhotonKernel, testing::Values(glass_preset, nested_preset), [](const auto& parameter) {
  return std::string(parameter.index == 0 ? "dispersion" : "absorption_and_nesting");
});

// kernels/photons/photon_map.h and grid.cl against a sum over all photons: the same whole numbers, whatever order the
// photons came in.

const char* const source = R"(
#include "kernels/photons/photon_map.h"
#include "kernels/tracing/work_item.h"
typedef long4 Sum;
kernel void gather_all(PHOTON_MAP_ARGUMENTS, global const VisiblePoint* points, global Sum* sums, uint count)
{
  const uint i = work_item();
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

/// Coordinates are multiples of 1/256 and below 4, so that squares of distances are exact in single precision: a photon
/// is inside or not, however a compiler orders the operations.
float lattice(std::mt19937& random, float reach) {
  return std::floor(random() * 0x1p-32f * 2 * reach * 256 - reach * 256) / 256;
}

/// Photons in a cube and on its middle plane, of `groups` groups and some empty slots.
std::vector<StoredPhoton> make_photons(std::size_t count, int groups, std::mt19937& random) {
  std::vector<StoredPhoton> photons(count);
  for (StoredPhoton& p : photons) {
    for (float& x : p.position) x = lattice(random, 2);
    if (random() % 2) p.position[1] = 0;
    p.group = static_cast<int>(random() % static_cast<unsigned>(groups + 1)) - 1;
    for (int& q : p.xyz) q = static_cast<int>(random() % 16 ? random() % 5000 : random() % ((1u << 24) + 1));
  }
  return photons;
}

std::vector<VisiblePoint> make_points(std::size_t count, int groups, float largest, std::mt19937& random) {
  const std::array<shared::float4, 4> normals{
      {{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, -1, 0}, {0.75f, -0.5f, 0.25f, 0}}}; // exact, any length
  std::vector<VisiblePoint> points(count);
  for (VisiblePoint& p : points) {
    p.position = {lattice(random, 2.5f), random() % 2 ? 0 : lattice(random, 2), lattice(random, 2.5f), largest};
    if (random() % 2) p.position.w = std::ceil(random() * 0x1p-32f * largest * 64) / 64;
    p.normal = normals[random() % 4];
    p.group = static_cast<int>(random() % static_cast<unsigned>(groups));
  }
  return points;
}

Sum reference(const std::vector<StoredPhoton>& photons, const VisiblePoint& at) {
  Sum sum;
  for (const StoredPhoton& p : photons) {
    const double dx = p.position[0] - at.position.x, dy = p.position[1] - at.position.y,
                 dz = p.position[2] - at.position.z;
    const double height = dx * at.normal.x + dy * at.normal.y + dz * at.normal.z;
    if (p.group != at.group || !(dx * dx + dy * dy + dz * dz + 16 * height * height < at.position.w * at.position.w))
      continue;
    sum.x += p.xyz[0], sum.y += p.xyz[1], sum.z += p.xyz[2], ++sum.count;
  }
  return sum;
}

class PhotonMapTest : public testing::Test {
protected:
  /// Sorts the photons, and hands back the sums at the points.
  static std::vector<Sum> gather(const std::vector<StoredPhoton>& photons, const std::vector<VisiblePoint>& points,
                                 double cell) {
    static const test::TestKernels kernels(source);
    photons::PhotonMap map(kernels.context(), static_cast<std::uint32_t>(photons.size()));
    map.stored().write(photons);
    map.build(cell, static_cast<std::uint32_t>(photons.size()));
    const compute::Buffer<VisiblePoint> at(kernels.context(), "points", std::span<const VisiblePoint>(points));
    compute::Buffer<Sum> sums(kernels.context(), "sums", points.size());
    kernels.kernel("gather_all")
        .run(points.size(), 64, map.arguments(),
             {{"points", at}, {"sums", sums}, {"count", static_cast<std::uint32_t>(points.size())}});
    return sums.read();
  }

  static void expect_reference(const std::vector<StoredPhoton>& photons, const std::vector<VisiblePoint>& points,
                               double cell) {
    const std::vector<Sum> sums = gather(photons, points, cell);
    std::int64_t found = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(sums[i], reference(photons, points[i])) << "point " << i << " in cells of " << cell;
      found += sums[i].count;
    }
    EXPECT_GT(found, static_cast<std::int64_t>(points.size()));
  }
};

TEST_F(PhotonMapTest, SumsAreThoseOverAllPhotons) {
  std::mt19937 random(1);
  const std::vector<StoredPhoton> photons = make_photons(20000, 3, random);
  const std::vector<VisiblePoint> points = make_points(300, 3, 0.5f, random);
  for (const double cell : {1.0, 0.5, 0.3, 0.17}) expect_reference(photons, points, cell);
}

// Fewer buckets than cells in a search: runs wrap round the table, and rows of one search share buckets.
TEST_F(PhotonMapTest, NothingCountsTwiceWhereCellsShareBuckets) {
  std::mt19937 random(2);
  const std::vector<StoredPhoton> photons = make_photons(1500, 2, random);
  expect_reference(photons, make_points(500, 2, 2.0f, random), 0.7);
  expect_reference(photons, make_points(500, 2, 2.0f, random), 1.9);
  expect_reference(make_photons(40000, 400, random), make_points(200, 400, 1.5f, random), 0.5);
}

// All in one place: every sum of 24-bit quanta has to be widened in time.
TEST_F(PhotonMapTest, ManyLargePhotonsDoNotOverflow) {
  std::vector<StoredPhoton> photons(100000, {{0.25f, 0, 0.25f}, 0, {1 << 24, (1 << 24) - 1, 1}, 0});
  const VisiblePoint here{{0.25f, 0, 0.25f, 0.125f}, {0, 1, 0, 0}, {}, 0, {}};
  EXPECT_EQ(gather(photons, {here}, 0.25)[0],
            (Sum{(std::int64_t{1} << 24) * 100000, ((std::int64_t{1} << 24) - 1) * 100000, 100000, 100000}));
}

TEST_F(PhotonMapTest, TheOrderOfPhotonsChangesNothing) {
  std::mt19937 random(3);
  std::vector<StoredPhoton> photons = make_photons(50000, 2, random);
  for (StoredPhoton& p : photons) // no lattice: any positions
    for (float& x : p.position) x += static_cast<float>(random()) * 1e-12f;
  const std::vector<VisiblePoint> points = make_points(500, 2, 0.4f, random);
  const std::vector<Sum> before = gather(photons, points, 0.4);
  std::shuffle(photons.begin(), photons.end(), random);
  EXPECT_EQ(gather(photons, points, 0.4), before);
}

TEST_F(PhotonMapTest, PlacesBeyondEveryCellAndEmptyMapsAreHarmless) {
  std::vector<StoredPhoton> photons(10, {{3e20f, -3e20f, 1e30f}, 0, {1, 2, 3}, 0});
  const std::vector<VisiblePoint> points{{{3e20f, -3e20f, 1e30f, 1.0f}, {0, 1, 0, 0}, {}, 0, {}},
                                         {{0, 0, 0, 1.0f}, {0, 1, 0, 0}, {}, 0, {}}};
  const std::vector<Sum> sums = gather(photons, points, 1e-3);
  EXPECT_EQ(sums[0].count, 10);
  EXPECT_EQ(sums[1].count, 0);
  for (StoredPhoton& p : photons) p.group = NO_PHOTON;
  EXPECT_EQ(gather(photons, points, 1e-3)[0].count, 0);
}

} // namespace nephroid::photons_test
