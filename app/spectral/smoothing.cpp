// SPDX-License-Identifier: Apache-2.0
#include "spectral/smoothing.h"

#include "base/parallel.h"
#include "base/summed_area.h"
#include "scene/ray.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace nephroid::spectral {
namespace {

/// How far a kernel may reach, and how far around a pixel its noise is asked for, in pixels.
constexpr int reach = 6, noise_reach = 7;
constexpr std::size_t block_rows = 64;

/// Surfaces that are looked at, one mirror after the other.
constexpr int most_mirrors = 8;

/// Two pixels are on one nearly flat part where their normals and the way between them are within about 25 and 30 degrees of it.
constexpr float least_cosine = 0.9f, most_rise = 0.5f;

struct Offset {
  int x, y;
  int distance2() const { return x * x + y * y; }
};

/// The pixels within reach, nearest first.
const std::vector<Offset>& offsets()
{
  static const std::vector<Offset> all = [] {
    std::vector<Offset> made;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if (x * x + y * y <= reach * reach) made.push_back({x, y});
    std::stable_sort(made.begin(), made.end(), [](const Offset& a, const Offset& b) { return a.distance2() < b.distance2(); });
    return made;
  }();
  return all;
}

/// Variance over light around each pixel, means of R, G and B: of light that comes in equal portions, one portion. 0 in the dark.
std::vector<double> portions(std::span<const double> light, std::span<const float> error_draw, int width, int height)
{
  const SummedArea lights(width, height, [&](std::size_t i) { return light[i]; });
  const SummedArea variances(width, height, [&](std::size_t i) {
    const double r = error_draw[3 * i], g = error_draw[3 * i + 1], b = error_draw[3 * i + 2];
    return (r * r + g * g + b * b) / 3;
  });
  std::vector<double> portion(light.size());
  for (std::size_t i = 0; i < portion.size(); ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double near = lights.mean(x, y, noise_reach);
    portion[i] = near > 0 ? std::max(variances.mean(x, y, noise_reach), 0.0) / near : 0;
  }
  return portion;
}

} // namespace

Smoothing::Smoothing(const scene::Scene& scene, const scene::Bvh& bvh)
    : width_(scene.camera.width), height_(scene.camera.height),
      seen_(static_cast<std::size_t>(scene.camera.width) * static_cast<std::size_t>(scene.camera.height))
{
  const scene::Camera& camera = scene.camera;
  const glm::dvec3 eye(camera.position), right(camera.right), up(camera.up), forward(camera.forward);
  for_ranges(seen_.size(), 1 << 12, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const int column = static_cast<int>(i) % width_, row = static_cast<int>(i) / width_;
      const double x = column + 0.5, y = row + 0.5;
      const glm::dvec3 way = forward + (2 * x / width_ - 1) * camera.tan_x * right + (1 - 2 * y / height_) * camera.tan_y * up;
      seen_[i] = look(scene, bvh, eye, way);
    }
  });
  find_edges();
}

Smoothing::Seen Smoothing::look(const scene::Scene& scene, const scene::Bvh& bvh, glm::dvec3 from, glm::dvec3 way)
{
  Seen seen;
  std::optional<std::uint32_t> left; // the triangle that the ray leaves
  for (int surface = 0; surface < most_mirrors; ++surface) {
    const auto hit =
        left ? scene::closest_hit(bvh, from, way, [&](std::uint32_t t) { return t != *left; }) : scene::closest_hit(bvh, from, way);
    if (!hit) return {glm::vec3(0), glm::vec3(0), seen.first};
    const glm::uvec3 corners = scene.geometry.triangles[hit->triangle];
    const std::vector<glm::vec3>& at = scene.geometry.positions;
    const glm::dvec3 a(at[corners.x]), b(at[corners.y]), c(at[corners.z]), normal = glm::normalize(glm::cross(b - a, c - a));
    from += hit->t * way;
    seen.position = glm::vec3(from);
    seen.normal = glm::vec3(normal);
    seen.object = static_cast<int>(scene.object_of_triangle[hit->triangle]);
    if (surface == 0) seen.first = seen.object;
    const scene::Object& object = scene.objects[static_cast<std::size_t>(seen.object)];
    if (scene.materials[static_cast<std::size_t>(object.material)].type != scene::Material::Type::mirror) break;
    way = glm::reflect(way, normal);
    left = hit->triangle;
  }
  return seen;
}

