// SPDX-License-Identifier: Apache-2.0
#include "photons/pixel_surfaces.h"

#include "base/parallel.h"
#include "scene/ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>

namespace nephroid::photons {
namespace {

constexpr std::size_t middle = optics::wavelength_count / 2;

struct SurfaceHit {
  int object;
  glm::dvec3 position, geometric, shading; ///< outward unit normals; alike unless the object is smooth
  std::uint32_t primitive;
};

class CameraRay {
public:
  CameraRay(const scene::Scene& scene, const scene::Bvh& bvh, const glm::dvec3& from, const glm::dvec3& way)
      : scene_(scene), bvh_(bvh), from_(from), way_(way), inside_(scene.camera.inside) {}

  /// Moves on to the next surface; empty where there is none.
  std::optional<SurfaceHit> next() {
    const auto hit = scene::closest_hit(bvh_, from_, way_, {}, std::numeric_limits<double>::infinity(), left_);
    if (!hit) return std::nullopt;
    length_ += hit->t;
    from_ += hit->t * way_;
    left_ = hit->primitive;
    return hit_on(hit->primitive);
  }

  void reflect(const SurfaceHit& hit) { bend(hit, std::nullopt); }

  /// Passes the surface of glass, or is totally reflected there (kernels/scatter/dielectric.h). False
  /// where both sides have one index of refraction, so that the surface is invisible.
  bool cross(const SurfaceHit& hit) {
    std::vector<int> beyond = inside_;
    int near = medium_of(inside_);
    const auto entry = std::find(beyond.rbegin(), beyond.rend(), hit.object);
    if (glm::dot(way_, hit.geometric) < 0)
      beyond.push_back(hit.object);
    else if (entry != beyond.rend())
      beyond.erase(std::next(entry).base());
    else
      near = hit.object; // an open mesh: the ray got in without meeting its surface
    const double ratio = index_of(near) / index_of(medium_of(beyond));
    if (ratio == 1 || bend(hit, ratio)) inside_ = std::move(beyond);
    return ratio != 1;
  }

  const glm::dvec3& way() const { return way_; }
  double length() const { return length_; }

private:
  SurfaceHit hit_on(std::uint32_t primitive) const {
    const std::size_t triangles = scene_.geometry.triangles.size();
    const auto object = static_cast<int>(scene_.object_of_primitive[primitive]);
    if (primitive >= triangles) {
      const glm::dvec3 normal = normal_at(scene_.geometry.ellipsoids[primitive - triangles], from_);
      return {object, from_, normal, normal, primitive};
    }
    const glm::uvec3 corner = scene_.geometry.triangles[primitive];
    const std::vector<glm::vec3>&at = scene_.geometry.positions, &normals = scene_.geometry.normals;
    const glm::dvec3 a(at[corner.x]), b(at[corner.y]), c(at[corner.z]), across = glm::cross(b - a, c - a);
    SurfaceHit hit{object, from_, glm::normalize(across), {}, primitive};
    hit.shading = hit.geometric;
    if (!scene_.objects[static_cast<std::size_t>(hit.object)].smooth) return hit;
    const double u = glm::dot(glm::cross(a - c, from_ - c), across) / glm::dot(across, across),
                 v = glm::dot(glm::cross(b - a, from_ - a), across) / glm::dot(across, across);
    const glm::dvec3 mixed = (1 - u - v) * glm::dvec3(normals[corner.x]) + u * glm::dvec3(normals[corner.y]) +
                             v * glm::dvec3(normals[corner.z]);
    if (glm::dot(mixed, hit.geometric) > 0) hit.shading = glm::normalize(mixed);
    return hit;
  }

  /// The object whose material fills the place: that of highest priority, of equals the one entered last; -1: air.
  int medium_of(const std::vector<int>& inside) const {
    int best = -1;
    for (const int object : inside)
      if (best < 0 || scene_.objects[static_cast<std::size_t>(object)].priority >=
                          scene_.objects[static_cast<std::size_t>(best)].priority)
        best = object;
    return best;
  }

  double index_of(int object) const {
    if (object < 0) return 1;
    return material_of(scene_, scene_.objects[static_cast<std::size_t>(object)]).n[middle];
  }

  /// Bends the ray about the shading normal, or about the triangle's own where that would send it to the wrong side.
  /// ratio is that of the indices before and beyond glass; empty: a mirror. True where the ray went through.
  bool bend(const SurfaceHit& hit, std::optional<double> ratio) {
    const double side = glm::dot(way_, hit.geometric) < 0 ? 1 : -1;
    for (const glm::dvec3& normal : {side * hit.shading, side * hit.geometric}) {
      if (glm::dot(way_, normal) >= 0) continue;
      const glm::dvec3 refracted = ratio ? glm::refract(way_, normal, *ratio) : glm::dvec3(0); // 0: totally reflected
      const bool through = refracted != glm::dvec3(0);
      const glm::dvec3 bent = through ? refracted : glm::reflect(way_, normal);
      if ((side * glm::dot(bent, hit.geometric) < 0) != through) continue;
      way_ = glm::normalize(bent);
      return through;
    }
    return false; // along the triangle: straight on
  }

