// SPDX-License-Identifier: Apache-2.0
#include "ui/view/gizmo_edits.h"

#include "scene/scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::ui {
namespace {

using Kind = Selection::Kind;

preset::Vec3 rounded_vector(const glm::dvec3& v, int decimals) {
  return {rounded(v.x, decimals), rounded(v.y, decimals), rounded(v.z, decimals)};
}

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

/// A light's axes: the third is its direction, the first two are an area light's edges.
glm::dmat3 light_axes(const preset::Light& light) {
  const glm::dvec3 along = unit_or(to_vector(light.direction), {0, -1, 0});
  const glm::dvec3 wanted = to_vector(light.up);
  const glm::dvec3 other = std::abs(along.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 up =
      unit_or(wanted - glm::dot(wanted, along) * along, unit_or(other - glm::dot(other, along) * along, other));
  return {glm::cross(up, along), up, along};
}

/// A light's place. A directional light has none; it is shown in front of the camera's target, far enough for its arrow
/// to be visible.
glm::dvec3 light_place(const preset::Preset& preset, const preset::Light& light) {
  if (preset::has(light.type, LIGHT_HAS_POSITION)) return to_vector(light.position);
  const preset::Camera& camera = preset.scene.camera;
  const double reach = 0.3 * preset::height_at_target(camera);
  return to_vector(camera.target) - reach * unit_or(to_vector(light.direction), {0, -1, 0});
}

GizmoTarget light_grip(const preset::Preset& preset, const preset::Light& light) {
  GizmoTarget grip;
  grip.at = light_place(preset, light);
  grip.moves = preset::has(light.type, LIGHT_HAS_POSITION);
  grip.turns = preset::is_directed(light);
  if (grip.turns) grip.axes = light_axes(light);
  if (preset::has(light.type, LIGHT_HAS_EDGES)) grip.scales = {true, true, false};
  return grip;
}

glm::dmat3 about(const glm::dvec3& axis, double degrees) {
  return glm::dmat3(glm::rotate(glm::dmat4(1), degrees * std::numbers::pi / 180, axis));
}

/// Moves a changed object back so that its pivot is at `place`.
void keep_pivot(preset::Transform& transform, const glm::dvec3& pivot, const glm::dvec3& place) {
  if (pivot == glm::dvec3(0)) return;
  transform.translate = to_stored(place - Affine(transform).linear * pivot);
}

/// The angle nearest to `near` among those that differ from `degrees` by multiples of 360.
double nearest_turn(double degrees, double near) { return degrees + 360 * std::round((near - degrees) / 360); }

/// The nearest axis (a column, perhaps negated) to each direction of the picture (right, up, away); each axis once.
glm::dmat3 sorted_axes(const glm::dmat3& axes, const glm::dmat3& directions) {
  std::array<int, 3> order{0, 1, 2}, best = order;
  double most = -1;
  do {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += std::abs(glm::dot(axes[order[static_cast<std::size_t>(i)]], directions[i]));
    if (sum <= most + 1e-9) continue;
    most = sum;
    best = order;
  } while (std::ranges::next_permutation(order).found);
  glm::dmat3 sorted;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& axis = axes[best[static_cast<std::size_t>(i)]];
    sorted[i] = glm::dot(axis, directions[i]) < 0 ? -axis : axis;
  }
  return sorted;
}

} // namespace

std::optional<GizmoTarget> grip_of(const preset::Preset& preset, const Selection& selection, const ViewedScene* seen) {
  switch (in_preset(selection, &preset).kind) {
  case Kind::object: {
    const preset::Transform& transform = preset.scene.objects[selection.index].transform;
    GizmoTarget grip;
    grip.pivot = pivot_of(seen, preset, selection.index);
    grip.at = to_vector(transform.translate) + Affine(transform).linear * grip.pivot;
    grip.axes = scene::rotation(transform.rotate_deg);
    grip.turns = true;
    grip.scales = {true, true, true};
    return grip;
  }
  case Kind::light: {
    const preset::Light& light = preset.scene.lights[selection.index];
    return preset::has(light.type, LIGHT_HAS_OBJECT) ? std::nullopt : std::optional(light_grip(preset, light));
  }
  case Kind::camera: return GizmoTarget{.at = to_vector(preset.scene.camera.target)};
  case Kind::environment:
  case Kind::nothing: break;
  }
  return std::nullopt;
}

