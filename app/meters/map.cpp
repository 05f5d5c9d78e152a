// SPDX-License-Identifier: Apache-2.0
#include "meters/map.h"

#include "preset/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nephroid::meters {
namespace {

using Colour = std::array<unsigned char, 3>;
constexpr Colour limit_colour{0, 255, 128};

const char* name_of(const scene::MeterSurface& surface, Quantity quantity) {
  if (surface.is_goniometer()) return quantity == Quantity::irradiance ? "radiant_intensity" : "luminous_intensity";
  return quantity == Quantity::irradiance ? "irradiance" : "illuminance";
}

/// A value between cells, of those around that are there; nothing where none is.
std::optional<double> between(const Map& map, const std::vector<float>& values, double x, double y) {
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  double sum = 0, weights = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const int i = std::clamp(column + dx, 0, map.width - 1), j = std::clamp(row + dy, 0, map.height - 1);
      const int cell = map.cells[map.place(j, i)];
      const double weight = std::abs(1 - dx - (x - column)) * std::abs(1 - dy - (y - row));
      if (cell < 0) continue;
      sum += weight * values[static_cast<std::size_t>(cell)];
      weights += weight;
    }
  return weights > 0 ? std::optional(sum / weights) : std::nullopt;
}

/// Copies words, black to the bitmap's ground and white to light grey.
void draw_words(measure::Bitmap& bitmap, int x, int y, const image::Image& words) {
  for (int row = 0; row < words.height && y + row < bitmap.height; ++row)
    for (int column = 0; column < words.width && x + column < bitmap.width; ++column) {
      const float ink = words.data[static_cast<std::size_t>(row) * static_cast<std::size_t>(words.width) +
                                   static_cast<std::size_t>(column)];
      const auto grey = static_cast<unsigned char>(std::lround(32 + 192 * ink));
      bitmap.set(x + column, y + row, {grey, grey, grey});
    }
}

/// A cross at the middle of the highest cell, black beside white.
void mark_highest(ColouredMap& coloured, const Map& map, const std::vector<float>& values) {
  constexpr int arm = 7;
  const auto highest = static_cast<int>(std::ranges::max_element(values) - values.begin());
  const auto place = static_cast<int>(std::ranges::find(map.cells, highest) - map.cells.begin());
  const int x = place % map.width * coloured.zoom + coloured.zoom / 2,
            y = place / map.width * coloured.zoom + coloured.zoom / 2;
  for (const int side : {-1, 1, 0}) {
    const unsigned char grey = side == 0 ? 255 : 0;
    for (int along = -arm; along <= arm; ++along) {
      coloured.bitmap.set(x + along, y + side, {grey, grey, grey});
      coloured.bitmap.set(x + side, y + along, {grey, grey, grey});
    }
  }
}

/// "40 m", "3.2 mm".
std::string length_of(double metres) {
  return metres < 0.1 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.3g} m", metres);
}

/// "+x", "-z"; of what is aslant its three numbers.
std::string name_of(const glm::dvec3& direction) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) > 1 - 1e-6) return fmt::format("{}{}", direction[axis] > 0 ? '+' : '-', "xyz"[axis]);
  return fmt::format("({:.2g}, {:.2g}, {:.2g})", direction.x, direction.y, direction.z);
}

/// "40 m x 50 m; right +x, up -z", of a map with one chart; else nothing.
std::string sides_of(const scene::MeterSurface& surface, double metres_per_unit) {
  if (surface.charts.size() != 1 || surface.is_goniometer() || surface.count() < 2) return {};
  const scene::MeterChart& chart = surface.charts.front();
  return fmt::format("{} x {}; right {}, up {}", length_of(chart.columns * chart.cell_width * metres_per_unit),
                     length_of(chart.rows * chart.cell_height * metres_per_unit), name_of(chart.right),
                     name_of(chart.up));
}

} // namespace

Map map_of(const scene::MeterSurface& surface) {
  Map map;
  for (const scene::MeterChart& chart : surface.charts) {
    map.width += chart.columns + (map.width > 0 ? 1 : 0);
    map.height = std::max(map.height, chart.rows);
  }
  map.cells.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), -1);
  int left = 0;
  for (const scene::MeterChart& chart : surface.charts) {
    for (int row = 0; row < chart.rows; ++row)
      for (int column = 0; column < chart.columns; ++column)
        map.cells[map.place(row, left + column)] = surface.cells[chart.first + chart.place(row, column)];
    left += chart.columns + 1;
  }
  return map;
}

