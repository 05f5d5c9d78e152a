// SPDX-License-Identifier: Apache-2.0
// Extreme settings of clusters, maps and lights compared by the colour of one caustic: which way it is estimated must
// not matter.
#pragma once
#include "spectral/settings.h"
#include "tests/support/extremes.h"
#include "tests/support/passes.h"

namespace nephroid::test {

/// A dispersing ball above the camera, so that it is not seen, and its caustic on the floor; the picture is 4 m of it.
/// 2^18 photons.
inline preset::Preset caustic_of_ball(int pixels = 16) {
  preset::Preset p = lit_floor(pixels);
  Screen{{0, 0, 0}, 4, pixels}.fill(p.scene.camera, 2);
  spectral::settings(p).direct = false;
  p.scene.lights[0].spectrum = {};
  p.scene.lights[0].position = {0, 6, 0};
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::cauchy;
  p.scene.materials["glass"].dispersion.coefficients = {1.5, 0.01};
  p.scene.objects.push_back(object("ball", sphere(0.1), "glass", at({0, 3, 0})));
  p.scene.objects.back().normals = preset::Object::Normals::smooth;
  spectral::settings(p).photons_per_pass = 1 << 13;
  p.stop.passes = 32;
  return p;
}

/// Mean X, Y and Z of a layer.
inline std::vector<double> mean_xyz(const job::Snapshot& snapshot, const std::string& name) {
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  const std::vector<float>& rgb = layer(snapshot, name).rgb;
  optics::Colour sum{};
  for (std::size_t i = 0; i < rgb.size(); ++i) sum[i % 3] += rgb[i] / (static_cast<double>(rgb.size()) / 3);
  const optics::Colour xyz = optics::linear_srgb_to_xyz(sum);
  return {xyz.begin(), xyz.end()};
}

/// With its error from the scatter of passes.
inline std::vector<Estimate> colour_by_passes(const preset::Preset& p, const std::string& name = "caustic") {
  return render_passes(p, [&](const job::Snapshot& snapshot) { return mean_xyz(snapshot, name); });
}

/// The same from the scatter of whole runs, for those whose passes hang on each other.
inline std::vector<Estimate> colour_by_runs(preset::Preset p, int runs, const std::string& name = "caustic") {
  std::vector<Estimate> estimates(3);
  std::vector<std::vector<double>> all;
  for (p.seed = 1000; static_cast<int>(all.size()) < runs; ++p.seed) all.push_back(mean_xyz(render(p), name));
  for (std::size_t c = 0; c < 3; ++c) {
    for (const auto& one : all) estimates[c].mean += one[c] / runs;
    for (const auto& one : all)
      estimates[c].variance += std::pow(one[c] - estimates[c].mean, 2) / (double(runs) * (runs - 1));
    estimates[c].degrees = runs - 1;
  }
  return estimates;
}

/// Y over the true Y. X, Y and Z have to agree within their noise and within a share `bias` of the truth.
inline Outcome same_colour(const std::vector<Estimate>& gave, const std::vector<Estimate>& truth, double bias = 0) {
  Outcome outcome;
  for (const std::size_t c : {0u, 2u, 1u}) {
    const Estimate difference{gave[c].mean - truth[c].mean, gave[c].variance + truth[c].variance,
                              std::min(gave[c].degrees, truth[c].degrees)};
    const Outcome one = near(gave[c].mean / truth[c].mean, 1, tolerance(difference) / truth[c].mean + bias);
    outcome = {one.gave, one.right, outcome.good && one.good};
  }
  return outcome;
}

} // namespace nephroid::test
