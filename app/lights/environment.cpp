// SPDX-License-Identifier: Apache-2.0
// The environment as one of a scene's lights (scene::make_environment_light).
#include "lights/lights.h"

namespace nephroid::lights {
namespace {

class Environment final : public Model {
public:
  void describe(preset::Fields&, preset::Light&) const override {}                 // scene.environment is
  void load(const preset::Light&, const Loading&, scene::Light&) const override {} // described by itself
  void set_row(const scene::Light&, shared::DeviceLight&) const override {}        // its tables say its colour
  bool has_places(const shared::DeviceLight&) const override { return true; }
  std::vector<glm::dvec3> extent(const scene::Scene&, const scene::Light&) const override { return {}; }
  double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres,
                   double metres_per_unit) const override {
    return light.irradiance_w_m2 * shadow_m2(spheres, metres_per_unit);
  }
  double irradiance(const scene::Light& light, double) const override { return light.irradiance_w_m2; }
  std::optional<Punctual> punctual(const scene::Light&) const override { return std::nullopt; }
};

} // namespace

const Model& environment() {
  static const Environment made;
  return made;
}

} // namespace nephroid::lights
