// SPDX-License-Identifier: Apache-2.0
#include "optics/primary_reflectances.h"

#include "base/error.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "optics/tables.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace nephroid::optics {
namespace {

using Numbers = Eigen::Matrix<double, 6, 1>;

/// Each is exp(q_i) / (exp(q_red) + exp(q_green) + exp(q_blue)), where q_red and q_green are parabolas over the
/// wavelength and q_blue is 0: they are within 0..1, and their sum is 1.
std::array<Spectrum, 3> spectra_of(const Numbers& parabolas) {
  std::array<Spectrum, 3> spectra{};
  for (std::size_t w = 0; w < wavelength_count; ++w) {
    const double x = (static_cast<double>(w) - 200) / 200;
    std::array<double, 3> q{};
    for (Eigen::Index i = 0; i < 2; ++i)
      q[static_cast<std::size_t>(i)] = parabolas[3 * i] + x * (parabolas[3 * i + 1] + x * parabolas[3 * i + 2]);
    const double largest = std::ranges::max(q);
    double sum = 0;
    for (double& value : q) sum += value = std::exp(value - largest);
    for (std::size_t i = 0; i < 3; ++i) spectra[i][w] = q[i] / sum;
  }
  return spectra;
}

/// Under D65: [wavelength], linear sRGB of light that adds up to (1, 1, 1).
std::array<Colour, wavelength_count> white_by_wavelength() {
  const Spectrum light = illuminant("D65");
  const ColourMatching& eye = cie_1931();
  std::array<Colour, wavelength_count> white{};
  Colour sum{};
  for (std::size_t w = 0; w < wavelength_count; ++w) {
    white[w] = xyz_to_linear_srgb({light[w] * eye.x[w], light[w] * eye.y[w], light[w] * eye.z[w]});
    for (std::size_t c = 0; c < 3; ++c) sum[c] += white[w][c];
  }
  for (Colour& colour : white)
    for (std::size_t c = 0; c < 3; ++c) colour[c] /= sum[c];
  return white;
}

/// Solves for the colours of red and green, three numbers each, by Newton's method with Levenberg's damping.
std::array<Spectrum, 3> make_primary_reflectances() {
  const std::array<Colour, wavelength_count> white = white_by_wavelength();
  const auto error_of = [&](const std::array<Spectrum, 3>& spectra) {
    Numbers error;
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 3; ++c) {
        error[3 * i + c] = i == c ? -1 : 0;
        for (std::size_t w = 0; w < wavelength_count; ++w)
          error[3 * i + c] += spectra[static_cast<std::size_t>(i)][w] * white[w][static_cast<std::size_t>(c)];
      }
    return error;
  };
  Numbers parabolas{4, 20, 5, 5, 5, -20}; // red at long waves, green in the middle
  std::array<Spectrum, 3> spectra = spectra_of(parabolas);
  Numbers error = error_of(spectra);
  double damping = 0.01;
  for (int step = 0; step < 200 && error.norm() > 1e-12; ++step) {
    Eigen::Matrix<double, 6, 6> slope = Eigen::Matrix<double, 6, 6>::Zero();
    for (std::size_t w = 0; w < wavelength_count; ++w) {
      const double x = (static_cast<double>(w) - 200) / 200;
      const std::array<double, 3> power{1, x, x * x};
      for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) {
          const auto i = static_cast<std::size_t>(row / 3), j = static_cast<std::size_t>(column / 3);
          slope(row, column) += white[w][static_cast<std::size_t>(row % 3)] * spectra[i][w] *
                                ((i == j ? 1 : 0) - spectra[j][w]) * power[static_cast<std::size_t>(column % 3)];
        }
    }
    Eigen::Matrix<double, 6, 6> normal = slope.transpose() * slope;
    normal.diagonal() *= 1 + damping;
    const Numbers next = parabolas - normal.ldlt().solve(slope.transpose() * error);
    const std::array<Spectrum, 3> trial = spectra_of(next);
    const Numbers trial_error = error_of(trial);
    if (trial_error.norm() < error.norm()) {
      parabolas = next, spectra = trial, error = trial_error;
      damping *= 0.3;
    } else
      damping *= 4;
  }
  if (!(error.norm() < 1e-9)) throw failed("reflectances of sRGB's primaries", "were not found");
  return spectra;
}

} // namespace

const std::array<Spectrum, 3>& primary_reflectances(SpectralRange range) {
  static const std::array<Spectrum, 3> visible = make_primary_reflectances();
  static const std::array<Spectrum, 3> solar = [] {
    std::array<Spectrum, 3> spectra{};
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<Row> rows;
      for (int w = 0; w < wavelength_count; ++w)
        rows.push_back({double(wavelength_nm(w)), visible[c][static_cast<std::size_t>(w)]});
      spectra[c] = spectrum_of(LinearTable(std::move(rows)), SpectralRange::solar);
    }
    return spectra;
  }();
  return range == SpectralRange::visible ? visible : solar;
}

} // namespace nephroid::optics