  const scene::Scene& scene_;
  const scene::Bvh& bvh_;
  glm::dvec3 from_, way_;
  std::vector<int> inside_;                  ///< the dielectric objects around `from_`, the one entered last at the end
  std::uint32_t left_ = scene::no_primitive; ///< primitive that the ray leaves
  double length_ = 0;
};

/// A place as the camera sees it: x and y in pixels, times z; z along the view.
using Seen = glm::dvec3;

class Marks {
public:
  explicit Marks(const scene::Camera& camera) : camera_(camera), marked_(camera.pixels()) {}

  Seen see(const glm::dvec3& hit) const {
    const glm::dvec3 way = hit - glm::dvec3(camera_.position);
    const double z = glm::dot(way, glm::dvec3(camera_.forward)),
                 x = glm::dot(way, glm::dvec3(camera_.right)) / camera_.tan_x,
                 y = glm::dot(way, glm::dvec3(camera_.up)) / camera_.tan_y;
    return {(x + z) / 2 * camera_.width, (z - y) / 2 * camera_.height, z};
  }

  /// Marks, row by row, what lies between a triangle's sides, and what its outline touches.
  void mark(const std::array<Seen, 3>& corners) {
    // The part before the eye: what is nearer than a ten thousandth of the farthest corner is beside it.
    const double farthest = std::max({corners[0].z, corners[1].z, corners[2].z}), near = 1e-4 * farthest;
    if (!(farthest > 0)) return;
    points_.clear();
    for (std::size_t i = 0; i < 3; ++i) {
      const Seen &a = corners[i], &b = corners[(i + 1) % 3];
      if (a.z >= near) points_.push_back(a);
      if ((a.z >= near) != (b.z >= near)) points_.push_back(a + (near - a.z) / (b.z - a.z) * (b - a));
    }
    for (Seen& p : points_) p = {p.x / p.z, p.y / p.z, 1};
    const auto [top, bottom] =
        std::ranges::minmax_element(points_, [](const Seen& a, const Seen& b) { return a.y < b.y; });
    for (int row = index(top->y - margin, camera_.height); row <= index(bottom->y + margin, camera_.height); ++row)
      mark_row(row);
  }

  /// Marks a ball of triangles just outside of an ellipsoid. Facets of 1/32 of a turn each way come within
  /// cos^2(pi / 32) = 0.9904 of their corners' distance to the middle.
  void mark(const scene::Ellipsoid& ellipsoid) {
    constexpr int around = 32;
    constexpr double angle = 2 * std::numbers::pi / around, scale = 1.01;
    const auto corner = [&](int ring, int i) {
      const double polar = ring * angle, turn = i * angle;
      glm::dvec3 hit = ellipsoid.centre;
      hit += scale * std::cos(polar) * glm::dvec3(ellipsoid.half_axes[1]);
      hit += scale * std::sin(polar) * std::cos(turn) * glm::dvec3(ellipsoid.half_axes[0]);
      return see(hit + scale * std::sin(polar) * std::sin(turn) * glm::dvec3(ellipsoid.half_axes[2]));
    };
    for (int ring = 0; ring < around / 2; ++ring)
      for (int i = 0; i < around; ++i) {
        mark(std::array{corner(ring, i), corner(ring + 1, i), corner(ring + 1, i + 1)});
        mark(std::array{corner(ring, i), corner(ring + 1, i + 1), corner(ring, i + 1)});
      }
  }

  const std::vector<std::uint8_t>& marked() const { return marked_; }

private:
  /// A margin in pixels, as kernels decide in single precision which pixel a path belongs to.
  static constexpr double margin = 0.01;

  static int index(double at, int size) { return static_cast<int>(std::clamp(std::floor(at), 0.0, size - 1.0)); }

  /// Marks the part of the outline within the row's height, from the leftmost to the rightmost pixel.
  void mark_row(int row) {
    const double top = row - margin, bottom = row + 1 + margin;
    double left = std::numeric_limits<double>::max(), right = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Seen &a = points_[i], &b = points_[(i + 1) % points_.size()];
      if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
      for (const double y : {std::clamp(a.y, top, bottom), std::clamp(b.y, top, bottom)}) {
        const double x = a.y == b.y ? (y == a.y ? a.x : b.x) : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        left = std::min({left, x, a.y == b.y ? b.x : x});
        right = std::max({right, x, a.y == b.y ? b.x : x});
      }
    }
    if (right + margin < 0 || left - margin > camera_.width) return;
    const auto first = static_cast<std::ptrdiff_t>(row) * camera_.width;
    std::fill(marked_.begin() + first + index(left - margin, camera_.width),
              marked_.begin() + first + index(right + margin, camera_.width) + 1, std::uint8_t{1});
  }

