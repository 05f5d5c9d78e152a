// SPDX-License-Identifier: Apache-2.0
#include "inverse/lens/forecast.h"

#include "inverse/lens/lens.h"
#include "inverse/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

/// As large as its cells are to its facets, so that it comes as close to its picture.
Layout coarse(Layout layout) {
  constexpr int most_facets = 128, most_cells = 64; // a side
  const int times = std::max({1, (std::max(layout.facets.x, layout.facets.y) + most_facets - 1) / most_facets,
                              (std::max(layout.cells.x, layout.cells.y) + most_cells - 1) / most_cells});
  layout.facets = glm::max(layout.facets / times, 2);
  layout.cells = glm::max(layout.cells / times, 2);
  layout.steepest = std::numeric_limits<double>::infinity();
  layout.light.facets = light_on_facets(layout);
  return layout;
}

double steepest_deg(const Layout& layout, const Surface& surface) {
  double steepest = 0;
  for (int row = 0; row <= layout.facets.y; ++row)
    for (int column = 0; column <= layout.facets.x; ++column)
      if (const glm::dvec2 p = layout.corner(column, row); !layout.is_beside(p))
        steepest = std::max(steepest, glm::length(surface.at(p).gradient));
  return glm::degrees(std::atan(steepest));
}

} // namespace

LensForecast forecast(const Layout& layout, const Target& target, std::optional<double> mesh_error) {
  const Layout reduced = coarse(layout);
  Target wanted(reduced.cell_count());
  for (std::size_t c = 0; c < target.size(); ++c) wanted[*reduced.cell_at(layout.middle_of_cell(c))] += target[c];
  Lens lens(reduced, wanted, mesh_error, {}); // its mesh is not made
  while (!lens.finished() && lens.steps() < lens.most()) lens.advance();
  return {lens.relief(), steepest_deg(reduced, lens.surface()), lens.mesh_error(),
          count_triangles(layout, mesh_parts(layout, lens.surface(), lens.mesh_error()))};
}

std::vector<std::string> forecast_notes(const Settings& settings, const LensForecast& lens) {
  constexpr double deep = 0.5;   // of the thickness
  constexpr double unsure = 0.9; // the forecast is right within a tenth
  const double thickness = settings.stock_mm ? *settings.stock_mm - lens.relief_mm / 2 : settings.thickness_mm,
               thinnest = thickness - lens.relief_mm / 2;
  const std::string depth = fmt::format("the lens becomes some {:.2g} mm deep, and ", lens.relief_mm);
  const char* const remedy =
      "; the run is refused once the lens is found to miss it; choose a receiver further away, a brighter 'background'";
  const char* const thicker = settings.stock_mm ? "stock_mm" : "thickness_mm";
  std::vector<std::string> notes;
  if (settings.max_relief_mm && lens.relief_mm > unsure * *settings.max_relief_mm)
    notes.push_back(
        fmt::format("{}'max_relief_mm' is {}{} or a larger max_relief_mm", depth, *settings.max_relief_mm, remedy));
  if (settings.min_thickness_mm && lens.relief_mm / 2 > unsure * (thickness - *settings.min_thickness_mm))
    notes.push_back(fmt::format("{}{:.2g} mm are left at its thinnest, where 'min_thickness_mm' is {}{} or a larger {}",
                                depth, std::max(0.0, thinnest), *settings.min_thickness_mm, remedy, thicker));
  else if (lens.relief_mm > deep * thickness)
    notes.push_back(
        fmt::format("{}the {} {:.4g} mm thick: {:.2g} mm are left at its thinnest; choose a receiver further away, a "
                    "brighter 'background' or a larger {}",
                    depth, settings.stock_mm ? "sheet is" : "object is", settings.stock_mm.value_or(thickness),
                    std::max(0.0, thinnest), thicker));
  if (settings.max_slope_deg && lens.steepest_deg > unsure * *settings.max_slope_deg)
    notes.push_back(fmt::format("the lens becomes as steep as some {:.2g} degrees, and 'max_slope_deg' is {}{} or a "
                                "larger max_slope_deg",
                                lens.steepest_deg, *settings.max_slope_deg, remedy));
  return notes;
}

} // namespace nephroid::inverse
