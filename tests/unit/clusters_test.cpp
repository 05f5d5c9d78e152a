// SPDX-License-Identifier: Apache-2.0
// Wavelength clusters: the figures for N-SF66 and N-BK7, exact integrals, and what must hold for any curve. The two
// designed dispersion curves: sorting the wavelengths by n saves the clusters that it saves in the thesis
// (section 4.1.1: 202 and 204 sorted, 247 not sorted).
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "photons/clusters/clusters.h"
#include "tests/support/test.h"

namespace nephroid::clusters_test {

using namespace nephroid::photons;
using optics::Spectrum;

constexpr double radian = std::numbers::pi / 180;

Spectrum glass(const std::string& name) {
  return optics::sample_n(
      optics::load_dispersion(std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/" + name + ".yml"),
      optics::Extrapolation::automatic);
}

Spectrum made(const std::function<double(double nm)>& n) {
  Spectrum result{};
  for (int i = 0; i < optics::wavelength_count; ++i) result[static_cast<std::size_t>(i)] = n(optics::wavelength_nm(i));
  return result;
}

std::size_t count(const Spectrum& n, double threshold_deg, ClusterMethod method) {
  return cluster_wavelengths(n, threshold_deg, method).clusters.size();
}

/// theta2 in degrees; 90 beyond the critical angle.
double theta2(double theta1_deg, double n) {
  return std::asin(std::min(1.0, std::sin(theta1_deg * radian) / n)) / radian;
}

/// Midpoint rule with many points: slow, and independent of the quadrature under test.
double integral_deg2(double n) {
  constexpr int steps = 200000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += theta2((i + 0.5) * last_angle_deg / steps, n);
  return sum * last_angle_deg / steps;
}

/// What must hold for every clustering: each wavelength once, sorted by falling n, the bound, the sums.
void expect_sound(const Spectrum& n, const Clustering& clustering) {
  std::vector<int> all;
  double total = 0, previous = INFINITY;
  for (const Cluster& cluster : clustering.clusters) {
    ASSERT_FALSE(cluster.wavelengths.empty());
    double sum = 0;
    for (int index : cluster.wavelengths) {
      const double value = n[static_cast<std::size_t>(index)];
      EXPECT_LE(value, previous);
      previous = value;
      sum += value;
    }
    EXPECT_NEAR(cluster.n_mean, sum / static_cast<double>(cluster.wavelengths.size()), 1e-12 * cluster.n_mean);
    EXPECT_TRUE(std::isfinite(cluster.theta_deg2));
    if (cluster.wavelengths.size() > 1) {
      EXPECT_LE(cluster.theta_deg2, clustering.threshold_deg * 89 * (1 + 1e-12));
    }
    total += cluster.theta_deg2;
    all.insert(all.end(), cluster.wavelengths.begin(), cluster.wavelengths.end());
  }
  EXPECT_NEAR(total, clustering.total_theta_deg2, 1e-9 * (1 + total));
  std::sort(all.begin(), all.end());
  std::vector<int> each(optics::wavelength_count);
  std::iota(each.begin(), each.end(), 0);
  EXPECT_EQ(all, each);
}

TEST(Clusters, TotalOfNsf66) {
  const Spectrum n = glass("N-SF66");
  for (ClusterMethod method : {ClusterMethod::optimal, ClusterMethod::thesis, ClusterMethod::brute_force})
    EXPECT_NEAR(cluster_wavelengths(n, 0.05, method).total_theta_deg2, 130.936, 0.001);
}

TEST(Clusters, CountsOfNsf66AndNbk7) {
  const Spectrum flint = glass("N-SF66"), crown = glass("N-BK7");
  EXPECT_EQ(count(flint, 0.05, ClusterMethod::optimal), 32u);
  EXPECT_EQ(count(flint, 0.1, ClusterMethod::optimal), 16u);
  const double thresholds[] = {0.5, 0.1, 0.05, 0.01};
  const std::size_t flint_counts[] = {4, 21, 41, 190}, crown_counts[] = {1, 7, 12, 60};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(count(flint, thresholds[i], ClusterMethod::thesis), flint_counts[i]) << thresholds[i];
    EXPECT_EQ(count(crown, thresholds[i], ClusterMethod::thesis), crown_counts[i]) << thresholds[i];
    EXPECT_LE(count(flint, thresholds[i], ClusterMethod::optimal), flint_counts[i]);
    EXPECT_LE(count(crown, thresholds[i], ClusterMethod::optimal), crown_counts[i]);
  }
  EXPECT_EQ(count(flint, 0.05, ClusterMethod::brute_force), 401u);
}

TEST(Clusters, PatchesAgreeWithTheExactIntegral) {
  const Spectrum n = glass("N-SF66"); // falls everywhere: already sorted
  const std::vector<double> exact = theta_exact(n), patches = theta_patches(n);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) worst = std::max(worst, std::fabs(patches[i] / exact[i] - 1));
  EXPECT_LT(worst, 0.0034);
  const double sum = std::accumulate(exact.begin(), exact.end(), 0.0),
               patch_sum = std::accumulate(patches.begin(), patches.end(), 0.0);
  EXPECT_LT(std::fabs(patch_sum / sum - 1), 5e-6);
}

