// SPDX-License-Identifier: Apache-2.0
#include "optics/colour.h"

#include "optics/tables.h"

#include <cmath>

namespace nephroid::optics {
namespace {

using Matrix = std::array<Colour, 3>;

/// Linear sRGB to XYZ with the four digits that IEC 61966-2-1 prints.
constexpr Matrix srgb_to_xyz_matrix{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};

constexpr Colour multiply(const Matrix& m, const Colour& v)
{
  Colour result{};
  for (std::size_t row = 0; row < 3; ++row) result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

/// Cofactors over the determinant: exact to the last digits, so that there and back is the identity.
constexpr Matrix inverse(const Matrix& m)
{
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

/// XYZ of the D65 white that sRGB names: xy = .3127 / .3290, Y = 1.
constexpr Colour lab_white{0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};

/// The cube root of CIELAB with its straight start below (6/29)^3 (CIE 015).
double lab_root(double t)
{
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

ColourMatching read_cie_1931()
{
  const Table table = read_table("cie-1931-2deg-1nm");
  ColourMatching result{};
  Spectrum* const functions[] = {&result.x, &result.y, &result.z};
  for (std::size_t f = 0; f < 3; ++f) {
    const LinearTable curve(table.rows(f));
    for (int i = 0; i < wavelength_count; ++i) (*functions[f])[static_cast<std::size_t>(i)] = curve(wavelength_nm(i));
  }
  return result;
}

} // namespace

const ColourMatching& cie_1931()
{
  static const ColourMatching functions = read_cie_1931();
  return functions;
}

Colour to_xyz(const Spectrum& spectrum)
{
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

double srgb_encode(double linear)
{
  const double size = std::fabs(linear);
  const double encoded = size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

Colour xyz_to_lab(const Colour& xyz)
{
  const double x = lab_root(xyz[0] / lab_white[0]), y = lab_root(xyz[1] / lab_white[1]), z = lab_root(xyz[2] / lab_white[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double lightness(double relative_luminance) { return 116 * lab_root(relative_luminance) - 16; }

} // namespace nephroid::optics
