// SPDX-License-Identifier: Apache-2.0
// How moving, turning and scaling the selection change a preset. Pure functions: no mouse, no Dear ImGui.
#pragma once
#include "preset/preset.h"
#include "ui/view/pinhole.h"

#include <glm/glm.hpp>

namespace nephroid::ui {

/// Where the selection can be grabbed, in the preset's coordinates, and what can be done with it.
struct GizmoTarget {
  glm::dvec3 at{0};
  glm::dmat3 axes{1}; ///< the selection's own axes as columns, a rotation
  bool moves = true, turns = false;
  std::array<bool, 3> scales{}; ///< whether it can be scaled along each of its own axes
  glm::dvec3 pivot{0};          ///< an object's pivot_of
};
/// Nothing where nothing is selected. seen: may be null.
std::optional<GizmoTarget> grip_of(const preset::Preset& preset, const Selection& selection, const ViewedScene* seen);
/// The wanted tool where the grip allows it, else the first that it allows. A point light can only be moved.
Handles::Tool usable_tool(const GizmoTarget& grip, Handles::Tool wanted);

/// The angles of preset::Transform for a rotation, the nearest to `near` of all possible ones: scene::rotation of them
/// gives the rotation again.
preset::Vec3 angles_of(const glm::dmat3& rotation, const preset::Vec3& near);

/// The new place has so many decimals along every axis that it moved along; negative: whole tens, hundreds.
void move(preset::Preset& preset, const Selection& selection, const glm::dvec3& by, int decimals);
/// Turns counter-clockwise about a unit axis through the grip, which is the selection's.
void turn(preset::Preset& preset, const Selection& selection, const GizmoTarget& grip, const glm::dvec3& axis,
          double degrees);
/// Scales along the selection's own axes.
void stretch(preset::Preset& preset, const Selection& selection, const GizmoTarget& grip, const glm::dvec3& factors);

/// Lengths for a thing at this distance in front of the camera: a snapping step of 1, 2 or 5 times a power of ten,
/// about a twentieth of the distance; and decimals well below a pixel.
double snap_step(double depth);
int decimals_for(double depth);
inline constexpr double snap_deg = 15, snap_factor = 0.1;

/// The effect of an arrow key, along the axis (the scene's or the selection's) that is nearest to that direction of the
/// picture: a tenth of a step or, snapping, a whole one; 1 degree, or 15; 2 percent, or 10.
enum class Nudge { left, right, up, down, away, nearer };
/// Nothing where nothing is selected, or the camera sees nothing.
std::optional<preset::Preset> nudged(const preset::Preset& preset, const Selection& selection, const Handles& handles,
                                     const ViewedScene* seen, Nudge nudge);

/// The camera with the selection as its target; nothing where that has no place, or the camera cannot be turned there.
std::optional<preset::Camera> looking_at(const preset::Preset& preset, const Selection& selection,
                                         const ViewedScene* seen);

} // namespace nephroid::ui
