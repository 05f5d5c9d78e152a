// SPDX-License-Identifier: Apache-2.0
#include "scene/meter.h"

#include "optics/spectrum.h"
#include "preset/json_text.h"
#include "scene/directions.h"
#include "scene/facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace nephroid::scene {
namespace {

/// How far pieces are above their surface, of its largest coordinate: more than rounding moves a point on it.
constexpr double lift = 1e-6;

/// The six sides of a box along the axes, the top's map with -z up.
constexpr std::array<std::array<glm::dvec3, 2>, 6> sides{{{{{0, 0, -1}, {0, 1, 0}}},
                                                          {{{0, 0, 1}, {0, 1, 0}}},
                                                          {{{1, 0, 0}, {0, 0, -1}}},
                                                          {{{1, 0, 0}, {0, 0, 1}}},
                                                          {{{1, 0, 0}, {0, 1, 0}}},
                                                          {{{-1, 0, 0}, {0, 1, 0}}}}};

/// Cuts polygons into cells.
struct Builder {
  MeterSurface& meter;
  std::vector<std::vector<std::pair<Polygon, double>>> places{}; ///< [place]: polygons, and the scale of their areas

  void add(const MeterChart& chart, Polygon polygon, double area_scale) {
    const auto range = [&](const Polygon& of, const glm::dvec3& way) {
      double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
      for (const glm::dvec3& p : of) low = std::min(low, glm::dot(p, way)), high = std::max(high, glm::dot(p, way));
      return std::array{low, high};
    };
    const auto cell = [](double way, double size, int count) {
      return std::clamp(static_cast<int>(std::floor(way / size)), 0, count - 1);
    };
    const auto [low, high] = range(polygon, chart.up);
    for (int row = cell(chart.top - high, chart.cell_height, chart.rows);
         row <= cell(chart.top - low, chart.cell_height, chart.rows); ++row) {
      const double row_top = chart.top - row * chart.cell_height;
      Polygon strip = polygon;
      if (row > 0) strip = clipped(strip, -chart.up, -row_top);
      if (row + 1 < chart.rows) strip = clipped(strip, chart.up, row_top - chart.cell_height);
      if (strip.size() < 3) continue;
      const auto [from, to] = range(strip, chart.right);
      for (int column = cell(from - chart.left, chart.cell_width, chart.columns);
           column <= cell(to - chart.left, chart.cell_width, chart.columns); ++column) {
        const double left = chart.left + column * chart.cell_width;
        Polygon part = strip;
        if (column > 0) part = clipped(part, chart.right, left);
        if (column + 1 < chart.columns) part = clipped(part, -chart.right, -(left + chart.cell_width));
        if (part.size() >= 3) places[chart.first + chart.place(row, column)].emplace_back(std::move(part), area_scale);
      }
    }
  }

  /// Numbers the cells with an area. above: how far pieces are above their facets.
  void finish(double above) {
    const double largest = largest_area();
    meter.cells.assign(places.size(), -1);
    meter.first_piece.push_back(0);
    for (std::size_t place = 0; place < places.size(); ++place) {
      std::vector<double> areas;
      glm::dvec3 centre(0), across(0);
      const std::size_t first = meter.pieces.size();
      for (const auto& [polygon, scale] : places[place])
        for (std::size_t i = 2; i < polygon.size(); ++i) {
          const glm::dvec3 n = 0.5 * glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
          const double area = glm::length(n);
          if (area <= 1e-9 * largest) continue;
          const glm::dvec3 up = above / area * n;
          areas.push_back(area * scale);
          across += n;
          centre += area * scale / 3 * (polygon[0] + polygon[i - 1] + polygon[i]);
          meter.pieces.push_back(
              {glm::vec3(polygon[0] + up), glm::vec3(polygon[i - 1] + up), glm::vec3(polygon[i] + up)});
        }
      double sum = 0;
      for (const double area : areas) sum += area;
      if (sum <= 1e-4 * largest) {
        meter.pieces.resize(first);
        continue;
      }
      double before = 0;
      for (const double area : areas) meter.chances.push_back(static_cast<float>((before += area) / sum));
      meter.chances.back() = 1;
      meter.cells[place] = static_cast<int>(meter.areas.size());
      meter.areas.push_back(sum);
      meter.centres.push_back(centre / sum);
      meter.normals.push_back(glm::normalize(across));
      meter.first_piece.push_back(static_cast<std::uint32_t>(meter.pieces.size()));
    }
  }

private:
  double largest_area() const {
    double most = 0;
    for (const MeterChart& chart : meter.charts) most = std::max(most, chart.cell_width * chart.cell_height);
    return most;
  }
};

/// Of a triangle as seen from a point (Van Oosterom and Strackee 1983).
double solid_angle(const std::array<glm::vec3, 3>& triangle, const glm::dvec3& from) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(triangle[0]) - from),
                   b = glm::normalize(glm::dvec3(triangle[1]) - from),
                   c = glm::normalize(glm::dvec3(triangle[2]) - from);
  return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// Divides an edge into cells of about this size.
