// SPDX-License-Identifier: Apache-2.0
// The tables that engine 1 hands to its kernels: targets that enclose, sums over wavelength, cdfs exact to the bit,
// which wavelengths glass and mirrors take alike; and the plan's reasons.
#include "optics/spectrum.h"
#include "photons/clusters/scene_clusters.h"
#include "scene/ray.h"
#include "spectral/settings.h"
#include "tests/support/plans.h"
#include "tracing/scales.h"
#include "tracing/targets.h"

namespace nephroid::device_scene_test {

using nephroid::exact_cdf;
using nephroid::exact_cdf_from_zero;
using namespace nephroid::photons;

preset::Preset scene_with(const preset::Shape& shape, const preset::Material& material) {
  preset::Preset p = empty_preset();
  p.scene.materials["thing"] = material;
  p.scene.materials["white"] = white(0.5);
  p.scene.objects = {object("thing", shape, "thing"), object("floor", quad(10, 10), "white", at({0, -2, 0}))};
  preset::Light light{.position = {0, 5, 0}};
  p.scene.lights = {light};
  spectral::settings(p).direct = true;
  return p;
}

void expect_enclosed(const scene::Scene& scene, const std::vector<scene::Sphere>& spheres) {
  const scene::Object& thing = scene.objects[0];
  for (std::uint32_t t = thing.first_triangle; t < thing.first_triangle + thing.triangle_count; ++t) {
    bool enclosed = false;
    for (const scene::Sphere& s : spheres) {
      bool all = true;
      for (int corner = 0; corner < 3; ++corner)
        all = all && glm::length(scene.geometry.positions[scene.geometry.triangles[t][corner]] - s.centre) <=
                         s.radius * 1.000001f;
      enclosed = enclosed || all;
    }
    ASSERT_TRUE(enclosed) << "triangle " << t;
  }
  for (const scene::Ellipsoid& e : ellipsoids_of(scene, thing))
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 u = scene::even_direction(i, 500);
      const glm::dvec3 p = glm::dvec3(e.centre) + u.x * glm::dvec3(e.half_axes[0]) + u.y * glm::dvec3(e.half_axes[1]) +
                           u.z * glm::dvec3(e.half_axes[2]);
      EXPECT_TRUE(std::ranges::any_of(
          spheres, [&](const auto& s) { return glm::distance(p, glm::dvec3(s.centre)) <= s.radius * 1.000001; }));
    }
}

TEST(Targets, ABallIsOneAndARodIsMany) {
  preset::Shape ball;
  const scene::Scene round = scene::load_scene(scene_with(ball, glass(1.5)));
  EXPECT_EQ(tracing::caustic_targets(round).size(), 1u);
  expect_enclosed(round, tracing::caustic_targets(round));

  preset::Shape rod{.type = preset::Shape::Type::sphere};
  preset::Preset p = scene_with(rod, glass(1.5));
  p.scene.objects[0].transform.scale = {1, 8, 1};
  const scene::Scene scene = scene::load_scene(p);
  const std::vector<scene::Sphere> spheres = tracing::caustic_targets(scene);
  EXPECT_GE(spheres.size(), 4u);
  EXPECT_LE(spheres.size(), tracing::max_targets);
  expect_enclosed(scene, spheres);
  EXPECT_LT(tracing::mean_shadow(spheres), 0.5 * M_PI * 4 * 4); // of the one sphere about it, radius 4
}

TEST(Targets, TheShadowOfSpheresInAClosedForm) {
  EXPECT_NEAR(tracing::mean_shadow({{{0, 0, 0}, 2}}), 4 * M_PI, 1e-9);
  EXPECT_NEAR(tracing::mean_shadow({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}}), M_PI, 1e-6);
  // Two unit spheres touching: the shadow along the line that joins them is one disc, across it two. For the angle t to
  // that line the discs' distance is d = 2 sin t and their union 2 pi - 2 acos(d / 2) + (d / 2) sqrt(4 - d^2); averaged
  // over the sphere by quadrature.
  double mean = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double c = (i + 0.5) / steps, d = 2 * std::sqrt(1 - c * c);
    mean += (2 * M_PI - 2 * std::acos(d / 2) + d / 2 * std::sqrt(4 - d * d)) / steps;
  }
  EXPECT_NEAR(tracing::mean_shadow({{{0, 0, -1}, 1}, {{0, 0, 1}, 1}}) / mean, 1, 0.02);
}

