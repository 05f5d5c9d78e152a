// SPDX-License-Identifier: Apache-2.0
#include "optics/conductor.h"

#include "optics/fresnel.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephroid::optics {
namespace {

constexpr Eigen::Index angles = 128; // evenly spaced cosines

/// -ln R of a metal, [angle].
Eigen::VectorXd loss(double n, double k) {
  return Eigen::VectorXd::NullaryExpr(angles, [&](Eigen::Index a) {
    const double cosine = (static_cast<double>(a) + 0.5) / static_cast<double>(angles);
    return -std::log(std::max(conductor_reflectance(cosine, 1, {n, k}), 1e-30));
  });
}

} // namespace

ConductorTerms conductor_terms(const Spectrum& n, const Spectrum& k) {
  std::vector<Eigen::VectorXd> losses;
  for (std::size_t w = 0; w < n.size(); ++w) losses.push_back(loss(n[w], k[w]));
  ConductorTerms terms;
  Eigen::MatrixXd chosen(angles, 0);
  for (std::size_t count = 0;; ++count) {
    std::size_t worst = 0;
    terms.error = -1;
    for (std::size_t w = 0; w < n.size(); ++w) {
      const Eigen::ArrayXd part = (-losses[w].array()).exp(); // R; as the weight it makes of errors of -ln R those of R
      const Eigen::MatrixXd weighted = part.matrix().asDiagonal() * chosen;
      Eigen::VectorXd x(0); // the library cannot solve for nothing
      if (count > 0) x = weighted.colPivHouseholderQr().solve((part * losses[w].array()).matrix());
      for (std::size_t j = 0; j < count; ++j) terms.coefficients[j][w] = x[static_cast<Eigen::Index>(j)];
      const double error = ((-(chosen * x).array()).exp() - part).abs().maxCoeff();
      if (error > terms.error) terms.error = error, worst = w;
    }
    if (count == conductor_term_count || (count > 0 && terms.error < 1e-6)) return terms;
    terms.wavelengths[count] = worst;
    chosen.conservativeResize(Eigen::NoChange, chosen.cols() + 1);
    chosen.rightCols(1) = losses[worst];
  }
}

} // namespace nephroid::optics
