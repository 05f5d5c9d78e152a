// SPDX-License-Identifier: Apache-2.0
// What kernels/transport/differential.h is judged by: a path in double precision, written from the laws themselves,
// through a given sequence of triangles and ellipsoids, so that a slightly different index of refraction sends it
// through the same ones.
#pragma once
#include "scene/scene.h"
#include "tests/support/ellipsoids.h"

namespace nephroid::test {

/// What a path meets, one after the other; the last is where it ends.
struct Encounter {
  std::uint32_t triangle = 0; ///< or, beyond their number, an ellipsoid
  bool transmitted = false;
  bool shading = false; ///< bent about the interpolated normal: filled in by retrace where `decide` says so
};

struct Ray64 {
  glm::dvec3 position{0}, direction{0};
};

class PathReference {
public:
  explicit PathReference(const scene::Scene& scene) : scene_(scene) {}

  /// Position and direction at every encounter, after it. n: of every material. Planes of triangles count as endless.
  /// decide: choose between the shading and the geometric normal, else keep what was chosen.
  std::vector<Ray64> retrace(Ray64 ray, std::vector<Encounter>& encounters, const std::vector<double>& n,
                             bool decide) const {
    std::vector<Ray64> states;
    std::vector<int> inside;
    for (std::size_t i = 0; i < encounters.size(); ++i) {
      Encounter& e = encounters[i];
      if (const std::size_t triangles = scene_.geometry.triangles.size(); e.triangle >= triangles) {
        const scene::Ellipsoid& ellipsoid = scene_.geometry.ellipsoids[e.triangle - triangles];
        ray.position += first_hit(ellipsoid, ray.position, ray.direction, 1e-6) * ray.direction;
        const glm::dvec3 normal = normal_at(ellipsoid, ray.position);
        if (i + 1 < encounters.size()) bend(ray, e, normal, normal, inside, n, decide);
        states.push_back(ray);
        continue;
      }
      const glm::uvec3 c = scene_.geometry.triangles[e.triangle];
      const glm::dvec3 a = scene_.geometry.positions[c.x], e1 = glm::dvec3(scene_.geometry.positions[c.y]) - a,
                       e2 = glm::dvec3(scene_.geometry.positions[c.z]) - a;
      const glm::dvec3 across = glm::cross(e1, e2), geometric = glm::normalize(across);
      ray.position += glm::dot(a - ray.position, geometric) / glm::dot(ray.direction, geometric) * ray.direction;
      if (i + 1 < encounters.size())
        bend(ray, e, geometric, shading_normal(c, ray.position - a, e1, e2), inside, n, decide);
      states.push_back(ray);
    }
    return states;
  }

private:
  const scene::Object& object_of(std::uint32_t triangle) const {
    return scene_.objects[scene_.object_of_primitive[triangle]];
  }

  glm::dvec3 shading_normal(const glm::uvec3& corner, const glm::dvec3& from_a, const glm::dvec3& e1,
                            const glm::dvec3& e2) const {
    const glm::dvec3 across = glm::cross(e1, e2);
    const double u = glm::dot(glm::cross(from_a, e2), across) / glm::dot(across, across),
                 v = glm::dot(glm::cross(e1, from_a), across) / glm::dot(across, across);
    const auto& normals = scene_.geometry.normals;
    return glm::normalize((1 - u - v) * glm::dvec3(normals[corner.x]) + u * glm::dvec3(normals[corner.y]) +
                          v * glm::dvec3(normals[corner.z]));
  }

  double index_in(const std::vector<int>& inside, const std::vector<double>& n) const {
    const scene::Object* medium = nullptr;
    for (const int o : inside)
      if (const scene::Object& candidate = scene_.objects[static_cast<std::size_t>(o)];
          !medium || candidate.priority >= medium->priority)
        medium = &candidate;
    return medium ? n[static_cast<std::size_t>(medium->material)] : 1;
  }

  void bend(Ray64& ray, Encounter& e, const glm::dvec3& geometric, const glm::dvec3& shading, std::vector<int>& inside,
            const std::vector<double>& n, bool decide) const {
    const double side = glm::dot(ray.direction, geometric) < 0 ? 1 : -1;
    const scene::Object& object = object_of(e.triangle);
    const bool mirror =
        scene_.materials[static_cast<std::size_t>(object.material)].type == scatter::Material::Type::mirror;
    std::vector<int> beyond = inside;
    if (!mirror) cross(beyond, static_cast<int>(scene_.object_of_primitive[e.triangle]), side > 0);
    const double n_i = index_in(inside, n), n_t = index_in(beyond, n);
    const auto bent = [&](const glm::dvec3& normal) {
      const double c = -glm::dot(ray.direction, normal), eta = n_i / n_t;
      if (!e.transmitted) return ray.direction + 2 * c * normal;
      return eta * ray.direction + (eta * c - std::sqrt(1 - eta * eta * (1 - c * c))) * normal;
    };
    if (decide) {
      const bool faces = object.smooth && glm::dot(ray.direction, side * shading) < 0;
      const bool leaves = faces && (side * glm::dot(bent(side * shading), geometric) < 0) == e.transmitted;
      e.shading = leaves;
    }
    ray.direction = glm::normalize(bent(side * (e.shading ? shading : geometric)));
    if (e.transmitted) inside = beyond;
  }

  static void cross(std::vector<int>& inside, int object, bool enters) {
    if (enters)
      inside.push_back(object);
    else if (const auto last = std::find(inside.rbegin(), inside.rend(), object); last != inside.rend())
      inside.erase(std::next(last).base());
  }

  const scene::Scene& scene_;
};

} // namespace nephroid::test