TEST(WavelengthTables, AddUpToTheWholeSpectrum) {
  preset::Material coloured = glass(1.5);
  coloured.dispersion.type = preset::Dispersion::Type::cauchy;
  coloured.dispersion.coefficients = {1.5, 0.01};
  const preset::Preset p = scene_with({}, coloured);
  const scene::Scene scene = scene::load_scene(p);
  const photons::RunTables tables = tables_of(p);
  const tracing::WavelengthTables& w = tables.wavelengths;
  EXPECT_GT(w.clusters.size(), 3u);
  EXPECT_EQ(w.cluster_wavelengths.size(), 401u);
  EXPECT_NEAR(std::accumulate(w.share[0].begin(), w.share[0].end(), 0.0), 1, 1e-12);
  const optics::Colour truth = optics::to_xyz(optics::illuminant("D65")); // times the reflectance .5
  double y = 0;
  for (std::size_t c = 0; c < w.clusters.size(); ++c)
    y += w.reflected_xyz[c * static_cast<std::size_t>(w.reflector_count)].y;
  EXPECT_NEAR(y, 0.5 * truth[1], 1e-6);
  EXPECT_NEAR(w.reflected_xyz_all[0].y, 0.5 * truth[1], 1e-7);
  EXPECT_EQ(w.cluster_cdf.front(), 0);
  EXPECT_EQ(w.cluster_cdf.back(), 1);
  EXPECT_TRUE(std::is_sorted(w.cluster_cdf.begin(), w.cluster_cdf.end()));
  EXPECT_FALSE(w.takes_light);
  // Every index of refraction is the mean of its cluster.
  for (std::size_t c = 0; c < w.clusters.size(); ++c) {
    double mean = 0;
    for (const int i : w.clusters[c])
      mean += scene.materials[0].n[static_cast<std::size_t>(i)] / static_cast<double>(w.clusters[c].size());
    EXPECT_NEAR(w.index_of_cluster[c * scene.materials.size()], mean, 1e-6);
  }
}

TEST(WavelengthTables, AMirrorOfOneTakesNoLightAndABlackOneDoes) {
  preset::Material mirror;
  mirror.type = preset::Material::Type::mirror;
  mirror.reflectance.value = 1;
  preset::Preset p = scene_with({}, mirror);
  EXPECT_FALSE(tables_of(p).wavelengths.takes_light);
  p.scene.materials["thing"].reflectance.value = 0;
  const tracing::WavelengthTables w = tables_of(p).wavelengths;
  EXPECT_TRUE(w.takes_light);
  EXPECT_FALSE(w.colours_light);
  EXPECT_EQ(w.coefficient[0], 200); // exp(-200) is 0 in single precision
}

// Balls around one another: a path can carry MEDIA_DEPTH of them.
TEST(RunTables, RefuseMoreMediaThanAPathCanCarry) {
  preset::Preset p = scene_with({}, glass(1.5));
  p.source = "p.json";
  p.scene.camera.position = {0, 0, 0.1};
  p.scene.objects.clear();
  for (int i = 0; i < MEDIA_DEPTH; ++i) {
    p.scene.objects.push_back(object("", preset::Shape{}, "thing"));
    p.scene.objects.back().transform.scale = {1.0 + i, 1.0 + i, 1.0 + i};
  }
  EXPECT_NE(tables_of(p).camera.inside.earlier >> (64 - MEDIUM_BITS), 0u); // the list is full
  p.scene.objects.push_back(object("", preset::Shape{}, "thing"));
  const auto refusal = [&p] { return refusal_of([&p] { tables_of(p); }); };
  EXPECT_THAT(refusal(),
              StartsWith("p.json#/scene/camera/position: is inside 9 dielectric objects; expected at most 8"));
  p.scene.camera.position = {0, 0, 20};
  p.scene.lights[0].position = {0, 0, 0.1};
  EXPECT_THAT(refusal(), StartsWith("p.json#/scene/lights/0/position: is inside 9 dielectric objects"));
}

bool planned_to_run(const plan::Plan& plan, const std::string& name, std::string* reason = nullptr) {
  for (const plan::Decision& pass : plan.decisions)
    if (pass.name == name) {
      if (reason) *reason = pass.reason;
      return pass.runs;
    }
  ADD_FAILURE() << "no pass " << name;
  return false;
}

