// SPDX-License-Identifier: Apache-2.0
// Small pictures by the real engine against closed forms of irradiance and power. Noise is judged in standard
// deviations that follow from the number of photons or samples, so that no seed makes a check fail by chance.
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scatter/spectra.h"
#include "spectral/checks/render.h"
#include "spectral/checks/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::check {
namespace {

using std::numbers::pi;

/// A white floor under a point light; the camera looks straight down on 1 m x 1 m of it.
preset::Preset lit_floor(int resolution, double camera_height, std::uint64_t seed) {
  preset::Preset p = empty_preset(resolution);
  p.seed = seed;
  p.scene.camera.position = {0, camera_height, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 2 * std::atan(0.5 / camera_height) * 180 / pi;
  p.scene.materials["white"] = white();
  p.scene.objects = {object("floor", quad(10, 10), "white")};
  preset::Light light;
  light.spectrum.illuminant = std::string("E"); // a plain "E" draws a false -Wrestrict from GCC 12
  light.position = {0.1, 1, -0.2};
  light.power_w = 5;
  p.scene.lights = {light};
  return p;
}

/// E = I cos(theta) / d^2 = I h / d^3: its mean over the square of a pixel, and its variance there, from 8 x 8 places.
struct PixelTruth {
  double irradiance = 0, variance = 0;
};
PixelTruth pixel_truth(const preset::Light& light, int resolution, int row, int column) {
  constexpr int places = 8;
  PixelTruth truth;
  double squares = 0;
  for (int i = 0; i < places * places; ++i) {
    const int place_x = i % places, place_z = i / places;
    const double x = (column + (place_x + 0.5) / places) / resolution - 0.5,
                 z = (row + (place_z + 0.5) / places) / resolution - 0.5;
    const double d = std::hypot(light.position[0] - x, light.position[1], light.position[2] - z);
    const double e = light.power_w / (4 * pi) * light.position[1] / (d * d * d);
    truth.irradiance += e / (places * places);
    squares += e * e / (places * places);
  }
  truth.variance = std::max(squares - truth.irradiance * truth.irradiance, 0.0);
  return truth;
}

/// The distance of a layer from the truth in sigma: of the sum over all pixels, and of each by itself as chi-square.
struct Distance {
  double sum_error = 0, pixel_error = 0, ratio = 1;
  double worst() const { return worse(pixel_error, sum_error); }
};
/// variance(truth) is that of a pixel's measured irradiance.
template <class Variance>
Distance distance(const job::Snapshot& snapshot, const char* name, const preset::Preset& p, const Variance& variance) {
  const int size = p.scene.camera.resolution[0];
  const double y_of_light = optics::to_xyz(optics::illuminant("E"))[1];
  double sum = 0, truth_sum = 0, variance_sum = 0, chi2 = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const PixelTruth truth = pixel_truth(p.scene.lights[0], size, row, column);
      // White under E has the radiance E / pi. Single precision and the grid of places add 3e-5 to each pixel.
      const double e = luminance(layer(snapshot, name), size, row, column) / y_of_light * pi, v = variance(truth);
      sum += e;
      truth_sum += truth.irradiance;
      variance_sum += v;
      chi2 += (e - truth.irradiance) * (e - truth.irradiance) / (v + std::pow(3e-5 * truth.irradiance, 2));
    }
  const double pixels = double(size) * size;
  return {(sum - truth_sum) / std::sqrt(variance_sum + std::pow(1e-5 * truth_sum, 2)),
          (chi2 - pixels) / std::sqrt(2 * pixels), sum / truth_sum};
}

Result direct_light(const compute::Context& context, std::uint64_t seed) {
  preset::Preset p = lit_floor(32, 2, seed);
  spectral::settings(p).direct = true;
  spectral::settings(p).caustic = false;
  constexpr int samples = 32;
  p.stop.passes = spectral::settings(p).pixel_samples = samples;
  const Distance d =
      distance(render(p, context), "direct", p, [](const PixelTruth& t) { return t.variance / samples; });
  return judged(
      d.worst(), 6, "sigma",
      fmt::format("a floor under a point light, 32 x 32 pixels, against P cos(theta) / (4 pi d^2): ratio {:.6f}",
                  d.ratio));
}

/// The light sits in a ball of n = 1, which bends and reflects nothing. Its photons, each of P / N, must make the same
/// picture as direct light, and a pixel of the area A gets a Poisson count of N E A / P of them.
Result through_nothing(const compute::Context& context, std::uint64_t seed) {
  preset::Preset p = lit_floor(16, 0.5, seed);
  p.scene.materials["nothing"] = glass(1);
  p.scene.objects.push_back(object("ball", ball(0.3), "nothing", at({0.1, 1, -0.2})));
  spectral::settings(p).photons_per_pass = 1 << 19;
  const double photon_w = p.scene.lights[0].power_w / spectral::settings(p).photons_per_pass,
               pixel_area = 1.0 / (16 * 16);
  const Distance d = distance(render(p, context), "caustic", p,
                              [&](const PixelTruth& t) { return t.irradiance * photon_w / pixel_area; });
  return judged(d.worst(), 6, "sigma",
                fmt::format("photons through a ball of n = 1, 16 x 16 pixels and their sum, against the direct light "
                            "of a point: ratio {:.4f}",
                            d.ratio));
}

/// A floor with a disc of light on it, 1 m x 1 m of which a camera with a lens sees from above, out of focus and
/// shifted. The picture is the disc convolved with the lens's image, a disc of the radius R |1 - z / f| on the floor at
/// the depth z. So its mean place and its spread about that have closed forms, and its sum is the light's power.
Result through_a_lens(const compute::Context& context, std::uint64_t seed, bool by_photons) {
  constexpr int size = 64, samples = 128;
  constexpr double depth = 0.5, focus = 0.3, radius = 0.2, half_angle = 0.15, shift_x = 0.1, shift_y = -0.05;
  double worst = 0, spread_ratio = 1;
  for (const bool orthographic : {false, true}) {
    preset::Preset p = lit_floor(size, depth, seed);
    preset::Camera& camera = p.scene.camera;
    if (orthographic) camera.projection = preset::Camera::Projection::orthographic;
    camera.shift = {shift_x, shift_y};
    camera.aperture = 2 * radius;
    camera.focus_distance = focus;
    preset::Light& light = p.scene.lights[0];
    light = pencil({0.05, 1, -0.1}, {0, -1, 0}, half_angle / degree);
    light.power_w = 5;
    p.scene.materials["nothing"] = glass(1);
    if (by_photons) p.scene.objects.push_back(object("ball", ball(0.2), "nothing", at(light.position)));
    spectral::settings(p).photons_per_pass = 1 << 17;
    spectral::settings(p).direct = !by_photons;
    spectral::settings(p).caustic = by_photons;
    if (!by_photons) p.stop.passes = spectral::settings(p).pixel_samples = samples;
    const job::Snapshot snapshot = render(p, context);
    const job::Layer& seen = layer(snapshot, by_photons ? "caustic" : "direct");
    double sum = 0, x = 0, y = 0, squares = 0; // in metres on the floor
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const double e = luminance(seen, size, row, column);
        const double right = (column + 0.5) / size - 0.5 + shift_x - light.position[0],
                     down = (row + 0.5) / size - 0.5 - shift_y - light.position[2];
        sum += e;
        x += e * right;
        y += e * down;
        squares += e * (right * right + down * down);
      }
    const double power = sum * pi / (size * size) / optics::to_xyz(scatter::make_light_spectrum(light.spectrum, {}))[1];
    // Of the disc, of the lens's image and of a pixel: the mean squares of the distance from the middle.
    const double disc2 = 1 / std::cos(half_angle) - 1, image2 = std::pow(radius * (1 - depth / focus), 2) / 2,
                 spread = disc2 + image2 + 1.0 / (6 * size * size);
    const double count = by_photons ? double(spectral::settings(p).photons_per_pass)
                                    : samples * double(size * size) * pi * std::pow(std::tan(half_angle), 2);
    const double sigma = 1 / std::sqrt(count);
    const double variance = (disc2 * disc2 + image2 * image2) / 3 + 2 * disc2 * image2; // of a distance's square
    spread_ratio = squares / sum / spread;
    for (const double error :
         {(power / light.power_w - 1) / sigma, x / sum / (std::sqrt(spread / 2) * sigma),
          y / sum / (std::sqrt(spread / 2) * sigma), (squares / sum - spread) / (std::sqrt(variance) * sigma)})
      worst = worse(worst, error);
  }
  return judged(worst, 6, "sigma",
                fmt::format("a disc of light out of focus, as {} show it, with perspective and without, against the "
                            "circle of confusion: ratio of the mean squares {:.4f}",
                            by_photons ? "photons" : "paths from the eye", spread_ratio));
}
Result photons_through_a_lens(const compute::Context& context, std::uint64_t seed) {
  return through_a_lens(context, seed, true);
}
Result paths_through_a_lens(const compute::Context& context, std::uint64_t seed) {
  return through_a_lens(context, seed, false);
}

