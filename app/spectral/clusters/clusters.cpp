// SPDX-License-Identifier: Apache-2.0
#include "spectral/clusters/clusters.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace nephroid::spectral {
namespace {

using Wavelengths = std::array<int, optics::wavelength_count>;
/// One past the last member of each group, in the sorted order.
using Ends = std::vector<std::size_t>;

void check_input(const optics::Spectrum& n, double threshold_deg)
{
  if (!(threshold_deg > 0 && threshold_deg < 90))
    throw bad_input("clusters", fmt::format("the threshold is {} degrees", threshold_deg), "expected above 0 and below 90");
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const double value = n[static_cast<std::size_t>(i)];
    if (!std::isfinite(value) || !(value > 0))
      throw bad_input("clusters", fmt::format("the index of refraction is {} at {} nm", value, optics::wavelength_nm(i)),
                      "expected a number above 0");
  }
}

Wavelengths by_falling_n(const optics::Spectrum& n)
{
  Wavelengths order{};
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return n[static_cast<std::size_t>(a)] > n[static_cast<std::size_t>(b)]; });
  return order;
}

/// Fills each group from the left as far as the bound allows. A group may be used when it is one wavelength or sums to at most
/// h. No division into contiguous groups has fewer: every contiguous part of a usable group is usable, because Theta >= 0. Let
/// our k-th group end at g_k and that of any other division at o_k. Then g_k >= o_k, by induction over k: where o_k > g_(k-1), the
/// wavelengths g_(k-1) + 1 .. o_k are a part of the other's k-th group (as o_(k-1) <= g_(k-1)), so they are usable, and ours,
/// which starts at the same wavelength and goes as far as it can, reaches o_k at least. So ours is through no later.
Ends packed_from_the_left(const std::vector<double>& theta, double h)
{
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

/// Algorithm 4.1 as printed: merge the two neighbouring free clusters with the smallest sum, again and again, while that sum is
/// at most h. A wavelength whose own Theta reaches h is final from the start.
Ends merged_pairwise(const std::vector<double>& theta, double h)
{
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

Ends one_by_one()
{
  Ends ends(optics::wavelength_count);
  std::iota(ends.begin(), ends.end(), std::size_t{1});
  return ends;
}

Cluster make_cluster(std::span<const int> members, std::span<const double> theta, const optics::Spectrum& n)
{
  Cluster cluster;
  cluster.wavelengths.assign(members.begin(), members.end());
  double sum = 0;
  for (int member : members) sum += n[static_cast<std::size_t>(member)];
  cluster.n_mean = sum / static_cast<double>(members.size());
  cluster.theta_deg2 = std::accumulate(theta.begin(), theta.end(), 0.0);
  return cluster;
}

} // namespace

Clustering cluster_wavelengths(const optics::Spectrum& n, double threshold_deg, ClusterMethod method)
{
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
  theta.back() = 0; // the last wavelength goes nowhere: its change was there for the decision only

  Clustering result;
  result.method = method;
  result.threshold_deg = threshold_deg;
  result.total_theta_deg2 = std::accumulate(theta.begin(), theta.end(), 0.0);
  std::size_t begin = 0;
  for (std::size_t end : ends) {
    result.clusters.push_back(make_cluster(std::span(order).subspan(begin, end - begin), std::span(theta).subspan(begin, end - begin), n));
    begin = end;
  }
  return result;
}

std::vector<std::vector<int>> common_refinement(std::span<const Clustering> clusterings)
{
  // The group of each wavelength so far; every clustering splits it by (group so far, cluster).
  Wavelengths group{};
  for (const Clustering& clustering : clusterings) {
    std::map<std::pair<int, std::size_t>, int> names;
    Wavelengths cluster_of{};
    for (std::size_t c = 0; c < clustering.clusters.size(); ++c)
      for (int index : clustering.clusters[c].wavelengths) cluster_of[static_cast<std::size_t>(index)] = static_cast<int>(c);
    for (std::size_t i = 0; i < group.size(); ++i)
      group[i] = names.try_emplace({group[i], cluster_of[i]}, static_cast<int>(names.size())).first->second;
  }
  // Names were given in the order of first appearance, so groups come out by their smallest wavelength.
  std::vector<std::vector<int>> result;
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (static_cast<std::size_t>(group[i]) == result.size()) result.emplace_back();
    result[static_cast<std::size_t>(group[i])].push_back(static_cast<int>(i));
  }
  return result;
}

} // namespace nephroid::spectral