std::string csv(const scene::MeterSurface& surface, const glm::dvec3& origin, double metres_per_unit,
                const Reading& reading) {
  const bool is_far = surface.is_goniometer();
  std::string text = is_far ? "cell,gamma_deg,c_deg,sr" : "cell,x,y,z,normal_x,normal_y,normal_z,area_m2";
  for (const LayerReading& layer : reading.layers)
    for (const char* unit : {is_far ? "W/sr" : "W/m^2", is_far ? "cd" : "lx"}) {
      const std::string name = layer.name == "all" ? unit : fmt::format("{} {}", layer.name, unit);
      text += fmt::format(",{},{} low,{} high", name, name, name);
    }
  text += "\n";
  for (std::size_t cell = 0; cell < surface.count(); ++cell) {
    const glm::dvec3 p = surface.centres[cell] + origin, n = surface.normals[cell];
    if (is_far) {
      const scene::GammaC way = scene::direction_of(surface, cell);
      fmt::format_to(std::back_inserter(text), "{},{:.4f},{:.4f},{:.7g}", cell, way.gamma_deg, way.c_deg,
                     surface.steradians[cell]);
    } else
      fmt::format_to(std::back_inserter(text), "{},{:.7g},{:.7g},{:.7g},{:.6g},{:.6g},{:.6g},{:.7g}", cell, p.x, p.y,
                     p.z, n.x, n.y, n.z, surface.areas[cell] * metres_per_unit * metres_per_unit);
    for (const LayerReading& layer : reading.layers)
      for (const std::vector<Interval>& cells : layer.cells)
        fmt::format_to(std::back_inserter(text), ",{:.7g},{:.7g},{:.7g}", cells[cell].value, cells[cell].low,
                       cells[cell].high);
    text += "\n";
  }
  return text;
}

image::Image picture(const scene::MeterSurface& surface, double metres_per_unit, const Reading& reading) {
  const Map map = map_of(surface);
  image::Image image;
  image.width = map.width;
  image.height = map.height;
  for (const LayerReading& layer : reading.layers)
    for (const Quantity quantity : quantities) {
      const std::string name = layer.name == "all" ? name_of(surface, quantity)
                                                   : fmt::format("{}.{}", layer.name, name_of(surface, quantity));
      image.channels.insert(image.channels.end(), {name, name + ".half"});
    }
  image.channels.push_back(surface.is_goniometer() ? "steradians" : "area");
  image.data.reserve(map.cells.size() * image.channels.size());
  for (const int cell : map.cells) {
    if (cell < 0) {
      image.data.resize(image.data.size() + image.channels.size(), 0.0f);
      continue;
    }
    const auto c = static_cast<std::size_t>(cell);
    for (const LayerReading& layer : reading.layers)
      for (const std::vector<Interval>& cells : layer.cells) {
        image.data.push_back(static_cast<float>(cells[c].value));
        image.data.push_back(static_cast<float>(cells[c].high - cells[c].value));
      }
    image.data.push_back(static_cast<float>(
        surface.is_goniometer() ? surface.steradians[c] : surface.areas[c] * metres_per_unit * metres_per_unit));
  }
  return image;
}

std::vector<float> shown_values(const preset::Meter& meter, const Reading& reading) {
  const double unit = preset::size_of(preset::unit_of(meter));
  std::vector<float> values;
  for (const Interval& cell : reading.all().cells[static_cast<std::size_t>(quantity_of(meter.unit))])
    values.push_back(static_cast<float>(cell.value / unit));
  return values;
}

