// SPDX-License-Identifier: Apache-2.0
#include "ui/view/scene_overlay.h"

#include "scene/scene.h"
#include "ui/widgets/theme.h"

#include <imgui.h>

#include <cmath>

namespace nephroid::ui {
namespace {

using LightType = preset::Light::Type;

constexpr ImU32 lamp = IM_COL32(255, 214, 102, 255), marked = IM_COL32(255, 150, 50, 255);
constexpr float icon_radius = 6, grab_radius = 10; ///< pixels at scale 1

/// A line of the scene, as far as it is before the camera. Dark below, so that it is seen on any colour.
void draw_line(const Sight& sight, glm::dvec3 a, glm::dvec3 b, ImU32 colour)
{
  const double from = sight.depth(a), to = sight.depth(b), nearest = 1e-3 * std::max(std::abs(from), std::abs(to));
  if (!(std::max(from, to) > nearest)) return;
  if (from < nearest) a += (nearest - from) / (to - from) * (b - a);
  if (to < nearest) b += (nearest - to) / (from - to) * (a - b);
  const auto start = sight.to_screen(a), end = sight.to_screen(b);
  if (!start || !end) return;
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddLine(vec(*start), vec(*end), colour::outline, 3 * scale());
  draw_list->AddLine(vec(*start), vec(*end), colour, 1.4f * scale());
}

/// The edges of a parallelepiped from its middle by three half edges.
void draw_box(const Sight& sight, const glm::dvec3& middle, const glm::dmat3& half, ImU32 colour)
{
  const auto corner = [&](unsigned bits) {
    glm::dvec3 p = middle;
    for (int axis = 0; axis < 3; ++axis) p += (bits >> axis & 1 ? 1.0 : -1.0) * half[axis];
    return p;
  };
  for (unsigned bits = 0; bits < 8; ++bits)
    for (unsigned axis = 0; axis < 3; ++axis)
      if (!(bits >> axis & 1)) draw_line(sight, corner(bits), corner(bits | 1U << axis), colour);
}

void draw_object_box(const Context& context, const Sight& sight, std::size_t index)
{
  const auto box = local_box(context.run.seen<SeenScene>().get(), *context.preset(), index);
  if (!box) return;
  const preset::Transform& transform = context.preset()->scene.objects[index].transform;
  const glm::dmat3 turn = scene::rotation(transform.rotate_deg);
  const glm::dvec3 factors = to_vector(transform.scale), half = 0.5 * (box->high - box->low) * factors;
  const glm::dvec3 middle = turn * (0.5 * (box->high + box->low) * factors) + to_vector(transform.translate);
  draw_box(sight, middle, {half.x * turn[0], half.y * turn[1], half.z * turn[2]}, marked);
}

/// An area light's rectangle; the way that the light of the others goes; a disc where it is.
void draw_light(const Context& context, const Sight& sight, std::size_t index, bool selected)
{
  const preset::Preset& preset = *context.preset();
  const preset::Light& light = preset.scene.lights[index];
  const Grip grip = *grip_of(preset, {Selection::Kind::light, index}, nullptr);
  const auto at = sight.to_screen(grip.at);
  if (!at) return;
  const ImU32 colour = selected ? marked : lamp;
  const double em = 2 * sight.depth(grip.at) * sight.tan_x / sight.size[0] * ImGui::GetFontSize();
  if (light.type == LightType::area)
    draw_box(sight, grip.at, {0.5 * light.size[0] * grip.axes[0], 0.5 * light.size[1] * grip.axes[1], glm::dvec3(0)}, colour);
  if (light.type != LightType::point) draw_line(sight, grip.at, grip.at + 2.5 * em * grip.axes[2], colour);
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  const float radius = icon_radius * scale();
  draw_list->AddCircleFilled(vec(*at), radius + 2 * scale(), colour::outline);
  draw_list->AddCircleFilled(vec(*at), radius, colour);
  draw_list->AddCircleFilled(vec(*at), 0.4f * radius, colour::outline);
}

} // namespace

std::optional<Point> SceneOverlay::icon(const Context& context, std::size_t light) const
{
  const auto grip = sight_ ? grip_of(*context.preset(), {Selection::Kind::light, light}, nullptr) : std::nullopt;
  return grip ? sight_->to_screen(grip->at) : std::nullopt;
}

void SceneOverlay::draw(const Context& context, const Canvas& canvas, const std::array<int, 2>& picture, bool hovered)
{
  const preset::Preset* preset = context.preset();
  sight_.reset();
  if (preset && has_scene(*preset)) sight_ = make_sight(preset->scene.camera, place(context.chosen.look, canvas, picture), picture);
  const Selection selection = context.selection();
  const bool other_picture = context.comparing.comparison().flip; // nothing over that: one looks at it to compare
  if (sight_ && context.chosen.handles.shown && !other_picture) {
    if (selection.kind == Selection::Kind::object) draw_object_box(context, *sight_, selection.index);
    for (std::size_t i = 0; i < preset->scene.lights.size(); ++i)
      draw_light(context, *sight_, i, selection == Selection{Selection::Kind::light, i});
  }
  if (sight_ && !other_picture)
    gizmo_.draw(context, *sight_, canvas, hovered);
  else
    gizmo_.rest(context);
}

void SceneOverlay::click(const Context& context, const Point& at) const
{
  if (!sight_ || !context.chosen.handles.shown) return;
  Selection selection;
  double nearest = grab_radius * scale();
  for (std::size_t i = 0; i < context.preset()->scene.lights.size(); ++i) {
    const auto place = icon(context, i);
    const double distance = place ? std::hypot((*place)[0] - at[0], (*place)[1] - at[1]) : nearest;
    if (distance >= nearest) continue;
    nearest = distance;
    selection = {Selection::Kind::light, i};
  }
  if (selection.kind == Selection::Kind::nothing) {
    const auto seen = context.run.seen<SeenScene>();
    if (!seen) return; // no run of the preset was ready yet: nobody knows what is there
    const Ray ray = sight_->ray(at);
    const bool inside = at[0] >= sight_->corner[0] && at[1] >= sight_->corner[1] && at[0] < sight_->corner[0] + sight_->size[0] &&
                        at[1] < sight_->corner[1] + sight_->size[1];
    if (const auto object = inside ? object_at(*seen, *context.preset(), ray) : std::nullopt)
      selection = {Selection::Kind::object, *object};
  }
  if (selection != context.selection()) context.push(command::Select{selection});
}

} // namespace nephroid::ui
