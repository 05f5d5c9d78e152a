// SPDX-License-Identifier: Apache-2.0
// Which wavelengths glass and mirrors take alike: the bound against a search, and that parts keep it and are as few as can be.
#include "scene/scene.h"
#include "spectral/clusters/clusters.h"
#include "tests/support/presets.h"
#include "tests/support/temporary_folder.h"
#include "tracing/wavelength_tables.h"

namespace nephroid::losses_test {

using namespace nephroid::spectral;

double searched_difference(double a, double b, double longest)
{
  double most = 0;
  constexpr int steps = 200'000;
  for (int i = 0; i <= steps; ++i) {
    const double s = longest * std::pow(double(i) / steps, 4); // fine near 0, where much is absorbed
    most = std::max(most, std::abs(std::exp(-a * s) - std::exp(-b * s)));
  }
  return most;
}

TEST(Losses, TheLargestDifferenceIsWhatASearchFinds)
{
  for (const auto& [a, b, longest] : {std::array{0.0, 3.0, 0.5},
                                      {3.0, 0.0, 0.5},
                                      {1.0, 2.0, 10.0},
                                      {2.0, 1.0, 0.1},
                                      {5.0, 5.0, 1.0},
                                      {1e-3, 1e4, 2.0},
                                      {100.0, 101.0, 3.0}})
    EXPECT_NEAR(largest_difference(a, b, longest), searched_difference(a, b, longest), 1e-6) << a << " " << b << " " << longest;
  // Twice as much: exp(-s) - exp(-2 s) is 1/4 at s = ln 2.
  EXPECT_DOUBLE_EQ(largest_difference(1, 2, 10), 0.25);
}

/// A ball of glass, 0.1 m across, from clear at 380 nm to opaque at 780 nm, or a mirror from white to black.
scene::Scene dyed_scene(const std::filesystem::path& folder, bool mirror)
{
  preset::Preset p = test::empty_preset(4);
  preset::Shape ball;
  ball.radius = 0.05;
  preset::Material& material = p.scene.materials["dye"] = mirror ? check::mirror(0.5) : test::glass(1.5);
  if (mirror) {
    material.reflectance.type = preset::Reflectance::Type::table;
    material.reflectance.table = {{380, 1}, {780, 0}};
  } else {
    std::ofstream(folder / "dye.yml") << "DATA:\n  - type: tabulated nk\n    data: |\n        0.38 1.5 0\n        0.78 1.5 1e-4\n";
    material.absorption = true;
    material.dispersion.type = preset::Dispersion::Type::file;
    material.dispersion.file = (folder / "dye.yml").string();
  }
  p.scene.objects = {test::object("ball", ball, "dye")};
  return scene::load_scene(p);
}

TEST(Losses, PartsKeepTheBoundAndAreTheFewest)
{
  const test::TemporaryFolder folder;
  for (const bool mirror : {false, true}) {
    const scene::Scene scene = dyed_scene(folder.path(), mirror);
    // The box about a ball of 0.1 m has a diagonal of 0.1 sqrt(3) m.
    const double longest = mirror ? 8 : 0.2 * std::sqrt(3.0), most = 0.1;
    const std::vector<double> a = tracing::loss_coefficients(scene.materials[0]);
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

TEST(Losses, ClearGlassAndWhiteMirrorsSplitNothing)
{
  preset::Preset p = test::empty_preset(4);
  p.scene.materials["glass"] = test::glass(1.5);
  p.scene.materials["mirror"] = check::mirror(1);
  p.scene.objects = {test::object("ball", preset::Shape{}, "glass"), test::object("wall", test::quad(1, 1), "mirror")};
  const std::vector<std::vector<int>> clusters = {{0, 2}, {1}};
  EXPECT_EQ(split_by_losses(clusters, scene::load_scene(p), 8, 0.01), clusters);
}

} // namespace nephroid::losses_test