ColouredMap coloured(const scene::MeterSurface& surface, const std::vector<float>& values, double scale,
                     std::optional<double> threshold, int edge) {
  constexpr Colour nothing{32, 32, 32}, line{255, 255, 255};
  const Map map = map_of(surface);
  const int zoom = std::max(1, edge / std::max(map.width, map.height)), width = map.width * zoom,
            height = map.height * zoom;
  const int lines = measure::colour_bar(height, scale, false).numbers - 1; // at the numbers beside the bar
  ColouredMap result{measure::Bitmap(width, height), zoom};
  const bool has_lines = map.width * map.height > 16 && zoom > 2;
  std::vector<float> smooth; // [y][x], where there are lines; below 0: none
  if (has_lines)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        smooth.push_back(
            static_cast<float>(between(map, values, (x + 0.5) / zoom - 0.5, (y + 0.5) / zoom - 0.5).value_or(-scale)));
  /// Whether a line between values of unlike levels goes along a pixel.
  const auto goes_here = [&](int x, int y, const auto& level_of) {
    const auto level = [&](int i, int j) {
      return level_of(smooth[static_cast<std::size_t>(std::min(j, height - 1)) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(std::min(i, width - 1))]);
    };
    return has_lines && (level(x + 1, y) != level(x, y) || level(x, y + 1) != level(x, y));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int cell = map.cells[map.place(y / zoom, x / zoom)];
      if (cell < 0)
        result.bitmap.set(x, y, nothing);
      else if (threshold && goes_here(x, y, [&](float value) { return value > *threshold; }))
        result.bitmap.set(x, y, limit_colour);
      else if (goes_here(x, y,
                         [&](float value) { return std::min(int(std::floor(lines * value / scale)), lines + 1); }))
        result.bitmap.set(x, y, line);
      else
        result.bitmap.set(x, y, measure::map_colour(values[static_cast<std::size_t>(cell)] / scale));
    }
  if (has_lines) mark_highest(result, map, values);
  return result;
}

double map_scale(const std::vector<float>& values, std::optional<double> threshold) {
  const double scale = measure::colour_scale(values);
  if (!threshold || *threshold <= scale || std::ranges::max(values) <= *threshold) return scale;
  return measure::colour_scale(std::vector{static_cast<float>(*threshold)});
}

measure::Bitmap false_colours(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
                              const std::vector<float>& values, double scale, const std::string& title) {
  constexpr int edge = 640, margin = 6, letter = 16;
  const std::optional<double> threshold = preset::threshold_in(meter, preset::unit_of(meter));
  const measure::Bitmap map = coloured(surface, values, scale, threshold, edge).bitmap;
  const measure::ColourBar bar = measure::colour_bar(map.height, scale, false);
  const auto words_of = [](const std::string& text) {
    return text.empty() ? image::Image() : image::text_picture(text, letter, Location("a meter's map"));
  };
  const auto room_of = [](const image::Image& words) { return words.height > 0 ? words.height + 2 * margin : 0; };
  const image::Image above = words_of(title), unit = words_of(std::string(preset::word(preset::unit_of(meter)))),
                     below = words_of(sides_of(surface, metres_per_unit)),
                     limit = words_of(!threshold ? ""
                                      : std::ranges::max(values) > *threshold
                                          ? fmt::format("green: {}", *meter.threshold)
                                          : fmt::format("nothing is above {}", *meter.threshold));
  const int top = room_of(above) + room_of(unit), bottom = top + std::max(map.height, bar.height);
  measure::Bitmap bitmap(std::max({map.width + std::max(bar.width, unit.width + 2 * margin), above.width + 2 * margin,
                                   below.width + 2 * margin, limit.width + 2 * margin}),
                         bottom + room_of(below) + room_of(limit));
  measure::Bitmap beside(bar.width, bar.height);
  measure::draw(beside, 0, bar);
  const auto copy = [&](const measure::Bitmap& from, int left) {
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) bitmap.set(left + x, top + y, from.at(x, y));
  };
  copy(map, 0);
  copy(beside, map.width);
  draw_words(bitmap, margin, margin, above);
  draw_words(bitmap, map.width + margin, room_of(above) + margin, unit);
  draw_words(bitmap, margin, bottom + margin, below);
  draw_words(bitmap, margin, bottom + room_of(below) + margin, limit);
  return bitmap;
}

measure::Bitmap false_colours(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
                              const Reading& reading) {
  const std::vector<float> values = shown_values(meter, reading);
  const double scale = map_scale(values, preset::threshold_in(meter, preset::unit_of(meter)));
  return false_colours(meter, surface, metres_per_unit, values, scale, "");
}

} // namespace nephroid::meters