void Smoothing::find_edges()
{
  const auto differ = [&](std::size_t i, std::size_t j) {
    if (seen_[i].first == seen_[j].first && seen_[i].object == seen_[j].object) return;
    seen_[i].at_edge = seen_[j].at_edge = true;
  };
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      if (x + 1 < width) differ(i, i + 1);
      if (y + 1 < height) differ(i, i + width);
      if (x + 1 < width && y + 1 < height) differ(i, i + width + 1), differ(i + 1, i + width);
    }
}

std::uint64_t Smoothing::bytes(const scene::Camera& camera)
{
  return sizeof(Seen) * static_cast<std::uint64_t>(camera.width) * static_cast<std::uint64_t>(camera.height);
}

bool Smoothing::are_level(const Seen& a, const Seen& b)
{
  if (a.first != b.first || a.object != b.object || a.at_edge != b.at_edge || a.object < 0) return false;
  const glm::vec3 way = b.position - a.position;
  return glm::dot(a.normal, b.normal) > least_cosine && std::abs(glm::dot(way, a.normal + b.normal)) <= 2 * most_rise * glm::length(way);
}

void Smoothing::find_kernel(std::size_t i, double wanted, std::span<const double> light, Kernel& kernel) const
{
  const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
  kernel.pixels.clear();
  kernel.inside = 0;
  kernel.ring_weight = 1;
  double inside = 0, ring = 0;
  int distance2 = 0;
  for (const Offset& o : offsets()) {
    if (o.distance2() > distance2) {
      if (inside + ring >= wanted) break;
      inside += std::exchange(ring, 0);
      kernel.inside = kernel.pixels.size();
      distance2 = o.distance2();
    }
    const int u = x + o.x, v = y + o.y;
    if (u < 0 || u >= width_ || v < 0 || v >= height_) continue;
    const std::size_t j = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
    if (j != i && !are_level(seen_[i], seen_[j])) continue;
    kernel.pixels.push_back(j);
    ring += light[j];
  }
  if (kernel.inside > 0 && ring > 0) kernel.ring_weight = std::clamp((wanted - inside) / ring, 0.0, 1.0);
}

void Smoothing::spread(std::vector<float>& rgb, std::vector<float>& error_draw) const
{
  if (error_draw.empty()) return;
  std::vector<double> light(seen_.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) light[i / 3] += std::max(static_cast<double>(rgb[i]), 0.0) / 3;
  const std::vector<double> portion = portions(light, error_draw, width_, height_);
  std::vector<float> rgb_spread(rgb.size()), draw_spread(rgb.size());
  const auto is_zero = [](const std::vector<float>& v, std::size_t i) { return v[3 * i] == 0 && v[3 * i + 1] == 0 && v[3 * i + 2] == 0; };
  // A block of rows takes what all pixels within reach of it spread, in their order: the same bits on any number of cores.
  for_ranges(static_cast<std::size_t>(height_), block_rows, [&](std::size_t, Range rows) {
    const std::size_t width = static_cast<std::size_t>(width_), first = rows.begin * width, end = rows.end * width;
    const std::size_t from = (rows.begin - std::min<std::size_t>(rows.begin, reach)) * width;
    const std::size_t to = std::min<std::size_t>(rows.end + reach, static_cast<std::size_t>(height_)) * width;
    Kernel kernel;
    for (std::size_t i = from; i < to; ++i) {
      if (is_zero(rgb, i) && is_zero(error_draw, i)) continue;
      // Of n portions the noise is 1 / sqrt(n).
      find_kernel(i, portion[i] / (noise * noise), light, kernel);
      const std::size_t size = kernel.pixels.size();
      const auto all = static_cast<double>(kernel.inside) + kernel.ring_weight * static_cast<double>(size - kernel.inside);
      for (std::size_t k = 0; k < size; ++k) {
        const std::size_t j = kernel.pixels[k];
        if (j < first || j >= end) continue;
        const auto part = static_cast<float>((k < kernel.inside ? 1 : kernel.ring_weight) / all);
        for (std::size_t c = 0; c < 3; ++c) {
          rgb_spread[3 * j + c] += part * rgb[3 * i + c];
          draw_spread[3 * j + c] += part * error_draw[3 * i + c];
        }
      }
    }
  });
  rgb = std::move(rgb_spread);
  error_draw = std::move(draw_spread);
}

} // namespace nephroid::spectral
