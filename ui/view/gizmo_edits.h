// SPDX-License-Identifier: Apache-2.0
// What moving, turning and scaling what is selected does to a preset. Pure functions: no mouse, no Dear ImGui.
#pragma once
#include "preset/preset.h"
#include "ui/state/selection.h"
#include "ui/view/pinhole.h"

#include <glm/glm.hpp>

namespace nephroid::ui {

/// Where what is selected can be taken hold of, in the preset's coordinates, and what can be done with it.
struct GizmoTarget {
  glm::dvec3 at{0};
  glm::dmat3 axes{1}; ///< its own axes as columns, a rotation
  bool moves = true, turns = false;
  std::array<bool, 3> scales{}; ///< along which of its own axes
  glm::dvec3 pivot{0};          ///< of an object: pivot_of
};
/// Nothing where nothing is selected. seen: may be null.
std::optional<GizmoTarget> grip_of(const preset::Preset& preset, const Selection& selection, const ViewedScene* seen);
/// The tool that is asked for where the grip allows it; else the first that it allows. A point light is moved only.
Handles::Tool usable_tool(const GizmoTarget& grip, Handles::Tool wanted);

/// The angles of preset::Transform that are this rotation, those nearest to `near` of all that are: scene::rotation of
/// them gives it again.
preset::Vec3 angles_of(const glm::dmat3& rotation, const preset::Vec3& near);

/// Each changes what is selected of the preset, of which `grip` is. by: what is moved goes to a place with so many
/// decimals along every axis that it moved along; negative: whole tens, hundreds.
void move(preset::Preset& preset, const Selection& selection, const glm::dvec3& by, int decimals);
/// Counter-clockwise about a unit axis through the grip.
void turn(preset::Preset& preset, const Selection& selection, const GizmoTarget& grip, const glm::dvec3& axis,
          double degrees);
/// Multiplies its extent along its own axes.
void stretch(preset::Preset& preset, const Selection& selection, const GizmoTarget& grip, const glm::dvec3& factors);

/// Lengths for a thing so far in front of the camera: a step of the snapping, 1, 2 or 5 times a power of ten, about a
/// twentieth of the distance; and decimals that are well below a pixel.
double snap_step(double depth);
int decimals_for(double depth);
inline constexpr double snap_deg = 15, snap_factor = 0.1;

/// What an arrow key does: along the axis (of the scene or its own) that is nearest to that direction of the picture, a
/// tenth of a step or, snapping, a whole one; a degree, or 15; 2 percent, or 10.
enum class Nudge { left, right, up, down, away, nearer };
/// Nothing where nothing is selected, or the camera sees nothing.
std::optional<preset::Preset> nudged(const preset::Preset& preset, const Selection& selection, const Handles& handles,
                                     const ViewedScene* seen, Nudge nudge);

/// The camera with what is selected as its target; nothing where that is not a place, or the camera could not look
/// there.
std::optional<preset::Camera> looking_at(const preset::Preset& preset, const Selection& selection,
                                         const ViewedScene* seen);

} // namespace nephroid::ui