/// A sky of one colour above and black below gives a white floor its own colour: what the ball of n = 1 hides of it
/// comes through the ball. Half a sky is also drawn by its peaks. Compares each channel's mean over the pixels, in
/// standard errors by their own scatter about the truth.
Result sky_through_nothing(const compute::Context& context, std::uint64_t seed) {
  preset::Preset p = lit_floor(16, 0.5, seed);
  p.scene.lights.clear();
  p.scene.objects[0] = object("floor", quad(3, 3), "white");
  p.scene.materials["nothing"] = glass(1);
  p.scene.objects.push_back(object("ball", ball(0.4), "nothing", at({0.1, 1, -0.2})));
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->colour = {0.7, 0.4, 0.05};
  p.scene.environment->lights = true;
  spectral::settings(p).direct = true;
  spectral::settings(p).background = false;
  spectral::settings(p).photons_per_pass = 1 << 15;
  p.stop.passes = spectral::settings(p).pixel_samples = 16;
  const job::Snapshot snapshot = render(p, context, [](scene::Scene& scene) {
    scene.environment->height = 2;
    scene.environment->rgb.resize(6, 0.0f);
    scene.lights.back() = scene::make_environment_light(*scene.environment);
  });
  const std::vector<float>&direct = layer(snapshot, "direct").rgb, &caustic = layer(snapshot, "caustic").rgb;
  double sums[3] = {}, squares[3] = {}, hidden = 0, worst = 0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    const double off = (double(direct[i]) + caustic[i]) / p.scene.environment->colour[i % 3] - 1;
    sums[i % 3] += off;
    squares[i % 3] += off * off;
    hidden += double(caustic[i]) / p.scene.environment->colour[i % 3] / static_cast<double>(direct.size());
  }
  for (int c = 0; c < 3; ++c) worst = worse(worst, sums[c] / std::sqrt(squares[c]));
  return judged(worst, 6, "sigma",
                fmt::format("a floor under half a sky of one colour, {:.3f} of its light through a ball of n = 1, "
                            "against the sky's colour: ratio {:.4f}",
                            hidden, 1 + sums[1] * 3 / static_cast<double>(direct.size())));
}

