// SPDX-License-Identifier: Apache-2.0
// Parallel light, from a point far away or from a disc.
#include "lights/lights.h"

#include "scene/directions.h"

#include <cmath>
#include <numbers>

namespace nephroid::lights {
namespace {

class Directional final : public Model {
public:
  void describe(preset::Fields& v, preset::Light& light) const override {
    v.field("irradiance_w_m2", "Irradiance of 380 to 780 nm on a plane that faces the light.", light.irradiance_w_m2,
            {.unit = "W/m^2", .bounds = preset::power_bounds});
    v.field("angular_diameter_deg", "Of the disc that the light comes from: 0.53 for the sun, 0 for a point.",
            light.angular_diameter_deg, {.unit = "degrees", .bounds = preset::within(0, 10)});
    describe_direction(v, light);
  }

  void load(const preset::Light& from, const Loading& loading, scene::Light& light) const override {
    light.direction = scene::unit_direction(scene::to_dvec3(from.direction), loading.where / "direction");
    light.irradiance_w_m2 = from.irradiance_w_m2;
    light.one_minus_cos = 2 * std::pow(std::sin(from.angular_diameter_deg / 4 * std::numbers::pi / 180), 2);
  }

  void set_row(const scene::Light& light, shared::DeviceLight& row) const override {
    row.as.directional = {scene::to_float4(light.direction), static_cast<float>(light.one_minus_cos)};
  }

  bool has_places(const shared::DeviceLight& row) const override { return row.as.directional.one_minus_cos > 0; }

  std::vector<glm::dvec3> extent(const scene::Scene&, const scene::Light&) const override { return {}; }

  double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres,
                   double metres_per_unit) const override {
    return light.irradiance_w_m2 * shadow_m2(spheres, metres_per_unit);
  }

  double irradiance(const scene::Light& light, double) const override { return light.irradiance_w_m2; }

  std::optional<Punctual> punctual(const scene::Light& light) const override {
    return Punctual{"directional", light.irradiance_w_m2, {}};
  }

  std::string_view left_out(const scene::Light& light) const override {
    return has_disc(light) ? "a sun is a point: its disc is left out" : std::string_view();
  }
};

} // namespace

const Model& directional() {
  static const Directional made;
  return made;
}

} // namespace nephroid::lights
