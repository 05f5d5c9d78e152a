// SPDX-License-Identifier: Apache-2.0
#include "photons/clusters/clusters.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace nephroid::photons {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Gauss-Legendre nodes and weights on 0..1. The integrands are analytic up to about 1 degree beyond the end of the
/// interval. So 64 nodes leave an error below 1e-8 of the integral for n next to 1, and only rounding elsewhere.
struct Quadrature {
  static constexpr int count = 64;
  std::array<double, count> node{}, weight{};

  Quadrature() {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 0;
      for (int newton = 0; newton < 8; ++newton) {
        double p = 1, previous = 0;
        for (int k = 1; k <= count; ++k) previous = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * previous) / k);
        slope = count * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      const auto index = static_cast<std::size_t>(i);
      node[index] = (1 + x) / 2;
      weight[index] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

/// The integral over u = 0..end (radians) of asin(ratio sin u), in square radians.
double arc_integral(double ratio, double end) {
  static const Quadrature quadrature;
  double sum = 0;
  for (std::size_t i = 0; i < quadrature.node.size(); ++i)
    sum += quadrature.weight[i] * std::asin(std::min(1.0, ratio * std::sin(end * quadrature.node[i])));
  return sum * end;
}

// Theta by the thesis' bicubic patches (4.5)-(4.14). d theta2 / d lambda over wavelength and angle of incidence is cut
// into bicubic patches of 1 nm by 1 degree. A wavelength's Theta is the volume below its 89.
constexpr int angle_count = last_angle_deg + 1; ///< 0..89 degrees

/// Appendix A.2: a = M^-1 Psi. Columns: psi at the corners (0,0), (1,0), (0,1), (1,1) of (wavelength, angle), then
/// psi_lambda, psi_theta, psi_lambda_theta there. Rows: a_00, a_10, a_20, a_30, a_01, ... a_33 of (4.8).
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

/// The volume below a patch is a^T b = (M^-T b)^T Psi with b_ij = 1 / ((i + 1)(j + 1)) (4.12, 4.13).
constexpr std::array<double, 16> volume_weights() {
  std::array<double, 16> weights{};
  for (std::size_t row = 0; row < 16; ++row) {
    const std::size_t i = row % 4, j = row / 4;
    const double b = 1.0 / static_cast<double>((i + 1) * (j + 1));
    for (std::size_t column = 0; column < 16; ++column) weights[column] += m_inverse[row][column] * b;
  }
  return weights;
}

/// A value for each wavelength and each whole degree of incidence.
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

/// The derivative (value(i + 1) - value(i - 1)) / 2, one-sided at both ends.
template <class Value>
double difference(std::size_t i, std::size_t count, Value value) {
  const std::size_t low = i == 0 ? 0 : i - 1, high = std::min(i + 1, count - 1);
  return high == low ? 0 : (value(high) - value(low)) / static_cast<double>(high - low);
}

/// The derivative (4.3) in degrees a nanometre, with n' from differences in the sorted order.
Grid angle_derivative(std::span<const double> n) {
  Grid psi(n.size());
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double slope = difference(i, n.size(), [&](std::size_t k) { return n[k]; });
    for (std::size_t j = 0; j < angle_count; ++j) {
      const double s = std::sin(static_cast<double>(j) * degree);
      psi(i, j) = -s * slope / (n[i] * std::sqrt(n[i] * n[i] - s * s)) / degree;
    }
  }
  return psi;
}

Grid wavelength_difference(const Grid& grid) {
  Grid result(grid.wavelengths());
  for (std::size_t i = 0; i < grid.wavelengths(); ++i)
    for (std::size_t j = 0; j < angle_count; ++j)
      result(i, j) = difference(i, grid.wavelengths(), [&](std::size_t k) { return grid(k, j); });
  return result;
}

Grid angle_difference(const Grid& grid) {
  Grid result(grid.wavelengths());
  for (std::size_t i = 0; i < grid.wavelengths(); ++i)
    for (std::size_t j = 0; j < angle_count; ++j)
      result(i, j) = difference(j, angle_count, [&](std::size_t k) { return grid(i, k); });
  return result;
}

using Wavelengths = std::array<int, optics::wavelength_count>;
/// Ends of groups: one past the last member of each, in the sorted order.
using Ends = std::vector<std::size_t>;