/// A pencil meets a mirror that is not grey, then a screen: each wavelength's reflectance is left, without chance.
Result coloured_mirror(const compute::Context& context, std::uint64_t seed) {
  preset::Preset p = empty_preset(16);
  p.seed = seed;
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["mirror"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["mirror"].reflectance.patch = "blue sky";
  p.scene.materials["white"] = white();
  p.scene.objects = {object("mirror", quad(1, 1), "mirror"),
                     object("screen", quad(10, 10), "white", at({2, 0, 0}, {0, 0, 90}))};
  p.scene.lights = {pencil({-1, 1, 0}, {1, -1, 0}, 0.5)};
  p.scene.lights[0].spectrum = {};
  p.scene.lights[0].spectrum.illuminant = "D65";
  p.scene.camera.position = {-3, 1, 0};
  spectral::settings(p).low_discrepancy = true; // photons' wavelengths are drawn, and evenly so
  spectral::settings(p).photons_per_pass = 1 << 16;
  const photons::EnergyBalance e = photons::energy_of(render(p, context));
  const optics::Spectrum light = optics::illuminant("D65"), patch = optics::colorchecker_patch("blue sky");
  double truth = 0;
  for (std::size_t i = 0; i < light.size(); ++i) truth += light[i] * patch[i];
  return judged(e.deposited_w / e.emitted_w - truth, 2e-5, "",
                fmt::format("daylight after a mirror of blue sky's reflectance: {:.6f} of its power is left, against "
                            "the sum over 401 wavelengths",
                            e.deposited_w / e.emitted_w));
}

/// A scene with smooth and faceted glass, a mirror that absorbs, and a floor that does not catch everything.
preset::Preset everything(std::uint64_t seed) {
  preset::Preset p = empty_preset(32);
  p.seed = seed;
  p.unit = preset::Preset::Unit::cm;
  preset::Material dispersive = glass(1.7);
  dispersive.dispersion.type = preset::Dispersion::Type::cauchy;
  dispersive.dispersion.coefficients = {1.65, 0.03};
  p.scene.materials["glass"] = dispersive;
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["mirror"].reflectance.value = 0.9;
  p.scene.materials["white"] = white();
  const preset::Shape diamond{.type = preset::Shape::Type::brilliant, .radius = 1};
  p.scene.objects = {object("ball", ball(1), "glass", at({-1.5, 1.5, 0})),
                     object("diamond", diamond, "glass", at({1.5, 1.5, 0}, {20, 0, 15})),
                     object("mirror", quad(2, 2), "mirror", at({0, 1.5, -2}, {75, 0, 0})),
                     object("floor", quad(12, 12), "white")};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  p.scene.lights.resize(1);
  p.scene.lights[0].position = {0.5, 6, 3};
  p.scene.lights[0].power_w = 10;
  p.scene.camera.position = {0, 9, 9};
  spectral::settings(p).direct = true;
  spectral::settings(p).threshold_deg = 1;
  spectral::settings(p).photons_per_pass = 1 << 16;
  p.stop.passes = 2;
  return p;
}

/// Power is counted in whole quanta, so only the last conversion to watts rounds.
Result energy(const compute::Context& context, std::uint64_t seed) {
  const photons::EnergyBalance e = photons::energy_of(render(everything(seed), context));
  const double off = (e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w) / e.emitted_w - 1;
  const bool all_there =
      e.deposited_w > 0 && e.missed_w > 0 && e.absorbed_w > 0 && e.escaped_w > 0 && e.refused_contributions == 0;
  return judged(all_there ? off : 1, 1e-12, "",
                fmt::format("of {:.4f} W, {:.4f} deposited, {:.4f} missed, {:.4f} absorbed, {:.4f} escaped, {:.4f} "
                            "lost; {} contributions refused",
                            e.emitted_w, e.deposited_w, e.missed_w, e.absorbed_w, e.escaped_w, e.lost_w,
                            e.refused_contributions));
}

/// The clock cuts slices, so two runs differ in how their work is cut, and in the order of the device's threads.
Result same_bits(const compute::Context& context, std::uint64_t seed) {
  const job::Snapshot first = render(everything(seed), context), second = render(everything(seed), context);
  double differ = 0;
  for (std::size_t i = 0; i < first.picture->rgb.size(); ++i) differ += first.picture->rgb[i] != second.picture->rgb[i];
  const job::Snapshot other = render(everything(seed + 1), context);
  if (first.picture->rgb == other.picture->rgb) differ = static_cast<double>(first.picture->rgb.size());
  return judged(
      differ, 0, "numbers",
      fmt::format("of {} of a picture, those that a second run with the same seed changes; another seed changes them",
                  first.picture->rgb.size()));
}

} // namespace

Checks radiometry_checks() {
  return {{"picture: direct light of a point", direct_light},
          {"picture: photons through nothing", through_nothing},
          {"picture: photons through a lens", photons_through_a_lens},
          {"picture: paths through a lens", paths_through_a_lens},
          {"picture: a sky through nothing", sky_through_nothing},
          {"picture: a coloured mirror", coloured_mirror},
          {"picture: energy balance", energy},
          {"picture: the same seed, the same bits", same_bits}};
}

} // namespace nephroid::check
