// SPDX-License-Identifier: Apache-2.0
// A ball as a lens is below. The curve in the coffee cup. Parallel light meets the inside of a mirror cylinder; its
// caustic is a nephroid.
//
// Seen along the axis, with R = 1 and light along +x: a ray at height z = sin(phi) meets the wall at P = (cos phi, sin
// phi), where the normal is -P. Reflection turns its direction d = (1, 0) into d - 2 (d.P) P = -(cos 2 phi, sin 2 phi),
// so a ray next to it, d phi farther, starts cos(phi) d phi beside it and is turned by 2 d phi: after a way s the two
// are |cos(phi) - 2 s| d phi apart. They meet at s = cos(phi) / 2, and the envelope of all rays is
//   P - cos(phi) / 2 (cos 2 phi, sin 2 phi) = ((3 cos phi - cos 3 phi) / 4, (3 sin phi - sin 3 phi) / 4),
// an arc of a nephroid with its cusp, phi = 0, at half the radius.
//
// Here light also falls at a slope: the wall's points between two heights reflect it to the floor, a way s0 < s < s1
// from the wall seen from above, which does not change its pattern, because reflection at an upright wall keeps the
// slope. The strip dz of incoming light spreads over the area |1 - 2 s / cos phi| dz ds of floor: E = E0 sin(elevation)
// / |1 - 2 s / cos phi|, summed over all rays through a point.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::nephroid_test {

constexpr double slope = 0.5;          // down per unit along
constexpr double s0 = 0.05, s1 = 0.95; // from the wall to the floor
constexpr int facets = 4096;           // of the half cylinder: chords lie up to (pi / 4096)^2 / 8 = 7e-8 R inside
constexpr int fine = 4;                // the truth's pixels in one of the picture's, each way
const Screen cup_floor{{0.6, 0, 0}, 0.7, 128};

/// The half of the wall with x > 0, facing the axis, with exact vertex normals.
void write_half_cylinder(const std::filesystem::path& file) {
  std::string text;
  for (int i = 0; i <= facets; ++i) {
    const double phi = M_PI * (double(i) / facets - 0.5), x = std::cos(phi), z = std::sin(phi);
    for (const double s : {s0, s1})
      text += fmt::format("v {:.9f} {:.9f} {:.9f}\nvn {:.9f} 0 {:.9f}\n", x, s * slope, z, -x, -z);
  }
  for (int i = 0; i < facets; ++i) {
    const int a = 2 * i + 1, b = a + 1, c = a + 2, d = a + 3; // low, high, next low, next high
    text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\nf {1}//{1} {3}//{3} {2}//{2}\n", a, b, c, d);
  }
  std::ofstream(file) << text;
}

preset::Preset cup(const TemporaryFolder& folder) {
  write_half_cylinder(folder.path() / "wall.obj");
  preset::Preset p = empty_preset();
  p.scene.materials["mirror"] = check::mirror(1);
  p.scene.materials["white"] = white();
  preset::Object wall;
  wall.name = "wall";
  wall.mesh = (folder.path() / "wall.obj").string();
  wall.material = "mirror";
  wall.normals = preset::Object::Normals::smooth;
  p.scene.objects = {wall, object("floor", quad(4, 4), "white")};
  p.scene.lights = {parallel_light({1, -slope, 0})};
  cup_floor.fill(p.scene.camera, 4);
  spectral::settings(p).photons_per_pass = 1 << 20;
  p.stop.passes = 4;
  return p;
}

