// SPDX-License-Identifier: Apache-2.0
#include "ui/inverse/annealing/pictures.h"

#include "inverse/bending.h"
#include "ui/state/tone.h"
#include "ui/widgets/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::ui {
namespace {

constexpr double cells_about_a_beam = 9; ///< at least so many across

/// 0 becomes middle grey; linear values are shown with the display's curve, as a person compares them.
std::vector<float> as_colours(const job::Picture& picture) {
  float most = 1e-9f;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    if (i % 3 < 2) most = std::max(most, std::abs(picture.rgb[i]));
  std::vector<float> colours = picture.rgb;
  for (std::size_t i = 0; i < colours.size(); i += 3) {
    colours[i] = 0.2f + 0.2f * colours[i] / most;
    colours[i + 1] = 0.2f + 0.2f * colours[i + 1] / most;
    colours[i + 2] = 0.2f;
  }
  return colours;
}

ImU32 beam_colour(double alpha) {
  return with_alpha(IM_COL32(255, 176, 32, 255), static_cast<float>(std::clamp(alpha, 0.0, 1.0)));
}

} // namespace

void RunPictures::follow(const std::shared_ptr<const job::Snapshot>& snapshot) {
  snapshot_ = snapshot;
  std::erase_if(shown_, [&](const auto& shown) { return !find(shown.first); });
}

const job::Picture* RunPictures::find(const std::string& name) const {
  if (!snapshot_) return nullptr;
  for (const job::NamedPicture& named : snapshot_->pictures)
    if (named.name == name) return named.picture.get();
  return nullptr;
}

void RunPictures::draw(const std::string& name, const ImVec2& low, const ImVec2& high, bool signed_values) {
  const job::Picture* picture = find(name);
  if (!picture) return;
  Shown& shown = shown_[name];
  if (shown.picture.get() != picture) {
    const std::span<unsigned char> bytes = shown.texture.edit(picture->width, picture->height);
    toned_pixels(signed_values ? as_colours(*picture) : picture->rgb, {}, bytes);
    shown.picture = {snapshot_, picture};
  }
  shown.texture.draw(low, high, high.x - low.x >= static_cast<float>(picture->width));
}

std::optional<FacetBeam> facet_beam(const job::Picture& slopes, const inverse::Layout& layout,
                                    const glm::ivec2& facet) {
  if (slopes.width != layout.facets.x || slopes.height != layout.facets.y) return std::nullopt;
  if (facet.x < 0 || facet.y < 0 || facet.x >= layout.facets.x || facet.y >= layout.facets.y) return std::nullopt;
  const std::size_t index = inverse::index_at(facet.x, facet.y, layout.facets.x);
  const glm::dvec2 slope{slopes.rgb[3 * index], slopes.rgb[3 * index + 1]};
  const double height = slopes.rgb[3 * index + 2];
  FacetBeam beam{facet, slope, height, inverse::facet_power(layout, index, slope), {}};
  for (std::size_t j = 0; j < layout.distances.size(); ++j)
    beam.prints.push_back(inverse::footprint(layout, index, slope, j, height));
  return beam;
}

std::optional<BeamBox> box_of(const inverse::Footprint& print) {
  if (print.cells.empty()) return std::nullopt;
  return BeamBox{{print.x0, print.y0}, {print.x0 + print.columns, print.y0 + print.rows}};
}