TEST(Clusters, RefractionIntegralAboveAtAndBelowOne) {
  EXPECT_NEAR(refraction_integral_deg2(1), 89 * 89 / 2.0, 1e-9); // theta2 = theta1
  for (double n : {0.2, 0.9, 0.9995, 0.9999, 1.00001, 1.3, 1.9, 4.0})
    EXPECT_NEAR(refraction_integral_deg2(n), integral_deg2(n), 1e-4) << n;
  EXPECT_NEAR(refraction_integral_deg2(1e-9), 90 * 89, 1e-4); // reflected from the start
  EXPECT_NEAR(refraction_integral_deg2(1e9), 0, 1e-3);
}

// (A.3) as derived in clusters.cpp, against differences of (4.3) along a curve n(lambda) with known n' and n''.
TEST(Clusters, MixedDerivativeOfAppendixA) {
  const auto n = [](double l) { return 1.9 - 0.2 * std::sin(l); };
  const auto psi = [&](double l, double theta) {
    const double s = std::sin(theta), value = n(l), slope = -0.2 * std::cos(l);
    return -s * slope / (value * std::sqrt(value * value - s * s));
  };
  for (double l : {0.3, 1.0, 2.0})
    for (double theta : {0.2, 0.8, 1.4}) {
      const double h = 1e-4;
      const double measured =
          (psi(l + h, theta + h) - psi(l + h, theta - h) - psi(l - h, theta + h) + psi(l - h, theta - h)) / (4 * h * h);
      const double v = n(l), d = -0.2 * std::cos(l), dd = 0.2 * std::sin(l), s2 = std::sin(theta) * std::sin(theta),
                   c = std::cos(theta);
      const double derived =
          -c * (v * v * v * dd - s2 * v * dd - s2 * d * d - 2 * v * v * d * d) / std::pow(v * v - s2, 2.5);
      EXPECT_NEAR(measured, derived, 1e-6) << l << " " << theta;
    }
}

/// The fewest contiguous groups by dynamic programming over all divisions.
std::size_t fewest(const std::vector<double>& theta, double h) {
  std::vector<std::size_t> best(theta.size() + 1, 0);
  for (std::size_t end = 1; end <= theta.size(); ++end) {
    best[end] = best[end - 1] + 1;
    double sum = theta[end - 1];
    for (std::size_t begin = end - 1; begin-- > 0;) {
      sum += theta[begin];
      if (sum > h) break;
      best[end] = std::min(best[end], best[begin] + 1);
    }
  }
  return best.back();
}

