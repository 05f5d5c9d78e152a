// SPDX-License-Identifier: Apache-2.0
// Small scenes about a glass ball of radius 1 for the renderer of engine 2, and what its pictures show.
#pragma once
#include "environment/engine.h"
#include "environment/job.h"
#include "tests/environment/bakes.h"
#include "tests/support/process_state.h"

namespace nephroid::test {

/// Jobs whose bakes are kept in a folder of the test's own.
class EnvironmentJobs : public testing::Test {
protected:
  static environment::EnvironmentPlan plan_of(const preset::Preset& p) {
    const scene::Scene scene = scene::load_scene(p);
    return environment::make_plan(p, scene, scene::build_bvh(scene.geometry));
  }
  static std::unique_ptr<job::Job> job_of(const preset::Preset& p, const environment::EnvironmentPlan& plan) {
    return environment::make_job(p, plan, bake_context());
  }
  static std::unique_ptr<job::Job> job_of(const preset::Preset& p) { return job_of(p, plan_of(p)); }
  static job::Snapshot run(job::Job& job) {
    while (!job.finished()) job.advance();
    return job.snapshot();
  }
  static job::Snapshot run(const preset::Preset& p) { return run(*job_of(p)); }

  TemporaryFolder cache;
  CacheHome home{cache.path()};
};

/// A white square of the wall's material that faces along a normal.
inline std::string facing_quad(const std::string& name, const glm::dvec3& place, const glm::dvec3& normal,
                               double side) {
  const double about_x = std::asin(normal.z) * 180 / std::numbers::pi,
               about_z = std::atan2(-normal.x, normal.y) * 180 / std::numbers::pi;
  return fmt::format(R"({{"name": "{}", "shape": {{"type": "quad", "size": [{}, 1, {}]}}, "material": "wall",
                          "transform": {{"translate": [{}, {}, {}], "rotate_deg": [{}, 0, {}]}}}})",
                     name, side, side, place.x, place.y, place.z, about_x, about_z);
}

/// The ball and others by their spheres alone, with few photons, under no light yet; walls send back all light.
inline preset::Preset ball_and(const std::string& others, const preset::Overrides& more = {}) {
  preset::Overrides overrides{
      "environment.resolution=32",       "environment.spheres=8", "environment.photons=20000",
      "environment.radii=uniform",       "environment.reach=2",   "environment.directions=26",
      "environment.refine=false",        "stop.passes=4",         "scene.materials.wall.reflectance=1",
      "scene.camera.resolution=[16, 16]"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return bake_preset(glass_ball + (others.empty() ? "" : ", " + others), overrides);
}

inline preset::Light lamp(const glm::dvec3& direction, double irradiance_w_m2 = 1) {
  return {.type = preset::Light::Type::directional,
          .irradiance_w_m2 = irradiance_w_m2,
          .direction = {direction.x, direction.y, direction.z}};
}

inline void even_light(preset::Preset& p, double radiance = 1) {
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->radiance = radiance;
}

inline void look(preset::Preset& p, const glm::dvec3& from, const glm::dvec3& at, double fov_deg) {
  const glm::dvec3 way = glm::normalize(at - from);
  p.scene.camera.position = {from.x, from.y, from.z};
  p.scene.camera.target = {at.x, at.y, at.z};
  p.scene.camera.up = std::abs(way.y) > 0.8 ? preset::Vec3{1, 0, 0} : preset::Vec3{0, 1, 0};
  p.scene.camera.fov_deg = fov_deg;
}

inline const std::vector<float>& layer_rgb(const job::Snapshot& made, const std::string& name) {
  for (const job::Layer& of : made.picture->layers)
    if (of.name == name) return of.rgb;
  ADD_FAILURE() << "no layer " << name;
  return made.picture->rgb;
}

/// Of all pixels.
inline glm::dvec3 mean(const std::vector<float>& rgb) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < rgb.size(); i += 3) sum += glm::dvec3(rgb[i], rgb[i + 1], rgb[i + 2]);
  return sum * (3.0 / static_cast<double>(rgb.size()));
}

} // namespace nephroid::test
