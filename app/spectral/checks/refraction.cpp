// SPDX-License-Identifier: Apache-2.0
// Pencils of light through plates, a prism and a ball lens by the real engine, against Fresnel and Snell.
#include "spectral/checks/render.h"
#include "spectral/checks/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::check {
namespace {

/// An inclined pencil crosses a plate of 40 m x 1 mm x 40 m.
Result plate(const compute::Context& context, std::uint64_t seed) {
  constexpr double n = 1.5;
  double worst = 0;
  for (const double theta_deg : {0.0, 40.0, 56.31, 70.0, 80.0, 86.0}) {
    preset::Preset p = empty_preset(16);
    p.seed = seed;
    p.scene.materials["glass"] = glass(n);
    p.scene.objects = {object("plate", box(40, 1e-3, 40), "glass")};
    p.scene.lights = {inclined_pencil(theta_deg * degree)};
    worst = worse(worst, z_of_transmitted(context, std::move(p), plate_transmittance(theta_deg * degree, n)));
  }
  return judged(
      worst, 6, "sigma",
      "transmittance at 0, 40, 56.3, 70, 80 and 86 degrees, the farthest from (1 - R) / (1 + R) with Fresnel's R");
}

/// A plate has four interfaces instead of two, without interference: T = (1 - R) / (1 + 3 R). Above them is a hole
/// through glass, made by its priority: light enters the hole before the glass around it.
Result plates_in_one(const compute::Context& context, std::uint64_t seed) {
  preset::Preset p = empty_preset(16);
  p.seed = seed;
  p.scene.materials["glass"] = glass(1.8);
  p.scene.materials["air"] = glass(1);
  p.scene.objects = {object("block", box(1, 0.3, 1), "glass"), object("bubble", box(0.5, 0.1, 0.5), "air"),
                     object("upper block", box(1, 0.1, 1), "glass", at({0, 0.5, 0})),
                     object("hole", box(0.5, 0.3, 0.5), "air", at({0, 0.5, 0}))};
  p.scene.objects[1].priority = p.scene.objects[3].priority = 1;
  p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05)};
  const double r = std::pow(0.8 / 2.8, 2);
  return judged(z_of_transmitted(context, std::move(p), (1 - r) / (1 + 3 * r)), 6, "sigma",
                "transmittance of glass of n = 1.8 with a hole through it, above a slab with air inside, against (1 - "
                "R) / (1 + 3 R)");
}

/// A camera before the screen z = screen_z, which sees the light that lands there along y = 0; columns are x.
struct Screen {
  double z, x_first, x_last;     ///< place of the screen, and the range of x in the columns
  double distance_y, distance_z; ///< distances of the camera from the screen's middle
  static constexpr int columns = 1024, rows = 64;

  void put_into(preset::Preset& p) const {
    const double middle = (x_first + x_last) / 2, distance = std::hypot(distance_y, distance_z);
    p.scene.camera.resolution = {columns, rows};
    p.scene.camera.position = {middle, distance_y, z + distance_z};
    p.scene.camera.target = {middle, 0, z};
    p.scene.camera.fov_deg = 2 * std::atan((x_last - x_first) / 2 / distance * rows / columns) / degree;
    p.scene.materials["white"] = white();
    p.scene.objects.push_back(object("screen", quad(4, 4), "white", at({0, 0, z}, {90, 0, 0})));
  }
  double column(double x) const { return (x - x_first) / (x_last - x_first) * columns; }

  /// The light's centre within 6 columns of the brightest: light reflected inside the glass lands elsewhere.
  double landing(const job::Layer& picture) const {
    double flux[columns] = {};
    for (int row = 0; row < rows; ++row)
      for (int i = 0; i < columns; ++i) flux[i] += luminance(picture, columns, row, i);
    const int brightest = static_cast<int>(std::max_element(flux, flux + columns) - flux);
    double sum = 0, moment = 0;
    for (int i = std::max(brightest - 6, 0); i <= std::min(brightest + 6, columns - 1); ++i) {
      sum += flux[i];
      moment += flux[i] * (i + 0.5);
    }
    return moment / sum; // NaN where nothing landed
  }
};

