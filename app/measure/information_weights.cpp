// SPDX-License-Identifier: Apache-2.0
#include "measure/information_weights.h"

#include "base/parallel.h"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <limits>

namespace nephroid::measure {
namespace {

constexpr std::size_t most = 10; ///< 3 x 3 neighbours and the parent
using Neighbours = std::array<double, most>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;

constexpr std::size_t block_rows = 16;
constexpr double tiny = 1e-15; ///< the authors' threshold: a variance or a weight below counts as none (2.2e-16 moves results by 1e-6)

/// The 3 x 3 pixels about (x, y), then the parent's pixel if there is one. Returns how many.
std::size_t gather(Neighbours& y, const Plane& plane, const Plane& parent, std::size_t column, std::size_t row)
{
  std::size_t n = 0;
  for (std::size_t r = row - 1; r <= row + 1; ++r)
    for (std::size_t c = column - 1; c <= column + 1; ++c) y[n++] = plane.row(r)[c];
  if (!parent.values.empty()) y[n++] = parent.row(row)[column];
  return n;
}

/// The mean of y y^T over all inner pixels.
Matrix covariance(const Plane& plane, const Plane& parent, std::size_t n)
{
  const std::size_t rows = plane.height - 2;
  std::vector<std::array<double, most * most>> blocks((rows + block_rows - 1) / block_rows);
  for_ranges(rows, block_rows, [&](std::size_t block, Range range) {
    std::array<double, most * most> sums{};
    Neighbours y{};
    for (std::size_t row = range.begin + 1; row <= range.end; ++row)
      for (std::size_t column = 1; column + 1 < plane.width; ++column) {
        gather(y, plane, parent, column, row);
        for (std::size_t i = 0; i < most; ++i)
          for (std::size_t j = 0; j < most; ++j) sums[i * most + j] += y[i] * y[j];
      }
    blocks[block] = sums;
  });
  Matrix result = Matrix::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (const auto& sums : blocks)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += sums[i * most + j];
  return result / static_cast<double>(rows * (plane.width - 2));
}

/// The Gaussian scale mixture: a neighbourhood is a Gaussian vector of this covariance times a local strength.
struct Mixture {
  std::size_t n = 0;
  std::array<double, most> eigenvalues{};
  std::array<Neighbours, most> inverse{}; ///< of the covariance; on what it spans where it is singular (a flat reference: zero)

  explicit Mixture(const Matrix& c) : n(static_cast<std::size_t>(c.rows()))
  {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(c);
    // Rounding makes eigenvalues negative: they become 0, and the others are scaled so that the variance stays (the authors' way).
    const auto positive = solver.eigenvalues().cwiseMax(0).eval();
    const double scale = positive.sum() > 0 ? solver.eigenvalues().sum() / positive.sum() : 0;
    const double least = positive.maxCoeff() * static_cast<double>(most) * std::numeric_limits<double>::epsilon();
    for (std::size_t k = 0; k < n; ++k) {
      eigenvalues[k] = positive[static_cast<Eigen::Index>(k)] * scale;
      if (positive[static_cast<Eigen::Index>(k)] <= least) continue;
      const auto vector = solver.eigenvectors().col(static_cast<Eigen::Index>(k));
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          inverse[i][j] += vector[static_cast<Eigen::Index>(i)] * vector[static_cast<Eigen::Index>(j)] / eigenvalues[k];
    }
  }

  /// The local strength, y^T C^-1 y / n.
  double strength(const Neighbours& y) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < most; ++i) {
      double product = 0;
      for (std::size_t j = 0; j < most; ++j) product += inverse[i][j] * y[j];
      sum += product * y[i];
    }
    return sum / static_cast<double>(n);
  }
};

/// The picture's neighbourhood is the reference's times gain, plus noise of this variance.
struct Distortion {
  double gain = 0, noise = 0;
};

Distortion distortion(const Plane& reference, const Plane& picture, std::size_t column, std::size_t row)
{
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t r = row - 1; r <= row + 1; ++r)
    for (std::size_t c = column - 1; c <= column + 1; ++c) {
      const double a = reference.row(r)[c], b = picture.row(r)[c];
      x += a;
      y += b;
      xx += a * a;
      yy += b * b;
      xy += a * b;
    }
  x /= 9;
  y /= 9;
  const double covariance_xy = xy / 9 - x * y, variance_x = std::fmax(0, xx / 9 - x * x), variance_y = std::fmax(0, yy / 9 - y * y);
  if (variance_y < tiny) return {0, 0};
  if (variance_x < tiny) return {0, variance_y};
  const double gain = covariance_xy / (variance_x + tiny);
  return {gain, variance_y - gain * covariance_xy};
}

/// Bits that eye and picture share with the scene, equation 22 of the paper: the sum over the eigenvalues of
/// log2(1 + ((v + (1 + g^2) s) S L + s v) / s^2), with s the variance of the eye's own noise. One logarithm of the product: each
/// factor is below 1e20.
double bits(const Mixture& mixture, double strength, const Distortion& d)
{
  constexpr double eye = 0.4;
  double product = 1;
  for (std::size_t k = 0; k < mixture.n; ++k)
    product *= 1 + ((d.noise + (1 + d.gain * d.gain) * eye) * strength * mixture.eigenvalues[k] + eye * d.noise) / (eye * eye);
  const double result = std::log2(product);
  return result < tiny ? 0 : result;
}

} // namespace

Plane information_weights(const Plane& reference, const Plane& picture, const Plane& parent)
{
  Neighbours example{};
  const Mixture mixture(covariance(reference, parent, gather(example, reference, parent, 1, 1)));
  Plane weights(reference.width - 2, reference.height - 2);
  for_ranges(weights.height, block_rows, [&](std::size_t, Range rows) {
    Neighbours y{};
    for (std::size_t row = rows.begin; row < rows.end; ++row)
      for (std::size_t column = 0; column < weights.width; ++column) {
        gather(y, reference, parent, column + 1, row + 1);
        weights.row(row)[column] = bits(mixture, mixture.strength(y), distortion(reference, picture, column + 1, row + 1));
      }
  });
  return weights;
}

} // namespace nephroid::measure
