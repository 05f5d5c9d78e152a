// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/panel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::ui {
namespace {

constexpr double least_radius = 1.5,
                 radius_of_all = 14; ///< a disc's in pixels at scale 1; its area grows with the flux
constexpr double least_circle = 2.5; ///< a smaller disc is a square: thousands of circles are slow
constexpr int outline_points = 16;   ///< along a side of a region
constexpr ImU32 marked_colour = IM_COL32(255, 255, 255, 255);

/// 0..1.
double wrapped(double u) { return u - std::floor(u); }

void draw_disc(ImDrawList& list, const ImVec2& at, double radius, ImU32 fill) {
  const auto inner = static_cast<float>(radius * scale());
  const float outer = inner + std::max(1.0f, scale());
  for (const auto& [r, colour] : {std::pair{outer, colour::outline}, std::pair{inner, fill}})
    if (radius < least_circle)
      list.AddRectFilled(at - ImVec2(r, r), at + ImVec2(r, r), colour);
    else
      list.AddCircleFilled(at, r, colour);
}

} // namespace

const environment::Region& region_of(const environment::Segmentation& segmentation, std::size_t index) {
  const std::size_t lights = segmentation.lights.size();
  return index < lights ? segmentation.lights[index] : segmentation.dropped.at(index - lights);
}

MapDrag MapView::draw(const MapContents& contents, float most_height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const double free = std::max(16.0f, ImGui::GetContentRegionAvail().x), ratio = aspect(contents.layout);
  const double width = std::floor(std::min(free, most_height * ratio)), height = std::floor(width / ratio);
  area_ = {corner.x, corner.y, width, height};
  wanted_ = {contents.layout, static_cast<int>(width)};
  ImGui::InvisibleButton("map", {static_cast<float>(width), static_cast<float>(height)});
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  MapDrag drag;
  drag.taken = ImGui::IsItemActivated();
  if (drag.taken) taken_x_ = mouse.x;
  drag.moved = active && !drag.taken && ImGui::GetIO().MouseDelta.x != 0;
  drag.ended = ImGui::IsItemDeactivated();
  drag.across = (mouse.x - taken_x_) / width;
  hovered_ = hovered && !active ? region_at(contents, {mouse.x, mouse.y}) : std::nullopt;

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end = corner + vec({width, height});
  list.PushClipRect(corner, end, true);
  list.AddRectFilled(corner, end, colour::surround);
  draw_picture(contents);
  if (contents.shown.map) draw_front(contents);
  if (contents.shown.cut) draw_lights(contents);
  const std::optional<std::size_t> marked = hovered_ ? hovered_ : contents.marked;
  if (marked && contents.shown.cut && *marked < contents.figures.size())
    draw_outline(contents, region_of(contents.shown.cut->segmentation, *marked));
  list.PopClipRect();
  list.AddRect(corner - ImVec2(1, 1), end + ImVec2(1, 1), colour::frame);
  return drag;
}