/// Allows half a pixel: a pencil is some pixels wide, and the centre of its photons is known better than that.
Result off_by(double worst_pixels, std::string detail) {
  return judged(worst_pixels, 0.5, "pixels", std::move(detail));
}

/// N-SF11 by Schott's Sellmeier formula, and by the same coefficients here.
constexpr double sf11_b[] = {1.73759695, 0.313747346, 1.89878101}, sf11_c[] = {0.013188707, 0.0623068142, 155.23629};
double sf11(double nm) {
  const double l2 = nm * nm * 1e-6;
  double n2 = 1;
  for (int i = 0; i < 3; ++i) n2 += sf11_b[i] * l2 / (l2 - sf11_c[i]);
  return std::sqrt(n2);
}

Result prism(const compute::Context& context, std::uint64_t seed) {
  constexpr double side = 0.1, incidence = 62 * degree, screen_z = -1;
  const auto path = [&](double nm) { return prism_path(side, incidence, sf11(nm), screen_z); };
  const double blue = path(400).landing_x, red = path(700).landing_x, margin = 0.15 * (red - blue);
  preset::Preset p = empty_preset();
  p.seed = seed;
  const Screen screen{screen_z, blue - margin, red + margin, 0.5, 1.5};
  screen.put_into(p);
  preset::Material& material = p.scene.materials["glass"] = glass(1);
  material.dispersion.type = preset::Dispersion::Type::sellmeier;
  material.dispersion.b.assign(std::begin(sf11_b), std::end(sf11_b));
  material.dispersion.c_um2.assign(std::begin(sf11_c), std::end(sf11_c));
  p.scene.objects.push_back(
      object("prism", {.type = preset::Shape::Type::prism, .height = side, .side = side}, "glass"));
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  spectral::settings(p).photons_per_pass = 1 << 14;
  double worst = 0;
  for (const double nm : {400.0, 450.0, 500.0, 600.0, 700.0}) {
    const PrismPath truth = path(nm);
    p.scene.lights = {pencil({truth.from_x, 0, truth.from_z}, {truth.direction_x, 0, truth.direction_z}, 0.005, nm)};
    worst = worse(worst, screen.landing(layer(render(p, context), "caustic")) - screen.column(truth.landing_x));
  }
  return off_by(
      worst,
      fmt::format("five wavelengths through 60 degrees of N-SF11 onto a screen 1 m behind, the farthest from Snell's "
                  "place; {:.0f} pixels from violet to red",
                  screen.column(red) - screen.column(blue)));
}

Result ball_lens(const compute::Context& context, std::uint64_t seed) {
  constexpr double radius = 0.05, n = 1.5, screen_z = -4 * radius;
  preset::Preset p = empty_preset();
  p.seed = seed;
  const Screen screen{screen_z, -3.2 * radius, 0.2 * radius, 6 * radius, 6 * radius};
  screen.put_into(p);
  p.scene.materials["glass"] = glass(n);
  p.scene.objects.push_back(object("ball", ball(radius), "glass"));
  p.scene.objects.back().normals = preset::Object::Normals::smooth;
  spectral::settings(p).photons_per_pass = 1 << 14;
  double worst = 0;
  for (const double height : {0.05, 0.2, 0.4, 0.6, 0.75}) {
    p.scene.lights = {pencil({height * radius, 0, 4 * radius}, {0, 0, -1}, 0.005)};
    worst = worse(worst, screen.landing(layer(render(p, context), "caustic")) -
                             screen.column(ball_lens_landing(radius, height * radius, n, screen_z)));
  }
  return off_by(worst, "rays at 0.05 to 0.75 radii of a ball of n = 1.5 onto a screen 4 radii behind it, the farthest "
                       "from the ray trace "
                       "whose paraxial focus is n R / (2 (n - 1))");
}

} // namespace

Checks refraction_checks() {
  return {{"plate: Fresnel's transmittance", plate},
          {"plate: air inside glass", plates_in_one},
          {"prism: wavelengths where Snell says", prism},
          {"ball lens: rays towards its focus", ball_lens}};
}

} // namespace nephroid::check
