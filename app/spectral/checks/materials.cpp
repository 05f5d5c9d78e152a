// SPDX-License-Identifier: Apache-2.0
// Pencils of light on metals, tinted glass, panes and coatings by the real engine, against Fresnel and Airy.
#include "optics/fresnel.h"
#include "optics/primary_reflectances.h"
#include "optics/spectrum.h"
#include "scatter/spectra.h"
#include "spectral/checks/render.h"
#include "spectral/checks/scene_parts.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

namespace nephroid::check {
namespace {

/// An inclined pencil on a mirror in a room.
preset::Preset onto_mirror(const preset::Material& mirror, double theta, std::uint64_t seed) {
  preset::Preset p = empty_preset(16);
  p.seed = seed;
  p.scene.materials["mirror"] = mirror;
  p.scene.materials["white"] = white();
  preset::Shape room = box(100, 100, 100);
  room.inwards = true;
  p.scene.objects = {object("mirror", quad(40, 40), "mirror"), object("room", room, "white")};
  p.scene.lights = {inclined_pencil(theta)};
  spectral::settings(p).photons_per_pass = 1 << 16;
  return p;
}

/// What is left of daylight after one reflection. Each photon draws its wavelengths.
Result metals(const compute::Context& context, std::uint64_t seed) {
  double worst = 0;
  for (const char* metal : {"gold", "silver", "copper", "aluminium", "brass"}) {
    const optics::DispersionCurve curve = scatter::load_dispersion(metal);
    const optics::Spectrum light = optics::illuminant("D65"),
                           n = optics::sample_n(curve, optics::Extrapolation::automatic),
                           k = optics::sample_k(curve, optics::Extrapolation::automatic);
    for (const double theta_deg : {0.0, 60.0, 85.0}) {
      preset::Preset p = onto_mirror(conductor(metal), theta_deg * degree, seed);
      p.scene.lights[0].spectrum = {};
      spectral::settings(p).low_discrepancy = true; // wavelengths are drawn, and evenly so
      const photons::EnergyBalance e = photons::energy_of(render(p, context));
      double truth = 0;
      for (std::size_t w = 0; w < light.size(); ++w)
        truth += light[w] * optics::conductor_reflectance(std::cos(theta_deg * degree), 1, {n[w], k[w]});
      worst = worse(worst, e.deposited_w / e.emitted_w - truth);
    }
  }
  return judged(worst, 2e-5, "",
                "daylight on gold, silver, copper, aluminium and brass at 0, 60 and 85 degrees: the part that is left, "
                "against Fresnel's equations at 401 wavelengths");
}

double smith_lambda(double cosine, double alpha) {
  return (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
}

/// The part of the light that meets a facet of GGX, is reflected there and leaves without meeting a second one, or
/// masked: does not leave. It is the integral over facets h of D(h) (view . h) / (view . n) R(view . h) over 1 +
/// Lambda(view) + Lambda(out), where `out` is above the surface; of all that is reflected the integral without
/// Lambda(out). Facets are taken by t and azimuth, as in app/check/roughness.cpp, in steps of s = sqrt(1 - t).
template <class Reflectance>
double reflected_part(double cos_view, double alpha, bool masked, const Reflectance& reflectance) {
  constexpr int steps = 600;
  const double sin_view = std::sqrt(1 - cos_view * cos_view);
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double s = (i + 0.5) / steps, t = 1 - s * s,
                   phi = std::numbers::pi * (j + 0.5) / steps; // both halves are alike
      const double cosine = std::sqrt((1 - t) / (1 - t + alpha * alpha * t)), sine = std::sqrt(1 - cosine * cosine);
      const double seen = sin_view * sine * std::cos(phi) + cos_view * cosine, out = 2 * seen * cosine - cos_view;
      if (!(seen > 0)) continue;
      const double view_lambda = smith_lambda(cos_view, alpha),
                   leaves = out > 0 ? 1 / (1 + view_lambda + smith_lambda(out, alpha)) : 0;
      sum +=
          2 * s * seen / (cosine * cos_view) * reflectance(seen) * (masked ? 1 / (1 + view_lambda) - leaves : leaves);
    }
  return sum / steps / steps;
}

/// In the room's light all that misses here was masked. Photons that are sent down by a facet are lost, too.
Result rough_mirror(const compute::Context& context, std::uint64_t seed) {
  double worst = 0;
  for (const double roughness : {0.3, 0.7, 1.0})
    for (const double theta_deg : {0.0, 60.0, 80.0}) {
      preset::Material rough = mirror(1);
      rough.roughness = roughness;
      preset::Preset p = onto_mirror(rough, theta_deg * degree, seed);
      spectral::settings(p).photons_per_pass = 1 << 20;
      const photons::EnergyBalance e = photons::energy_of(render(p, context));
      worst =
          worse(worst, e.deposited_w / e.emitted_w - reflected_part(std::cos(theta_deg * degree), roughness * roughness,
                                                                    false, [](double) { return 1.0; }));
    }
  return judged(worst, 2e-3, "",
                "light that leaves a perfect mirror of roughness .3, .7 and 1 at 0, 60 and 80 degrees, against the "
                "integral over its facets");
}

/// The luminance of a plane that the sun shines on from `light` radians to one side, seen from `view` radians to the
/// other.
double shine(const compute::Context& context, const preset::Material& material, double light, double view) {
  preset::Preset p = empty_preset(8);
  p.scene.materials["plane"] = material;
  p.scene.objects = {object("plane", quad(1, 1), "plane")};
  p.scene.lights.resize(1);
  p.scene.lights[0].type = preset::Light::Type::directional;
  p.scene.lights[0].spectrum = line(550);
  p.scene.lights[0].direction = {std::sin(light), -std::cos(light), 0};
  p.scene.camera.position = {1000 * std::sin(view), 1000 * std::cos(view), 0};
  p.scene.camera.up = {0, 0, 1};
  p.scene.camera.fov_deg = 0.001;
  spectral::settings(p).direct = true;
  spectral::settings(p).caustic = false;
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(4);
  const job::Snapshot snapshot = render(p, context);
  const job::Layer& direct = layer(snapshot, "direct");
  double sum = 0;
  for (int pixel = 0; pixel < 64; ++pixel) sum += luminance(direct, 8, pixel / 8, pixel % 8) / 64;
  return sum;
}

/// A matt white plane has the radiance E / pi, so pi times the value of the microfacets' reflection is what is more.
Result highlights(const compute::Context& context, std::uint64_t) {
  double worst = 0;
  for (const double roughness : {0.03, 0.3, 0.6, 1.0})
    for (const auto& [light_deg, view_deg] : {std::pair{0.0, 20.0}, {45.0, 45.0}, {60.0, 20.0}, {30.0, -50.0}}) {
      const double light = light_deg * degree, view = view_deg * degree, alpha = roughness * roughness;
      const double half = std::cos((view - light) / 2), narrow = 1 + (alpha * alpha - 1) * half * half;
      const double seen = 1 + smith_lambda(std::cos(light), alpha) + smith_lambda(std::cos(view), alpha);
      const double value =
          alpha * alpha / (std::numbers::pi * narrow * narrow * 4 * seen * std::cos(light) * std::cos(view));
      if (value < 1e-3) continue; // a few quanta of the film
      preset::Material rough = mirror(1);
      rough.roughness = roughness;
      const double truth = std::numbers::pi * value * shine(context, white(), light, view);
      worst = worse(worst, shine(context, rough, light, view) / truth - 1);
    }
  return judged(worst, 1e-3, "",
                "sunlight on mirrors of roughness .03, .3, .6 and 1, seen from four sides, over that on a white plane: "
                "against the value of GGX' reflection");
}

/// A base of 0.5 below a coat, 0 to 1 of roughness.
preset::Material plastic(double n, double roughness) {
  preset::Material m;
  m.type = preset::Material::Type::plastic;
  m.dispersion.n = n;
  m.reflectance.value = 0.5;
  m.roughness = roughness;
  return m;
}

/// A polished coat reflects by Fresnel's R, and T = 1 - R passes. The base below it, over a white plane, has the
/// reflectance times the T of the ways in and out, over the mean of T over all sides (Mitsuba's "plastic", where
/// "nonlinear" is false).
Result plastics(const compute::Context& context, std::uint64_t seed) {
  double worst = 0;
  for (const double n : {1.3, 1.5, 1.9}) {
    double passes = 0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
      const double cosine = (i + 0.5) / steps;
      passes += 2 * cosine * (1 - optics::fresnel_reflectance(cosine, 1, n)) / steps;
    }
    for (const auto& [light_deg, view_deg] : {std::pair{0.0, 20.0}, {60.0, 20.0}, {30.0, -70.0}, {84.0, 0.0}}) {
      const auto passing = [&](double angle_deg) {
        return 1 - optics::fresnel_reflectance(std::cos(angle_deg * degree), 1, n);
      };
      const double light = light_deg * degree, view = view_deg * degree,
                   truth = 0.5 * passing(light_deg) * passing(view_deg) / passes,
                   seen = shine(context, plastic(n, 0), light, view) / shine(context, white(), light, view);
      worst = worse(worst, seen - truth);
      const photons::EnergyBalance e = photons::energy_of(render(onto_mirror(plastic(n, 0), light, seed), context));
      worst = worse(worst, e.deposited_w / e.emitted_w - (1 - passing(light_deg)));
    }
  }
  return judged(worst, 1e-3, "",
                "sunlight on a matt base under coats of n = 1.3, 1.5 and 1.9, over that on a white plane, and the part "
                "that the coat reflects: against Fresnel's equations");
}

/// In a white world a white base loses no light below a polished coat. Rough ones lose what meets a second facet.
Result white_plastics(const compute::Context& context, std::uint64_t seed) {
  double worst = 0;
  for (const double roughness : {0.0, 0.1, 0.5})
    for (const double view_deg : {0.0, 45.0, 80.0}) {
      preset::Preset p = empty_preset(8);
      p.seed = seed;
      p.scene.materials["plane"] = plastic(1.5, roughness);
      p.scene.materials["plane"].reflectance.value = 1;
      p.scene.objects = {object("plane", quad(1, 1), "plane")};
      p.scene.environment.emplace().type = preset::Environment::Type::constant;
      p.scene.environment->lights = true;
      p.scene.camera.position = {1000 * std::sin(view_deg * degree), 1000 * std::cos(view_deg * degree), 0};
      p.scene.camera.up = {0, 0, 1};
      p.scene.camera.fov_deg = 0.001;
      spectral::settings(p).direct = spectral::settings(p).background = true;
      spectral::settings(p).pixel_samples = p.stop.passes.emplace(1024);
      spectral::settings(p).low_discrepancy = true;
      const job::Snapshot snapshot = render(p, context);
      double sum = 0;
      for (const char* name : {"direct", "background"})
        for (int pixel = 0; pixel < 64; ++pixel) sum += luminance(layer(snapshot, name), 8, pixel / 8, pixel % 8) / 64;
      double truth = 1;
      if (roughness > 0)
        truth -= reflected_part(std::cos(view_deg * degree), roughness * roughness, true,
                                [](double cosine) { return optics::fresnel_reflectance(cosine, 1, 1.5); });
      worst = worse(worst, sum - truth);
    }
  return judged(worst, 1e-3, "", "radiance of white plastic in a white world, against that of the world");
}

/// `material` in a preset that an inclined pencil crosses, as `shape`.
double z_through(const compute::Context& context, std::uint64_t seed, const preset::Material& material,
                 const preset::Shape& shape, const preset::Light& light, double truth, double left = 1) {
  preset::Preset p = empty_preset(16);
  p.seed = seed;
  p.scene.materials["glass"] = material;
  p.scene.objects = {object("plate", shape, "glass")};
  p.scene.lights = {light};
  return z_of_transmitted(context, std::move(p), truth, left);
}

Result tinted_plate(const compute::Context& context, std::uint64_t seed) {
  preset::Material tinted = glass(1.5);
  tinted.tint.value = 0.7;
  const double z = z_through(context, seed, tinted, box(40, 1e-3, 40), inclined_pencil(0.7),
                             plate_transmittance(0.7, 1.5), 0.7 * 0.7);
  return judged(z, 6, "sigma",
                "transmittance of a plate at 40 degrees whose faces each pass 0.7, against 0.49 of glass'");
}

Result pane(const compute::Context& context, std::uint64_t seed) {
  preset::Material thin = glass(1.5);
  thin.thin = true;
  thin.tint.value = 0.6;
  double worst = 0;
  for (const double theta_deg : {0.0, 30.0, 45.0, 60.0, 70.0, 80.0})
    worst = worse(worst, z_through(context, seed, thin, quad(40, 40), inclined_pencil(theta_deg * degree),
                                   pane_transmittance(theta_deg * degree, 1.5), 0.6));
  return judged(worst, 6, "sigma",
                "transmittance of a thin pane that passes 0.6, at 0, 30, 45, 60, 70 and 80 degrees, the farthest from "
                "0.6 times the mean of both polarisations' (1 - R) / (1 + R)");
}

/// The plate's faces are far apart for interference, so their reflectances add up as those of a bare plate do.
Result coated_plate(const compute::Context& context, std::uint64_t seed) {
  double worst = 0;
  for (const auto& [n_layer, thickness_nm] : {std::pair{1.38, 100.0}, {2.35, 180.0}, {1.0, 60.0}}) {
    preset::Material coated = glass(1.5);
    coated.coating.emplace().dispersion.n = n_layer;
    coated.coating->thickness_nm = thickness_nm;
    for (const double nm : {420.0, 550.0, 700.0})
      for (const double theta_deg : {0.0, 60.0}) {
        const double r = optics::coated_reflectance(std::cos(theta_deg * degree), 1, n_layer, 1.5, thickness_nm / nm);
        worst = worse(worst, z_through(context, seed, coated, box(40, 1e-3, 40),
                                       inclined_pencil(theta_deg * degree, nm), (1 - r) / (1 + r)));
      }
  }
  return judged(worst, 6, "sigma",
                "transmittance of plates with layers of n = 1.38, 2.35 and 1 at 420, 550 and 700 nm, 0 and 60 degrees, "
                "the farthest from (1 - R) / (1 + R) with Airy's R");
}

/// A board of four colours that lies below the camera, x to the right and -z up in the picture, lit by daylight: the
/// sun's alone, or what a lamp sends through a plate of glass.
job::Snapshot on_a_board(const compute::Context& context, bool through_glass, const std::optional<double>& nm,
                         const std::optional<preset::Texture>& texture) {
  preset::Preset p = empty_preset(16);
  p.scene.materials["board"] = white();
  p.scene.materials["board"].texture = texture;
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects = {object("board", quad(2, 2), "board")};
  if (through_glass) p.scene.objects.push_back(object("plate", box(0.4, 0.01, 0.4), "glass", at({0, 8, 0})));
  p.scene.lights.resize(1);
  p.scene.lights[0].type = through_glass ? preset::Light::Type::point : preset::Light::Type::directional;
  p.scene.lights[0].position = {0, 9, 0};
  if (nm) p.scene.lights[0].spectrum = line(*nm);
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 2 * std::atan(0.2) / degree;
  spectral::settings(p).direct = !through_glass;
  spectral::settings(p).caustic = through_glass;
  spectral::settings(p).jitter = nm.has_value(); // clusters as a whole have no noise of colours
  return render(p, context);
}

/// A checkerboard's colours on a white card are those of its fields. Of light of one wavelength, a mixture of the three
/// reflectances of which colours are made is left.
Result textures(const compute::Context& context, std::uint64_t) {
  preset::Texture board;
  board.type = preset::Texture::Type::checkerboard;
  board.colour0 = {0.75, 0.5, 0.125};
  board.colour1 = {0.25, 0.0, 1.0};
  double worst = 0;
  for (const bool through_glass : {false, true})
    for (const std::optional<double>& nm : {std::optional<double>(), std::optional(500.0), std::optional(620.0)}) {
      const job::Snapshot plain = on_a_board(context, through_glass, nm, std::nullopt),
                          coloured = on_a_board(context, through_glass, nm, board);
      const char* name = through_glass ? "caustic" : "direct";
      const job::Layer &white = layer(plain, name), &seen = layer(coloured, name);
      std::array<std::array<double, 3>, 2> light{}, left{}; // of the fields of each colour
      for (std::size_t i = 0; i < white.rgb.size(); ++i) {
        const std::size_t colour = (i / 3 % 16 < 8) == (i / 48 < 8) ? 1 : 0;
        light[colour][i % 3] += white.rgb[i];
        left[colour][i % 3] += seen.rgb[i];
      }
      for (std::size_t colour = 0; colour < 2; ++colour)
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const preset::Vec3& rgb = colour == 0 ? board.colour0 : board.colour1;
          double truth = rgb[channel];
          if (nm) {
            truth = 0;
            for (std::size_t c = 0; c < 3; ++c)
              truth += rgb[c] * optics::primary_reflectances()[c][static_cast<std::size_t>(*nm - optics::first_nm)];
          }
          worst = worse(worst, left[colour][channel] / light[colour][channel] - truth);
        }
    }
  return judged(worst, 1e-3, "",
                "daylight, 500 and 620 nm on a checkerboard, from the sun and through glass, over that on white: "
                "against the colours of its fields");
}

} // namespace

Checks material_checks() {
  return {{"material: metals", metals},
          {"material: a rough mirror", rough_mirror},
          {"material: highlights", highlights},
          {"material: plastic", plastics},
          {"material: white plastic", white_plastics},
          {"material: tinted glass", tinted_plate},
          {"material: a thin pane", pane},
          {"material: coatings", coated_plate},
          {"material: textures", textures}};
}

} // namespace nephroid::check
