// SPDX-License-Identifier: Apache-2.0
// The best mixture of a noisy picture and an estimate: never worse than the better of the two, whatever the estimate is
// worth.
#include "photons/mixture.h"

#include "tests/support/test.h"

#include <fmt/format.h>

#include <numeric>
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

/// Frames of a film, each mixed with the one before. Photons fall on each of two halves with a mean of `photons` a
/// pixel at a light of 1, so that the variance of a frame by itself is light / (2 photons).
class Film {
public:
  explicit Film(double photons, unsigned seed = 3) : photons_(photons), generator_(seed) {}

  void next(const std::vector<float>& truth) {
    own_.assign(values, 0);
    std::vector<float> draw(values);
    for (std::size_t i = 0; i < values; i += 3) {
      std::poisson_distribution<int> photons(photons_ * truth[i]);
      const double a = photons(generator_) / photons_, b = photons(generator_) / photons_;
      for (std::size_t c = i; c < i + 3; ++c)
        own_[c] = static_cast<float>((a + b) / 2), draw[c] = static_cast<float>((a - b) / 2);
    }
    std::vector<float> mixed = own_, mixed_draw = draw;
    said_ = draw;
    if (!mixed_.empty()) said_ = photons::mix_before({mixed_, draw_}, side, side, mixed, mixed_draw);
    mixed_ = std::move(mixed), draw_ = std::move(mixed_draw);
  }
  const std::vector<float>& own() const { return own_; }
  const std::vector<float>& mixed() const { return mixed_; }
  const std::vector<float>& said() const { return said_; }

private:
  double photons_;
  std::mt19937 generator_;
  std::vector<float> own_, mixed_, draw_, said_;
};

/// A light of 1 with a square of `light` from column `left` on, 12 pixels wide and high.
std::vector<float> lit_square(float light, int left) {
  std::vector<float> truth(values, 1);
  for (int y = 20; y < 32; ++y)
    for (int x = left; x < left + 12; ++x)
      for (int c = 0; c < 3; ++c) truth[static_cast<std::size_t>(3 * (y * side + x) + c)] = light;
  return truth;
}

double mean(std::span<const float> rgb) {
  return std::accumulate(rgb.begin(), rgb.end(), 0.0) / static_cast<double>(rgb.size());
}

// What stands still has the noise of all frames together: after n of them 1 / n of the variance of one.
TEST(FramesThatKnowEachOther, GatherWhatStandsStill) {
  for (const double photons : {2.0, 20.0}) {
    Film film(photons);
    const std::vector<float> truth = lit_square(4, 10);
    constexpr int frames = 12;
    for (int i = 0; i < frames; ++i) film.next(truth);
    EXPECT_LT(square(film.mixed(), truth), 1.8 / frames * square(film.own(), truth)) << photons;
    EXPECT_GT(square(film.mixed(), truth), 0.8 / frames * square(film.own(), truth)) << photons;
    const std::vector<float> none(values);
    const double said = square(film.said(), none) / square(film.mixed(), truth);
    EXPECT_GT(said, 0.8) << photons;
    EXPECT_LT(said, 1.6) << photons << ": with what may be bias";
  }
}

// A lamp goes out, or a caustic jumps away, between two frames: what is left of it is less than the noise that it had,
// and the error of no film is above that of frames by themselves.
TEST(FramesThatKnowEachOther, LeaveNoGhost) {
  for (const double photons : {2.0, 20.0})
    for (const float light : {1.5f, 2.0f, 10.0f, 100.0f}) {
      Film film(photons);
      for (int i = 0; i < 12; ++i) film.next(lit_square(light, 10));
      const std::vector<float> truth = lit_square(light, 40);
      film.next(truth);
      SCOPED_TRACE(fmt::format("light {}, {} photons", light, photons));
      EXPECT_LT(square(film.mixed(), truth), 1.02 * square(film.own(), truth));
      double left = 0;
      for (int y = 20; y < 32; ++y)
        for (int x = 10; x < 22; ++x) left += film.mixed()[static_cast<std::size_t>(3 * (y * side + x))] - 1;
      EXPECT_LT(left / 144, std::sqrt(1 / (2 * photons))) << "the deviation of a pixel by itself";
      for (int i = 0; i < 3; ++i) film.next(truth);
      EXPECT_LT(square(film.mixed(), truth), 0.6 * square(film.own(), truth)) << "and gathers again";
    }
}

// Where light moves on by a pixel a frame, the bias that stays behind does not grow from frame to frame.
TEST(FramesThatKnowEachOther, DoNotGatherBias) {
  Film film(20);
  for (int i = 0; i < 40; ++i) {
    const std::vector<float> truth = lit_square(3, 5 + i);
    film.next(truth);
    EXPECT_LT(square(film.mixed(), truth), 1.02 * square(film.own(), truth)) << i;
  }
}

// Noise of photons is skewed: bright places are noisy ones. The light of a film stays all the same.
TEST(FramesThatKnowEachOther, AreNotDarker) {
  for (const double photons : {0.05, 0.5, 5.0}) {
    double sum = 0, square_sum = 0;
    constexpr int films = 24;
    for (unsigned seed = 1; seed <= films; ++seed) {
      Film film(photons, seed);
      for (int i = 0; i < 8; ++i) film.next(lit_square(4, 10));
      const double light = mean(film.mixed()) / mean(lit_square(4, 10));
      sum += light, square_sum += light * light;
    }
    const double light = sum / films, deviation = std::sqrt((square_sum / films - light * light) / (films - 1));
    EXPECT_NEAR(light, 1, 3 * deviation + 0.002) << photons << " photons";
  }
}

} // namespace nephroid::mixture_test