int cells_along(double edge, double cell) { return std::max(1, static_cast<int>(std::lround(edge / cell))); }

[[noreturn]] void refuse_count(double count, double smallest_edge, const preset::Meter& meter, const Location& where) {
  throw bad_input(where / (meter.cell ? "cell" : "size"), fmt::format("makes {:.3g} cells", count),
                  fmt::format("expected at most {}", most_meter_cells),
                  fmt::format("take a cell of {:.3g} or more", smallest_edge));
}

void require_count(std::size_t count, double area, const preset::Meter& meter, const Location& where) {
  if (count > most_meter_cells)
    refuse_count(static_cast<double>(count), std::sqrt(area / static_cast<double>(most_meter_cells)) * 1.05, meter,
                 where);
}

/// Sets a chart's grid so that cells divide it evenly.
void divide(MeterChart& chart, double width, double height, double cell, const preset::Meter& meter,
            const Location& where) {
  const double count = std::max(1.0, width / cell) * std::max(1.0, height / cell);
  if (count > 1.1 * static_cast<double>(most_meter_cells))
    refuse_count(count, std::sqrt(width * height / static_cast<double>(most_meter_cells)) * 1.05, meter, where);
  chart.columns = cells_along(width, cell);
  chart.rows = cells_along(height, cell);
  chart.cell_width = width / chart.columns;
  chart.cell_height = height / chart.rows;
  require_count(chart.places(), width * height, meter, where);
}

double cell_of(const preset::Meter& meter, double longest) { return meter.cell.value_or(longest / 64); }

/// What is up in the map of a plane: +y, or -z where that is flat.
glm::dvec3 usual_up(const glm::dvec3& normal) {
  return std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
}

/// Adds a rectangle in the air to the charts, cut into cells. chart: its frame and its grid.
void add_plane(MeterChart chart, const glm::dvec3& centre, double width, double height, Builder& builder) {
  const double above = lift * std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z), width, height});
  const glm::dvec3 from = centre - width / 2 * chart.right + height / 2 * chart.up;
  chart.left = glm::dot(from, chart.right);
  chart.top = glm::dot(from, chart.up);
  chart.height = glm::dot(centre, chart.normal()) + above;
  chart.first = builder.places.size();
  builder.meter.charts.push_back(chart);
  builder.places.resize(chart.first + chart.places());
  for (int row = 0; row < chart.rows; ++row)
    for (int column = 0; column < chart.columns; ++column) {
      const glm::dvec3 a = from + column * chart.cell_width * chart.right - row * chart.cell_height * chart.up,
                       b = a - chart.cell_height * chart.up, c = b + chart.cell_width * chart.right,
                       d = a + chart.cell_width * chart.right;
      builder.places[chart.first + chart.place(row, column)].emplace_back(Polygon{a, b, c, d}, 1.0);
    }
}

