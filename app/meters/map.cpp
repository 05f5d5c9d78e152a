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
        image.data.push_back(static_cast<float>(cells[c].half()));
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

ColouredMap coloured(const scene::MeterSurface& surface, const std::vector<float>& values, double scale, int edge) {
  constexpr Colour nothing{32, 32, 32}, line{255, 255, 255};
  const Map map = map_of(surface);
  const int zoom = std::max(1, edge / std::max(map.width, map.height)), width = map.width * zoom,
            height = map.height * zoom;
  const int lines = measure::colour_bar(height, scale, false).numbers - 1; // at the numbers beside the bar
  ColouredMap result{measure::Bitmap(width, height), zoom};
  std::vector<int> levels; // [y][x], where there are lines
  const bool has_lines = map.width * map.height > 16 && zoom > 2;
  if (has_lines)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto value = between(map, values, (x + 0.5) / zoom - 0.5, (y + 0.5) / zoom - 0.5);
        levels.push_back(value ? static_cast<int>(std::floor(lines * *value / scale)) : -1);
      }
  const auto level = [&](int x, int y) {
    return levels[static_cast<std::size_t>(std::min(y, height - 1)) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(std::min(x, width - 1))];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int cell = map.cells[map.place(y / zoom, x / zoom)];
      if (cell < 0) {
        result.bitmap.set(x, y, nothing);
        continue;
      }
      const int here = has_lines ? level(x, y) : 0;
      const bool crosses = has_lines && here <= lines && (level(x + 1, y) != here || level(x, y + 1) != here);
      result.bitmap.set(x, y, crosses ? line : measure::map_colour(values[static_cast<std::size_t>(cell)] / scale));
    }
  return result;
}

measure::Bitmap false_colours(const preset::Meter& meter, const scene::MeterSurface& surface,
                              const std::vector<float>& values, double scale, const std::string& title) {
  constexpr int edge = 640;
  const measure::Bitmap map = coloured(surface, values, scale, edge).bitmap;
  const measure::ColourBar bar = measure::colour_bar(map.height, scale, false);
  const Location where("a meter's map");
  const image::Image words = image::text_picture(std::string(preset::word(preset::unit_of(meter))), 16, where),
                     above = title.empty() ? image::Image() : image::text_picture(title, 16, where);
  const int top_of_map = title.empty() ? 0 : above.height + 12, top = top_of_map + words.height + 12;
  measure::Bitmap bitmap(std::max(map.width + std::max(bar.width, words.width + 12), above.width + 12),
                         top + std::max(map.height, bar.height));
  measure::Bitmap beside(bar.width, bar.height);
  measure::draw(beside, 0, bar);
  const auto copy = [&](const measure::Bitmap& from, int left) {
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        const unsigned char* pixel =
            from.rgba.data() +
            4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width) + static_cast<std::size_t>(x));
        bitmap.set(left + x, top + y, {pixel[0], pixel[1], pixel[2]});
      }
  };
  copy(map, 0);
  copy(beside, map.width);
  draw_words(bitmap, 6, 6, above);
  draw_words(bitmap, map.width + 6, top_of_map + 6, words);
  return bitmap;
}

measure::Bitmap false_colours(const preset::Meter& meter, const scene::MeterSurface& surface, const Reading& reading) {
  const std::vector<float> values = shown_values(meter, reading);
  return false_colours(meter, surface, values, measure::colour_scale(values), "");
}

} // namespace nephroid::meters
