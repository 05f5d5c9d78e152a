// SPDX-License-Identifier: Apache-2.0
// A reading as files: a table, a picture of numbers, and one of false colours.
#pragma once
#include "image/image.h"
#include "measure/difference.h"
#include "meters/reading.h"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::meters {

/// The cells as they lie in the charts' grids, the charts side by side with a column between them.
struct Map {
  int width = 0, height = 0;
  std::vector<int> cells; ///< [row from the top][column]; -1: none
  std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};
Map map_of(const scene::MeterSurface& surface);

/// Rows of cell, place, normal, area; irradiance and illuminance with both ends of their intervals; then each layer's.
/// origin: preset coordinates of the scene's (0, 0, 0). Places are in the preset's unit.
/// Of a goniometer each cell has its gamma and C in their place, and its solid angle.
std::string csv(const scene::MeterSurface& surface, const glm::dvec3& origin, double metres_per_unit,
                const Reading& reading);

/// Channels "irradiance" and "illuminance", "irradiance.half" and so on for the halves of their intervals,
/// "direct.irradiance" and so on for layers, "area" in square metres: 0 where there is no cell.
image::Image picture(const scene::MeterSurface& surface, double metres_per_unit, const Reading& reading);

/// The cells' values in the meter's unit.
std::vector<float> shown_values(const preset::Meter& meter, const Reading& reading);

/// Values of cells in false colours, with lines of equal value where cells are large enough.
struct ColouredMap {
  measure::Bitmap bitmap; ///< a cell is zoom x zoom pixels
  int zoom = 1;
};
/// A green line is about what is above the threshold, and a cross is at the highest cell. scale: where the colours end.
/// edge: of the bitmap's longer side, in pixels, where cells are fewer.
ColouredMap coloured(const scene::MeterSurface& surface, const std::vector<float>& values, double scale,
                     std::optional<double> threshold, int edge);

/// Where the colours end: at measure::colour_scale of the values, and not below a threshold that one of them is above.
double map_scale(const std::vector<float>& values, std::optional<double> threshold);

/// Values of the meter's unit in false colours with lines of equal value, the scale beside them, and below them how
/// large the map is and where its sides lie. title: a line above the map; may be empty. Throws as image::text_picture.
measure::Bitmap false_colours(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
                              const std::vector<float>& values, double scale, const std::string& title);
/// The same with the scale of the values alone (map_scale).
measure::Bitmap false_colours(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
                              const Reading& reading);

} // namespace nephroid::meters