void make_plane(const preset::Meter& meter, const Scene& scene, const Location& where, Builder& builder) {
  const bool point = meter.type == preset::Meter::Type::point;
  const glm::dvec3 normal = glm::normalize(to_dvec3(meter.normal));
  const glm::dvec3 up = !point && meter.up ? to_dvec3(*meter.up) : usual_up(normal);
  MeterChart chart;
  chart.right = glm::normalize(glm::cross(up, normal));
  chart.up = glm::cross(normal, chart.right);
  const double edge = std::sqrt(std::numbers::pi) / 2 * meter.diameter, width = point ? edge : meter.size[0],
               height = point ? edge : meter.size[1];
  divide(chart, width, height, point ? edge : cell_of(meter, std::max(width, height)), meter, where);
  const glm::dvec3 centre = to_dvec3(meter.position) - scene.origin;
  add_plane(chart, centre, width, height, builder);
  builder.finish(builder.meter.charts.front().height - glm::dot(centre, normal));
}

/// A cube far away, whose cells are directions as seen from its middle.
void make_goniometer(const preset::Meter& meter, const Scene& scene, const Location& where, Builder& builder) {
  constexpr double far = 1000; // times the reach of the scene: directions are off by .06 degrees, intensities by .2 %
  for (const Light& light : scene.lights)
    if (light.type == preset::Light::Type::directional)
      throw bad_input(where, "is a goniometer where light comes from far away, which goes on in its own direction",
                      "expected lamps alone", "leave out the sun, the sky and directional lights");
  const glm::dvec3 middle = to_dvec3(meter.position) - scene.origin;
  double reach = 0;
  for (const Object& object : scene.objects)
    if (!is_empty(object))
      reach = std::max(reach, glm::distance(middle, glm::dvec3(object.bounds.centre)) + double(object.bounds.radius));
  for (const Light& light : scene.lights)
    reach = std::max(reach, glm::distance(middle, glm::dvec3(light.position)) + glm::length(light.edge_u) / 2 +
                                glm::length(light.edge_v) / 2);
  const double edge = 2 * far * std::max(reach, 1e-3);
  const int cells = std::max(1, static_cast<int>(std::lround(90 / meter.step_deg)));
  for (const std::array<glm::dvec3, 2>& side : sides) {
    MeterChart chart{-side[0], side[1]}; // looks to the middle
    chart.columns = chart.rows = cells;
    chart.cell_width = chart.cell_height = edge / cells;
    add_plane(chart, middle - edge / 2 * chart.normal(), edge, edge, builder);
  }
  builder.finish(lift * edge);
  MeterSurface& surface = builder.meter;
  surface.middle = middle;
  surface.rounding = 2 / far;
  const glm::dvec3 down = glm::normalize(to_dvec3(meter.direction)),
                   zero = perpendicular_up(meter.up.value_or(preset::Vec3{0, 0, 1}), down, where / "up");
  surface.directions = {zero, glm::cross(zero, down), down};
  surface.steradians.assign(surface.count(), 0);
  for (std::size_t cell = 0; cell < surface.count(); ++cell)
    for (std::uint32_t piece = surface.first_piece[cell]; piece < surface.first_piece[cell + 1]; ++piece)
      surface.steradians[cell] += solid_angle(surface.pieces[piece], middle);
}

/// Turns a frame by quarters until its second way is as near as can be to what is up.
std::array<glm::dvec3, 2> upright(glm::dvec3 right, glm::dvec3 up) {
  const glm::dvec3 wanted = usual_up(glm::cross(right, up));
  std::array best{right, up};
  for (int quarter = 0; quarter < 3; ++quarter) {
    const glm::dvec3 before = right;
    right = up;
    up = -before;
    if (glm::dot(up, wanted) > glm::dot(best[1], wanted) + 1e-9) best = {right, up};
  }
  return best;
}