/// W that the wall sends into squares of the floor, by Kronecker's sequence of Roberts' numbers in the strip's (z, s),
/// where the incoming light is uniform. Exact for all points less than sin(60 degrees) from the axis: what meets the
/// wall twice or lies beyond |z| = 0.9 stays farther out.
std::vector<double> truth(const Screen& squares) {
  constexpr int points = 1 << 25;
  constexpr double a1 = 0.7548776662466927, a2 = 0.5698402909980532; // 1 / g, 1 / g^2 with g^3 = g + 1
  std::vector<double> picture(squares.count(), 0.0);
  const double sine = slope / std::hypot(1, slope), each = sine * 1.8 * (s1 - s0) / points;
  double u = 0, v = 0;
  for (int i = 0; i < points; ++i) {
    u += a1, v += a2;
    u -= u >= 1, v -= v >= 1;
    const double z = 1.8 * u - 0.9, s = s0 + (s1 - s0) * v,
                 cosine = std::sqrt(1 - z * z); // phi is the arc whose sine is z
    squares.add(picture, cosine - s * (cosine * cosine - z * z), z - s * 2 * z * cosine, each);
  }
  return picture;
}

/// How far the light of some pixels lies to the right of the truth, in pixels, and the standard error of that. To first
/// order a picture moved by a shift differs by g = -d(truth)/dx times the shift, so the shift is the regression of
/// (picture - truth) on g, with weights 1 / variance: right on average and with a known error where the picture is the
/// truth, however steep that is.
struct Shift {
  double pixels = 0, error = 0;
};
Shift shift_of(const std::vector<double>& picture, const std::vector<double>& fine_truth, double photon_w,
               int first_row, int last_row, int first_column, int last_column) {
  const auto expected = [&](int row, int column, int steps) {
    double sum = 0;
    for (int y = row * fine; y < (row + 1) * fine; ++y)
      for (int x = column * fine; x < (column + 1) * fine; ++x)
        sum += fine_truth[static_cast<std::size_t>(y * cup_floor.pixels * fine + x - steps)];
    return sum;
  };
  double sum = 0, weights = 0;
  for (int row = first_row; row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column) {
      const double truth_here = expected(row, column, 0);
      if (truth_here == 0) continue;
      const double g = (expected(row, column, 1) - expected(row, column, -1)) * fine / 2;
      sum += (picture[static_cast<std::size_t>(row * cup_floor.pixels + column)] - truth_here) * g / truth_here;
      weights += g * g / truth_here;
    }
  return {sum / weights, std::sqrt(photon_w / weights)};
}

class Nephroid : public testing::Test {
protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    const preset::Preset p = cup(folder);
    const job::Snapshot snapshot = render(p);
    EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
    picture = watts(snapshot, "caustic", cup_floor, spectrum_of(p.scene.lights[0]));
    photon_w = directional_photon_w(p, 4.0 * (1 << 20));
  }
  inline static std::vector<double> picture;
  inline static double photon_w = 0;
};

TEST_F(Nephroid, IrradianceIsTheSumOverRays) {
  std::vector<bool> once(cup_floor.count()); // what light reaches after one reflection only
  for (int row = 0; row < cup_floor.pixels; ++row)
    for (int column = 0; column < cup_floor.pixels; ++column)
      once[static_cast<std::size_t>(row * cup_floor.pixels + column)] =
          std::hypot(cup_floor.x(column), cup_floor.z(row)) < 0.86;
  // A pixel has some 600 points of the sequence and more, which are within 1 %.
  expect_agreement("nephroid: irradiance", agreement(picture, truth(cup_floor), photon_w, 0.01, once));
}

TEST_F(Nephroid, CuspAndEdgeAreWhereTheCurveSays) {
  const std::vector<double> fine_truth = truth({cup_floor.centre, cup_floor.side, cup_floor.pixels * fine});
  const auto row_of = [](double z) { return static_cast<int>((z + cup_floor.side / 2) / cup_floor.pixel_side()); };
  const auto expect_edge = [&](const std::string& what, double x, double low_z, double high_z) {
    const int column = static_cast<int>((x - cup_floor.centre[0] + cup_floor.side / 2) / cup_floor.pixel_side());
    const Shift edge = shift_of(picture, fine_truth, photon_w, row_of(low_z), row_of(high_z), column - 10, column + 10);
    expect_truth(what, x + edge.pixels * cup_floor.pixel_side(), x, sigmas * edge.error * cup_floor.pixel_side());
    EXPECT_LT(sigmas * edge.error, 0.5) << what; // half a pixel would be seen
  };
  expect_edge("nephroid: x of the cusp / R", 0.5, -0.015, 0.015); // on the axis the only edge is the cusp
  for (const double phi_deg : {-43, -38, -33, -28, 28, 33, 38, 43}) {
    const double phi = phi_deg * degree, x = (3 * std::cos(phi) - std::cos(3 * phi)) / 4,
                 z = (3 * std::sin(phi) - std::sin(3 * phi)) / 4;
    expect_edge(fmt::format("nephroid: x of the edge / R at z = {:+.3f} R", z), x, z, z);
  }
}

