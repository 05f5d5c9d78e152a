// SPDX-License-Identifier: Apache-2.0
// Kernels of facets against the host, which has double precision: the light that facets send, and how the weighted
// squares change with a slope.
#include "inverse/assign/cost.h"
#include "inverse/assign/device_facets.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/light.h"
#include "tests/inverse/searches.h"

namespace nephroid::device_facets_test {

using namespace inverse;

struct Lit {
  const char* what;
  Light light{};
  double sun = 0, scatter = 0, band = 0;
  bool free_heights = false;
  std::vector<glm::dvec2> offsets{};
  bool is_mirror = false;
};
void PrintTo(const Lit& lit, std::ostream* stream) { *stream << lit.what; }

class DeviceFacetsTest : public testing::TestWithParam<Lit> {
protected:
  Layout layout() {
    const Lit& lit = GetParam();
    Layout made{
        .size = {100, 60}, .facets = {32, 20}, .receiver = {90, 80}, .cells = {30, 24}, .distances = {100, 220}};
    made.sun_radius = lit.sun;
    made.scatter = lit.scatter;
    made.free_heights = lit.free_heights;
    if (!lit.offsets.empty()) made.offsets = lit.offsets;
    if (lit.is_mirror) {
      made.n = mirror_index;
      made.steepest = steepest_mirror;
    }
    if (lit.band > 0) made.spectrum = test::band(made.n, lit.band);
    for (std::size_t i = 0; i < made.parts().size(); ++i)
      made.spectrum->parts[i].xyz *= 2 * (static_cast<double>(i) + 0.5) / 400;
    made.light = make_illumination(made, lit.light, "light");
    return made;
  }

  /// Towards places on the last receiver, and beside it.
  static std::vector<glm::dvec2> slopes(const Layout& layout) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-0.6, 0.6);
    std::vector<glm::dvec2> made;
    for (std::size_t i = 0; i < layout.facet_count(); ++i) {
      const glm::dvec2 to = glm::dvec2(uniform(random), uniform(random)) * layout.receiver;
      made.push_back(nearest_reachable((to - layout.middle(i)) / layout.distances.back(), layout.n, layout.sines_on(i),
                                       layout.steepest));
    }
    return made;
  }

  std::vector<double> heights(const Layout& layout) {
    std::vector<double> made(layout.facet_count());
    for (std::size_t i = 0; i < made.size() && GetParam().free_heights; ++i)
      made[i] = 5 * std::sin(static_cast<double>(i));
    return made;
  }
};

TEST_P(DeviceFacetsTest, SendTheirLightAsTheHostSays) {
  const Layout l = layout();
  const std::vector<Target> targets = ring_and_disc(l);
  DeviceFacets facets(test::shared_context(), l, targets, picture_weights(l, targets));
  const std::vector<double> z = heights(l);
  facets.put(slopes(l), z);
  const std::vector<std::vector<double>> truth = light_of_all(l, facets.slopes(), z), light = facets.light();
  for (const std::size_t j : {0u, 1u}) {
    double apart = 0, all = 0;
    for (std::size_t c = 0; c < l.cell_count(); ++c) {
      apart += std::abs(light[j][c] - truth[j][c]);
      all += truth[j][c];
    }
    EXPECT_GT(all, 200);
    EXPECT_LT(apart / all, 1e-4) << j;
  }
}

// Every seventh facet is turned a little; differences of the host's sum. Where the edge of a sharp beam meets that of a
// cell they are inexact: a narrow sun's beams, which have no such edges, are within .005.
TEST_P(DeviceFacetsTest, KnowTheGradient) {
  const Layout l = layout();
  const std::vector<Target> targets = ring_and_disc(l);
  const std::vector<double> weights = picture_weights(l, targets), z = heights(l);
  DeviceFacets facets(test::shared_context(), l, targets, weights);
  facets.put(slopes(l), z);
  const std::vector<glm::dvec2> all = facets.slopes(), gradient = facets.gradient();
  const std::vector<std::vector<double>> light = light_of_all(l, all, z);
  double apart = 0, norm = 0;
  for (std::size_t i = 0; i < all.size(); i += 7)
    for (int axis = 0; axis < 2; ++axis) {
      const double h = 0.02 * l.cell()[axis] / l.distances.back();
      double sum[2];
      for (const int side : {0, 1}) {
        glm::dvec2 slope = all[i];
        slope[axis] += side == 0 ? -h : h;
        std::vector<std::vector<double>> there = light;
        add_light(l, i, all[i], -1, there, z[i]);
        add_light(l, i, slope, 1, there, z[i]);
        sum[side] = weighted_squares(targets, weights, there, l.facet_count());
      }
      const double truth = (sum[1] - sum[0]) / (2 * h), found = gradient[i][axis];
      apart += (found - truth) * (found - truth);
      norm += truth * truth;
    }
  EXPECT_GT(norm, 0);
  EXPECT_LT(std::sqrt(apart / norm), 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Lights, DeviceFacetsTest,
    testing::Values(
        Lit{.what = "straight"}, Lit{.what = "tilted", .light = {.tilt_deg = 20, .turn_deg = 30}},
        Lit{.what = "lamp", .light = {.type = Light::Type::point, .distance_mm = 300, .offset_mm = {20, 10}}},
        Lit{.what = "rectangle",
            .light = {.type = Light::Type::area,
                      .distance_mm = 300,
                      .offset_mm = {20, 10},
                      .shape = Light::Shape::rectangle,
                      .size_mm = {40, 5}}},
        Lit{.what = "rough, disc",
            .light = {.type = Light::Type::area, .distance_mm = 300, .size_mm = {20, 40}},
            .scatter = 0.01},
        Lit{.what = "rectangle and band",
            .light =
                {.type = Light::Type::area, .distance_mm = 300, .shape = Light::Shape::rectangle, .size_mm = {15, 30}},
            .band = 0.06},
        Lit{.what = "sun", .sun = 0.03}, Lit{.what = "narrow sun", .sun = 0.004}, Lit{.what = "rough", .scatter = 0.01},
        Lit{.what = "band", .band = 0.06},
        Lit{.what = "tilted sun and band", .light = {.tilt_deg = 15}, .sun = 0.03, .band = 0.06},
        Lit{.what = "free heights", .free_heights = true},
        Lit{.what = "receivers aside", .offsets = {{-30, 10}, {25, -20}}},
        Lit{.what = "mirror", .sun = 0.004, .is_mirror = true},
        Lit{.what = "tilted mirror", .light = {.tilt_deg = 20, .turn_deg = 30}, .sun = 0.004, .is_mirror = true},
        Lit{.what = "mirror and lamp",
            .light = {.type = Light::Type::area, .distance_mm = 300, .size_mm = {20, 40}},
            .is_mirror = true}));

} // namespace nephroid::device_facets_test
