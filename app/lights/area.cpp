// SPDX-License-Identifier: Apache-2.0
// A rectangle that shines to one side, evenly or as a picture says.
#include "lights/lights.h"

#include "base/exact_cdf.h"
#include "image/image.h"
#include "optics/colour.h"
#include "scatter/texture.h"
#include "scene/directions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace nephroid::lights {
namespace {

/// Its luminance. A note of what is clipped goes to warnings.
std::shared_ptr<const scene::LightPicture> load_light_picture(const std::filesystem::path& file,
                                                              std::vector<std::string>& warnings) {
  const image::Image image = scatter::read_texels(file);
  const image::Rgb colours = image::rgb_of(image, file.string());
  scene::LightPicture picture{image.width, image.height, {}};
  double most = 0;
  bool negative = false;
  for (std::size_t i = 0; i < colours.values.size(); i += 3) {
    const double y = optics::linear_srgb_to_xyz({colours.values[i], colours.values[i + 1], colours.values[i + 2]})[1];
    if (!std::isfinite(y))
      throw bad_input(file.string(), fmt::format("texel {} has a value that is not finite", i / 3));
    negative = negative || y < 0;
    picture.luminance.push_back(static_cast<float>(std::max(y, 0.0)));
    most = std::max(most, y);
  }
  if (!(most > 0)) throw bad_input(file.string(), "is black", "expected a picture that shines somewhere");
  for (const std::string& note : image.notes) warnings.push_back(fmt::format("{}: {}", file.filename().string(), note));
  if (!colours.grey)
    warnings.push_back(fmt::format("{}: as a lamp it shines by its luminance, in the light's spectrum, without colours",
                                   file.filename().string()));
  if (negative) warnings.push_back(fmt::format("{}: negative luminance is taken as black", file.filename().string()));
  return std::make_shared<const scene::LightPicture>(std::move(picture));
}

/// The rows, then the texels of each row, by luminance.
std::vector<float> picture_table(const scene::LightPicture& picture) {
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  std::vector<double> rows(height, 0);
  std::vector<float> columns;
  for (std::size_t row = 0; row < height; ++row) {
    const auto begin = picture.luminance.begin() + static_cast<std::ptrdiff_t>(row * width);
    const std::vector<double> texels(begin, begin + static_cast<std::ptrdiff_t>(width));
    for (const double texel : texels) rows[row] += texel;
    const std::vector<float> cdf = exact_cdf(texels);
    columns.insert(columns.end(), cdf.begin(), cdf.end());
  }
  std::vector<float> table = exact_cdf(rows);
  table.insert(table.end(), columns.begin(), columns.end());
  return table;
}

class Area final : public Model {
public:
  void describe(preset::Fields& v, preset::Light& light) const override {
    describe_power(v, light);
    describe_position(v, light);
    describe_direction(v, light);
    v.field("size", "Edge lengths.", light.size, {.unit = preset::length_unit, .bounds = preset::length_bounds});
    v.field("up", "Along the second edge, as far as the direction allows.", light.up,
            {.bounds = preset::position_bounds});
    v.field("picture", "A picture: how the light is spread over the rectangle, by luminance; its top is at up.",
            light.picture, {.text = preset::Text::file});
  }

  void load(const preset::Light& from, const Loading& loading, scene::Light& light) const override {
    const Location& where = loading.where;
    if (from.picture)
      light.picture = load_light_picture(loading.finder.find(*from.picture, where / "picture"), loading.warnings);
    const glm::dvec3 direction = scene::unit_direction(scene::to_dvec3(from.direction), where / "direction");
    const glm::dvec3 up = scene::perpendicular_up(from.up, direction, where / "up");
    light.direction = direction;
    light.edge_u = from.size[0] * glm::cross(up, direction);
    light.edge_v = from.size[1] * up;
    load_position(from, loading, light);
  }

  void set_row(const scene::Light& light, shared::DeviceLight& row) const override {
    row.as.area = {scene::to_float4(light.position),         scene::to_float4(light.direction),
                   scene::to_float4(light.edge_u),           scene::to_float4(light.edge_v),
                   light.picture ? light.picture->width : 0, light.picture ? light.picture->height : 0};
  }

  std::vector<float> table(const scene::Light& light, const Surfaces&, shared::DeviceLight&) const override {
    return light.picture ? picture_table(*light.picture) : std::vector<float>();
  }

  bool has_places(const shared::DeviceLight&) const override { return true; }

  glm::dvec3 place(const shared::DeviceLight& row, const float* table, const Surfaces&,
                   std::array<float, 2> u) const override {
    const shared::DeviceArea& area = row.as.area;
    const auto on_rectangle = [&](double x, double y) {
      return vector(area.centre) + (x - 0.5) * vector(area.edge_u) + (y - 0.5) * vector(area.edge_v);
    };
    if (row.table < 0) return on_rectangle(u[0], u[1]);
    const auto width = static_cast<std::size_t>(area.width), height = static_cast<std::size_t>(area.height);
    const auto [line, down] = bin_of(table, height, u[1]);
    const auto [column, along] = bin_of(table + height + line * width, width, u[0]);
    return on_rectangle((static_cast<double>(column) + along) / static_cast<double>(width),
                        1 - (static_cast<double>(line) + down) / static_cast<double>(height));
  }

  std::vector<glm::dvec3> extent(const scene::Scene&, const scene::Light& light) const override {
    std::vector<glm::dvec3> corners;
    for (const glm::vec2& corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)})
      corners.emplace_back(light.position + 0.5f * (corner.x * light.edge_u + corner.y * light.edge_v));
    return corners;
  }

  bool reaches(const scene::Light& light, const scene::Sphere& sphere) const override {
    const glm::dvec3 way = glm::dvec3(sphere.centre) - glm::dvec3(light.position);
    constexpr double margin = 1e-4; // kernels compute directions in single precision
    return glm::dot(way, glm::dvec3(light.direction)) + sphere.radius + margin * glm::length(way) > 0;
  }

  double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres, double) const override {
    return surface_towards_w(light, spheres);
  }

  std::optional<Punctual> punctual(const scene::Light&) const override { return std::nullopt; }

  std::string_view left_out(const scene::Light& light) const override {
    return light.picture ? no_pattern : std::string_view();
  }
};

} // namespace

const Model& area() {
  static const Area made;
  return made;
}

} // namespace nephroid::lights