void check_input(const optics::Spectrum& n, double threshold_deg) {
  if (!(threshold_deg > 0 && threshold_deg < 90))
    throw bad_input("clusters", fmt::format("the threshold is {} degrees", threshold_deg),
                    "expected above 0 and below 90");
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const double value = n[static_cast<std::size_t>(i)];
    if (!std::isfinite(value) || !(value > 0))
      throw bad_input("clusters",
                      fmt::format("the index of refraction is {} at {} nm", value, optics::wavelength_nm(i)),
                      "expected a number above 0");
  }
}

Wavelengths by_falling_n(const optics::Spectrum& n) {
  Wavelengths order{};
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(
      order, [&](int a, int b) { return n[static_cast<std::size_t>(a)] > n[static_cast<std::size_t>(b)]; });
  return order;
}

/// Fills each group from the left as far as the bound allows. A group may be used when it is one wavelength or sums to
/// at most h. No division into contiguous groups has fewer: every contiguous part of a usable group is usable, because
/// Theta >= 0. Let our k-th group end at g_k and that of any other division at o_k. Then g_k >= o_k, by induction over
/// k: where o_k > g_(k-1), the wavelengths g_(k-1) + 1 .. o_k are a part of the other's k-th group (as o_(k-1) <=
/// g_(k-1)), so they are usable. Our group starts at the same wavelength and goes as far as it can, so it reaches at
/// least o_k. So our division needs no more groups.
Ends packed_from_the_left(const std::vector<double>& theta, double h) {
  Ends ends;
  double sum = 0;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const bool first = i == 0;
    if (!first && sum + theta[i] > h) {
      ends.push_back(i);
      sum = 0;
    }
    sum += theta[i];
  }
  ends.push_back(theta.size());
  return ends;
}

/// Algorithm 4.1 as printed: merge the two neighbouring free clusters with the smallest sum, again and again, while
/// that sum is at most h. A wavelength whose own Theta reaches h is final from the start.
Ends merged_pairwise(const std::vector<double>& theta, double h) {
  struct Group {
    double theta;
    std::size_t end;
    bool free;
  };
  std::vector<Group> groups;
  for (std::size_t i = 0; i < theta.size(); ++i) groups.push_back({theta[i], i + 1, theta[i] < h});
  while (true) {
    std::optional<std::size_t> best;
    double best_sum = h;
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
      const double sum = groups[i].theta + groups[i + 1].theta;
      const bool better = best ? sum < best_sum : sum <= best_sum;
      if (groups[i].free && groups[i + 1].free && better) best = i, best_sum = sum;
    }
    if (!best) break;
    groups[*best] = {best_sum, groups[*best + 1].end, true};
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(*best) + 1);
  }
  Ends ends;
  for (const Group& group : groups) ends.push_back(group.end);
  return ends;
}

Ends one_by_one() {
  Ends ends(optics::wavelength_count);
  std::iota(ends.begin(), ends.end(), std::size_t{1});
  return ends;
}

Cluster make_cluster(std::span<const int> members, std::span<const double> theta, const optics::Spectrum& n) {
  Cluster cluster;
  cluster.wavelengths.assign(members.begin(), members.end());
  double sum = 0;
  for (int member : members) sum += n[static_cast<std::size_t>(member)];
  cluster.n_mean = sum / static_cast<double>(members.size());
  cluster.theta_deg2 = std::accumulate(theta.begin(), theta.end(), 0.0);
  return cluster;
}

} // namespace

double refraction_integral_deg2(double n) {
  constexpr double end = last_angle_deg * degree;
  if (n >= 1) return arc_integral(1 / n, end) / (degree * degree);
  // Below 1 the integrand has an infinite slope at the critical angle and stays at 90 degrees beyond it. Integrating by
  // parts exchanges the axes, and the inverse theta1 = asin(n sin theta2) is smooth.
  const double theta2_end = std::asin(std::min(1.0, std::sin(end) / n));
  return (end * theta2_end - arc_integral(n, theta2_end)) / (degree * degree);
}

std::vector<double> theta_exact(std::span<const double> n) {
  std::vector<double> theta(n.size() - 1);
  double before = refraction_integral_deg2(n[0]);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double after = n[i + 1] == n[i] ? before : refraction_integral_deg2(n[i + 1]);
    theta[i] = std::max(0.0, after - before);
    before = after;
  }
  return theta;
}

