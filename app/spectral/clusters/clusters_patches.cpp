// SPDX-License-Identifier: Apache-2.0
// Theta by the thesis' bicubic patches (4.5)-(4.14): the surface d theta2 / d lambda over wavelength and angle of incidence is
// cut into patches of 1 nm by 1 degree, each a bicubic polynomial, and a wavelength's Theta is the volume below its 89 patches.
#include "spectral/clusters/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::spectral {
namespace {

constexpr int angle_count = last_angle_deg + 1; ///< 0..89 degrees
constexpr double radian = std::numbers::pi / 180;

/// Appendix A.2: a = M^-1 Psi. Columns: psi at the corners (0,0), (1,0), (0,1), (1,1) of (wavelength, angle), then psi_lambda,
/// psi_theta and psi_lambda_theta at the same corners. Rows: a_00, a_10, a_20, a_30, a_01, ... a_33 of (4.8).
constexpr std::array<std::array<int, 16>, 16> m_inverse{{
    {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {-3, 3, 0, 0, -2, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {2, -2, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, -3, 3, 0, 0, -2, -1, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 2, -2, 0, 0, 1, 1, 0, 0},
    {-3, 0, 3, 0, 0, 0, 0, 0, -2, 0, -1, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, -3, 0, 3, 0, 0, 0, 0, 0, -2, 0, -1, 0},
    {9, -9, -9, 9, 6, 3, -6, -3, 6, -6, 3, -3, 4, 2, 2, 1},
    {-6, 6, 6, -6, -3, -3, 3, 3, -4, 4, -2, 2, -2, -2, -1, -1},
    {2, 0, -2, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 2, 0, -2, 0, 0, 0, 0, 0, 1, 0, 1, 0},
    {-6, 6, 6, -6, -4, -2, 4, 2, -3, 3, -3, 3, -2, -1, -2, -1},
    {4, -4, -4, 4, 2, 2, -2, -2, 2, -2, 2, -2, 1, 1, 1, 1},
}};

/// The volume below a patch is a^T b = (M^-T b)^T Psi with b_ij = 1 / ((i + 1)(j + 1)) (4.12, 4.13): one weight a corner value.
constexpr std::array<double, 16> volume_weights()
{
  std::array<double, 16> weights{};
  for (std::size_t row = 0; row < 16; ++row) {
    const std::size_t i = row % 4, j = row / 4;
    const double b = 1.0 / static_cast<double>((i + 1) * (j + 1));
    for (std::size_t column = 0; column < 16; ++column) weights[column] += m_inverse[row][column] * b;
  }
  return weights;
}

/// One value for each wavelength and each whole degree of incidence.
class Grid {
public:
  explicit Grid(std::size_t wavelengths) : wavelengths_(wavelengths), values_(wavelengths * angle_count) {}
  std::size_t wavelengths() const { return wavelengths_; }
  double& operator()(std::size_t i, std::size_t j) { return values_[i * angle_count + j]; }
  double operator()(std::size_t i, std::size_t j) const { return values_[i * angle_count + j]; }

private:
  std::size_t wavelengths_;
  std::vector<double> values_;
};

/// (value(i + 1) - value(i - 1)) / 2, and one-sided at both ends.
template <class Value>
double difference(std::size_t i, std::size_t count, Value value)
{
  const std::size_t low = i == 0 ? 0 : i - 1, high = std::min(i + 1, count - 1);
  return high == low ? 0 : (value(high) - value(low)) / static_cast<double>(high - low);
}

/// (4.3) in degrees a nanometre, with n' by differences in the sorted order.
Grid angle_derivative(std::span<const double> n)
{
  Grid psi(n.size());
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double slope = difference(i, n.size(), [&](std::size_t k) { return n[k]; });
    for (std::size_t j = 0; j < angle_count; ++j) {
      const double s = std::sin(static_cast<double>(j) * radian);
      psi(i, j) = -s * slope / (n[i] * std::sqrt(n[i] * n[i] - s * s)) / radian;
    }
  }
  return psi;
}

Grid wavelength_difference(const Grid& grid)
{
  Grid result(grid.wavelengths());
  for (std::size_t i = 0; i < grid.wavelengths(); ++i)
    for (std::size_t j = 0; j < angle_count; ++j)
      result(i, j) = difference(i, grid.wavelengths(), [&](std::size_t k) { return grid(k, j); });
  return result;
}

Grid angle_difference(const Grid& grid)
{
  Grid result(grid.wavelengths());
  for (std::size_t i = 0; i < grid.wavelengths(); ++i)
    for (std::size_t j = 0; j < angle_count; ++j) result(i, j) = difference(j, angle_count, [&](std::size_t k) { return grid(i, k); });
  return result;
}

} // namespace

// The corner derivatives are finite differences of psi on the grid, as the thesis takes them (appendix A.1, last paragraph), so
// that a staircase gives a large figure and not an infinite one. They approximate, with s = sin theta1, c = cos theta1,
//   psi_theta        = -c n n' / (n^2 - s^2)^(3/2)                                                                 (A.2)
//   psi_lambda_theta = -c (n^3 n'' - s^2 n n'' - s^2 n'^2 - 2 n^2 n'^2) / (n^2 - s^2)^(5/2)                        (A.3)
// (A.3) has lost its operators in print. It follows from (A.2): d/d lambda of n n' (n^2 - s^2)^(-3/2) is
// ((n n'' + n'^2) (n^2 - s^2) - 3 n^2 n'^2) (n^2 - s^2)^(-5/2).
std::vector<double> theta_patches(std::span<const double> n)
{
  std::vector<double> theta = theta_exact(n);
  // The patch of step i reads psi at i - 1 .. i + 2; all of these need n >= 1, where (4.3) is finite up to 89 degrees.
  const auto from_one = static_cast<std::size_t>(std::find_if(n.begin(), n.end(), [](double value) { return value < 1; }) - n.begin());
  const std::size_t steps = from_one == n.size() ? theta.size() : from_one - std::min<std::size_t>(from_one, 2);
  if (steps == 0) return theta;

  constexpr std::array<double, 16> weights = volume_weights();
  const Grid psi = angle_derivative(n.first(from_one)), psi_lambda = wavelength_difference(psi), psi_theta = angle_difference(psi),
             psi_both = wavelength_difference(psi_theta);
  const Grid* const values[] = {&psi, &psi_lambda, &psi_theta, &psi_both};
  for (std::size_t i = 0; i < steps; ++i) {
    double volume = 0;
    for (std::size_t j = 0; j + 1 < angle_count; ++j)
      for (std::size_t corner = 0; corner < 16; ++corner)
        volume += weights[corner] * (*values[corner / 4])(i + corner % 2, j + corner / 2 % 2);
    // Beside a jump a cubic undershoots; an angle sorted by n never goes back.
    theta[i] = std::max(0.0, volume);
  }
  return theta;
}

} // namespace nephroid::spectral