  const scene::Camera& camera_;
  std::vector<std::uint8_t> marked_; ///< a pixel; not zero: it is
  std::vector<Seen> points_;
};

} // namespace

PixelSurfaces surfaces_of_pixel(const scene::Scene& scene, const scene::Bvh& bvh, const scene::Camera& camera,
                                int column, int row, int most_surfaces) {
  const double x = 2 * (column + 0.5) / camera.width - 1, y = 1 - 2 * (row + 0.5) / camera.height;
  const auto [eye, way] = camera.ray(x, y);
  const double spacing = 2 * std::max(camera.tan_x / camera.width, camera.tan_y / camera.height) / glm::length(way);
  PixelSurfaces surfaces;
  if (camera.receiver >= 0) {
    const scene::Object& receiver = scene.objects[static_cast<std::size_t>(camera.receiver)];
    const glm::dvec3 corner = scene.geometry.positions[scene::triangles_of(scene, receiver).front().x];
    const double distance = glm::dot(corner - eye, glm::dvec3(camera.forward));
    surfaces.first = surfaces.last = {glm::vec3(eye + distance * way), -camera.forward, camera.receiver, 0};
    surfaces.way = glm::vec3(glm::normalize(way));
    surfaces.spacing = static_cast<float>(spacing * glm::length(way) * distance);
    return surfaces;
  }
  CameraRay ray(scene, bvh, eye, glm::normalize(way));
  for (int surface = 0; surface < most_surfaces; ++surface) {
    const std::optional<SurfaceHit> hit = ray.next();
    if (!hit) break;
    const scene::Object& object = scene.objects[static_cast<std::size_t>(hit->object)];
    const scatter::Material& material = material_of(scene, object);
    const bool matt = is_matt(material.type);
    const glm::dvec3 arrives = ray.way();
    if (is_refractive(material.type)) {
      const bool bends = !material.thin && ray.cross(*hit); // most of the light passes a pane
      if (!bends && !is_textured(material)) continue;
    } else if (!matt)
      ray.reflect(*hit);
    const bool is_first = surfaces.first.object < 0;
    if (is_first || matt) {
      surfaces.last = {glm::vec3(hit->position), glm::vec3(hit->geometric), hit->object, hit->primitive};
      surfaces.way = glm::vec3(arrives);
      surfaces.spacing = static_cast<float>(spacing * (camera.orthographic ? 1 : ray.length()));
    }
    if (is_first) surfaces.first = surfaces.last;
    if (matt) break;
  }
  return surfaces;
}

std::vector<std::uint32_t> glass_pixels(const scene::Scene& scene) {
  if (scene.camera.receiver >= 0 || scene.camera.meter) return {};
  std::vector<std::uint8_t> marked(scene.camera.pixels());
  std::mutex mutex;
  const auto take = [&](const Marks& marks) {
    const std::lock_guard lock(mutex);
    std::ranges::transform(marked, marks.marked(), marked.begin(), std::bit_or());
  };
  Marks few(scene.camera);
  const auto mark = [&](Marks& marks, std::span<const glm::uvec3> triangles) {
    for (const glm::uvec3& triangle : triangles) {
      const auto seen = [&](std::uint32_t vertex) { return marks.see(scene.geometry.positions[vertex]); };
      marks.mark(std::array{seen(triangle.x), seen(triangle.y), seen(triangle.z)});
    }
  };
  for (const scene::Object& object : scene.objects) {
    if (!is_specular(material_of(scene, object).type)) continue;
    const std::span triangles = scene::triangles_of(scene, object);
    constexpr std::size_t block_size = 1 << 16;
    if (triangles.size() <= block_size)
      mark(few, triangles);
    else
      for_ranges(triangles.size(), block_size, [&](std::size_t, Range range) {
        Marks marks(scene.camera);
        mark(marks, triangles.subspan(range.begin, range.end - range.begin));
        take(marks);
      });
    for (const scene::Ellipsoid& ellipsoid : scene::ellipsoids_of(scene, object)) few.mark(ellipsoid);
  }
  take(few);
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0 || !scene.camera.inside.empty() || !scene.camera.is_plain())
      pixels.push_back(static_cast<std::uint32_t>(i));
  return pixels;
}

} // namespace nephroid::photons
