// SPDX-License-Identifier: Apache-2.0
// Light on receivers: what is added to pages is found there, whatever their levels, by looks of every size.
#include "photons/receivers/receiver_light.h"
#include "tests/support/statistics.h"
#include "tests/support/test_kernels.h"

#include <glm/glm.hpp>

#include <numeric>

namespace nephroid::receivers_test {

using photons::PageTrees;

const char* const source = R"(
#include "kernels/photons/receiver_light.cl"
// A place, the lit side's normal, and the edges of a footprint about it.
typedef struct { float4 position, normal, a, b; } Place;
static inline Surface surface_of(const Place* place)
{
  Surface surface;
  surface.position = place->position.xyz;
  surface.geometric = surface.shading = place->normal.xyz;
  surface.offset = 0.0f;
  surface.object = 0;
  return surface;
}
kernel void add(global const int* receiver_table, global const Place* places, uint count, volatile global long* sums,
                float quanta)
{
  const uint i = work_item();
  if (i >= count) return;
  const Receivers on = receivers_of(receiver_table);
  const Place place = places[i];
  const Surface surface = surface_of(&place);
  add_to_receiver(&on, &surface, 1.0f, place.a.xyz, place.b.xyz, sums, (float3)(quanta, 2.0f * quanta, 0.0f));
}
kernel void look(global const int* receiver_table, global const Place* places, uint count, global const float* totals,
                 global float4* out)
{
  const uint i = work_item();
  if (i >= count) return;
  const Receivers on = receivers_of(receiver_table);
  const Place place = places[i];
  const Surface surface = surface_of(&place);
  const float weight = 1.0f;
  out[i].xyz =
      look_at_receiver(&on, &surface, 1.0f, place.a.xyz, place.b.xyz, (float2)(0.5f), totals, 1, &weight).caustic;
}
)";

struct Place {
  shared::float4 position, normal, a, b;
};

shared::float4 four(const glm::vec3& v) { return {v.x, v.y, v.z, 0}; }

/// A square floor about the origin, y up, or one turned about x, with pages where looks ask.
class Floor {
public:
  explicit Floor(const std::vector<shared::DeviceLook>& looks, float turn = 0, float edge = 2.002f)
      : turn_(turn), trees_(photons::make_pages(looks, 6, 1000)),
        table_(kernels().context(), "receivers",
               photons::receiver_table({{{{-edge / 2, -edge / 2, -edge / 2}, 1 / edge, 0, 1}}, 6}, trees_, {})),
        sums_(kernels().context(), "sums", 3 * PAGE_TEXELS * trees_.pages.size()),
        totals_(kernels().context(), "totals", 3 * PAGE_TEXELS * trees_.pages.size()) {
    sums_.fill_zero();
    totals_.fill_zero();
  }

  static const test::TestKernels& kernels() {
    static const test::TestKernels kernels(source);
    return kernels;
  }

  /// A footprint on the floor: its middle, and its edges, along the floor.
  Place place(glm::vec2 middle, glm::vec2 a, glm::vec2 b, float side = 1) const {
    return {four(on_floor(middle)), four(side * glm::vec3(0, std::cos(turn_), std::sin(turn_))), four(on_floor(a)),
            four(on_floor(b))};
  }

  void add(const std::vector<Place>& places, float quanta) {
    compute::Buffer<Place> buffer(kernels().context(), "places", places);
    kernels().kernel("add").run(places.size(), 1,
                                {{"receiver_table", table_},
                                 {"places", buffer},
                                 {"count", static_cast<std::uint32_t>(places.size())},
                                 {"sums", sums_},
                                 {"quanta", quanta}});
  }

  std::vector<shared::float4> look(const std::vector<Place>& places) {
    develop();
    compute::Buffer<Place> buffer(kernels().context(), "places", places);
    compute::Buffer<shared::float4> out(kernels().context(), "irradiance", places.size());
    kernels().kernel("look").run(places.size(), 1,
                                 {{"receiver_table", table_},
                                  {"places", buffer},
                                  {"count", static_cast<std::uint32_t>(places.size())},
                                  {"totals", totals_},
                                  {"out", out}});
    return out.read();
  }

  /// All light that was added, X and Y, in quanta.
  std::array<std::int64_t, 2> added() const {
    std::array<std::int64_t, 2> sum{};
    const std::vector<std::int64_t> sums = sums_.read();
    for (std::size_t i = 0; i < sums.size(); i += 3) sum[0] += sums[i], sum[1] += sums[i + 1];
    return sum;
  }

  const PageTrees& trees() const { return trees_; }

private:
  glm::vec3 on_floor(glm::vec2 v) const { return {v.x, -std::sin(turn_) * v.y, std::cos(turn_) * v.y}; }

