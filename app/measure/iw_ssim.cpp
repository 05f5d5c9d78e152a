// SPDX-License-Identifier: Apache-2.0
#include "measure/iw_ssim.h"

#include "base/parallel.h"
#include "measure/lab.h"
#include "measure/laplacian_pyramid.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nephroid::measure {
namespace {

constexpr std::size_t most = 10; ///< 3 x 3 neighbours and the parent
using Neighbours = std::array<double, most>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;

constexpr std::size_t weights_block_rows = 16;
/// The authors' threshold: a variance or a weight below counts as none (2.2e-16 moves results by 1e-6).
constexpr double tiny = 1e-15;

/// The 3 x 3 pixels about (x, y), then the parent's pixel if there is one. Returns how many.
std::size_t gather(Neighbours& y, const Plane& plane, const Plane& parent, std::size_t column, std::size_t row) {
  std::size_t n = 0;
  for (std::size_t r = row - 1; r <= row + 1; ++r)
    for (std::size_t c = column - 1; c <= column + 1; ++c) y[n++] = plane.row(r)[c];
  if (!parent.values.empty()) y[n++] = parent.row(row)[column];
  return n;
}

/// The mean of y y^T over all inner pixels.
Matrix covariance(const Plane& plane, const Plane& parent, std::size_t n) {
  const std::size_t rows = plane.height - 2;
  std::vector<std::array<double, most * most>> blocks((rows + weights_block_rows - 1) / weights_block_rows);
  for_ranges(rows, weights_block_rows, [&](std::size_t block, Range range) {
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
      for (std::size_t j = 0; j < n; ++j)
        result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += sums[i * most + j];
  return result / static_cast<double>(rows * (plane.width - 2));
}

/// The Gaussian scale mixture: a neighbourhood is a Gaussian vector of this covariance times a local strength.
struct Mixture {
  std::size_t n = 0;
  std::array<double, most> eigenvalues{};
  std::array<Neighbours, most> inverse{}; ///< the covariance's, on what that spans (a flat reference: zero)

  explicit Mixture(const Matrix& c) : n(static_cast<std::size_t>(c.rows())) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(c);
    // Rounding makes eigenvalues negative: they become 0, and the others are scaled to the variance, as the authors do.
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
  double strength(const Neighbours& y) const {
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

Distortion distortion(const Plane& reference, const Plane& picture, std::size_t column, std::size_t row) {
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
  const double covariance_xy = xy / 9 - x * y, variance_x = std::fmax(0, xx / 9 - x * x),
               variance_y = std::fmax(0, yy / 9 - y * y);
  if (variance_y < tiny) return {0, 0};
  if (variance_x < tiny) return {0, variance_y};
  const double gain = covariance_xy / (variance_x + tiny);
  return {gain, variance_y - gain * covariance_xy};
}

/// Bits that eye and picture share with the scene, equation 22: the sum over the eigenvalues of log2(1 + ((v + (1 +
/// g^2) s) S L + s v) / s^2), with s the variance of the eye's own noise. It is one logarithm of the product.
double bits(const Mixture& mixture, double strength, const Distortion& d) {
  constexpr double eye = 0.4;
  double product = 1;
  for (std::size_t k = 0; k < mixture.n; ++k)
    product *=
        1 + ((d.noise + (1 + d.gain * d.gain) * eye) * strength * mixture.eigenvalues[k] + eye * d.noise) / (eye * eye);
  const double result = std::log2(product);
  return result < tiny ? 0 : result;
}

/// How much a person learns from each place of a level of both pyramids, in bits: a weight a pixel, without the
/// outermost ring. `parent` is that of the reference, as large as the level, or empty where it is not to be used.
Plane information_weights(const Plane& reference, const Plane& picture, const Plane& parent) {
  Neighbours example{};
  const Mixture mixture(covariance(reference, parent, gather(example, reference, parent, 1, 1)));
  Plane weights(reference.width - 2, reference.height - 2);
  for_ranges(weights.height, weights_block_rows, [&](std::size_t, Range rows) {
    Neighbours y{};
    for (std::size_t row = rows.begin; row < rows.end; ++row)
      for (std::size_t column = 0; column < weights.width; ++column) {
        gather(y, reference, parent, column + 1, row + 1);
        weights.row(row)[column] =
            bits(mixture, mixture.strength(y), distortion(reference, picture, column + 1, row + 1));
      }
  });
  return weights;
}

constexpr int scale_count = 5;
/// Wang et al. 2003; their sum is 1.0001.
constexpr std::array<double, scale_count> scale_weights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr std::size_t window = 11, margin = window / 2;
constexpr double luminance_constant = (0.01 * 255) * (0.01 * 255), contrast_constant = (0.03 * 255) * (0.03 * 255);
constexpr std::size_t block_rows = 32;

/// Gaussian of standard deviation 1.5, sum 1.
std::array<double, window> gaussian() {
  std::array<double, window> taps{};
  for (std::size_t i = 0; i < window; ++i) {
    const double x = static_cast<double>(i) - margin;
    taps[i] = std::exp(-x * x / (2 * 1.5 * 1.5));
  }
  const double sum = std::accumulate(taps.begin(), taps.end(), 0.0);
  for (double& tap : taps) tap /= sum;
  return taps;
}

Plane luma(const Pixels& picture) {
  Plane plane(static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
  for_ranges(plane.values.size(), std::size_t{1} << 14, [&](std::size_t, Range range) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
      const float* const rgb = &picture.rgb[3 * p];
      plane.values[p] =
          255 * (0.299 * encode_clipped(rgb[0]) + 0.587 * encode_clipped(rgb[1]) + 0.114 * encode_clipped(rgb[2]));
    }
  });
  return plane;
}

/// Gaussian means over the window of a, b, a^2, b^2 and a b.
enum Moment { mean_a, mean_b, mean_aa, mean_bb, mean_ab, moment_count };
using Moments = std::array<Plane, moment_count>;

/// The moments along one row; valid windows only.
void row_moments(Moments& moments, std::size_t to, const double* a, const double* b,
                 const std::array<double, window>& taps) {
  for (std::size_t x = 0; x < moments[0].width; ++x) {
    std::array<double, moment_count> sums{};
    for (std::size_t i = 0; i < window; ++i) {
      const double wa = taps[i] * a[x + i], wb = taps[i] * b[x + i];
      sums[mean_a] += wa;
      sums[mean_b] += wb;
      sums[mean_aa] += wa * a[x + i];
      sums[mean_bb] += wb * b[x + i];
      sums[mean_ab] += wa * b[x + i];
    }
    for (std::size_t m = 0; m < moment_count; ++m) moments[m].row(to)[x] = sums[m];
  }
}

double similarity(const std::array<double, moment_count>& m, bool with_luminance) {
  const double aa = m[mean_a] * m[mean_a], bb = m[mean_b] * m[mean_b], ab = m[mean_a] * m[mean_b];
  const double variances = std::max(0.0, m[mean_aa] - aa) + std::max(0.0, m[mean_bb] - bb);
  const double structure = (2 * (m[mean_ab] - ab) + contrast_constant) / (variances + contrast_constant);
  return with_luminance ? structure * (2 * ab + luminance_constant) / (aa + bb + luminance_constant) : structure;
}

/// SSIM's contrast and structure, with luminance if asked for, of every window that lies wholly inside.
Plane similarities(const Plane& a, const Plane& b, bool with_luminance) {
  const std::array<double, window> taps = gaussian();
  Plane result(a.width - 2 * margin, a.height - 2 * margin);
  for_ranges(result.height, block_rows, [&](std::size_t, Range rows) {
    const std::size_t count = rows.end - rows.begin;
    Moments moments;
    moments.fill(Plane(result.width, count + 2 * margin));
    for (std::size_t y = 0; y < count + 2 * margin; ++y)
      row_moments(moments, y, a.row(rows.begin + y), b.row(rows.begin + y), taps);
    for (std::size_t y = 0; y < count; ++y)
      for (std::size_t x = 0; x < result.width; ++x) {
        std::array<double, moment_count> sums{};
        for (std::size_t i = 0; i < window; ++i)
          for (std::size_t m = 0; m < moment_count; ++m) sums[m] += taps[i] * moments[m].row(y + i)[x];
        result.row(rows.begin + y)[x] = similarity(sums, with_luminance);
      }
  });
  return result;
}

/// Whether the window about inner pixel (x, y) of a scale counts. Level pixel i lies on pixel 2^scale i of the picture.
struct ScaleMask {
  Mask mask;
  std::size_t width;
  int scale;

  bool operator()(std::size_t x, std::size_t y) const {
    return counts(mask, ((y + margin) << scale) * width + ((x + margin) << scale));
  }
};

/// The mean of the similarities that count, weighted where there are weights.
std::optional<double> pooled(const Plane& similarity, const Plane* weights, const ScaleMask& mask) {
  double sum = 0, weight_sum = 0, plain_sum = 0;
  std::size_t windows = 0;
  for (std::size_t y = 0; y < similarity.height; ++y)
    for (std::size_t x = 0; x < similarity.width; ++x) {
      if (!mask(x, y)) continue;
      const double weight = weights ? weights->row(y + margin - 1)[x + margin - 1] : 1;
      sum += weight * similarity.row(y)[x];
      weight_sum += weight;
      plain_sum += similarity.row(y)[x];
      ++windows;
    }
  if (windows == 0) return std::nullopt;
  return weight_sum > 0 ? sum / weight_sum : plain_sum / static_cast<double>(windows);
}

} // namespace

std::vector<std::optional<double>> iw_ssim_each(const Pixels& picture, const Pixels& reference,
                                                std::span<const Mask> masks) {
  if (std::min(picture.width, picture.height) < iw_ssim_smallest_side)
    return std::vector<std::optional<double>>(masks.size());
  const std::vector<Plane> a = laplacian_pyramid(luma(picture), scale_count),
                           b = laplacian_pyramid(luma(reference), scale_count);
  const double weight_sum = std::accumulate(scale_weights.begin(), scale_weights.end(), 0.0);
  std::vector<std::optional<double>> results(masks.size(), 1.0);
  for (std::size_t s = 0; s < scale_count; ++s) {
    const bool coarsest = s + 1 == scale_count, has_parent = s + 2 < scale_count;
    const Plane parent = has_parent ? enlarged_parent(b[s + 1], b[s].width, b[s].height) : Plane();
    const Plane weights = coarsest ? Plane() : information_weights(b[s], a[s], parent);
    const Plane similar = similarities(b[s], a[s], coarsest);
    for (std::size_t m = 0; m < masks.size(); ++m) {
      const ScaleMask mask{masks[m], static_cast<std::size_t>(picture.width), static_cast<int>(s)};
      const std::optional<double> mean = pooled(similar, coarsest ? nullptr : &weights, mask);
      if (!mean) results[m].reset();
      if (results[m]) *results[m] *= std::pow(std::max(0.0, *mean), scale_weights[s] / weight_sum);
    }
  }
  return results;
}

} // namespace nephroid::measure
