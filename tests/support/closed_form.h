// SPDX-License-Identifier: Apache-2.0
// Comparing what was rendered with a closed form: each comparison leaves a row (figure, truth, tolerance) among the
// test's properties, from which the table of closed forms in the docs is made; and the noise of photons, which says how
// far off a picture may be.
#pragma once
#include "optics/spectrum.h"
#include "tests/support/render.h"
#include "tests/support/statistics.h"
#include "tracing/targets.h"

namespace nephroid::test {

inline constexpr double degree = std::numbers::pi / 180;

/// This many standard deviations: a normal distribution is farther off in one of 10^9 cases.
inline constexpr double sigmas = 6.2;

/// A row of the table of closed forms, as a property of the running test.
inline void record(const std::string& what, double figure, double truth, double tolerance) {
  char row[160];
  std::snprintf(row, sizeof row, "%.7g | %.7g | %.2g | %.2g", figure, truth, std::abs(figure - truth), tolerance);
  testing::Test::RecordProperty(what, row);
}

inline void expect_truth(const std::string& what, double figure, double truth, double tolerance) {
  record(what, figure, truth, tolerance);
  EXPECT_NEAR(figure, truth, tolerance) << what;
}

/// A share of `count` independent photons of equal power: within its binomial standard error and a stated error of the
/// scene itself.
inline void expect_share(const std::string& what, double figure, double truth, double count, double bias = 0) {
  expect_truth(what, figure, truth, sigmas * std::sqrt(std::max(truth * (1 - truth), 1 / count) / count) + bias);
}

/// A square of a horizontal plane, and a camera that looks straight down on it: every pixel is a square of the plane.
/// Rows run along +z, columns along +x.
struct Screen {
  preset::Vec3 centre{0, 0, 0};
  double side = 1;
  int pixels = 64;

  double pixel_side() const { return side / pixels; }
  double pixel_area() const { return pixel_side() * pixel_side(); }
  std::size_t count() const { return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels); }
  double x(int column) const { return centre[0] + (column + 0.5) * pixel_side() - side / 2; }
  double z(int row) const { return centre[2] + (row + 0.5) * pixel_side() - side / 2; }
  /// Adds to the pixel that holds (x, z), where there is one.
  void add(std::vector<double>& picture, double at_x, double at_z, double value) const {
    const double column = (at_x - centre[0] + side / 2) / pixel_side(),
                 row = (at_z - centre[2] + side / 2) / pixel_side();
    if (!(column >= 0 && row >= 0 && column < pixels && row < pixels)) return;
    picture[static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels) + static_cast<std::size_t>(column)] +=
        value;
  }
  void fill(preset::Camera& camera, double height) const {
    camera = {.position = {centre[0], centre[1] + height, centre[2]},
              .target = centre,
              .up = {0, 0, -1},
              .fov_deg = 2 * std::atan(side / 2 / height) / degree,
              .resolution = {pixels, pixels}};
  }
};

/// Y of every pixel of a layer.
inline std::vector<double> luminance(const job::Layer& picture) {
  std::vector<double> y(picture.rgb.size() / 3);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = optics::linear_srgb_to_xyz({picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]})[1];
  return y;
}

/// W that reach every pixel's square of a white screen, from its radiance, which is irradiance / pi.
inline std::vector<double> watts(const job::Snapshot& snapshot, const std::string& name, const Screen& screen,
                                 const optics::Spectrum& light) {
  std::vector<double> power = luminance(layer(snapshot, name));
  const double y_of_a_watt = optics::to_xyz(light)[1];
  for (double& w : power) w *= std::numbers::pi * screen.pixel_area() / y_of_a_watt;
  return power;
}

/// A tabulated dispersion file of one n and one k at all wavelengths.
inline std::string write_constant_nk(const fs::path& file, double n, double k) {
  std::ofstream(file) << "DATA:\n  - type: tabulated nk\n    data: |\n        0.3 " << n << " " << k << "\n        0.9 "
                      << n << " " << k << "\n";
  return file.string();
}