  void develop() {
    compute::Kernel take = kernels().kernel("take_light"), sum = kernels().kernel("sum_light");
    take.run(PAGE_TEXELS * trees_.pages.size(), 64,
             {{"receiver_table", table_},
              {"sums", sums_},
              {"totals", totals_},
              {"film_half", 0u},
              {"kind", 0},
              {"scale", 1.0f},
              {"part", 1.0f},
              {"undivided_only", 0}});
    const std::vector<std::uint32_t>& first = trees_.first_pages;
    for (std::size_t level = first.size() - 1; level-- > 0;) {
      const std::uint32_t count = first[level + 1] - first[level];
      sum.run(count * PAGE_TEXELS, 64,
              {{"receiver_table", table_},
               {"totals", totals_},
               {"film_half", 0u},
               {"kind", 0},
               {"first", first[level]},
               {"count", count}});
    }
  }

  float turn_;
  PageTrees trees_;
  compute::Buffer<int> table_;
  compute::Buffer<std::int64_t> sums_;
  compute::Buffer<float> totals_;
};

/// Charts that are lit from above, below.
constexpr int facing_up = 3, facing_down = 2;

/// Looks that want pages finer and finer towards a place of the chart.
std::vector<shared::DeviceLook> looks_around(glm::vec2 place, int deepest, int chart = facing_up) {
  std::vector<shared::DeviceLook> looks;
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
  for (int level = 0; level <= deepest; ++level)
    for (int i = 0; i < 64; ++i)
      looks.push_back({chart, glm::clamp(place.x + std::ldexp(uniform(engine), -level), 0.f, 0.999f),
                       glm::clamp(place.y + std::ldexp(uniform(engine), -level), 0.f, 0.999f), level});
  return looks;
}

/// Footprints that tile the floor exactly: parallelograms whose edges are those of a turned lattice.
std::vector<Place> tiling(const Floor& floor, float edge, float reach) {
  const glm::vec2 a{edge, 0.3f * edge}, b{-0.2f * edge, 0.8f * edge};
  std::vector<Place> places;
  const int count = static_cast<int>(4 * reach / edge);
  for (int i = -count; i <= count; ++i)
    for (int j = -count; j <= count; ++j) {
      const glm::vec2 middle = float(i) * a + float(j) * b;
      if (std::max(std::abs(middle.x), std::abs(middle.y)) < reach) places.push_back(floor.place(middle, a, b));
    }
  return places;
}
float area_of(float edge) { return edge * 0.8f * edge + 0.3f * edge * 0.2f * edge; }

TEST(Receivers, EvenLightIsEvenWhateverThePages) {
  Floor floor(looks_around({0.37f, 0.61f}, 7));
  ASSERT_GE(floor.trees().first_pages.size(), 8u);
  const float edge = 0.013f, quanta = 1e6f;
  floor.add(tiling(floor, edge, 0.9f), quanta);
  std::vector<Place> looks;
  std::mt19937 engine(2);
  std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
  for (int i = 0; i < 400; ++i) {
    const float size = std::exp2(-10 * (uniform(engine) + 0.5f)) * 0.2f, turn = 6.3f * uniform(engine);
    const glm::vec2 a = size * glm::vec2(std::cos(turn), std::sin(turn)),
                    b = size * (uniform(engine) + 0.6f) * glm::vec2(-std::sin(turn), std::cos(turn) + 0.3f);
    looks.push_back(floor.place({uniform(engine), uniform(engine)}, a, b));
  }
  for (const shared::float4& irradiance : floor.look(looks)) {
    EXPECT_NEAR(irradiance.x, quanta / area_of(edge), 2e-3f * quanta / area_of(edge));
    EXPECT_NEAR(irradiance.y, 2 * irradiance.x, 1e-4f * irradiance.y); // rounded quanta
  }
}

// A window of a wide floor: light is looked at in a thousandth of it.
TEST(Receivers, EvenLightIsEvenInAPartOfAWideFloor) {
  Floor floor(looks_around({0.5f, 0.5f}, 10), 0, 100.2f);
  const float edge = 0.011f, quanta = 1e6f;
  floor.add(tiling(floor, edge, 0.5f), quanta);
  std::vector<Place> looks;
  std::mt19937 engine(2);
  std::uniform_real_distribution<float> uniform(-0.1f, 0.1f);
  for (int i = 0; i < 400; ++i)
    looks.push_back(floor.place({uniform(engine), uniform(engine)}, {0.0125f, 0}, {0, 0.0125f}));
  for (const shared::float4& irradiance : floor.look(looks))
    EXPECT_NEAR(irradiance.x, quanta / area_of(edge), 2e-3f * quanta / area_of(edge));
}

