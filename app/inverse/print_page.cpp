// SPDX-License-Identifier: Apache-2.0
#include "inverse/print_page.h"

#include "base/base64.h"
#include "image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

constexpr double margin = 12, text_line = 6; // mm
constexpr double lines_above = 4;            // lines of text above what is shown
constexpr const char *solid_line = "stroke=\"black\" stroke-width=\"0.2\"",
                     *dashed_line = "stroke=\"red\" stroke-width=\"0.2\" stroke-dasharray=\"2 2\"";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return safe;
}

std::string outline(const glm::dvec2& middle, const glm::dvec2& size, const char* style) {
  return fmt::format("<rect x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" fill=\"none\" {}/>\n",
                     middle.x - size.x / 2, middle.y - size.y / 2, size.x, size.y, style);
}

std::string object_outline(const Layout& layout, const glm::dvec2& middle, const char* style) {
  if (!layout.round) return outline(middle, layout.size, style);
  return fmt::format("<ellipse cx=\"{:.6g}\" cy=\"{:.6g}\" rx=\"{:.6g}\" ry=\"{:.6g}\" fill=\"none\" {}/>\n", middle.x,
                     middle.y, layout.size.x / 2, layout.size.y / 2, style);
}

std::string text(double x, double y, const std::string& words) {
  return fmt::format("<text x=\"{:.6g}\" y=\"{:.6g}\">{}</text>\n", x, y, escaped(words));
}

/// A cross in the middle, and an arrow at the upper edge.
std::string marks(const glm::dvec2& middle, const glm::dvec2& size, const char* style) {
  const double top = middle.y - size.y / 2;
  return fmt::format(
      "<path d=\"M{0:.6g} {1:.6g}h6m-3 -3v6\" fill=\"none\" {2}/>\n<path d=\"M{3:.6g} {4:.6g}l-2 3h4z\"/>\n",
      middle.x - 3, middle.y, style, middle.x, top + 0.5);
}

/// The smallest sheet from A4 on, upright or across, that holds this below lines of text; beyond A0, one of its own.
glm::dvec2 sheet_for(const glm::dvec2& content) {
  const glm::dvec2 needed = glm::max(content + glm::dvec2(0, lines_above * text_line), glm::dvec2(115, 0)) + 2 * margin;
  for (const glm::dvec2& iso : {glm::dvec2(210, 297), {297, 420}, {420, 594}, {594, 841}, {841, 1189}})
    for (const glm::dvec2& sheet : {iso, glm::dvec2(iso.y, iso.x)})
      if (needed.x <= sheet.x && needed.y <= sheet.y) return sheet;
  return needed;
}

glm::dvec2 middle_of(const glm::dvec2& content) {
  return {sheet_for(content).x / 2, margin + lines_above * text_line + content.y / 2};
}

/// A page's begin: the line that shows whether it was printed in real size, and two lines of text.
std::string begun(const glm::dvec2& content, const std::string& name, const std::string& first,
                  const std::string& second) {
  const glm::dvec2 sheet = sheet_for(content);
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6g}mm\" height=\"{1:.6g}mm\" "
                     "viewBox=\"0 0 {0:.6g} {1:.6g}\" font-family=\"sans-serif\" font-size=\"3.5\" stroke=\"none\">\n"
                     "<rect width=\"{0:.6g}\" height=\"{1:.6g}\" fill=\"white\"/>\n",
                     sheet.x, sheet.y) +
         text(margin, margin, fmt::format("{}: print at 100 %, then this line is 50 mm long:", name)) +
         fmt::format("<path d=\"M{:.6g} {:.6g}h50m0 -1.5v3m-50 0v-3\" fill=\"none\" {}/>\n", margin, margin + 3,
                     solid_line) +
         text(margin, margin + 2 * text_line, first) + text(margin, margin + 3 * text_line, second);
}

} // namespace

std::string object_page(const Layout& layout, const std::string& name) {
  const glm::dvec2 middle = middle_of(layout.size);
  return begun(layout.size, name,
               fmt::format("The object, {:.6g} x {:.6g} mm, seen along the light{}:", layout.size.x, layout.size.y,
                           layout.is_mirror() ? " that it sends" : ""),
               layout.is_mirror() ? "its flat back is on your side, the mirror on the other; the arrow is up."
                                  : "its flat front, where light enters, is on your side; the arrow is up.") +
         object_outline(layout, middle, solid_line) + marks(middle, layout.size, solid_line) + "</svg>\n";
}

std::string receiver_page(const Layout& layout, std::size_t receiver, const job::Picture& cast,
                          const std::string& name) {
  const glm::dvec2 content = glm::max(layout.size, layout.receiver), middle = middle_of(content),
                   corner = middle - layout.receiver / 2.0, offset = layout.offset(receiver);
  return begun(content, name,
               fmt::format("Receiver {}: {:.6g} x {:.6g} mm, {:.6g} mm from the facets, seen along the light",
                           receiver + 1, layout.receiver.x, layout.receiver.y, layout.distances[receiver]),
               offset == glm::dvec2(0) ? "(red: the object)"
                                       : fmt::format("its middle: {:.6g} mm {} and {:.6g} mm {} that of the object",
                                                     std::abs(offset.x), offset.x < 0 ? "to the left" : "to the right",
                                                     std::abs(offset.y), offset.y < 0 ? "below" : "above")) +
         fmt::format("<image x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" preserveAspectRatio=\"none\" "
                     "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n",
                     corner.x, corner.y, layout.receiver.x, layout.receiver.y,
                     base64(image::png(cast.width, cast.height, cast.rgb))) +
         outline(middle, layout.receiver, solid_line) +
         (offset == glm::dvec2(0) ? object_outline(layout, middle, dashed_line) : "") + "</svg>\n";
}

std::string plate_page(const glm::dvec2& plate, const std::vector<PlatePart>& bodies) {
  const glm::dvec2 middle = middle_of(plate);
  std::string page =
      begun(plate, "The plate", fmt::format("{:.6g} x {:.6g} mm, seen along the light:", plate.x, plate.y),
            "the flat fronts are on your side; the arrows are up.") +
      outline(middle, plate, dashed_line);
  for (const PlatePart& body : bodies) {
    const glm::dvec2 at = middle + glm::dvec2(body.middle.x, -body.middle.y);
    page += outline(at, body.size, solid_line) + marks(at, body.size, solid_line) +
            text(at.x - body.size.x / 2 + 1, at.y + body.size.y / 2 - 1.5, body.name);
  }
  return page + "</svg>\n";
}

} // namespace nephroid::inverse