TEST(SpectralPlan, LeavesOutWhatASceneDoesNotNeedAndSaysWhy) {
  preset::Preset p = scene_with({}, glass(1.5));
  EXPECT_TRUE(planned_to_run(plan_of(p), "photons"));
  EXPECT_TRUE(planned_to_run(plan_of(p), "direct"));
  EXPECT_FALSE(planned_to_run(plan_of(p), "mirrors"));
  EXPECT_EQ(plan_of(p).defines.at("NEPHROID_MATERIALS"),
            std::to_string(1 << MATERIAL_DIFFUSE | 1 << MATERIAL_DIELECTRIC));
  std::string reason;
  spectral::settings(p).caustic = false;
  EXPECT_FALSE(planned_to_run(plan_of(p), "photons", &reason));
  EXPECT_EQ(reason, "spectral.caustic is false");
  p = scene_with({}, white());
  EXPECT_FALSE(planned_to_run(plan_of(p), "photons", &reason));
  EXPECT_EQ(reason, "no object is of glass or a mirror");
  p = scene_with({}, glass(1.5));
  p.scene.lights[0].power_w = 0;
  EXPECT_FALSE(planned_to_run(plan_of(p), "photons", &reason)) << reason;
  p.scene.lights.clear();
  EXPECT_FALSE(planned_to_run(plan_of(p), "direct", &reason));
  EXPECT_EQ(reason, "the scene has no light");
}

TEST(SpectralPlan, SaysWhenAPassNeedsMorePhotons) {
  preset::Preset p = scene_with({}, glass(1.5));
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  spectral::settings(p).photons_per_pass = 1;
  EXPECT_THAT(plan_of(p).notes, Contains(HasSubstr("raised from 1 to 401")));
}

TEST(SpectralPlan, SaysThatStepsDoNothingWithoutBruteForce) {
  preset::Preset p = scene_with({}, glass(1.5));
  EXPECT_THAT(plan_of(p).notes, IsEmpty());
  spectral::settings(p).step_nm = 4;
  EXPECT_THAT(
      plan_of(p).notes,
      ElementsAre("spectral.step_nm: 4 does nothing here: spectral.method is optimal, and only brute_force has steps"));
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  EXPECT_THAT(plan_of(p).notes, IsEmpty());
}

TEST(ExactCdf, IsInProportion) {
  EXPECT_THAT(exact_cdf({1}), ElementsAre(1));
  const std::vector<float> cdf = exact_cdf({1, 3, 4});
  EXPECT_NEAR(cdf[0], 0.125, 0x1p-22); // a quantum each off, at most
  EXPECT_NEAR(cdf[1], 0.5, 0x1p-22);
  EXPECT_EQ(cdf[2], 1);
}

// Weights over 24 orders of magnitude: every difference is a whole number of 2^-24, 0 only where the weight is.
TEST(ExactCdf, LosesNothingInRounding) {
  std::vector<double> weights(401);
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] = i % 7 == 3 ? 0 : std::pow(10.0, -static_cast<double>(i % 25));
  const std::vector<float> cdf = exact_cdf(weights);
  ASSERT_EQ(cdf.size(), weights.size());
  float before = 0;
  for (std::size_t i = 0; i < cdf.size(); ++i) {
    const double quanta = std::ldexp(static_cast<double>(cdf[i]), 24);
    EXPECT_EQ(quanta, std::round(quanta)) << i;
    if (weights[i] > 0)
      EXPECT_GE(cdf[i] - before, 0x1p-24f) << i;
    else
      EXPECT_EQ(cdf[i], before) << i;
    before = cdf[i];
  }
  EXPECT_EQ(cdf.back(), 1);
}

TEST(ExactCdf, OfNothingIsEven) {
  EXPECT_THAT(exact_cdf({0, 0, 0, 0}), ElementsAre(0.25, 0.5, 0.75, 1));
  EXPECT_TRUE(exact_cdf({}).empty());
}

TEST(ExactCdf, FromZeroHasOneMore) {
  EXPECT_THAT(exact_cdf_from_zero({0, 2}), ElementsAre(0, 0, 1));
  EXPECT_THAT(exact_cdf_from_zero({}), ElementsAre(0));
}