TEST(Receivers, AllLightIsThere) {
  Floor floor(looks_around({0.5f, 0.5f}, 9));
  std::vector<Place> places;
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
  for (int i = 0; i < 1000; ++i) {
    const float size = i % 2 == 0 ? 0 : std::exp2(-16 * (uniform(engine) + 0.5f));
    places.push_back(floor.place({uniform(engine), uniform(engine)}, size * glm::vec2(uniform(engine), uniform(engine)),
                                 size * glm::vec2(uniform(engine), uniform(engine))));
  }
  floor.add(places, 12345.f);
  EXPECT_NEAR(floor.added()[0], 12345.0 * places.size(), 1.0 * places.size()); // rounded shares may lack the last one
  EXPECT_NEAR(floor.added()[1], 24690.0 * places.size(), 2.0 * places.size());
}

TEST(Receivers, APointIsSpreadOverTheFootprintThatHoldsIt) {
  Floor floor(looks_around({0.5f, 0.5f}, 8));
  floor.add({floor.place({0.011f, -0.007f}, {}, {})}, 1e6f);
  const std::vector<shared::float4> irradiance =
      floor.look({floor.place({0, 0}, {0.2f, 0}, {0, 0.2f}), floor.place({0.01f, 0}, {0.3f, 0.3f}, {-0.3f, 0.3f}),
                  floor.place({0.3f, 0.3f}, {0.05f, 0}, {0, 0.05f})});
  EXPECT_NEAR(irradiance[0].x, 1e6f / 0.04f, 1e-4f * irradiance[0].x);
  EXPECT_NEAR(irradiance[1].x, 1e6f / 0.18f, 1e-4f * irradiance[1].x);
  EXPECT_EQ(irradiance[2].x, 0);
}

TEST(Receivers, ATurnedFloorHasTheIrradianceOfALevelOne) {
  const float edge = 0.02f, quanta = 1e6f;
  std::vector<shared::DeviceLook> looks = looks_around({0.5f, 0.5f}, 6, 5);
  const std::vector<shared::DeviceLook> up = looks_around({0.5f, 0.5f}, 6, facing_up);
  looks.insert(looks.end(), up.begin(), up.end());
  for (const float turn : {0.6f, 0.9f}) { // 34 degrees: the chart across y; 52: the one across z
    Floor floor(looks, turn);
    floor.add(tiling(floor, edge, 0.6f), quanta);
    const std::vector<shared::float4> irradiance = floor.look({floor.place({0.1f, 0.2f}, {0.06f, 0}, {0, 0.05f})});
    EXPECT_NEAR(irradiance[0].x, quanta / area_of(edge), 2e-3f * irradiance[0].x) << turn;
  }
}

TEST(Receivers, LightBelowIsNotSeenFromAbove) {
  std::vector<shared::DeviceLook> looks = looks_around({0.5f, 0.5f}, 4),
                                  below = looks_around({0.5f, 0.5f}, 4, facing_down);
  looks.insert(looks.end(), below.begin(), below.end());
  Floor floor(looks);
  floor.add({floor.place({0, 0}, {0.1f, 0}, {0, 0.1f}, -1)}, 1e6f);
  const std::vector<shared::float4> irradiance =
      floor.look({floor.place({0, 0}, {0.04f, 0}, {0, 0.04f}), floor.place({0, 0}, {0.04f, 0}, {0, 0.04f}, -1)});
  EXPECT_EQ(irradiance[0].x, 0);
  EXPECT_NEAR(irradiance[1].x, 1e8f, 1e5f);
}

TEST(Receivers, PagesAreDividedWhereEnoughLooksAsk) {
  const PageTrees few = photons::make_pages(looks_around({0.3f, 0.3f}, 0), 6, 1000);
  EXPECT_EQ(few.pages.size(), 1u);
  const std::vector<shared::DeviceLook> looks = looks_around({0.3f, 0.3f}, 5);
  const PageTrees trees = photons::make_pages(looks, 6, 1000);
  EXPECT_EQ(std::ranges::count_if(trees.roots, [](int root) { return root != NO_PAGE; }), 1);
  for (std::size_t i = 0; i < trees.pages.size(); ++i) {
    const shared::DevicePage& page = trees.pages[i];
    std::size_t asked = 0;
    for (const shared::DeviceLook& look : looks)
      asked += look.level > page.level && std::floor(std::ldexp(look.x, page.level)) == float(page.x) &&
               std::floor(std::ldexp(look.y, page.level)) == float(page.y);
    EXPECT_EQ(page.child != NO_PAGE, asked >= photons::least_looks) << i;
    if (page.parent != NO_PAGE) {
      const shared::DevicePage& parent = trees.pages[static_cast<std::size_t>(page.parent)];
      EXPECT_EQ(page.level, parent.level + 1);
      EXPECT_EQ(static_cast<int>(i), parent.child + 2 * (page.y - 2 * parent.y) + page.x - 2 * parent.x);
    }
  }
  for (const std::size_t most : {1u, 4u, 5u, 21u})
    EXPECT_LE(photons::make_pages(looks, 6, most).pages.size(), most) << most;
}

} // namespace nephroid::receivers_test