TEST(Clusters, RandomCurvesAreSoundAndTheOptimalOnesHaveTheFewest) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 20; ++round) {
    const double low = 1 + uniform(random), width = std::pow(10, -3 * uniform(random));
    Spectrum n{};
    for (double& value : n) value = low + width * uniform(random);
    const double threshold = std::pow(10, -2 * uniform(random)) * 0.5;
    for (ClusterMethod method : {ClusterMethod::optimal, ClusterMethod::thesis, ClusterMethod::brute_force})
      expect_sound(n, cluster_wavelengths(n, threshold, method));
    Spectrum sorted = n;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    std::vector<double> theta = theta_exact(sorted);
    theta.push_back(theta.back());
    EXPECT_EQ(count(n, threshold, ClusterMethod::optimal), fewest(theta, threshold * 89)) << round;
  }
}

TEST(Clusters, FlatCurveIsOneClusterWithoutChange) {
  for (double value : {0.8, 1.0, 1.5}) {
    const Spectrum n = made([=](double) { return value; });
    for (ClusterMethod method : {ClusterMethod::optimal, ClusterMethod::thesis}) {
      const Clustering clustering = cluster_wavelengths(n, 0.05, method);
      EXPECT_EQ(clustering.clusters.size(), 1u);
      EXPECT_EQ(clustering.total_theta_deg2, 0);
      expect_sound(n, clustering);
    }
  }
}

// n = 1.6 up to 580 nm and 1.5 beyond. The wavelength before the jump has the whole change and stands alone; so do,
// with the patches' central differences, its neighbours.
TEST(Clusters, StaircasePutsTheJumpInItsOwnCluster) {
  const Spectrum n = made([](double nm) { return nm <= 580 ? 1.6 : 1.5; });
  const Clustering optimal = cluster_wavelengths(n, 0.05, ClusterMethod::optimal);
  expect_sound(n, optimal);
  ASSERT_EQ(optimal.clusters.size(), 3u);
  EXPECT_EQ(optimal.clusters[1].wavelengths, (std::vector<int>{580 - optics::first_nm}));
  EXPECT_NEAR(optimal.clusters[1].theta_deg2, refraction_integral_deg2(1.5) - refraction_integral_deg2(1.6), 1e-9);
  EXPECT_EQ(optimal.clusters[0].theta_deg2, 0);

  const Clustering thesis = cluster_wavelengths(n, 0.05, ClusterMethod::thesis);
  expect_sound(n, thesis);
  for (const Cluster& cluster : thesis.clusters) {
    const auto at = [&](int index) { return n[static_cast<std::size_t>(index)]; };
    EXPECT_EQ(at(cluster.wavelengths.front()), at(cluster.wavelengths.back()));
  }
}

TEST(Clusters, AJumpAtTheVeryEndSeparatesTheLastWavelength) {
  const Spectrum n = made([](double nm) { return nm < 780 ? 1.6 : 1.5; });
  const Clustering clustering = cluster_wavelengths(n, 0.05, ClusterMethod::optimal);
  EXPECT_EQ(clustering.clusters.back().wavelengths, (std::vector<int>{400}));
  EXPECT_EQ(clustering.clusters.back().theta_deg2, 0);
}

// A curve that meets every n several times: sorted, far fewer clusters are needed than wavelengths between two
// threshold steps.
TEST(Clusters, NeighboursInIndexAreClusteredNotNeighboursInWavelength) {
  const Spectrum wave = made([](double nm) { return 2 + 0.05 * std::sin(2 * std::numbers::pi * (nm - 380) / 80); });
  const Clustering sorted = cluster_wavelengths(wave, 0.1, ClusterMethod::optimal);
  expect_sound(wave, sorted);
  // The change from the highest to the lowest n, however often the curve goes up and down.
  EXPECT_NEAR(sorted.total_theta_deg2, integral_deg2(1.95) - integral_deg2(2.05), 1e-4);
  const Cluster& highest = sorted.clusters.front();
  const auto [first, last] = std::minmax_element(highest.wavelengths.begin(), highest.wavelengths.end());
  EXPECT_GT(*last - *first, 300); // from the first crest to the last
}