Handles::Tool usable_tool(const GizmoTarget& grip, Handles::Tool wanted) {
  const bool scales = std::ranges::any_of(grip.scales, [](bool b) { return b; });
  if ((wanted == Handles::Tool::turn && grip.turns) || (wanted == Handles::Tool::scale && scales)) return wanted;
  return grip.moves ? Handles::Tool::move : Handles::Tool::turn;
}

preset::Vec3 angles_of(const glm::dmat3& r, const preset::Vec3& near) {
  // r = Rz(c) Ry(b) Rx(a): its first column is (cos b cos c, cos b sin c, -sin b), its last row (-sin b, cos b sin a,
  // cos b cos a).
  const double cos_b = std::hypot(r[0][0], r[0][1]);
  std::array<glm::dvec3, 2> solutions;
  if (cos_b > 1e-9) {
    const double a = std::atan2(r[1][2], r[2][2]), b = std::atan2(-r[0][2], cos_b), c = std::atan2(r[0][1], r[0][0]);
    solutions = {glm::dvec3(a, b, c), glm::dvec3(a + std::numbers::pi, std::numbers::pi - b, c + std::numbers::pi)};
  } else {
    // The axes of a and c coincide: only a - c (b = 90 degrees) or a + c (b = -90) counts, and c stays as it was.
    const double sign = r[0][2] < 0 ? 1 : -1, c = near[2] * std::numbers::pi / 180;
    const double a = std::atan2(sign * r[1][0], r[1][1]) + sign * c;
    solutions.fill({a, sign * std::numbers::pi / 2, c});
  }
  preset::Vec3 best{};
  double least = -1;
  for (const glm::dvec3& radians : solutions) {
    preset::Vec3 angles{};
    double change = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      angles[i] = nearest_turn(radians[static_cast<int>(i)] * 180 / std::numbers::pi, near[i]);
      change += std::abs(angles[i] - near[i]);
      angles[i] = rounded(angles[i], 7);
    }
    if (least >= 0 && change >= least) continue;
    least = change;
    best = angles;
  }
  return best;
}

void move(preset::Preset& preset, const Selection& selection, const glm::dvec3& by, int decimals) {
  const double least = 0.5 * std::pow(10.0, -decimals);
  const auto shift = [&](preset::Vec3& place) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const double step = by[static_cast<int>(i)]; std::abs(step) >= least)
        place[i] = rounded(place[i] + step, decimals);
  };
  preset::Scene& scene = preset.scene;
  if (selection.kind == Kind::object) shift(scene.objects[selection.index].transform.translate);
  if (selection.kind == Kind::light) shift(scene.lights[selection.index].position);
  if (selection.kind == Kind::camera) shift(scene.camera.target);
}

void turn(preset::Preset& preset, const Selection& selection, const GizmoTarget& grip, const glm::dvec3& axis,
          double degrees) {
  if (degrees == 0) return;
  const glm::dmat3 rotation = about(axis, degrees);
  if (selection.kind == Kind::object) {
    preset::Transform& transform = preset.scene.objects[selection.index].transform;
    transform.rotate_deg = angles_of(rotation * scene::rotation(transform.rotate_deg), transform.rotate_deg);
    keep_pivot(transform, grip.pivot, grip.at);
  } else if (selection.kind == Kind::light) {
    preset::Light& light = preset.scene.lights[selection.index];
    light.direction = rounded_vector(rotation * to_vector(light.direction), 7);
    if (preset::is_framed(light)) light.up = rounded_vector(rotation * to_vector(light.up), 7);
  }
}

