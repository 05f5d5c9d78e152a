// SPDX-License-Identifier: Apache-2.0
#include "inverse/print_page.h"

#include "base/base64.h"
#include "image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::inverse {
namespace {

constexpr double margin = 12, text_line = 6; // mm

std::string escaped(const std::string& text)
{
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return safe;
}

/// About a middle.
std::string outline(const glm::dvec2& middle, const glm::dvec2& size, const char* style)
{
  return fmt::format("<rect x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" fill=\"none\" {}/>\n", middle.x - size.x / 2,
                     middle.y - size.y / 2, size.x, size.y, style);
}

std::string object_outline(const Layout& layout, const glm::dvec2& middle, const char* style)
{
  if (!layout.round) return outline(middle, layout.size, style);
  return fmt::format("<ellipse cx=\"{:.6g}\" cy=\"{:.6g}\" rx=\"{:.6g}\" ry=\"{:.6g}\" fill=\"none\" {}/>\n", middle.x, middle.y,
                     layout.size.x / 2, layout.size.y / 2, style);
}

std::string text(double x, double y, const std::string& words)
{
  return fmt::format("<text x=\"{:.6g}\" y=\"{:.6g}\">{}</text>\n", x, y, escaped(words));
}

/// A cross in the middle, and an arrow at the upper edge.
std::string marks(const glm::dvec2& middle, const glm::dvec2& size, const char* style)
{
  const double top = middle.y - size.y / 2;
  return fmt::format("<path d=\"M{0:.6g} {1:.6g}h6m-3 -3v6\" fill=\"none\" {2}/>\n<path d=\"M{3:.6g} {4:.6g}l-2 3h4z\"/>\n", middle.x - 3,
                     middle.y, style, middle.x, top + 0.5);
}

} // namespace

std::string print_page(const Layout& layout, const std::vector<std::shared_ptr<const job::Picture>>& cast, const std::string& name)
{
  constexpr const char *solid = "stroke=\"black\" stroke-width=\"0.2\"",
                       *dashed = "stroke=\"red\" stroke-width=\"0.2\" stroke-dasharray=\"2 2\"";
  const glm::dvec2 most = glm::max(layout.size, layout.receiver);
  const double block = most.y + 3 * text_line, width = std::max(most.x, 115.0) + 2 * margin,
               height = layout.size.y + 5 * text_line + static_cast<double>(cast.size()) * block + 2 * margin;
  std::string page = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6g}mm\" height=\"{1:.6g}mm\" "
                                 "viewBox=\"0 0 {0:.6g} {1:.6g}\" font-family=\"sans-serif\" font-size=\"3.5\" stroke=\"none\">\n"
                                 "<rect width=\"{0:.6g}\" height=\"{1:.6g}\" fill=\"white\"/>\n",
                                 width, height);
  double y = margin;
  page += text(margin, y, fmt::format("{}: print at 100 %, then this line is 50 mm long:", name));
  page += fmt::format("<path d=\"M{:.6g} {:.6g}h50m0 -1.5v3m-50 0v-3\" fill=\"none\" {}/>\n", margin, y + 3, solid);
  y += 2 * text_line;
  page += text(margin, y, fmt::format("The object, {:.6g} x {:.6g} mm, seen along the light:", layout.size.x, layout.size.y));
  page += text(margin, y + text_line, "its flat front, where light enters, is on your side; the arrow is up.");
  y += 2 * text_line + layout.size.y / 2;
  const glm::dvec2 object(width / 2, y);
  page += object_outline(layout, object, solid) + marks(object, layout.size, solid);
  y += layout.size.y / 2 + text_line;
  for (std::size_t j = 0; j < cast.size(); ++j, y += block) {
    page += text(margin, y + text_line,
                 fmt::format("Receiver {}: {:.6g} x {:.6g} mm, {:.6g} mm from the facets (red: the object)", j + 1, layout.receiver.x,
                             layout.receiver.y, layout.distances[j]));
    const glm::dvec2 middle(width / 2, y + 2 * text_line + most.y / 2), corner = middle - layout.receiver / 2.0;
    page += fmt::format("<image x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" preserveAspectRatio=\"none\" "
                        "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n",
                        corner.x, corner.y, layout.receiver.x, layout.receiver.y,
                        base64(image::png(cast[j]->width, cast[j]->height, cast[j]->rgb)));
    page += outline(middle, layout.receiver, solid) + object_outline(layout, middle, dashed);
  }
  return page + "</svg>\n";
}

} // namespace nephroid::inverse