TEST(Clusters, BelowOneTheAngleEndsAtNinetyDegreesAndNothingIsNan) {
  const Spectrum across = made([](double nm) { return 1.02 - 0.04 * (nm - 380) / 400; }); // 1.02 down to .98
  for (ClusterMethod method : {ClusterMethod::optimal, ClusterMethod::thesis}) {
    const Clustering clustering = cluster_wavelengths(across, 0.05, method);
    expect_sound(across, clustering);
    EXPECT_NEAR(clustering.total_theta_deg2, integral_deg2(0.98) - integral_deg2(1.02),
                method == ClusterMethod::optimal ? 1e-4 : 0.5);
  }
  for (double scale : {1e-6, 1e6}) { // far outside glass: still finite
    const Spectrum extreme = made([=](double nm) { return scale * (2 - nm / 1000); });
    for (ClusterMethod method : {ClusterMethod::optimal, ClusterMethod::thesis})
      expect_sound(extreme, cluster_wavelengths(extreme, 0.05, method));
  }
}

TEST(Clusters, BadInputIsRefused) {
  const auto error_of = [](const Spectrum& n, double threshold) {
    return test::refusal_of([&] { cluster_wavelengths(n, threshold, ClusterMethod::optimal); });
  };
  const Spectrum good = made([](double) { return 1.5; });
  for (double threshold : {0.0, -1.0, 90.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_THAT(error_of(good, threshold), HasSubstr("expected above 0 and below 90"));
  for (double value : {0.0, -1.5, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    Spectrum bad = good;
    bad[20] = value;
    EXPECT_THAT(error_of(bad, 0.05), HasSubstr("at 400 nm; expected a number above 0"));
  }
}

TEST(Clusters, CommonRefinementKeepsTogetherWhatIsTogetherEverywhere) {
  const Spectrum flint = glass("N-SF66"), dye = glass("rhodamine-6G-Seckin");
  const std::vector<Clustering> both{cluster_wavelengths(flint, 0.1, ClusterMethod::optimal),
                                     cluster_wavelengths(dye, 0.1, ClusterMethod::optimal)};
  const auto cluster_of = [&](const Clustering& clustering) {
    std::vector<std::size_t> result(optics::wavelength_count);
    for (std::size_t c = 0; c < clustering.clusters.size(); ++c)
      for (int index : clustering.clusters[c].wavelengths) result[static_cast<std::size_t>(index)] = c;
    return result;
  };
  const std::vector<std::size_t> a = cluster_of(both[0]), b = cluster_of(both[1]);
  const std::vector<std::vector<int>> groups = common_refinement(both);
  std::vector<std::size_t> group_of(optics::wavelength_count);
  int previous_first = -1;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    EXPECT_TRUE(std::is_sorted(groups[g].begin(), groups[g].end()));
    EXPECT_GT(groups[g].front(), previous_first);
    previous_first = groups[g].front();
    for (int index : groups[g]) group_of[static_cast<std::size_t>(index)] = g;
  }
  for (std::size_t i = 0; i < group_of.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_EQ(group_of[i] == group_of[j], a[i] == a[j] && b[i] == b[j]) << i << " " << j;
}

TEST(Clusters, CommonRefinementOfNothingOneAndItself) {
  const std::vector<std::vector<int>> none = common_refinement({});
  ASSERT_EQ(none.size(), 1u);
  EXPECT_EQ(none[0].size(), 401u);
  const Clustering one = cluster_wavelengths(glass("N-BK7"), 0.05, ClusterMethod::optimal);
  EXPECT_EQ(common_refinement(std::vector{one}).size(), one.clusters.size());
  EXPECT_EQ(common_refinement(std::vector{one, one}), common_refinement(std::vector{one}));
}

Spectrum material(const std::string& name) {
  return optics::sample_n(
      optics::load_dispersion(std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/" + name + ".yml"),
      optics::Extrapolation::refuse);
}

double bump(double nm, double centre_nm, double width_nm) {
  return std::exp(-std::pow((nm - centre_nm) / width_nm, 2));
}

double arbitrary_1(double nm) {
  return 2.1 - 0.35 * (nm - 380) / 400 - 0.65 * bump(nm, 440, 20) + 0.7 * bump(nm, 595, 30);
}
double arbitrary_2(double nm) {
  return 2 - 0.2 * (nm - 380) / 400 - 0.35 * bump(nm, 550, 40) + 0.75 * bump(nm, 640, 30);
}

std::size_t crossings(const Spectrum& n, double level) {
  std::size_t found = 0;
  for (std::size_t i = 0; i + 1 < n.size(); ++i) found += (n[i] - level) * (n[i + 1] - level) < 0;
  return found;
}

/// Algorithm 4.1 over neighbours in wavelength, which is what the thesis compares sorting with: Theta is the size of
/// the change to the next wavelength, up or down. The last wavelength decides by the change of the one before it, as in
/// clusters.h.
std::size_t clusters_without_sorting(const Spectrum& n, double threshold_deg) {
  const double h = threshold_deg * last_angle_deg;
  std::vector<double> theta;
  for (std::size_t i = 0; i + 1 < n.size(); ++i)
    theta.push_back(std::fabs(refraction_integral_deg2(n[i + 1]) - refraction_integral_deg2(n[i])));
  theta.push_back(theta.back());

  // A final cluster's Theta is at least h, so no sum with it is below h; only a neighbour of exactly 0 could make one
  // that equals h.
  while (theta.size() > 1) {
    std::vector<double> sums;
    std::transform(theta.begin(), theta.end() - 1, theta.begin() + 1, std::back_inserter(sums), std::plus<>());
    const auto least = std::min_element(sums.begin(), sums.end());
    if (*least > h) break;
    const auto left = theta.begin() + (least - sums.begin());
    *left = *least;
    theta.erase(left + 1);
  }
  return theta.size();
}

std::size_t clusters_sorted(const Spectrum& n, double threshold_deg) {
  return cluster_wavelengths(n, threshold_deg, ClusterMethod::thesis).clusters.size();
}

TEST(DesignedCurves, FilesHoldTheirFormulas) {
  const Spectrum one = material("arbitrary-1"), two = material("arbitrary-2");
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const double nm = optics::wavelength_nm(i);
    EXPECT_NEAR(one[static_cast<std::size_t>(i)], arbitrary_1(nm), 0.5000001e-8) << nm; // eight decimals
    EXPECT_NEAR(two[static_cast<std::size_t>(i)], arbitrary_2(nm), 0.5000001e-8) << nm;
  }
}

TEST(DesignedCurves, TheFirstMeetsTwoFiveTimes) { EXPECT_EQ(crossings(material("arbitrary-1"), 2), 5u); }

// A glass whose n falls everywhere is sorted as it is: there both ways must agree, which checks the helper above.
TEST(DesignedCurves, SortingChangesNothingWhereNFalls) {
  const Spectrum glass =
      optics::sample_n(optics::load_dispersion(std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/N-SF66.yml"),
                       optics::Extrapolation::automatic);
  for (double threshold : {0.5, 0.1, 0.05, 0.01})
    EXPECT_EQ(clusters_without_sorting(glass, threshold), clusters_sorted(glass, threshold));
}

TEST(DesignedCurves, SortedTheyNeedTheThesisNumbersOfClusters) {
  EXPECT_EQ(clusters_sorted(material("arbitrary-1"), 0.05), 202u);
  EXPECT_EQ(clusters_sorted(material("arbitrary-2"), 0.05), 204u);
  EXPECT_EQ(clusters_without_sorting(material("arbitrary-1"), 0.05), 247u);
  EXPECT_EQ(clusters_without_sorting(material("arbitrary-2"), 0.05), 247u);
}

} // namespace nephroid::clusters_test
