// SPDX-License-Identifier: Apache-2.0
#include "spectral/checks/render.h"

#include "optics/fresnel.h"
#include "spectral/checks/scene_parts.h"
#include "spectral/engine.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::check {
namespace {

constexpr int stack = 64; ///< entries that nearly all trees of checks and tests need at most

/// Builds programs for what nearly all scenes need, and for more where a scene needs more.
void share_programs(compute::Defines& defines) {
  const auto at_least = [&](const char* name, int value) {
    defines[name] = std::to_string(std::max(std::stoi(defines[name]), value));
  };
  at_least("NEPHROID_BVH_STACK", stack);
  at_least("NEPHROID_ELLIPSOIDS", 1);
}

using Point = glm::dvec2; // (x, z)

/// The point where a ray crosses the line through a and b.
Point crossing(const Point& o, const Point& d, const Point& a, const Point& b) {
  const Point e = b - a;
  const double t = ((a.x - o.x) * e.y - (a.y - o.y) * e.x) / (d.x * e.y - d.y * e.x);
  return o + t * d;
}

/// Refracts by Snell's law in the plane: unit direction d, unit normal n against it.
Point refracted(const Point& d, const Point& n, double eta) {
  const double c = -glm::dot(d, n), t = std::sqrt(1 - eta * eta * (1 - c * c));
  return eta * d + (eta * c - t) * n;
}

} // namespace

double plate_transmittance(double theta, double n) {
  const double r = optics::fresnel_reflectance(std::cos(theta), 1, n);
  return (1 - r) / (1 + r);
}

double pane_transmittance(double theta, double n) {
  const double inside = std::asin(std::sin(theta) / n), less = theta - inside, more = theta + inside;
  if (theta == 0) return plate_transmittance(0, n);
  double sum = 0;
  for (const double amplitude : {std::sin(less) / std::sin(more), std::tan(less) / std::tan(more)})
    sum += (1 - amplitude * amplitude) / (1 + amplitude * amplitude);
  return sum / 2;
}

double z_of_transmitted(const compute::Context& context, preset::Preset p, double truth, double left) {
  constexpr int photons = 1 << 17;
  p.scene.materials["white"] = white();
  p.scene.objects.push_back(object("floor", quad(400, 400), "white", at({0, -1, 0})));
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  spectral::settings(p).photons_per_pass = photons;
  const photons::EnergyBalance e = photons::energy_of(render(p, context));
  return (e.deposited_w / e.emitted_w / left - truth) / std::sqrt(truth * (1 - truth) / photons);
}

PrismPath prism_path(double side, double incidence, double n, double screen_z) {
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const Point apex{0, side * c / 2}, left{-side / 2, -side * c / 2}, right{side / 2, -side * c / 2};
  const Point into{c, -s}, right_normal{c, s}; // into: against the entry face's normal
  // The direction is turned by the angle of incidence towards the apex.
  const Point direction{into.x * std::cos(incidence) - into.y * std::sin(incidence),
                        into.x * std::sin(incidence) + into.y * std::cos(incidence)};
  const Point entry = (apex + left) / 2.0, from = entry - 2 * side * direction;
  const Point inside = refracted(direction, -into, 1 / n), exit = crossing(entry, inside, apex, right);
  const Point out = refracted(inside, -right_normal, n);
  return {from.x, from.y, direction.x, direction.y, exit.x + (screen_z - exit.y) / out.y * out.x};
}

double ball_lens_landing(double radius, double height, double n, double screen_z) {
  const double a = std::asin(height / radius), b = std::asin(height / radius / n), d = 2 * (a - b);
  if (d == 0) return height;
  const double focus = radius * std::sin(a) / std::sin(d);
  return (focus + screen_z) * std::tan(d);
}

photons::RunTables device_tables(const preset::Preset& preset) {
  const scene::Scene scene = scene::load_scene(preset);
  return photons::make_lit_tables(spectral::settings(preset), scene, scene::build_bvh(scene.geometry), {});
}

std::unique_ptr<job::Job> general_job(const preset::Preset& preset, tracing::LeaveOut leave_out,
                                      const compute::Context& context, const ChangeScene& change) {
  leave_out.occlusion = leave_out.light_types = leave_out.mirrors = leave_out.bending = leave_out.attenuation =
      leave_out.smooth_normals = false;
  scene::Scene scene = scene::load_scene(preset);
  if (change) change(scene);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  photons::RunPlan plan = spectral::make_plan(preset, scene, bvh, leave_out);
  share_programs(plan.defines);
  return photons::make_job(preset, scene, bvh, plan, context);
}

job::Snapshot render(const preset::Preset& preset, const compute::Context& context, const ChangeScene& change) {
  const auto job = general_job(preset, {}, context, change);
  while (!job->finished()) job->advance();
  return job->snapshot();
}

} // namespace nephroid::check