// The corner derivatives are finite differences of psi on the grid, as the thesis takes them (appendix A.1, last
// paragraph), so that a staircase gives a large figure and not an infinite one. They approximate, with s = sin theta1,
// c = cos theta1,
//   psi_theta        = -c n n' / (n^2 - s^2)^(3/2)                                                   (A.2)
//   psi_lambda_theta = -c (n^3 n'' - s^2 n n'' - s^2 n'^2 - 2 n^2 n'^2) / (n^2 - s^2)^(5/2)          (A.3)
// (A.3) has lost its operators in print. It follows from (A.2): d/d lambda of n n' (n^2 - s^2)^(-3/2) is
// ((n n'' + n'^2) (n^2 - s^2) - 3 n^2 n'^2) (n^2 - s^2)^(-5/2).
std::vector<double> theta_patches(std::span<const double> n) {
  std::vector<double> theta = theta_exact(n);
  // The patch of step i reads psi at i - 1 .. i + 2; all of these need n >= 1, where (4.3) is finite up to 89 degrees.
  const auto from_one =
      static_cast<std::size_t>(std::ranges::find_if(n, [](double value) { return value < 1; }) - n.begin());
  const std::size_t steps = from_one == n.size() ? theta.size() : from_one - std::min<std::size_t>(from_one, 2);
  if (steps == 0) return theta;

  constexpr std::array<double, 16> weights = volume_weights();
  const Grid psi = angle_derivative(n.first(from_one)), psi_lambda = wavelength_difference(psi),
             psi_theta = angle_difference(psi), psi_both = wavelength_difference(psi_theta);
  const Grid* const values[] = {&psi, &psi_lambda, &psi_theta, &psi_both};
  for (std::size_t i = 0; i < steps; ++i) {
    double volume = 0;
    for (std::size_t j = 0; j + 1 < angle_count; ++j)
      for (std::size_t corner = 0; corner < 16; ++corner)
        volume += weights[corner] * (*values[corner / 4])(i + corner % 2, j + corner / 2 % 2);
    // A cubic undershoots beside a jump, but an angle sorted by n never falls.
    theta[i] = std::max(0.0, volume);
  }
  return theta;
}

Clustering cluster_wavelengths(const optics::Spectrum& n, double threshold_deg, ClusterMethod method) {
  check_input(n, threshold_deg);
  const Wavelengths order = by_falling_n(n);
  std::vector<double> sorted_n;
  for (int index : order) sorted_n.push_back(n[static_cast<std::size_t>(index)]);

  std::vector<double> theta = method == ClusterMethod::thesis ? theta_patches(sorted_n) : theta_exact(sorted_n);
  theta.push_back(theta.back());
  const double h = threshold_deg * last_angle_deg;
  const Ends ends = method == ClusterMethod::optimal  ? packed_from_the_left(theta, h)
                    : method == ClusterMethod::thesis ? merged_pairwise(theta, h)
                                                      : one_by_one();
  theta.back() = 0; // the last wavelength's change served the decision only

  Clustering result;
  result.method = method;
  result.threshold_deg = threshold_deg;
  result.total_theta_deg2 = std::accumulate(theta.begin(), theta.end(), 0.0);
  std::size_t begin = 0;
  for (std::size_t end : ends) {
    result.clusters.push_back(
        make_cluster(std::span(order).subspan(begin, end - begin), std::span(theta).subspan(begin, end - begin), n));
    begin = end;
  }
  return result;
}

std::vector<std::vector<int>> common_refinement(std::span<const Clustering> clusterings) {
  // The group of each wavelength so far; every clustering splits it by (group so far, cluster).
  Wavelengths group{};
  for (const Clustering& clustering : clusterings) {
    std::map<std::pair<int, std::size_t>, int> names;
    Wavelengths cluster_of{};
    for (std::size_t c = 0; c < clustering.clusters.size(); ++c)
      for (int index : clustering.clusters[c].wavelengths)
        cluster_of[static_cast<std::size_t>(index)] = static_cast<int>(c);
    for (std::size_t i = 0; i < group.size(); ++i)
      group[i] = names.try_emplace({group[i], cluster_of[i]}, static_cast<int>(names.size())).first->second;
  }
  // Groups were numbered in the order of first appearance, so they are ordered by their smallest wavelength.
  std::vector<std::vector<int>> result;
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (static_cast<std::size_t>(group[i]) == result.size()) result.emplace_back();
    result[static_cast<std::size_t>(group[i])].push_back(static_cast<int>(i));
  }
  return result;
}

} // namespace nephroid::photons
