// SPDX-License-Identifier: Apache-2.0
#include "spectral/sight.h"

#include "optics/wavelength.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::spectral {
namespace {

constexpr int most_surfaces = 32;
constexpr std::size_t middle = optics::wavelength_count / 2;

using Type = scene::Material::Type;

/// A place on a surface.
struct Place {
  int object;
  glm::dvec3 position, geometric, shading; ///< normals: unit, outwards; alike unless the object is smooth
};

class Look {
public:
  Look(const scene::Scene& scene, const scene::Bvh& bvh, const glm::dvec3& way)
      : scene_(scene), bvh_(bvh), from_(scene.camera.position), way_(way), inside_(scene.camera.inside)
  {
  }

  /// Goes on to the next surface; empty where there is none.
  std::optional<Place> next()
  {
    const auto hit = scene::closest_hit(bvh_, from_, way_, {}, std::numeric_limits<double>::infinity(), left_);
    if (!hit) return std::nullopt;
    length_ += hit->t;
    from_ += hit->t * way_;
    left_ = hit->primitive;
    return place_on(hit->primitive);
  }

  /// Is sent back by a mirror.
  void reflect(const Place& place) { bend(place, std::nullopt); }

  /// Passes the surface of glass, or is totally reflected there (cross_interface in kernels/tracing/interface.h). False where there is
  /// nothing to see: both sides have one index of refraction.
  bool cross(const Place& place)
  {
    std::vector<int> beyond = inside_;
    int near = medium_of(inside_);
    const auto entry = std::find(beyond.rbegin(), beyond.rend(), place.object);
    if (glm::dot(way_, place.geometric) < 0)
      beyond.push_back(place.object);
    else if (entry != beyond.rend())
      beyond.erase(std::next(entry).base());
    else
      near = place.object; // an open mesh: the look got in without meeting its surface
    const double ratio = index_of(near) / index_of(medium_of(beyond));
    if (ratio == 1 || bend(place, ratio)) inside_ = std::move(beyond);
    return ratio != 1;
  }

  const glm::dvec3& way() const { return way_; }
  double length() const { return length_; }

private:
  Place place_on(std::uint32_t primitive) const
  {
    const std::size_t triangles = scene_.geometry.triangles.size();
    const auto object = static_cast<int>(scene_.object_of_primitive[primitive]);
    if (primitive >= triangles) {
      const glm::dvec3 normal = normal_at(scene_.geometry.ellipsoids[primitive - triangles], from_);
      return {object, from_, normal, normal};
    }
    const glm::uvec3 corner = scene_.geometry.triangles[primitive];
    const std::vector<glm::vec3>&at = scene_.geometry.positions, &normals = scene_.geometry.normals;
    const glm::dvec3 a(at[corner.x]), b(at[corner.y]), c(at[corner.z]), across = glm::cross(b - a, c - a);
    Place place{object, from_, glm::normalize(across), {}};
    place.shading = place.geometric;
    if (!scene_.objects[static_cast<std::size_t>(place.object)].smooth) return place;
    const double u = glm::dot(glm::cross(a - c, from_ - c), across) / glm::dot(across, across),
                 v = glm::dot(glm::cross(b - a, from_ - a), across) / glm::dot(across, across);
    const glm::dvec3 mixed =
        (1 - u - v) * glm::dvec3(normals[corner.x]) + u * glm::dvec3(normals[corner.y]) + v * glm::dvec3(normals[corner.z]);
    if (glm::dot(mixed, place.geometric) > 0) place.shading = glm::normalize(mixed);
    return place;
  }

  /// The object whose material fills the place: the highest priority, of equals the one entered last; -1: air.
  int medium_of(const std::vector<int>& inside) const
  {
    int best = -1;
    for (const int object : inside)
      if (best < 0 || scene_.objects[static_cast<std::size_t>(object)].priority >= scene_.objects[static_cast<std::size_t>(best)].priority)
        best = object;
    return best;
  }

  double index_of(int object) const
  {
    if (object < 0) return 1;
    return material_of(scene_, scene_.objects[static_cast<std::size_t>(object)]).n[middle];
  }

  /// ratio: of the indices before and beyond glass; empty: a mirror. About the shading normal, unless that sends the look to the wrong side
  /// of the triangle: then about the triangle's own. True where it went through.
  bool bend(const Place& place, std::optional<double> ratio)
  {
    const double side = glm::dot(way_, place.geometric) < 0 ? 1 : -1;
    for (const glm::dvec3& normal : {side * place.shading, side * place.geometric}) {
      if (glm::dot(way_, normal) >= 0) continue;
      const glm::dvec3 refracted = ratio ? glm::refract(way_, normal, *ratio) : glm::dvec3(0); // 0: totally reflected
      const bool through = refracted != glm::dvec3(0);
      const glm::dvec3 bent = through ? refracted : glm::reflect(way_, normal);
      if ((side * glm::dot(bent, place.geometric) < 0) != through) continue;
      way_ = glm::normalize(bent);
      return through;
    }
    return false; // along the triangle: straight on
  }

  const scene::Scene& scene_;
  const scene::Bvh& bvh_;
  glm::dvec3 from_, way_;
  std::vector<int> inside_;                  ///< the dielectric objects around `from_`, the one entered last at the end
  std::uint32_t left_ = scene::no_primitive; ///< that the look leaves
  double length_ = 0;
};

} // namespace

Sight look_through_pixel(const scene::Scene& scene, const scene::Bvh& bvh, int column, int row)
{
  const scene::Camera& camera = scene.camera;
  const double x = 2 * (column + 0.5) / camera.width - 1, y = 1 - 2 * (row + 0.5) / camera.height;
  const glm::dvec3 way =
      glm::dvec3(camera.forward) + x * camera.tan_x * glm::dvec3(camera.right) + y * camera.tan_y * glm::dvec3(camera.up);
  const double spacing = 2 * std::max(camera.tan_x / camera.width, camera.tan_y / camera.height) / glm::length(way);
  Look look(scene, bvh, glm::normalize(way));
  Sight sight;
  for (int surface = 0; surface < most_surfaces; ++surface) {
    const std::optional<Place> place = look.next();
    if (!place) break;
    const scene::Object& object = scene.objects[static_cast<std::size_t>(place->object)];
    const Type type = material_of(scene, object).type;
    const glm::dvec3 arrives = look.way();
    if (type == Type::mirror) look.reflect(*place);
    if (type == Type::dielectric && !look.cross(*place)) continue;
    const bool is_first = sight.first.object < 0;
    if (is_first || type == Type::diffuse) {
      sight.last = {glm::vec3(place->position), glm::vec3(place->geometric), place->object};
      sight.way = glm::vec3(arrives);
      sight.spacing = static_cast<float>(spacing * look.length());
    }
    if (is_first) sight.first = sight.last;
    if (type == Type::diffuse) break;
  }
  return sight;
}

} // namespace nephroid::spectral