/// The facets that a meter measures, cut by its box. back: of a flat object, the other side.
std::vector<Facet> measured_facets(const MeterSurface& meter, const Scene& scene, const Object& object, bool back) {
  std::vector<Facet> measured;
  for (Facet& facet : facets_of(scene, object)) {
    if (back) std::reverse(facet.polygon.begin(), facet.polygon.end());
    const glm::dvec3 n = across(facet.polygon);
    if (!(glm::length(n) > 0) || glm::dot(n, meter.facing) < meter.least_cosine * glm::length(n)) continue;
    for (int axis = 0; axis < 3 && facet.polygon.size() >= 3; ++axis) {
      glm::dvec3 way(0);
      way[axis] = 1;
      facet.polygon = clipped(facet.polygon, way, meter.low[axis]);
      facet.polygon = clipped(facet.polygon, -way, -meter.high[axis]);
    }
    if (facet.polygon.size() >= 3) measured.push_back(std::move(facet));
  }
  return measured;
}

/// Takes what the preset says of a part of the object.
void set_limits(const preset::Meter& meter, const Scene& scene, const Object& object, bool is_flat,
                const Location& where, MeterSurface& surface) {
  if (meter.within) {
    surface.low = to_dvec3(meter.within->low) - scene.origin;
    surface.high = to_dvec3(meter.within->high) - scene.origin;
  }
  if (!meter.facing || is_flat) return; // a flat object has two sides, and this chooses one
  if (object.ellipsoid_count > 0)
    throw bad_input(where / "facing", "is of flat facets, and the object is a ball", "expected no 'facing'",
                    "take a part of it by 'within'");
  surface.facing = glm::normalize(to_dvec3(*meter.facing));
  surface.least_cosine = std::sqrt(0.5) - 1e-6;
}

void make_surface(const preset::Meter& meter, const Scene& scene, const Location& where, Builder& builder) {
  const auto found = std::ranges::find(scene.objects, meter.object, &Object::name);
  const Object& object = *found; // preset::check has looked
  builder.meter.object = static_cast<int>(found - scene.objects.begin());
  const auto plane = plane_of(scene, object);
  const bool back = plane && meter.facing && glm::dot(plane->normal, to_dvec3(*meter.facing)) < 0;
  set_limits(meter, scene, object, plane.has_value(), where, builder.meter);
  const std::vector<Facet> facets = measured_facets(builder.meter, scene, object, back);
  if (facets.empty())
    throw bad_input(where, "measures nothing: no part of the object faces that way or is in the box",
                    "expected some surface", "look at 'facing' and 'within'");
  builder.meter.is_flat = plane.has_value();
  if (object.ellipsoid_count > 0) builder.meter.rounding = rounding_of_ellipsoids;
  std::array<std::vector<std::size_t>, 6> of_side;
  std::array<Bounds, 6> bounds;
  std::array<std::array<glm::dvec3, 2>, 6> frames = sides;
  if (plane) {
    const Rectangle rectangle = rectangle_about(scene, object, *plane, back ? -plane->normal : plane->normal);
    frames[0] = upright(rectangle.right, rectangle.up);
  }
  double longest = 0, largest = 0;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const std::size_t side = plane ? 0 : facets[i].side;
    of_side[side].push_back(i);
    for (const glm::dvec3& p : facets[i].polygon) {
      const glm::dvec3 place(glm::dot(p, frames[side][0]), glm::dot(p, frames[side][1]), 0);
      bounds[side] = enclosing(bounds[side], {place, place});
      for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
    }
    const glm::dvec3 size = bounds[side].high - bounds[side].low;
    longest = std::max({longest, size.x, size.y});
  }
  std::size_t places = 0;
  double area = 0;
  for (std::size_t side = 0; side < 6; ++side) {
    if (of_side[side].empty()) continue;
    MeterChart chart{frames[side][0], frames[side][1]};
    const glm::dvec3 size = bounds[side].high - bounds[side].low;
    divide(chart, size.x, size.y, cell_of(meter, longest), meter, where);
    chart.left = bounds[side].low.x;
    chart.top = bounds[side].high.y;
    chart.first = places;
    places += chart.places();
    area += size.x * size.y;
    require_count(places, area, meter, where);
    builder.meter.charts.push_back(chart);
  }
  builder.places.resize(places);
  auto chart = builder.meter.charts.begin();
  for (std::size_t side = 0; side < 6; ++side) {
    if (of_side[side].empty()) continue;
    for (const std::size_t i : of_side[side]) builder.add(*chart, facets[i].polygon, facets[i].area_scale);
    ++chart;
  }
  builder.finish(lift * largest);
}

