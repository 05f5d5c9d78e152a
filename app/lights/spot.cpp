// SPDX-License-Identifier: Apache-2.0
// A point that shines into a cone.
#include "lights/lights.h"

#include "scene/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::lights {
namespace {

class Spot final : public Model {
  static double cone(const scene::Light& light) { return 2 * std::numbers::pi * (1 - light.cos_half_angle); }

public:
  void describe(preset::Fields& v, preset::Light& light) const override {
    describe_power(v, light);
    describe_position(v, light);
    describe_direction(v, light);
    v.field("half_angle_deg", "Between the cone's axis and its edge: constant intensity inside, none outside.",
            light.half_angle_deg, {.unit = "degrees", .bounds = preset::within(0.01, 180)});
  }

  void load(const preset::Light& from, const Loading& loading, scene::Light& light) const override {
    light.direction = scene::unit_direction(scene::to_dvec3(from.direction), loading.where / "direction");
    light.cos_half_angle = std::cos(from.half_angle_deg * std::numbers::pi / 180);
    load_position(from, loading, light);
  }

  void set_row(const scene::Light& light, shared::DeviceLight& row) const override {
    row.as.spot = {scene::to_float4(light.position), scene::to_float4(light.direction),
                   static_cast<float>(1 - light.cos_half_angle), static_cast<float>(cone(light))};
  }

  glm::dvec3 place(const shared::DeviceLight& row, const float*, const Surfaces&, std::array<float, 2>) const override {
    return vector(row.as.spot.position);
  }

  bool reaches(const scene::Light& light, const scene::Sphere& sphere) const override {
    const glm::dvec3 way = glm::dvec3(sphere.centre) - glm::dvec3(light.position);
    const double distance = glm::length(way), along = glm::dot(way, glm::dvec3(light.direction));
    if (distance <= sphere.radius) return true;
    constexpr double margin = 1e-3; // kernels compute directions in single precision
    const double off_axis = std::acos(std::clamp(along / distance, -1.0, 1.0));
    return off_axis - std::asin(sphere.radius / distance) <=
           std::acos(std::clamp(light.cos_half_angle, -1.0, 1.0)) + margin;
  }

  double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres, double) const override {
    return light.power_w * std::min(1.0, steradians_of(spheres, light.position) / cone(light));
  }

  double irradiance(const scene::Light& light, double metres) const override {
    return light.power_w / (cone(light) * metres * metres);
  }

  std::optional<Punctual> punctual(const scene::Light& light) const override {
    return Punctual{"spot", light.power_w / cone(light),
                    std::min(std::acos(light.cos_half_angle), std::numbers::pi / 2)};
  }

  std::string_view left_out(const scene::Light& light) const override {
    if (light.cos_half_angle >= 0) return {};
    return "a spot of glTF has at most half of all directions: what a wider one sends beyond them is missing";
  }
};

} // namespace

const Model& spot() {
  static const Spot made;
  return made;
}

} // namespace nephroid::lights
