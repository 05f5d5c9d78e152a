// SPDX-License-Identifier: Apache-2.0
#include "ui/view/camera.h"

#include "preset/read.h"
#include "ui/view/sight.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

/// The camera's directions; right is found even where it looks along up.
struct Axes {
  glm::dvec3 up, right, outwards; ///< outwards: from the target to the camera; all unit
  double distance = 1;
};

Axes axes(const preset::Camera& camera)
{
  Axes a;
  const glm::dvec3 arm = to_vector(camera.position) - to_vector(camera.target);
  a.distance = glm::length(arm);
  a.outwards = a.distance > 0 ? arm / a.distance : glm::dvec3(0, 0, 1);
  const glm::dvec3 up = to_vector(camera.up);
  a.up = glm::length(up) > 0 ? glm::normalize(up) : glm::dvec3(0, 1, 0);
  glm::dvec3 right = glm::cross(a.up, a.outwards);
  if (glm::length(right) < 1e-9) right = glm::cross(a.up, std::abs(a.up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
  a.right = glm::normalize(right);
  return a;
}

nlohmann::ordered_json camera_fields(const preset::Preset& preset)
{
  return nlohmann::ordered_json::parse(preset::to_json(preset)).at("scene").at("camera");
}

} // namespace

preset::Camera orbit(const preset::Camera& camera, double right_deg, double up_deg)
{
  const Axes a = axes(camera);
  // Spherical coordinates about up: the polar angle and, in the plane across it, `ahead` (the camera's side) and `right`.
  const glm::dvec3 ahead = glm::cross(a.right, a.up);
  const double polar = std::acos(std::clamp(glm::dot(a.outwards, a.up), -1.0, 1.0));
  const double limit = glm::radians(1.0);
  const double new_polar = std::clamp(polar - glm::radians(up_deg), limit, glm::pi<double>() - limit);
  const double azimuth = glm::radians(right_deg);
  const glm::dvec3 across = std::cos(azimuth) * ahead + std::sin(azimuth) * a.right;
  preset::Camera moved = camera;
  moved.position = to_stored(to_vector(camera.target) + a.distance * (std::cos(new_polar) * a.up + std::sin(new_polar) * across));
  return moved;
}

preset::Camera dolly(const preset::Camera& camera, double factor)
{
  preset::Camera moved = camera;
  const glm::dvec3 target = to_vector(camera.target);
  moved.position = to_stored(target + factor * (to_vector(camera.position) - target));
  return moved;
}

preset::Camera pan(const preset::Camera& camera, double right, double down)
{
  const Axes a = axes(camera);
  const glm::dvec3 picture_up = glm::cross(a.outwards, a.right);
  const double height = 2 * a.distance * std::tan(glm::radians(camera.fov_deg) / 2);
  const glm::dvec3 shift = height * (down * picture_up - right * a.right);
  preset::Camera moved = camera;
  moved.position = to_stored(to_vector(camera.position) + shift);
  moved.target = to_stored(to_vector(camera.target) + shift);
  return moved;
}

std::string camera_json(const preset::Preset& preset) { return nlohmann::ordered_json{{"camera", camera_fields(preset)}}.dump(2) + "\n"; }

std::string camera_settings(const preset::Preset& preset)
{
  const nlohmann::ordered_json fields = camera_fields(preset);
  std::string text;
  for (const auto& [name, value] : fields.items())
    text += fmt::format("{}--set 'scene.camera.{}={}'", text.empty() ? "" : " ", name, value.dump());
  return text;
}

} // namespace nephroid::ui