/// Refuses a meter that glass encloses, or that looks into the surface that it lies on.
void require_air(const MeterSurface& meter, const Scene& scene, const Location& where) {
  const std::size_t probes = std::min<std::size_t>(meter.count(), 1024);
  for (std::size_t probe = 0; probe < probes; ++probe) {
    // All of a few cells, else some that are spread by the golden section.
    const std::size_t cell =
        probes == meter.count()
            ? probe
            : static_cast<std::size_t>(std::fmod(static_cast<double>(probe) * 0.618033988749895, 1) *
                                       static_cast<double>(meter.count()));
    const auto& [a, b, c] = meter.pieces[meter.first_piece[cell]]; // a cell's centre may be behind a curved surface
    const glm::dvec3 place = glm::dvec3(a + b + c) / 3.0;
    const std::vector<int> inside = dielectrics_around(scene, place);
    if (inside.empty()) continue;
    const std::string& name = scene.objects[static_cast<std::size_t>(inside.back())].name;
    if (meter.object == inside.back())
      throw bad_input(where / "object",
                      fmt::format("is {}, whose surface looks into its glass", preset::in_quotes(name)),
                      "expected an object that is not turned inwards");
    throw bad_input(where / (meter.object >= 0 ? "object" : "position"),
                    fmt::format("a cell is inside of the glass {}", preset::in_quotes(name)),
                    "expected a meter in the air", "move it, or turn its normal to the other side");
  }
}

} // namespace

Rectangle rectangle_about(const Scene& scene, const Object& object, const Plane& plane, const glm::dvec3& normal) {
  Rectangle rectangle;
  const glm::uvec3 first = triangles_of(scene, object).front();
  double least = std::numeric_limits<double>::max();
  for (int edge = 0; edge < 3; ++edge) {
    const auto corner = [&](int i) { return glm::dvec3(scene.geometry.positions[first[i % 3]]); };
    const glm::dvec3 right = glm::normalize(corner(edge + 1) - corner(edge)), up = glm::cross(normal, right);
    Bounds bounds;
    for_each_corner(scene, object, [&](const glm::dvec3& p) {
      const glm::dvec3 place(glm::dot(p, right), glm::dot(p, up), 0);
      bounds = enclosing(bounds, {place, place});
    });
    const glm::dvec3 size = bounds.high - bounds.low, middle = 0.5 * (bounds.low + bounds.high);
    if (size.x * size.y >= least * (1 - 1e-6)) continue;
    least = size.x * size.y;
    rectangle = {middle.x * right + middle.y * up + glm::dot(plane.point, normal) * normal, right, up, size.x, size.y};
  }
  return rectangle;
}

MeterSurface make_meter(const preset::Meter& meter, const Scene& scene, const Location& where) {
  MeterSurface surface;
  surface.name = meter.name;
  Builder builder{surface};
  if (meter.type == preset::Meter::Type::surface)
    make_surface(meter, scene, where, builder);
  else if (meter.type == preset::Meter::Type::goniometer)
    make_goniometer(meter, scene, where, builder);
  else
    make_plane(meter, scene, where, builder);
  if (surface.count() == 0) throw bad_input(where, "has no area", "expected a surface", "look at 'within' and 'size'");
  require_air(surface, scene, where);
  return surface;
}

Scene meter_view(Scene scene, MeterSurface meter) {
  scatter::Material white;
  white.reflectance = optics::constant_spectrum(1);
  meter.white = static_cast<int>(scene.objects.size());
  Object object;
  object.name = "meter";
  object.material = static_cast<int>(scene.materials.size());
  object.bounds = {meter.centres.front(), 0};
  scene.materials.push_back(white);
  scene.objects.push_back(object);
  scene.camera = {};
  scene.camera.position = glm::vec3(meter.centres.front());
  scene.camera.width = static_cast<int>(meter.count());
  scene.camera.height = 1;
  scene.camera.meter = std::make_shared<const MeterSurface>(std::move(meter));
  return scene;
}

} // namespace nephroid::scene
