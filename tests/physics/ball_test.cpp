// SPDX-License-Identifier: Apache-2.0
// A ball of glass over a floor in parallel light, seen by a pinhole: every pixel against a computation of its own. That
// follows rays in the plane of the axis for the light, and the eye's rays through the ball, in double precision.
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

#include <glm/glm.hpp>

namespace nephroid::ball_test {

using Vector = glm::dvec3;

constexpr double index = 1.5, floor_y = -1.3, floor_edge = 60; // of a ball of radius 1, in light straight down
constexpr int orders = 12;                                     // of reflections inside

double reflectance(double cos_i, double cos_t, double n) {
  const double s = (cos_i - n * cos_t) / (cos_i + n * cos_t), p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return (s * s + p * p) / 2;
}

/// Calls leave(place, way, part) for each ray that leaves the ball of what arrives at a place along a way: reflected,
/// then after 0, 1, 2, ... reflections inside. part: of its power, or of the radiance that an eye there sees.
template <class Leave>
void through_ball(Vector place, Vector way, const Leave& leave) {
  const double cos_i = -glm::dot(way, place), cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (index * index)),
               r = reflectance(cos_i, cos_t, index);
  leave(place, way + 2 * cos_i * place, r);
  way = way / index + (cos_i / index - cos_t) * place;
  double part = 1 - r;
  for (int order = 0; order < orders; ++order) {
    place += 2 * cos_t * way;
    leave(place, index * way + (cos_i - index * cos_t) * place, part * (1 - r));
    way -= 2 * cos_t * place;
    part *= r;
  }
}

/// Where a ray meets the floor; false: nowhere.
bool meets_floor(const Vector& place, const Vector& way, Vector& at) {
  if (!(way.y < -1e-9)) return false;
  at = place + (place.y - floor_y) / -way.y * way;
  return std::max(std::abs(at.x), std::abs(at.z)) < floor_edge / 2;
}

/// The irradiance on the floor, over that of the light, by the distance to the axis.
class Floor {
public:
  Floor() : caustic_(bins) {
    constexpr int rays = 2'000'000; // each of the same power
    for (int i = 0; i < rays; ++i) {
      const double h = std::sqrt((i + 0.5) / rays);
      through_ball({h, std::sqrt(1 - h * h), 0}, {0, -1, 0}, [&](const Vector& place, const Vector& way, double part) {
        Vector at;
        if (!meets_floor(place, way, at) || std::abs(at.x) >= bins * width) return;
        const auto bin = static_cast<std::size_t>(std::abs(at.x) / width);
        caustic_[bin] += part / rays / ((2 * static_cast<double>(bin) + 1) * width * width);
      });
    }
  }
  double direct(const Vector& at) const { return std::hypot(at.x, at.z) > 1 ? 1 : 0; }
  double caustic(const Vector& at) const {
    const double r = std::hypot(at.x, at.z);
    return r < bins * width ? caustic_[static_cast<std::size_t>(r / width)] : 0;
  }

private:
  static constexpr int bins = 4000;
  static constexpr double width = 0.005;
  std::vector<double> caustic_; ///< [bin]
};

/// What a ray from the eye sees, over what the lit floor shows.
struct Sight {
  double direct = 0, caustic = 0;
  bool of_ball = false;
};

Sight look(const Floor& floor, const Vector& eye, const Vector& way) {
  Sight sight;
  const auto see = [&](const Vector& place, const Vector& from, double part) {
    Vector at;
    if (!meets_floor(place, from, at)) return;
    sight.direct += part * floor.direct(at);
    sight.caustic += part * floor.caustic(at);
  };
  const double b = glm::dot(eye, way), inside = b * b - glm::dot(eye, eye) + 1;
  sight.of_ball = inside > 0;
  if (sight.of_ball)
    through_ball(glm::normalize(eye + (-b - std::sqrt(inside)) * way), way, see);
  else
    see(eye, way, 1);
  return sight;
}