/// Parallel light of 1 W/m^2 and 550 nm.
inline preset::Light parallel_light(const preset::Vec3& direction) {
  return {.type = preset::Light::Type::directional, .spectrum = line(550), .direction = direction};
}
inline optics::Spectrum spectrum_of(const preset::Light& light) { return optics::light_lines(light.spectrum.table); }

/// The most that a photon of a directional light of 1 W/m^2 carries, of `count`: in the largest target, as if no other
/// overlapped it. Half of the photons go to the targets' shadows by size, and half to all alike.
inline double directional_photon_w(const preset::Preset& preset, double count) {
  double sum = 0, largest = 0;
  const std::vector<scene::Sphere> targets = tracing::caustic_targets(scene::load_scene(preset));
  for (const scene::Sphere& s : targets) {
    const double square_metres = std::numbers::pi * s.radius * s.radius;
    sum += square_metres;
    largest = std::max(largest, square_metres);
  }
  const double alike = static_cast<double>(targets.size()) * largest;
  return 2 / (1 / sum + 1 / alike) / count;
}

/// How a picture compares with its truth where photons carry at most `photon_w`. A pixel that expects W watts then has
/// at most the variance W photon_w: that of a Poisson count, times photon_w^2.
struct Agreement {
  double p = 1;        ///< the p-value of the worst pixel or of the sum, whichever is worse, after Bernstein and Sidak
  double mean_z2 = 0;  ///< the pixels' mean: about 1 where all photons carry as much, less where some carry less
  double z2_error = 0; ///< standard error of mean_z2: a Poisson count of mean m has z^2 of variance 2 + 1 / m
  double ratio = 1;    ///< the ratio of the sums
  double error = 0;    ///< standard error of the ratio
  int pixels = 0;
};

/// truth_error: what the truth's own quadrature may be off by, as a share. used: pixels to look at; empty: all.
inline Agreement agreement(const std::vector<double>& figure, const std::vector<double>& truth, double photon_w,
                           double truth_error = 0, const std::vector<bool>& used = {}) {
  Agreement result;
  double worst = 1, sum_figure = 0, sum_truth = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!used.empty() && !used[i]) continue;
    const double off = std::max(std::abs(figure[i] - truth[i]) - truth_error * truth[i], 0.0);
    worst = std::min(worst, bernstein(off, truth[i] * photon_w, photon_w));
    if (truth[i] > 0) {
      result.mean_z2 += off * off / (truth[i] * photon_w);
      result.z2_error += 2 + photon_w / truth[i];
    }
    sum_figure += figure[i];
    sum_truth += truth[i];
    ++result.pixels;
  }
  result.mean_z2 /= result.pixels;
  result.z2_error = std::sqrt(result.z2_error) / result.pixels;
  result.ratio = sum_figure / sum_truth;
  result.error = std::sqrt(photon_w / sum_truth);
  const double off = std::max(std::abs(sum_figure - sum_truth) - truth_error * sum_truth, 0.0);
  worst = std::min(worst, bernstein(off, sum_truth * photon_w, photon_w));
  result.p = sidak(worst, result.pixels + 1);
  return result;
}

/// The picture is the truth within its noise: no pixel and not the sum is farther off than chance allows.
inline void expect_agreement(const std::string& what, const Agreement& a, double truth_error = 0) {
  record(what + ": power in all", a.ratio, 1, sigmas * a.error + truth_error);
  record(what + ": mean z^2 of pixels, at most", a.mean_z2, 1, 2 * sigmas * a.z2_error);
  EXPECT_LT(a.mean_z2, 1 + 2 * sigmas * a.z2_error) << what; // skewed, so twice as far as a normal distribution goes
  EXPECT_GT(a.p, false_alarm) << what << ": " << a.ratio << " of the power, mean z^2 " << a.mean_z2 << " over "
                              << a.pixels << " pixels";
}

} // namespace nephroid::test
