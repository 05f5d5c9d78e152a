// SPDX-License-Identifier: Apache-2.0
#include "inverse/poisson.h"

#include "base/parallel.h"

#include <glm/gtc/constants.hpp>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace nephroid::inverse {
namespace {

using Complex = std::complex<double>;

double eigenvalue(int k, int nodes, double spacing) {
  return 2 * (1 - std::cos(glm::pi<double>() * k / nodes)) / (spacing * spacing);
}

enum class Transform { forward, inverse };

/// Every row u becomes sum over i of u_i cos(pi k (i + 1/2) / nodes), or the other way round: by a Fourier transform as
/// long as the row, of its even nodes and then its odd ones backwards (Makhoul 1980, "A fast cosine transform in one
/// and two dimensions"). Two rows are the real and the imaginary part of one transform.
void transform_rows(Grid& grid, Transform way) {
  const Eigen::Index count = grid.cols(), last = grid.rows() - 1;
  if (count == 1) return;
  std::vector<Complex> turns;
  for (Eigen::Index k = 0; k < count; ++k)
    turns.push_back(std::polar(1.0, -glm::pi<double>() * static_cast<double>(k) / static_cast<double>(2 * count)));
  const auto place = [&](Eigen::Index i) { return 2 * i < count ? 2 * i : 2 * (count - i) - 1; };
  constexpr std::size_t pairs_a_block = 16;
  for_ranges(static_cast<std::size_t>(grid.rows() + 1) / 2, pairs_a_block, [&](std::size_t, const Range& range) {
    Eigen::FFT<double> fft;
    std::vector<Complex> values(static_cast<std::size_t>(count)), changed(values);
    for (std::size_t pair = range.begin; pair < range.end; ++pair) {
      double* const a = grid.row(2 * static_cast<Eigen::Index>(pair)).data();
      // The last one twice where their number is odd.
      double* const b = grid.row(std::min(2 * static_cast<Eigen::Index>(pair) + 1, last)).data();
      const auto at = [](std::vector<Complex>& of, Eigen::Index i) -> Complex& {
        return of[static_cast<std::size_t>(i)];
      };
      if (way == Transform::forward) {
        for (Eigen::Index i = 0; i < count; ++i) at(values, i) = {a[place(i)], b[place(i)]};
        fft.fwd(changed.data(), values.data(), count);
        for (Eigen::Index k = 0; k < count; ++k) {
          const Complex here = at(changed, k), mirrored = std::conj(at(changed, k > 0 ? count - k : 0));
          const Complex spectrum_a = (here + mirrored) / 2.0, spectrum_b = (here - mirrored) / Complex(0, 2);
          a[k] = (spectrum_a * at(turns, k)).real();
          b[k] = (spectrum_b * at(turns, k)).real();
        }
      } else {
        for (Eigen::Index k = 0; k < count; ++k) {
          const Complex other = k > 0 ? Complex(a[count - k], b[count - k]) : Complex(0);
          at(values, k) = (Complex(a[k], b[k]) - Complex(0, 1) * other) * std::conj(at(turns, k));
        }
        fft.inv(changed.data(), values.data(), count);
        for (Eigen::Index i = 0; i < count; ++i) {
          a[place(i)] = at(changed, i).real();
          b[place(i)] = at(changed, i).imag();
        }
      }
    }
  });
}

} // namespace

Poisson::Poisson(int columns, int rows, const glm::dvec2& spacing) : one_over_value_(Grid::Zero(columns, rows)) {
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      if (x + y > 0) one_over_value_(x, y) = 1 / (eigenvalue(x, columns, spacing.x) + eigenvalue(y, rows, spacing.y));
}

Grid Poisson::solve(const Grid& f) const {
  Grid rows = f;
  transform_rows(rows, Transform::forward);
  Grid columns = rows.transpose();
  transform_rows(columns, Transform::forward);
  columns = columns.cwiseProduct(one_over_value_);
  transform_rows(columns, Transform::inverse);
  rows = columns.transpose();
  transform_rows(rows, Transform::inverse);
  return rows;
}

} // namespace nephroid::inverse