void MapView::draw_picture(const MapContents& contents) {
  const std::shared_ptr<const MapPicture>& picture = contents.shown.picture;
  if (!picture || picture->size.layout != contents.layout) return;
  if (picture != in_texture_) {
    const std::span<unsigned char> bytes = texture_.edit(picture->size.width, picture->size.height());
    std::copy(picture->rgba.begin(), picture->rgba.end(), bytes.begin());
    in_texture_ = picture;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double left = area_[0], right = left + area_[2];
  const auto top = static_cast<float>(area_[1]), bottom = static_cast<float>(area_[1] + area_[3]);
  if (contents.layout == MapLayout::cube) {
    list.AddImage(texture_.ref(), {static_cast<float>(left), top}, {static_cast<float>(right), bottom});
    return;
  }
  // A map that is turned by r has at the picture's left edge what it has at r / 360 of its width.
  const double from = wrapped(contents.rotate_deg / 360), seam = right - from * area_[2];
  const auto u = static_cast<float>(from), x = static_cast<float>(seam);
  list.AddImage(texture_.ref(), {static_cast<float>(left), top}, {x, bottom}, {u, 0}, {1, 1});
  if (from > 0) list.AddImage(texture_.ref(), {x, top}, {static_cast<float>(right), bottom}, {0, 0}, {u, 1});
}

std::array<double, 2> MapView::to_screen(const MapContents& contents, const glm::dvec3& direction) const {
  glm::dvec2 at = place_of(contents.layout, direction);
  if (contents.layout == MapLayout::latitude_longitude) at.x = wrapped(at.x - contents.rotate_deg / 360);
  return {area_[0] + at.x * area_[2], area_[1] + at.y * area_[3]};
}

std::optional<std::size_t> MapView::region_at(const MapContents& contents, const std::array<double, 2>& mouse) const {
  if (!contents.shown.cut) return std::nullopt;
  glm::dvec2 at{(mouse[0] - area_[0]) / area_[2], (mouse[1] - area_[1]) / area_[3]};
  if (contents.layout == MapLayout::latitude_longitude) at.x = wrapped(at.x + contents.rotate_deg / 360);
  const auto point = cube_point(contents.layout, at);
  if (!point) return std::nullopt;
  const environment::CubeMap cube{contents.shown.cut->segmentation.cube_size, {}};
  const std::size_t texel =
      cube.texel(point->face, environment::texel_of(point->s, cube.size), environment::texel_of(point->t, cube.size));
  return static_cast<std::size_t>(contents.shown.cut->region_of_texel.at(texel));
}

/// The brightest first, so that small ones are seen on top. What is hidden of a light is missing from its disc's
/// colour.
void MapView::draw_lights(const MapContents& contents) const {
  const std::vector<environment::Region>& lights = contents.shown.cut->segmentation.lights;
  if (contents.figures.size() < lights.size()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::vector<std::size_t> order(lights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return contents.figures[a].share > contents.figures[b].share; });
  for (const std::size_t i : order) {
    const RegionFigures& figures = contents.figures[i];
    const double shown = 1 - figures.occluded.value_or(0);
    const auto channel = [&](std::size_t c) { return static_cast<int>(std::lround(shown * figures.colour.at(c))); };
    draw_disc(list, vec(to_screen(contents, lights[i].direction)),
              least_radius + radius_of_all * std::sqrt(figures.share),
              IM_COL32(channel(0), channel(1), channel(2), 255));
  }
}

/// Where the direction -z of the scene is: a cross, and the word.
void MapView::draw_front(const MapContents& contents) const {
  const ImVec2 at = vec(to_screen(contents, environment::turned({0, 0, -1}, -contents.rotate_deg)));
  const float arm = 7 * scale();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const auto& [colour, width] : {std::pair{colour::outline, 3.0f}, std::pair{colour::on_dark, 1.0f}}) {
    list.AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, colour, width * scale());
    list.AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, colour, width * scale());
  }
  const char* const word = "front";
  const ImVec2 extent = ImGui::CalcTextSize(word);
  const ImVec2 text{at.x - extent.x / 2, at.y + arm + 2 * scale()};
  list.AddText(text + ImVec2(scale(), scale()), colour::outline, word);
  list.AddText(text, colour::on_dark, word);
}

void MapView::draw_outline(const MapContents& contents, const environment::Region& region) const {
  const int size = contents.shown.cut->segmentation.cube_size;
  // A little inside of the face, whose edges belong to its neighbours too.
  const auto line = [&](int i) { return 0.9999 * environment::border(i, size); };
  const double s0 = line(region.rect.x0), s1 = line(region.rect.x1), t0 = line(region.rect.y0),
               t1 = line(region.rect.y1);
  const std::array<glm::dvec2, 5> corners{{{s0, t0}, {s1, t0}, {s1, t1}, {s0, t1}, {s0, t0}}};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const auto& [colour, width] : {std::pair{colour::outline, 4.0f}, std::pair{marked_colour, 2.0f}})
    for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
      ImVec2 from{};
      for (int i = 0; i <= outline_points; ++i) {
        const glm::dvec2 at = glm::mix(corners[side], corners[side + 1], static_cast<double>(i) / outline_points);
        const ImVec2 to = vec(to_screen(contents, environment::position({region.face, at.x, at.y})));
        const bool over_the_edge = std::abs(to.x - from.x) > 0.5 * area_[2]; // where the map goes on at the other side
        if (i > 0 && !over_the_edge) list.AddLine(from, to, colour, width * scale());
        from = to;
      }
    }
}

} // namespace nephroid::ui
