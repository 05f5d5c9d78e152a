// SPDX-License-Identifier: Apache-2.0
// The two designed dispersion curves: they are what their files say, and sorting the wavelengths by n saves the clusters that it saves
// in the thesis (section 4.1.1: 202 and 204 clusters sorted, 247 not sorted). Not here: clustering as such (clusters_test.cpp).
#include "optics/dispersion.h"
#include "spectral/clusters/clusters.h"
#include "tests/support/test.h"

namespace nephroid::designed_curves_test {

using namespace nephroid::spectral;
using optics::Spectrum;

Spectrum material(const std::string& name)
{
  return optics::sample_n(optics::load_dispersion(std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/" + name + ".yml"),
                          optics::Outside::refuse);
}

double bump(double nm, double centre_nm, double width_nm) { return std::exp(-std::pow((nm - centre_nm) / width_nm, 2)); }

double arbitrary_1(double nm) { return 2.1 - 0.35 * (nm - 380) / 400 - 0.65 * bump(nm, 440, 20) + 0.7 * bump(nm, 595, 30); }
double arbitrary_2(double nm) { return 2 - 0.2 * (nm - 380) / 400 - 0.35 * bump(nm, 550, 40) + 0.75 * bump(nm, 640, 30); }

std::size_t crossings(const Spectrum& n, double level)
{
  std::size_t found = 0;
  for (std::size_t i = 0; i + 1 < n.size(); ++i) found += (n[i] - level) * (n[i + 1] - level) < 0;
  return found;
}

/// Algorithm 4.1 over neighbours in wavelength, which is what the thesis compares sorting with: Theta is the size of the change to the
/// next wavelength, up or down. The last wavelength decides by the change of the one before it, as in clusters.h.
std::size_t clusters_without_sorting(const Spectrum& n, double threshold_deg)
{
  const double h = threshold_deg * last_angle_deg;
  std::vector<double> theta;
  for (std::size_t i = 0; i + 1 < n.size(); ++i)
    theta.push_back(std::fabs(refraction_integral_deg2(n[i + 1]) - refraction_integral_deg2(n[i])));
  theta.push_back(theta.back());

  // A final cluster's Theta is at least h, so no sum with it is below h; only a neighbour of exactly 0 could make one that equals h.
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

std::size_t clusters_sorted(const Spectrum& n, double threshold_deg)
{
  return cluster_wavelengths(n, threshold_deg, ClusterMethod::thesis).clusters.size();
}

TEST(DesignedCurves, FilesHoldTheirFormulas)
{
  const Spectrum one = material("arbitrary-1"), two = material("arbitrary-2");
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const double nm = optics::wavelength_nm(i);
    EXPECT_NEAR(one[static_cast<std::size_t>(i)], arbitrary_1(nm), 0.5000001e-8) << nm; // eight decimals
    EXPECT_NEAR(two[static_cast<std::size_t>(i)], arbitrary_2(nm), 0.5000001e-8) << nm;
  }
}

TEST(DesignedCurves, TheFirstMeetsTwoFiveTimes) { EXPECT_EQ(crossings(material("arbitrary-1"), 2), 5u); }

// A glass whose n falls everywhere is sorted as it is: there both ways must agree, which checks the helper above.
TEST(DesignedCurves, SortingChangesNothingWhereNFalls)
{
  const Spectrum glass = optics::sample_n(optics::load_dispersion(std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/N-SF66.yml"),
                                          optics::Outside::automatic);
  for (double threshold : {0.5, 0.1, 0.05, 0.01}) EXPECT_EQ(clusters_without_sorting(glass, threshold), clusters_sorted(glass, threshold));
}

TEST(DesignedCurves, SortedTheyNeedTheThesisNumbersOfClusters)
{
  EXPECT_EQ(clusters_sorted(material("arbitrary-1"), 0.05), 202u);
  EXPECT_EQ(clusters_sorted(material("arbitrary-2"), 0.05), 204u);
  EXPECT_EQ(clusters_without_sorting(material("arbitrary-1"), 0.05), 247u);
  EXPECT_EQ(clusters_without_sorting(material("arbitrary-2"), 0.05), 247u);
}

} // namespace nephroid::designed_curves_test
