// SPDX-License-Identifier: Apache-2.0
// The best mixture of a noisy picture and an estimate: never worse than the better of the two, whatever the estimate is
// worth.
#include "photons/mixture.h"

#include "tests/support/test.h"

#include <random>

namespace nephroid::mixture_test {

constexpr int side = 64;
constexpr std::size_t values = 3 * side * side;

double square(std::span<const float> a, std::span<const float> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return sum / static_cast<double>(a.size());
}

/// A ramp, seen with noise of a deviation of .1 in two halves, and known with a bias. Mean squares of the errors of the
/// picture, of what is known, of their mixture, and of the draw that says how far that is off.
struct Errors {
  double picture, known, mixed, said;
};
Errors errors_with(double bias, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> noise(0, 0.1F);
  std::vector<float> truth(values), picture(values), draw(values), biased(values);
  for (std::size_t i = 0; i < values; ++i) {
    const auto x = static_cast<double>(i / 3 % side) / side;
    truth[i] = static_cast<float>(0.5 + x);
    const float a = noise(generator), b = noise(generator); // of the halves: their mean has .1 / sqrt(2)
    picture[i] = truth[i] + (a + b) / 2;
    draw[i] = (a - b) / 2;
    biased[i] = truth[i] + static_cast<float>(bias * std::sin(20 * x));
  }
  std::vector<float> mixed = picture, mixed_draw = draw;
  photons::mix(picture, draw, {biased, {}}, std::vector<double>(side * side, 1), side, side, mixed, mixed_draw);
  const std::vector<float> none(values);
  return {square(picture, truth), square(biased, truth), square(mixed, truth), square(mixed_draw, none)};
}

TEST(Mixture, IsAsGoodAsTheBetterOne) {
  for (const double bias : {0.0, 0.01, 0.03, 0.1, 0.3, 3.0}) {
    const Errors e = errors_with(bias, 7);
    // By theory the square of the mixture's error is 1 / (1 / picture + 1 / known) where the bias is even; here it
    // comes and goes. A window of 17 x 17 pixels tells what it gains to a standard deviation, some 4 % of the picture's
    // square; 1e-4 is 2 % of that.
    EXPECT_LT(e.mixed, 1.03 * std::min(e.picture, e.known) + 1e-4) << "bias " << bias;
    EXPECT_GT(e.mixed, 0.9 / (1 / e.picture + 1 / e.known)) << "bias " << bias;
    EXPECT_LT(e.said, 1.1 * e.mixed + 5e-5) << "the draw is of the noise alone, bias " << bias;
  }
}

// Where there is no noise, nothing changes.
TEST(Mixture, LeavesWhatIsKnownExactly) {
  const std::vector<float> picture(values, 0.5F), none(values);
  std::vector<float> mixed = picture, draw = none;
  const std::vector<float> wrong(values, 1.5F);
  photons::mix(picture, none, {wrong, {}}, std::vector<double>(side * side, 0.5), side, side, mixed, draw);
  EXPECT_EQ(mixed, picture);
  EXPECT_EQ(draw, none);
}

} // namespace nephroid::mixture_test