double searched_difference(double a, double b, double longest) {
  double most = 0;
  constexpr int steps = 200'000;
  for (int i = 0; i <= steps; ++i) {
    const double s = longest * std::pow(double(i) / steps, 4); // fine near 0, where much is absorbed
    most = std::max(most, std::abs(std::exp(-a * s) - std::exp(-b * s)));
  }
  return most;
}

TEST(Losses, TheLargestDifferenceIsWhatASearchFinds) {
  for (const auto& [a, b, longest] : {std::array{0.0, 3.0, 0.5},
                                      {3.0, 0.0, 0.5},
                                      {1.0, 2.0, 10.0},
                                      {2.0, 1.0, 0.1},
                                      {5.0, 5.0, 1.0},
                                      {1e-3, 1e4, 2.0},
                                      {100.0, 101.0, 3.0}})
    EXPECT_NEAR(largest_difference(a, b, longest), searched_difference(a, b, longest), 1e-6)
        << a << " " << b << " " << longest;
  // Twice as much: exp(-s) - exp(-2 s) is 1/4 at s = ln 2.
  EXPECT_DOUBLE_EQ(largest_difference(1, 2, 10), 0.25);
}

/// A ball of glass, 0.1 m across, from clear at 380 nm to opaque at 780 nm, or a mirror from white to black.
scene::Scene dyed_scene(const fs::path& folder, bool mirror) {
  preset::Preset p = test::empty_preset(4);
  preset::Shape ball{.radius = 0.05};
  preset::Material& material = p.scene.materials["dye"] = mirror ? check::mirror(0.5) : test::glass(1.5);
  if (mirror) {
    material.reflectance.type = preset::Reflectance::Type::table;
    material.reflectance.table = {{380, 1}, {780, 0}};
  } else {
    std::ofstream(folder / "dye.yml")
        << "DATA:\n  - type: tabulated nk\n    data: |\n        0.38 1.5 0\n        0.78 1.5 1e-4\n";
    material.absorption = true;
    material.dispersion.type = preset::Dispersion::Type::file;
    material.dispersion.file = (folder / "dye.yml").string();
  }
  p.scene.objects = {test::object("ball", ball, "dye")};
  return scene::load_scene(p);
}

TEST(Losses, PartsKeepTheBoundAndAreTheFewest) {
  const test::TemporaryFolder folder;
  for (const bool mirror : {false, true}) {
    const scene::Scene scene = dyed_scene(folder.path(), mirror);
    // The box about a ball of 0.1 m has a diagonal of 0.1 sqrt(3) m.
    const double longest = mirror ? 8 : 0.2 * std::sqrt(3.0), most = 0.1;
    const std::vector<double> a =
        mirror ? scatter::loss_at_surface(scene.materials[0]) : scatter::loss_inside(scene.materials[0]);
    ASSERT_EQ(a.size(), static_cast<std::size_t>(optics::wavelength_count));
    std::vector<int> all(a.size());
    std::iota(all.begin(), all.end(), 0);
    const auto parts = split_by_losses({all}, scene, 8, most);
    std::vector<int> found;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      found.insert(found.end(), parts[i].begin(), parts[i].end());
      const auto of = [&](int w) { return a[static_cast<std::size_t>(w)]; };
      EXPECT_LE(largest_difference(of(parts[i].front()), of(parts[i].back()), longest), most);
      // Both curves fall in one direction: the next part's first wavelength would not have fitted.
      if (i > 0) {
        EXPECT_GT(largest_difference(of(parts[i - 1].front()), of(parts[i].front()), longest * 1.001), most);
      }
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, all);
    EXPECT_GT(parts.size(), 8u);
    EXPECT_LT(parts.size(), 100u);
  }
}

TEST(Losses, ClearGlassAndWhiteMirrorsSplitNothing) {
  preset::Preset p = test::empty_preset(4);
  p.scene.materials["glass"] = test::glass(1.5);
  p.scene.materials["mirror"] = check::mirror(1);
  p.scene.objects = {test::object("ball", preset::Shape{}, "glass"), test::object("wall", test::quad(1, 1), "mirror")};
  const std::vector<std::vector<int>> clusters = {{0, 2}, {1}};
  EXPECT_EQ(split_by_losses(clusters, scene::load_scene(p), 8, 0.01), clusters);
}

} // namespace nephroid::device_scene_test
