// SPDX-License-Identifier: Apache-2.0
#include "spectral/maps/map_radius.h"

#include "tracing/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::spectral {
namespace {

/// Width of what a pixel covers at the distance of the scene's middle.
double pixel_width(const scene::Camera& camera, const scene::Sphere& bounds)
{
  const double distance = std::max<double>(glm::length(camera.position - bounds.centre), 0.25 * bounds.radius);
  return 2 * distance * camera.tan_y / camera.height;
}

} // namespace

double first_map_radius(const Settings& settings, const scene::Scene& scene)
{
  return settings.sppm.radius ? *settings.sppm.radius : 2 * pixel_width(scene.camera, tracing::scene_bounds(scene));
}

std::string map_radius_note(const Settings& settings, const scene::Scene& scene)
{
  const double radius = first_map_radius(settings, scene), alpha = settings.sppm.alpha, shrunk = radius * std::sqrt(alpha);
  const scene::Sphere bounds = tracing::scene_bounds(scene);
  const double pixel = pixel_width(scene.camera, bounds), least = pixel / 16;
  if (settings.estimator == Settings::Estimator::sppm && radius >= least && shrunk < least)
    return fmt::format(
        "spectral.sppm.alpha: {:.3g} shrinks a radius from {:.3g} to {:.3g} pixels at its first photons, and hardly another one "
        "lies so near: caustics grow darker from pass to pass; choose 0.667 or so",
        alpha, radius / pixel, shrunk / pixel);
  if (!settings.sppm.radius) return "";
  const auto note = [&](const char* consequence) {
    return fmt::format("spectral.sppm.radius: {} units are {:.3g} pixels: {}; choose about {:.3g}, two pixels, or leave it out", radius,
                       radius / pixel, consequence, 2 * pixel);
  };
  if (radius > 32 * pixel || (radius > bounds.radius && radius > 2 * pixel))
    return note("caustics are blurred away, and gathering is slow");
  return radius < least ? note("hardly a photon lies so near, and caustics are black but for rare bright dots") : "";
}

double map_radius_factor(std::int64_t pass, double alpha)
{
  // The product of (k + alpha) / (k + 1) over k = 1 .. pass is Gamma(pass + 1 + alpha) / Gamma(1 + alpha) / Gamma(pass + 2).
  const auto p = static_cast<double>(pass);
  return std::exp(0.5 * (std::lgamma(p + 1 + alpha) - std::lgamma(1 + alpha) - std::lgamma(p + 2)));
}

} // namespace nephroid::spectral