void stretch(preset::Preset& preset, const Selection& selection, const GizmoTarget& grip, const glm::dvec3& factors) {
  const auto multiply = [](double& value, double factor) {
    if (factor != 1) value = with_digits(value * factor, 4);
  };
  if (selection.kind == Kind::object) {
    preset::Transform& transform = preset.scene.objects[selection.index].transform;
    for (std::size_t i = 0; i < 3; ++i) multiply(transform.scale[i], factors[static_cast<int>(i)]);
    keep_pivot(transform, grip.pivot, grip.at);
  } else if (selection.kind == Kind::light) {
    preset::Light& light = preset.scene.lights[selection.index];
    for (std::size_t i = 0; i < 2; ++i) multiply(light.size[i], factors[static_cast<int>(i)]);
  }
}

double snap_step(double depth) {
  const double wanted = depth / 20, power = std::pow(10.0, std::floor(std::log10(wanted)));
  return (wanted >= 5 * power ? 5 : wanted >= 2 * power ? 2 : 1) * power;
}

int decimals_for(double depth) { return static_cast<int>(std::ceil(-std::log10(depth * 1e-4))); }

std::optional<preset::Preset> nudged(const preset::Preset& preset, const Selection& selection, const Handles& handles,
                                     const ViewedScene* seen, Nudge nudge) {
  const auto grip = grip_of(preset, selection, seen);
  const auto pinhole = make_pinhole(preset.scene.camera, {}, {1, 1});
  if (!grip || !pinhole) return std::nullopt;
  const bool forth = nudge == Nudge::right || nudge == Nudge::up || nudge == Nudge::away;
  const int direction = nudge == Nudge::left || nudge == Nudge::right ? 0
                        : nudge == Nudge::up || nudge == Nudge::down  ? 1
                                                                      : 2;
  const glm::dmat3 axes =
      sorted_axes(handles.own_axes ? grip->axes : glm::dmat3(1), {pinhole->right, pinhole->up, pinhole->forward});
  preset::Preset edited = preset;
  switch (usable_tool(*grip, handles.tool)) {
  case Handles::Tool::move: {
    const double depth = glm::length(grip->at - pinhole->position);
    if (!(depth > 0)) return std::nullopt;
    const double step = snap_step(depth) * (handles.snap ? 1 : 0.1);
    move(edited, selection, (forth ? step : -step) * axes[direction], decimals_for(depth));
    break;
  }
  case Handles::Tool::turn: {
    // Left and right turn about the axis that is up; up and down about the one to the right, so that the front goes up.
    // "away" turns clockwise.
    const double degrees = (handles.snap ? snap_deg : 1) * (forth == (direction != 1) ? 1 : -1);
    turn(edited, selection, *grip, direction == 2 ? axes[2] : axes[1 - direction], degrees);
    break;
  }
  case Handles::Tool::scale: {
    const double factor = 1 + (handles.snap ? snap_factor : 0.02);
    glm::dvec3 factors(1);
    for (int i = 0; i < 3; ++i)
      if (grip->scales[static_cast<std::size_t>(i)]) factors[i] = forth ? factor : 1 / factor;
    stretch(edited, selection, *grip, factors);
    break;
  }
  }
  if (!make_pinhole(edited.scene.camera, {}, {1, 1})) return std::nullopt;
  return edited;
}

std::optional<preset::Camera> looking_at(const preset::Preset& preset, const Selection& selection,
                                         const ViewedScene* seen) {
  const auto grip = grip_of(preset, selection, seen);
  if (!grip || !grip->moves || selection.kind == Kind::camera) return std::nullopt;
  preset::Camera camera = preset.scene.camera;
  camera.target = to_stored(grip->at);
  if (!make_pinhole(camera, {}, {1, 1})) return std::nullopt;
  return camera;
}

} // namespace nephroid::ui
