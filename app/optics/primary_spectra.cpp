// SPDX-License-Identifier: Apache-2.0
#include "optics/primary_spectra.h"

#include "optics/colour.h"

#include <algorithm>
#include <cmath>

namespace nephroid::optics {
namespace {

Colour cross(const Colour& a, const Colour& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double dot(const Colour& a, const Colour& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The one way in which a smoothest spectrum may be curved; see make_primary_spectra.
Spectrum curved(const Spectrum& straight)
{
  constexpr std::size_t count = wavelength_count;
  const ColourMatching& eye = cie_1931();
  Spectrum one{};
  one.fill(1);
  const Colour mu = cross(to_xyz(one), to_xyz(straight));
  // D^T w = c: w[i] - 2 w[i - 1] + w[i - 2] = c[i]. The last two of these equations hold because c is orthogonal to straight lines.
  std::array<double, count - 2> w{};
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double c = mu[0] * eye.x[i] + mu[1] * eye.y[i] + mu[2] * eye.z[i];
    w[i] = c + (i >= 1 ? 2 * w[i - 1] : 0) - (i >= 2 ? w[i - 2] : 0);
  }
  // D g = w: second differences, so two sums; where they begin is a straight line, which is a way of its own.
  Spectrum g{};
  double largest = 0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    g[i + 1] = w[i - 1] + 2 * g[i] - g[i - 1];
    largest = std::max(largest, std::abs(g[i + 1]));
  }
  for (double& value : g) value /= largest;
  return g;
}

/// Of all spectra s with A s = b (A the three colour-matching functions, b an XYZ) the one with the smallest |D s|^2 (D second differences)
/// has D^T D s = A^T mu with Lagrange's multipliers mu (3 numbers). D loses straight lines, so v^T A^T mu = 0 for v = 1 and v = the
/// wavelength: two conditions, which leave mu one number: it is orthogonal to A 1 and to A (wavelength). So s is a sum of three
/// fixed functions, a constant, a straight line and one curve, and the three equations A s = b say how much there is of each.
std::array<Spectrum, 3> make_primary_spectra()
{
  std::array<Spectrum, 3> ways{};
  ways[0].fill(1);
  for (std::size_t i = 0; i < ways[1].size(); ++i) ways[1][i] = 2.0 * static_cast<double>(i) / (wavelength_count - 1) - 1;
  ways[2] = curved(ways[1]);
  const std::array<Colour, 3> columns{to_xyz(ways[0]), to_xyz(ways[1]), to_xyz(ways[2])};
  const double determinant = dot(columns[0], cross(columns[1], columns[2]));
  std::array<Spectrum, 3> spectra{};
  for (std::size_t primary = 0; primary < 3; ++primary) {
    Colour rgb{};
    rgb[primary] = 1;
    const Colour xyz = linear_srgb_to_xyz(rgb);
    for (std::size_t way = 0; way < 3; ++way) { // Cramer's rule
      const double amount = dot(xyz, cross(columns[(way + 1) % 3], columns[(way + 2) % 3])) / determinant;
      for (std::size_t i = 0; i < wavelength_count; ++i) spectra[primary][i] += amount * ways[way][i];
    }
  }
  return spectra;
}

} // namespace

const std::array<Spectrum, 3>& primary_spectra()
{
  static const std::array<Spectrum, 3> spectra = make_primary_spectra();
  return spectra;
}

} // namespace nephroid::optics
