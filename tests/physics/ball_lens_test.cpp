// SPDX-License-Identifier: Apache-2.0
// A glass ball as a lens: its focus, and what it makes of parallel light on a screen.
#include "optics/fresnel.h"
#include "tests/support/closed_form.h"

namespace nephroid::ball_lens_test {

constexpr double n = 1.5;

/// A ball of radius 1 m and a screen at y = -distance.
preset::Preset ball_and_screen(double distance)
{
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  preset::Shape ball;
  ball.radius = 1;
  p.scene.objects = {object("ball", ball, "glass"), object("screen", quad(100, 100), "white", at({0, -distance, 0}))};
  return p;
}

/// W on the screen from light of 1 W/m^2 that comes from a point at `source` above the ball's centre (or INFINITY) and meets the ball
/// within `aperture` of the axis: the integral over h, of which every ring h dh goes to a ring of the screen, for each branch of
/// reflections.
std::vector<double> truth(const Screen& screen, double distance, double aperture, double source = INFINITY)
{
  constexpr int rings = 1 << 17, directions = 1 << 12, each = 192;
  std::vector<double> picture(screen.count(), 0.0), cosine, sine;
  for (int i = 0; i < directions; ++i) {
    cosine.push_back(std::cos(2 * M_PI * i / directions));
    sine.push_back(std::sin(2 * M_PI * i / directions));
  }
  for (int ring = 0; ring < rings; ++ring) {
    const double h = aperture * std::sqrt((ring + 0.5) / rings);
    // A ray from a near point, at h before the ball's centre, is one at h' = h cos(tilt), with everything turned by the tilt.
    const double tilt = std::isinf(source) ? 0 : std::atan(h / source);
    for (int inner = -1; inner <= 3; ++inner) {
      optics::BallRay ray = optics::ball_ray(h * std::cos(tilt), n, inner);
      const double x = ray.x, y = ray.y;
      ray.x = x * std::cos(tilt) - y * std::sin(tilt);
      ray.y = x * std::sin(tilt) + y * std::cos(tilt);
      ray.angle += tilt;
      if (std::cos(ray.angle) <= 0) continue; // it goes the other way
      const double r = ray.y + (distance - ray.x) * std::tan(ray.angle);
      const double power = M_PI * aperture * aperture / rings / each * ray.share;
      for (int j = 0; j < each; ++j) {
        const auto k = static_cast<std::size_t>((j * directions / each + ring * 2531) % directions); // 2531 / 4096: the golden ratio
        screen.add(picture, r * cosine[k], r * sine[k], power);
      }
    }
  }
  return picture;
}

/// Root mean square distance from the axis of what lands on the screen.
double spread(const std::vector<double>& picture, const Screen& screen)
{
  double power = 0, moment = 0;
  for (int row = 0; row < screen.pixels; ++row)
    for (int column = 0; column < screen.pixels; ++column) {
      const double w = picture[static_cast<std::size_t>(row * screen.pixels + column)];
      power += w;
      moment += w * (std::pow(screen.x(column), 2) + std::pow(screen.z(row), 2));
    }
  return std::sqrt(moment / power - std::pow(screen.pixel_side(), 2) / 6); // a pixel's own square adds side^2 / 12 each way
}

// Near the axis i = h and t = h / n. A ray leaves at the height 2 t - i and is turned by 2 (i - t), so it crosses the axis
// 1 + (2 t - i) / (2 (i - t)) = n / (2 (n - 1)) from the centre: 1.5 radii for n = 1.5. The beam's spread on a screen is proportional to
// its distance from the focus; screens before and behind it say where it is. Light comes from a point at a = 1000 into a cone that is 0.02
// wide at the ball, and meets at b, 1 / a + 1 / b = 1 / f.
TEST(BallLens, FocusIsWhereTheParaxialFormulaSays)
{
  constexpr double source = 1000, aperture = 0.02;
  constexpr int photons = 1 << 18;
  const auto focus = [&](const std::array<double, 2>& at, const std::array<double, 2>& spreads) {
    const double b = (at[0] * spreads[1] + at[1] * spreads[0]) / (spreads[0] + spreads[1]);
    return 1 / (1 / source + 1 / b);
  };
  const std::array<double, 2> distances{1.35, 1.65};
  std::array<double, 2> measured{}, exact{};
  for (std::size_t i = 0; i < 2; ++i) {
    preset::Preset p = ball_and_screen(distances[i]);
    p.scene.lights = {pencil({0, source, 0}, {0, -1, 0}, std::atan(aperture / source) / degree)};
    spectral::settings(p).photons_per_pass = photons;
    const Screen screen{{0, -distances[i], 0}, 0.006, 100};
    screen.fill(p.scene.camera, 0.1);
    measured[i] = spread(watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0])), screen);
    exact[i] = spread(truth(screen, distances[i], aperture, source), screen);
  }
  // A uniform disc's mean square radius is known to 1 / sqrt(3 N), so the spread to 1 / sqrt(12 N), and the focus to
  // 0.15 / sqrt(24 N). The axis is off by rounding of the light's direction, 6e-8 of 1000. Rays at h focus nearer by about h^2.
  const double noise = sigmas * 0.15 / std::sqrt(24.0 * photons);
  expect_truth("ball lens: focus / R, from the exact rays", focus(distances, measured), focus(distances, exact), noise + 1e-5);
  expect_truth("ball lens: paraxial focus / R", focus(distances, measured), n / (2 * (n - 1)), noise + 1e-5 + aperture * aperture);
}

// E(r) = sum over branches of T(h) h dh / (r dr): beyond the focus the rays that passed near the rim cross the axis first and form a bright
// ring, the caustic's edge.
TEST(BallLens, IrradianceOnAScreenIsTheIntegralOverHeights)
{
  constexpr double distance = 2.5;
  preset::Preset p = ball_and_screen(distance);
  p.scene.lights = {parallel_light({0, -1, 0})};
  spectral::settings(p).photons_per_pass = 1 << 20;
  p.stop.passes = 4;
  const Screen screen{{0, -distance, 0}, 2.4, 120};
  screen.fill(p.scene.camera, 1);
  const std::vector<double> picture = watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0])),
                            expected = truth(screen, distance, 1);
  const double photon_w = directional_photon_w(p, 4.0 * (1 << 20));
  expect_agreement("ball lens: irradiance 2.5 R behind the centre", agreement(picture, expected, photon_w, 0.01), 0.01);
  for (int ring = 0; ring < 10; ++ring) {
    std::vector<bool> inside(screen.count());
    for (int row = 0; row < screen.pixels; ++row)
      for (int column = 0; column < screen.pixels; ++column)
        inside[static_cast<std::size_t>(row * screen.pixels + column)] =
            static_cast<int>(std::hypot(screen.x(column), screen.z(row)) / 0.12) == ring;
    const Agreement a = agreement(picture, expected, photon_w, 0, inside);
    expect_truth(fmt::format("ball lens: power on the ring {:.2f} to {:.2f} R, over the integral", ring * 0.12, ring * 0.12 + 0.12),
                 a.ratio, 1, sigmas * a.error + 2e-4);
  }
}

} // namespace nephroid::ball_lens_test