std::vector<std::vector<preset::Vec3>> lines_of(const FacetBeam& beam, const inverse::Layout& layout) {
  const std::size_t facet = inverse::index_at(beam.facet.x, beam.facet.y, layout.facets.x);
  const glm::dvec2 at = layout.middle(facet), inside = inverse::slope_inside(layout.sines_on(facet), layout.n);
  // Light comes from the front, or to a mirror from below.
  const double from_z = layout.is_mirror() ? -layout.distances.front() / 2 : layout.thickness;
  const glm::dvec2 from = at - inside * (from_z - beam.height),
                   end = at + beam.slope * (layout.distances.back() + beam.height);
  std::vector<std::vector<preset::Vec3>> lines{
      {{from.x, from.y, from_z}, {at.x, at.y, beam.height}, {end.x, end.y, -layout.distances.back()}}};
  for (std::size_t j = 0; j < beam.prints.size(); ++j) {
    const auto box = box_of(beam.prints[j]);
    if (!box) continue;
    const auto corner = [&](double x, double y) {
      const glm::dvec2 p = glm::dvec2(x, -y) * layout.cell() + layout.offset(j) +
                           glm::dvec2(-layout.receiver.x, layout.receiver.y) / 2.0;
      return preset::Vec3{p.x, p.y, -layout.distances[j]};
    };
    const glm::dvec2 &low = box->low, &high = box->high;
    lines.push_back({corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y),
                     corner(low.x, low.y)});
  }
  return lines;
}

double part_on(const inverse::Footprint& print) { return std::accumulate(print.cells.begin(), print.cells.end(), 0.0); }

void draw_beam_frame(const inverse::Footprint& print, const glm::ivec2& cells, const ImVec2& low, const ImVec2& high) {
  const auto box = box_of(print);
  if (!box) return;
  const double sx = (high.x - low.x) / cells.x, sy = (high.y - low.y) / cells.y, least = 5 * scale();
  const glm::dvec2 middle = (box->low + box->high) / 2.0, half = (box->high - box->low) / 2.0;
  const double x = low.x + middle.x * sx, y = low.y + middle.y * sy, w = std::max(half.x * sx + 1, least),
               h = std::max(half.y * sy + 1, least);
  const ImVec2 from{static_cast<float>(x - w), static_cast<float>(y - h)},
      to{static_cast<float>(x + w), static_cast<float>(y + h)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, high, true);
  list.AddRect({from.x - 1, from.y - 1}, {to.x + 1, to.y + 1}, colour::outline, 0, 3 * scale());
  list.AddRect(from, to, beam_colour(1), 0, 1.5f * scale());
  list.PopClipRect();
}

void draw_beam_cells(const inverse::Footprint& print, const job::Picture& picture, const ImVec2& low,
                     const ImVec2& high) {
  const auto box = box_of(print);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, colour::surround);
  if (!box) return;
  list.PushClipRect(low, high, true);
  const glm::dvec2 middle = (box->low + box->high) / 2.0, extent = box->high - box->low;
  const double across = std::max(cells_about_a_beam, std::max(extent.x, extent.y) + 4),
               size = (high.x - low.x) / across;
  const double left = middle.x - across / 2, top = middle.y - (high.y - low.y) / size / 2;
  const double most = *std::max_element(print.cells.begin(), print.cells.end());
  const auto corner = [&](int x, int y) {
    return ImVec2(low.x + static_cast<float>((x - left) * size), low.y + static_cast<float>((y - top) * size));
  };
  const int first_x = std::max(0, static_cast<int>(std::floor(left))),
            first_y = std::max(0, static_cast<int>(std::floor(top)));
  for (int y = first_y; y < picture.height && corner(0, y).y < high.y; ++y)
    for (int x = first_x; x < picture.width && corner(x, y).x < high.x; ++x) {
      const std::size_t index = inverse::index_at(x, y, picture.width);
      const unsigned char grey = image::shown(picture.rgb[3 * index]);
      list.AddRectFilled(corner(x, y), corner(x + 1, y + 1), IM_COL32(grey, grey, grey, 255));
      const int i = x - print.x0, k = y - print.y0;
      if (i < 0 || k < 0 || i >= print.columns || k >= print.rows) continue;
      const double part = print.cells[inverse::index_at(i, k, print.columns)];
      list.AddRectFilled(corner(x, y), corner(x + 1, y + 1), beam_colour(0.85 * part / most));
    }
  list.PopClipRect();
}

} // namespace nephroid::ui
