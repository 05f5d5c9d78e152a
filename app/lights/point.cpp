// SPDX-License-Identifier: Apache-2.0
// A point, even or with photometry.
#include "lights/lights.h"

#include "optics/colour.h"
#include "preset/meters.h"
#include "scene/directions.h"
#include "scene/photometry.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

namespace nephroid::lights {
namespace {

using std::numbers::pi;

constexpr std::size_t gammas = PHOTOMETRY_GAMMAS, planes = PHOTOMETRY_PLANES;

double degrees(double radians) { return radians * 180 / pi; }
double gamma_of(std::size_t step) { return pi * static_cast<double>(step) / (gammas - 1); }
double c_of(std::size_t plane) { return 2 * pi * static_cast<double>(plane) / (planes - 1); }

/// The steradians of a direction of the table: what its value adds to the integral of what kernels interpolate, which
/// is linear in gamma and C. With h between two steps the hat about gamma times sin(gamma) is sin(gamma) (2 - 2 cos h)
/// / h, at a pole 1 - sin(h) / h.
double steradians(std::size_t step, std::size_t plane) {
  const double h = gamma_of(1);
  const bool pole = step == 0 || step == gammas - 1, end = plane == 0 || plane == planes - 1;
  return (pole ? 1 - std::sin(h) / h : std::sin(gamma_of(step)) * (2 - 2 * std::cos(h)) / h) * c_of(1) *
         (end ? 0.5 : 1);
}

/// [plane][gamma] over the mean of all directions.
std::vector<float> even_steps(const scene::Photometry& photometry) {
  std::vector<double> values;
  double sum = 0;
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (std::size_t step = 0; step < gammas; ++step) {
      values.push_back(scene::intensity(photometry, degrees(gamma_of(step)), degrees(c_of(plane))));
      sum += values.back() * steradians(step, plane);
    }
  if (!(sum > 0))
    throw bad_input(photometry.file.string(), "shines nowhere in steps of half a degree", "expected a wider beam");
  std::vector<float> table;
  for (const double value : values) table.push_back(static_cast<float>(value * 4 * pi / sum));
  return table;
}

/// The part of its light that goes towards the spheres, or somewhat more.
double photometric_share(const scene::Light& light, const std::vector<scene::Sphere>& targets) {
  const std::vector<float> table = even_steps(*light.photometry);
  const double cell = gamma_of(1) + c_of(1); // no direction is farther from one of the table
  double share = 0;
  for (const scene::Sphere& target : targets) {
    const glm::dvec3 way = glm::dvec3(target.centre) - glm::dvec3(light.position);
    const double distance = glm::length(way), radius = target.radius;
    if (distance <= radius) return 1;
    const double half_angle = std::asin(radius / distance), least_cosine = std::cos(std::min(half_angle + cell, pi));
    double sum = 0, brightest = 0;
    for (std::size_t plane = 0; plane < planes; ++plane)
      for (std::size_t step = 0; step < gammas; ++step) {
        const double gamma = gamma_of(step), c = c_of(plane);
        const glm::dvec3 direction =
            std::cos(gamma) * glm::dvec3(light.direction) +
            std::sin(gamma) * (std::cos(c) * glm::dvec3(light.edge_u) + std::sin(c) * glm::dvec3(light.edge_v));
        if (glm::dot(direction, way) < least_cosine * distance) continue;
        const double value = table[plane * gammas + step];
        sum += value * steradians(step, plane) / (4 * pi);
        brightest = std::max(brightest, value);
      }
    share += std::min(sum, brightest * std::pow(std::sin(half_angle / 2), 2)); // (1 - cos) / 2 of the sphere
  }
  return std::min(share, 1.0);
}

/// What an earlier light has of the same file; null: none has.
std::shared_ptr<const scene::Photometry> shared_photometry(const scene::Scene& scene,
                                                           const std::filesystem::path& file) {
  for (const scene::Light& light : scene.lights)
    if (light.photometry && light.photometry->file == file) return light.photometry;
  return nullptr;
}

class Point final : public Model {
public:
  void describe(preset::Fields& v, preset::Light& light) const override {
    describe_power(v, light);
    describe_position(v, light);
    v.field("photometry",
            "An IES (LM-63) or EULUMDAT file: how the light is spread over directions. power_w is all of it, unless "
            "file_lumens is true.",
            light.photometry, {.text = preset::Text::file});
    v.field("file_lumens", "With photometry: take the file's own lumens, whatever power_w says.", light.file_lumens);
    v.field("direction", "With photometry: where the file's gamma = 0, straight down, is; any length but 0.",
            light.direction, {.bounds = preset::position_bounds});
    v.field("up", "With photometry: where the file's plane C = 0 is, as far as the direction allows.", light.up,
            {.bounds = preset::position_bounds});
  }

  void load(const preset::Light& from, const Loading& loading, scene::Light& light) const override {
    if (from.photometry) {
      const Location& where = loading.where;
      const std::filesystem::path file = loading.finder.find(*from.photometry, where / "photometry");
      light.photometry = shared_photometry(loading.scene, file);
      if (!light.photometry) light.photometry = std::make_shared<const scene::Photometry>(scene::load_photometry(file));
      light.direction = scene::unit_direction(scene::to_dvec3(from.direction), where / "direction");
      light.edge_u = scene::perpendicular_up(from.up, light.direction, where / "up");
      light.edge_v = glm::cross(light.edge_u, light.direction); // counterclockwise from C = 0, seen from behind
    }
    load_position(from, loading, light);
    if (!from.file_lumens) return;
    const Location field = loading.where / "file_lumens";
    if (!light.photometry)
      throw bad_input(field, "is true without a photometric file", "expected 'photometry' beside it");
    if (!(light.photometry->lumens > 0))
      throw bad_input(field, "is true, and the file does not say its lumens", "expected one set of lamps with lumens",
                      "leave it out, and set power_w");
    const optics::Spectrum& y = optics::power_and_luminance(loading.scene.range).y;
    light.power_w = light.photometry->lumens / preset::lumens_per_watt /
                    std::inner_product(y.begin(), y.end(), light.spectrum.begin(), 0.0);
  }

  void set_row(const scene::Light& light, shared::DeviceLight& row) const override {
    row.as.point = {scene::to_float4(light.position), scene::to_float4(light.direction), scene::to_float4(light.edge_u),
                    scene::to_float4(light.edge_v)};
  }

  std::vector<float> table(const scene::Light& light, const Surfaces&, shared::DeviceLight&) const override {
    return light.photometry ? even_steps(*light.photometry) : std::vector<float>();
  }

  glm::dvec3 place(const shared::DeviceLight& row, const float*, const Surfaces&, std::array<float, 2>) const override {
    return vector(row.as.point.position);
  }

  double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres,
                   double metres_per_unit) const override {
    return light.photometry ? light.power_w * photometric_share(light, spheres)
                            : Model::towards_w(light, spheres, metres_per_unit);
  }

  std::string_view left_out(const scene::Light& light) const override {
    return light.photometry ? no_pattern : std::string_view();
  }
};

} // namespace

const Model& point() {
  static const Point made;
  return made;
}

} // namespace nephroid::lights