struct Way {
  photons::Settings::Estimator estimator;
  double on_floor, in_glass; ///< the most rel_l2; half of it was seen
};
class BallInSunlight : public testing::TestWithParam<Way> {};

TEST_P(BallInSunlight, IsRightOnTheFloorAndInTheGlass) {
  constexpr int pixels = 64, places = 8; // places along a pixel's edge
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(index);
  p.scene.materials["white"] = white();
  preset::Shape ball;
  ball.radius = 1;
  p.scene.objects = {object("ball", ball, "glass"),
                     object("floor", quad(floor_edge, floor_edge), "white", at({0, floor_y, 0}))};
  p.scene.lights = {parallel_light({0, -1, 0})};
  p.scene.camera = {.position = {0, 3, 5}, .target = {0, -0.4, 0}, .fov_deg = 34, .resolution = {pixels, pixels}};
  spectral::settings(p).estimator = GetParam().estimator;
  spectral::settings(p).photons_per_pass = 1 << 18;
  spectral::settings(p).max_surfaces = 2 * orders;
  spectral::settings(p).direct = true;
  p.stop.passes = 16;
  const job::Snapshot run = test::render(p);
  const scene::Camera camera = scene::load_scene(p).camera;
  const Floor floor;

  struct Sums {
    double truth = 0, truth2 = 0, seen = 0, off2 = 0;
  } of_glass, of_floor;
  std::vector<double> seen, truth;
  std::vector<int> kinds; // 1: of the floor alone, 2: of the glass alone
  double scale = 0, lit = 0;
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column) {
      double sum = 0, caustic = 0;
      int of_ball = 0;
      for (int i = 0; i < places * places; ++i) {
        const double x = 2 * (column + (i % places + 0.5) / places) / pixels - 1,
                     y = 1 - 2 * (row + (i / places + 0.5) / places) / pixels;
        const auto [eye, way] = camera.ray(x, y);
        const Sight sight = look(floor, eye, glm::normalize(way));
        sum += (sight.direct + sight.caustic) / (places * places);
        caustic += sight.caustic / (places * places);
        of_ball += sight.of_ball ? 1 : 0;
      }
      const std::size_t pixel = static_cast<std::size_t>(row) * pixels + static_cast<std::size_t>(column);
      const double green = run.picture->rgb[3 * pixel + 1];
      if (of_ball == 0 && sum - caustic == 1) scale += test::layer(run, "direct").rgb[3 * pixel + 1], ++lit;
      seen.push_back(green);
      truth.push_back(sum);
      kinds.push_back(of_ball == 0 ? 1 : of_ball == places * places ? 2 : 0);
    }
  ASSERT_GT(lit, 100);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (kinds[i] == 0) continue;
    Sums& sums = kinds[i] == 1 ? of_floor : of_glass;
    const double value = seen[i] * lit / scale;
    sums.truth += truth[i], sums.seen += value;
    sums.truth2 += truth[i] * truth[i], sums.off2 += std::pow(value - truth[i], 2);
  }
  const auto rel_l2 = [](const Sums& sums) { return std::sqrt(sums.off2 / sums.truth2); };
  expect_truth("ball: light of the floor", of_floor.seen / of_floor.truth, 1, 1e-3);
  expect_truth("ball: light in the glass", of_glass.seen / of_glass.truth, 1, 1e-3);
  expect_truth("ball: rel_l2 of the floor", rel_l2(of_floor), 0, GetParam().on_floor);
  expect_truth("ball: rel_l2 in the glass", rel_l2(of_glass), 0, GetParam().in_glass);
}

INSTANTIATE_TEST_SUITE_P(By, BallInSunlight,
                         testing::Values(Way{photons::Settings::Estimator::tiles, 0.012, 0.025},
                                         Way{photons::Settings::Estimator::points, 0.028, 0.054}));

} // namespace nephroid::ball_test
