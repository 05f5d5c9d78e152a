// SPDX-License-Identifier: Apache-2.0
#include "optics/colour.h"

#include "optics/tables.h"

#include <algorithm>
#include <cmath>

namespace nephroid::optics {
namespace {

using Matrix = std::array<Colour, 3>;

/// Linear sRGB to XYZ with the four digits that IEC 61966-2-1 prints.
constexpr Matrix srgb_to_xyz_matrix{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};

constexpr Colour multiply(const Matrix& m, const Colour& v) {
  Colour result{};
  for (std::size_t row = 0; row < 3; ++row) result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

/// Cofactors over the determinant: exact to the last digits, so that there and back is the identity.
constexpr Matrix inverse(const Matrix& m) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      result[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  const double determinant = m[0][0] * result[0][0] + m[0][1] * result[1][0] + m[0][2] * result[2][0];
  for (Colour& row : result)
    for (double& value : row) value /= determinant;
  return result;
}

constexpr Matrix xyz_to_srgb_matrix = inverse(srgb_to_xyz_matrix);

/// The cube root of CIELAB with its straight start below (6/29)^3 (CIE 015).
double lab_root(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

ColourMatching read_cie_1931() {
  const Table table = read_table("cie-1931-2deg-1nm");
  const auto function = [&](std::size_t column) { return spectrum_of(LinearTable(table.rows(column))); };
  return {function(0), function(1), function(2)};
}

Colour cross(const Colour& a, const Colour& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Colour& a, const Colour& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The one way in which a smoothest spectrum may be curved; see make_primary_spectra.
Spectrum curved(const Spectrum& straight) {
  constexpr std::size_t count = wavelength_count;
  const ColourMatching& eye = cie_1931();
  Spectrum one{};
  one.fill(1);
  const Colour mu = cross(to_xyz(one), to_xyz(straight));
  // D^T w = c: w[i] - 2 w[i - 1] + w[i - 2] = c[i]. The last two hold because c is orthogonal to straight lines.
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

/// The three functions that all smoothest spectra are sums of: a constant, a straight line and a curve.
std::array<Spectrum, 3> smoothest_ways() {
  std::array<Spectrum, 3> ways{};
  ways[0].fill(1);
  for (std::size_t i = 0; i < ways[1].size(); ++i)
    ways[1][i] = 2.0 * static_cast<double>(i) / (wavelength_count - 1) - 1;
  ways[2] = curved(ways[1]);
  return ways;
}

/// The amounts of three columns whose sum is a colour, by Cramer's rule.
Colour amounts(const std::array<Colour, 3>& columns, const Colour& colour) {
  const double determinant = dot(columns[0], cross(columns[1], columns[2]));
  Colour amounts{};
  for (std::size_t way = 0; way < 3; ++way)
    amounts[way] = dot(colour, cross(columns[(way + 1) % 3], columns[(way + 2) % 3])) / determinant;
  return amounts;
}

/// Among all spectra s with A s = b (A the three colour-matching functions, b an XYZ) the one with the smallest |D s|^2
/// (D second differences) has D^T D s = A^T mu with Lagrange's multipliers mu (3 numbers). D loses straight lines, so
/// v^T A^T mu = 0 for v = 1 and v = the wavelength: two conditions, which leave mu one number: it is orthogonal to A 1
/// and to A (wavelength). So s is a sum of three fixed functions, a constant, a straight line and one curve, and the
/// three equations A s = b say how much there is of each.
std::array<Spectrum, 3> make_primary_spectra() {
  const std::array<Spectrum, 3> ways = smoothest_ways();
  const std::array<Colour, 3> columns{to_xyz(ways[0]), to_xyz(ways[1]), to_xyz(ways[2])};
  std::array<Spectrum, 3> spectra{};
  for (std::size_t primary = 0; primary < 3; ++primary) {
    Colour rgb{};
    rgb[primary] = 1;
    const Colour amount = amounts(columns, linear_srgb_to_xyz(rgb));
    for (std::size_t way = 0; way < 3; ++way)
      for (std::size_t i = 0; i < wavelength_count; ++i) spectra[primary][i] += amount[way] * ways[way][i];
  }
  return spectra;
}

} // namespace

const ColourMatching& cie_1931() {
  static const ColourMatching functions = read_cie_1931();
  return functions;
}

const ColourMatching& power_and_luminance(SpectralRange range) {
  const auto make = [](SpectralRange of) {
    ColourMatching result{};
    result.x.fill(1);
    result.y = rebinned(cie_1931().y, of); // the mean over each cell
    for (std::size_t i = 0; i < result.y.size(); ++i) result.y[i] /= cells(of).width_nm[i];
    return result;
  };
  static const ColourMatching visible = make(SpectralRange::visible), solar = make(SpectralRange::solar);
  return range == SpectralRange::visible ? visible : solar;
}

Colour to_xyz(const Spectrum& spectrum) {
  const ColourMatching& cie = cie_1931();
  Colour xyz{};
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    xyz[0] += spectrum[i] * cie.x[i];
    xyz[1] += spectrum[i] * cie.y[i];
    xyz[2] += spectrum[i] * cie.z[i];
  }
  return xyz;
}

Colour xyz_to_linear_srgb(const Colour& xyz) { return multiply(xyz_to_srgb_matrix, xyz); }

Colour linear_srgb_to_xyz(const Colour& rgb) { return multiply(srgb_to_xyz_matrix, rgb); }

std::array<Colour, 3> white_balance(const Colour& white_xyz) {
  constexpr Matrix bradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Colour grey = linear_srgb_to_xyz({white_xyz[1], white_xyz[1], white_xyz[1]});
  const Colour seen = multiply(bradford, white_xyz), wanted = multiply(bradford, grey);
  std::array<Colour, 3> balance{};
  for (std::size_t column = 0; column < 3; ++column) {
    Colour primary{};
    primary[column] = 1;
    Colour cones = multiply(bradford, linear_srgb_to_xyz(primary));
    for (std::size_t i = 0; i < 3; ++i) cones[i] *= wanted[i] / std::max(seen[i], wanted[i] / 50);
    const Colour rgb = xyz_to_linear_srgb(multiply(inverse(bradford), cones));
    for (std::size_t row = 0; row < 3; ++row) balance[row][column] = rgb[row];
  }
  return balance;
}

double srgb_encode(double linear) {
  const double size = std::fabs(linear);
  const double encoded = size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

double lightness(double relative_luminance) { return 116 * lab_root(relative_luminance) - 16; }

const std::array<Spectrum, 3>& primary_spectra(SpectralRange range) {
  static const std::array<Spectrum, 3> visible = make_primary_spectra();
  static const std::array<Spectrum, 3> solar{rebinned(visible[0], SpectralRange::solar),
                                             rebinned(visible[1], SpectralRange::solar),
                                             rebinned(visible[2], SpectralRange::solar)};
  return range == SpectralRange::visible ? visible : solar;
}

// Where the smoothest spectrum is negative somewhere, exp(sum of amounts times the same three ways) takes its place.
// Newton's method finds the amounts, on the way from white to the colour.
Spectrum light_of_colour(const Colour& rgb) {
  Spectrum light{};
  for (std::size_t i = 0; i < light.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) light[i] += rgb[c] * primary_spectra()[c][i];
  if (std::ranges::min(light) >= 0) return light;
  constexpr int steps = 64, turns = 6;
  constexpr double most = 0.01; // of a colour's way, that may be left
  static const std::array<Spectrum, 3> ways = smoothest_ways();
  const double luminance = linear_srgb_to_xyz(rgb)[1];
  Colour exponent{};
  const auto spectrum_of = [](const Colour& of) {
    Spectrum spectrum{};
    for (std::size_t i = 0; i < spectrum.size(); ++i)
      spectrum[i] = std::exp(of[0] * ways[0][i] + of[1] * ways[1][i] + of[2] * ways[2][i]);
    return spectrum;
  };
  Spectrum found = light;
  for (int step = 0; step <= steps; ++step) {
    Colour aim{};
    for (std::size_t c = 0; c < 3; ++c) aim[c] = luminance + (rgb[c] - luminance) * step / steps;
    const Colour wanted = linear_srgb_to_xyz(aim);
    double left = 0;
    for (int turn = 0; turn < turns; ++turn) {
      light = spectrum_of(exponent);
      const Colour xyz = to_xyz(light);
      Colour rest{};
      left = 0;
      for (std::size_t c = 0; c < 3; ++c) rest[c] = wanted[c] - xyz[c], left += std::abs(rest[c]) / wanted[1];
      std::array<Colour, 3> columns{};
      for (std::size_t way = 0; way < 3; ++way) {
        Spectrum change = light;
        for (std::size_t i = 0; i < change.size(); ++i) change[i] *= ways[way][i];
        columns[way] = to_xyz(change);
      }
      const Colour more = amounts(columns, rest);
      for (std::size_t way = 0; way < 3; ++way) exponent[way] += std::clamp(more[way], -1.0, 1.0);
    }
    if (step > 0 && !(left < most)) break; // as far as it got
    found = light;
  }
  return found;
}

} // namespace nephroid::optics
