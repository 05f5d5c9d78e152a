// SPDX-License-Identifier: Apache-2.0
#include "spectral/smoothing.h"

#include "base/parallel.h"
#include "scene/ray.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::spectral {
namespace {

/// How far a kernel may reach, and how far around a pixel its noise is asked for, in pixels.
constexpr int reach = 6, noise_reach = 7;

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

/// A plane of numbers added up from its corner, so that the sum over any rectangle is four of them (Crow 1984, "Summed-area tables").
class SummedArea {
public:
  SummedArea(std::span<const double> values, int width, int height) : width_(width), height_(height), table_(index(width, height) + 1)
  {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        table_[index(x + 1, y + 1)] = values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] +
                                      table_[index(x, y + 1)] + table_[index(x + 1, y)] - table_[index(x, y)];
  }
  /// Over the square that reaches r from (x, y), cut at the edges.
  double around(int x, int y, int r) const
  {
    const int x0 = std::max(x - r, 0), x1 = std::min(x + r + 1, width_), y0 = std::max(y - r, 0), y1 = std::min(y + r + 1, height_);
    return table_[index(x1, y1)] - table_[index(x0, y1)] - table_[index(x1, y0)] + table_[index(x0, y0)];
  }

private:
  std::size_t index(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<double> table_;
};

/// What a photon is worth around each pixel, as a mean of R, G and B: Poisson noise has the variance mean times worth. 0 in the dark.
std::vector<double> photon_worth(std::span<const double> light, std::span<const float> error_draw, int width, int height)
{
  std::vector<double> variance(light.size());
  for (std::size_t i = 0; i < error_draw.size(); ++i) variance[i / 3] += std::pow(static_cast<double>(error_draw[i]), 2) / 3;
  const SummedArea lights(light, width, height), variances(variance, width, height);
  std::vector<double> worth(light.size());
  for (std::size_t i = 0; i < worth.size(); ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double near = lights.around(x, y, noise_reach);
    worth[i] = near > 0 ? std::max(variances.around(x, y, noise_reach), 0.0) / near : 0;
  }
  return worth;
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
      const double x = static_cast<double>(static_cast<int>(i) % width_) + 0.5, y = static_cast<double>(static_cast<int>(i) / width_) + 0.5;
      const glm::dvec3 way = forward + (2 * x / width_ - 1) * camera.tan_x * right + (1 - 2 * y / height_) * camera.tan_y * up;
      const auto hit = scene::closest_hit(bvh, eye, way);
      if (!hit) continue;
      const glm::uvec3 corners = scene.geometry.triangles[hit->triangle];
      const std::vector<glm::vec3>& at = scene.geometry.positions;
      const glm::dvec3 a(at[corners.x]), b(at[corners.y]), c(at[corners.z]);
      seen_[i] = {glm::vec3(eye + hit->t * way), glm::vec3(glm::normalize(glm::cross(b - a, c - a))),
                  static_cast<int>(scene.object_of_triangle[hit->triangle])};
    }
  });
}

std::uint64_t Smoothing::bytes(const scene::Camera& camera)
{
  return sizeof(Seen) * static_cast<std::uint64_t>(camera.width) * static_cast<std::uint64_t>(camera.height);
}

bool Smoothing::are_level(const Seen& a, const Seen& b)
{
  if (a.object != b.object || a.object < 0) return false;
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
  const std::vector<double> worth = photon_worth(light, error_draw, width_, height_);
  std::vector<float> rgb_spread(rgb.size()), draw_spread(rgb.size());
  Kernel kernel;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const auto is_zero = [i](const std::vector<float>& v) { return v[3 * i] == 0 && v[3 * i + 1] == 0 && v[3 * i + 2] == 0; };
    if (is_zero(rgb) && is_zero(error_draw)) continue;
    find_kernel(i, enough_photons * worth[i], light, kernel);
    const std::size_t size = kernel.pixels.size();
    const auto all = static_cast<double>(kernel.inside) + kernel.ring_weight * static_cast<double>(size - kernel.inside);
    for (std::size_t k = 0; k < size; ++k) {
      const auto part = static_cast<float>((k < kernel.inside ? 1 : kernel.ring_weight) / all);
      const std::size_t j = kernel.pixels[k];
      for (std::size_t c = 0; c < 3; ++c) {
        rgb_spread[3 * j + c] += part * rgb[3 * i + c];
        draw_spread[3 * j + c] += part * error_draw[3 * i + c];
      }
    }
  }
  rgb = std::move(rgb_spread);
  error_draw = std::move(draw_spread);
}

} // namespace nephroid::spectral