// Near the edge. The tangent T of the envelope is the ray's own direction, (cos 2 phi, sin 2 phi), and its arc is dl =
// 3/2 sin(phi) d phi (the derivative of the curve), so its radius of curvature is r = dl / d(2 phi) = 3/4 sin(phi). A
// point inside the curve, a small d from it, lies on the two rays that touch it at l = +-sqrt(2 r d) from its foot. A
// ray that touches at l is d = l^2 / 2r away, so of the strip cos(phi) d phi = cos(phi) dl / 2r falls on dd = l dl / r,
// twice: E / E0' = cos(phi) / l = cos(phi) / sqrt(3/2 sin(phi) d), the inverse square root of the distance, on top of
// the light of the third ray, which changes slowly.
TEST_F(Nephroid, IrradianceFallsWithTheInverseRootOfTheDistance) {
  constexpr int bins = 5; // of distances d = 0.012 * 2^(i/2)...
  const double sine = slope / std::hypot(1, slope), innermost = 0.012;
  std::vector<double> excess(bins, 0), law(bins, 0), distance(bins, 0), outside(2, 0);
  std::vector<int> pixels(bins, 0);
  for (int row = 0; row < cup_floor.pixels; ++row)
    for (int column = 0; column < cup_floor.pixels; ++column) {
      const double x = cup_floor.x(column), z = std::abs(cup_floor.z(row));
      // The foot of the point on the curve: (X - C) . T changes its sign there.
      double low = 20 * degree, high = 45 * degree;
      const auto along = [&](double phi) {
        const double cx = (3 * std::cos(phi) - std::cos(3 * phi)) / 4, cz = (3 * std::sin(phi) - std::sin(3 * phi)) / 4;
        return (x - cx) * std::cos(2 * phi) + (z - cz) * std::sin(2 * phi);
      };
      if (along(low) < 0 || along(high) > 0) continue;
      for (int i = 0; i < 50; ++i) (along((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
      const double cx = (3 * std::cos(low) - std::cos(3 * low)) / 4, cz = (3 * std::sin(low) - std::sin(3 * low)) / 4;
      const double d = (x - cx) * std::sin(2 * low) - (z - cz) * std::cos(2 * low);
      const double e =
          picture[static_cast<std::size_t>(row * cup_floor.pixels + column)] / cup_floor.pixel_area() / sine;
      if (d < -cup_floor.pixel_side() && d > -4 * cup_floor.pixel_side()) outside[0] += e, ++outside[1];
      const int bin = static_cast<int>(std::floor(2 * std::log2(d / innermost)));
      if (!(d > 0) || bin < 0 || bin >= bins) continue;
      const auto i = static_cast<std::size_t>(bin);
      excess[i] += e;
      law[i] += std::cos(low) / std::sqrt(1.5 * std::sin(low) * d);
      distance[i] += std::log(d);
      ++pixels[i];
    }
  const double third_ray = outside[0] / outside[1];
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    const double x = distance[i] / pixels[i], y = std::log(excess[i] / pixels[i] - third_ray);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  expect_truth("nephroid: exponent of irradiance over distance", (bins * sxy - sx * sy) / (bins * sxx - sx * sx), -0.5,
               0.04);
  expect_truth("nephroid: irradiance over its law nearest the edge",
               (excess[0] / pixels[0] - third_ray) / (law[0] / pixels[0]), 1, 0.04);
}

// A glass ball as a lens: its focus, and what it makes of parallel light on a screen.

constexpr double n = 1.5;

/// A ball of radius 1 m and a screen at y = -distance.
preset::Preset ball_and_screen(double distance) {
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  preset::Shape ball;
  ball.radius = 1;
  p.scene.objects = {object("ball", ball, "glass"), object("screen", quad(100, 100), "white", at({0, -distance, 0}))};
  return p;
}

/// W on the screen from light of 1 W/m^2 that comes from a point at `source` above the ball's centre (or INFINITY) and
/// meets the ball within `aperture` of the axis: the integral over h, of which every ring h dh goes to a ring of the
/// screen, for each branch of reflections.
std::vector<double> truth(const Screen& screen, double distance, double aperture, double source = INFINITY) {
  constexpr int rings = 1 << 17, directions = 1 << 12, each = 192;
  std::vector<double> picture(screen.count(), 0.0), cosine, sine;
  for (int i = 0; i < directions; ++i) {
    cosine.push_back(std::cos(2 * M_PI * i / directions));
    sine.push_back(std::sin(2 * M_PI * i / directions));
  }
  for (int ring = 0; ring < rings; ++ring) {
    const double h = aperture * std::sqrt((ring + 0.5) / rings);
    // A ray from a near point, at h before the ball's centre, is one at h' = h cos(tilt), with everything turned by the
    // tilt.
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
        const auto k = static_cast<std::size_t>((j * directions / each + ring * 2531) %
                                                directions); // 2531 / 4096: the golden ratio
        screen.add(picture, r * cosine[k], r * sine[k], power);
      }
    }
  }
  return picture;
}

/// Root mean square distance from the axis of what lands on the screen.
double spread(const std::vector<double>& picture, const Screen& screen) {
  double power = 0, moment = 0;
  for (int row = 0; row < screen.pixels; ++row)
    for (int column = 0; column < screen.pixels; ++column) {
      const double w = picture[static_cast<std::size_t>(row * screen.pixels + column)];
      power += w;
      moment += w * (std::pow(screen.x(column), 2) + std::pow(screen.z(row), 2));
    }
  return std::sqrt(moment / power -
                   std::pow(screen.pixel_side(), 2) / 6); // a pixel's own square adds side^2 / 12 each way
}

// Near the axis i = h and t = h / n. A ray leaves at the height 2 t - i and is turned by 2 (i - t), so it crosses the
// axis 1 + (2 t - i) / (2 (i - t)) = n / (2 (n - 1)) from the centre: 1.5 radii for n = 1.5. The beam's spread on a
// screen is proportional to its distance from the focus; screens before and behind it say where it is. Light comes from
// a point at a = 1000 into a cone that is 0.02 wide at the ball, and meets at b, 1 / a + 1 / b = 1 / f.
TEST(BallLens, FocusIsWhereTheParaxialFormulaSays) {
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
  // 0.15 / sqrt(24 N). The axis is off by rounding of the light's direction, 6e-8 of 1000. Rays at h focus nearer by
  // about h^2.
  const double noise = sigmas * 0.15 / std::sqrt(24.0 * photons);
  expect_truth("ball lens: focus / R, from the exact rays", focus(distances, measured), focus(distances, exact),
               noise + 1e-5);
  expect_truth("ball lens: paraxial focus / R", focus(distances, measured), n / (2 * (n - 1)),
               noise + 1e-5 + aperture * aperture);
}

// E(r) = sum over branches of T(h) h dh / (r dr): beyond the focus the rays that passed near the rim cross the axis
// first and form a bright ring, the caustic's edge.
TEST(BallLens, IrradianceOnAScreenIsTheIntegralOverHeights) {
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
    expect_truth(fmt::format("ball lens: power on the ring {:.2f} to {:.2f} R, over the integral", ring * 0.12,
                             ring * 0.12 + 0.12),
                 a.ratio, 1, sigmas * a.error + 2e-4);
  }
}

} // namespace nephroid::nephroid_test
