// SPDX-License-Identifier: Apache-2.0
// The spectra of the sRGB primaries: the right colour, and nothing smoother has it.
#include "optics/colour.h"
#include "tests/support/test.h"

namespace nephroid::primary_spectra_test {

using namespace nephroid::optics;
using Second = std::array<double, wavelength_count - 2>;

Second second_differences(const Spectrum& s)
{
  Second d{};
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = s[i] - 2 * s[i + 1] + s[i + 2];
  return d;
}

double inner(const auto& a, const auto& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// What is left of a spectrum without its part along the colour-matching functions (Gram-Schmidt): it is black to the eye.
Spectrum without_colour(Spectrum s)
{
  const ColourMatching& eye = cie_1931();
  std::vector<Spectrum> basis;
  for (const Spectrum* function : {&eye.x, &eye.y, &eye.z}) {
    Spectrum b = *function;
    for (int twice = 0; twice < 2; ++twice) // once more for what rounding left
      for (const Spectrum& other : basis) {
        const double part = inner(b, other);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] -= part * other[i];
      }
    const double length = std::sqrt(inner(b, b));
    for (double& value : b) value /= length;
    basis.push_back(b);
  }
  for (const Spectrum& b : basis) {
    const double part = inner(s, b);
    for (std::size_t i = 0; i < s.size(); ++i) s[i] -= part * b[i];
  }
  return s;
}

TEST(PrimarySpectra, HaveTheColoursOfThePrimaries)
{
  for (std::size_t primary = 0; primary < 3; ++primary) {
    const Colour rgb = xyz_to_linear_srgb(to_xyz(primary_spectra()[primary]));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], c == primary ? 1 : 0, 1e-12) << primary;
  }
}

// To a colour and back, for colours inside the gamut, outside of it and far brighter than white.
TEST(PrimarySpectra, AreThereAndBack)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-2, 100);
  for (int i = 0; i < 100; ++i) {
    const Colour rgb{value(random), value(random), value(random)};
    Spectrum s{};
    for (std::size_t w = 0; w < s.size(); ++w)
      for (std::size_t p = 0; p < 3; ++p) s[w] += rgb[p] * primary_spectra()[p][w];
    const Colour back = xyz_to_linear_srgb(to_xyz(s));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-6);
  }
}

// A convex function is smallest where it does not change to first order in any direction that keeps the colour: |D (s + e v)|^2 has the
// slope 2 (D s).(D v) in e. Directions: each wavelength by itself, and random ones.
TEST(PrimarySpectra, NothingSmootherHasTheirColour)
{
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<Spectrum> directions;
  for (std::size_t w = 0; w < wavelength_count; w += 7) directions.emplace_back()[w] = 1;
  for (int i = 0; i < 50; ++i)
    for (double& value : directions.emplace_back()) value = normal(random);
  for (const Spectrum& s : primary_spectra()) {
    const Second curvature = second_differences(s);
    EXPECT_GT(inner(curvature, curvature), 0);
    for (const Spectrum& direction : directions) {
      const Second change = second_differences(without_colour(direction));
      const double slope = inner(curvature, change) / std::sqrt(inner(curvature, curvature) * inner(change, change));
      EXPECT_LT(std::abs(slope), 1e-7);
    }
  }
}

// Grey light has power at every wavelength, so nothing that absorbs can make it negative, and it falls off towards red as daylight does.
TEST(PrimarySpectra, GreyHasPowerEverywhere)
{
  double sum_of_y = 0;
  for (const double y : cie_1931().y) sum_of_y += y;
  for (std::size_t w = 0; w < wavelength_count; ++w) {
    double grey = 0; // in units of the even spectrum with Y = 1
    for (const Spectrum& s : primary_spectra()) grey += s[w] * sum_of_y;
    EXPECT_GT(grey, 0.3) << w;
    EXPECT_LT(grey, 1.2) << w;
  }
}

} // namespace nephroid::primary_spectra_test
