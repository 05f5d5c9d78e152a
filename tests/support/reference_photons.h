// SPDX-License-Identifier: Apache-2.0
// An independent photon tracer: Embree finds the hits, everything else is double precision and written from the laws
// themselves, with random numbers of its own. Slow and plain: what kernels/photons/photons.cl is judged by.
#pragma once
#include "optics/fresnel.h"
#include "photons/tables/run_tables.h"
#include "tests/support/ellipsoids.h"
#include "tests/support/tracer.h"

namespace nephroid::test {

/// XYZ sums a pixel, and of their squares.
struct ReferenceFilm {
  std::vector<glm::dvec3> sum, sum_of_squares;
};

/// Photons from a point light, in the open, into the cone about everything that is glass or a mirror.
class ReferencePhotons {
public:
  ReferencePhotons(const scene::Scene& scene, const photons::RunTables& tables, unsigned seed)
      : scene_(scene), tables_(tables), tracer_(scene.geometry, RTC_SCENE_FLAG_ROBUST), random_(seed) {
    for (const shared::DeviceTarget& target : tables.targets) {
      const glm::dvec3 way =
          glm::dvec3(target.centre_radius.x, target.centre_radius.y, target.centre_radius.z) - light();
      axis_ += glm::normalize(way);
    }
    axis_ = glm::normalize(axis_);
    for (const shared::DeviceTarget& target : tables.targets) {
      const glm::dvec3 way =
          glm::dvec3(target.centre_radius.x, target.centre_radius.y, target.centre_radius.z) - light();
      const double off_axis = std::acos(glm::dot(glm::normalize(way), axis_));
      half_angle_ = std::max(half_angle_, off_axis + std::asin(target.centre_radius.w / glm::length(way)));
    }
  }

  /// `count` photons; sums are of single photons' contributions to a pixel, for the light's whole power shared among
  /// `count`.
  ReferenceFilm trace(int count) {
    const auto pixels = static_cast<std::size_t>(scene_.camera.width) * static_cast<std::size_t>(scene_.camera.height);
    ReferenceFilm film{std::vector<glm::dvec3>(pixels, glm::dvec3(0)), std::vector<glm::dvec3>(pixels, glm::dvec3(0))};
    const double cone_share = (1 - std::cos(half_angle_)) / 2;
    for (int i = 0; i < count; ++i) {
      const int cluster = static_cast<int>(uniform() * static_cast<double>(tables_.wavelengths.clusters.size()));
      const double watts =
          scene_.lights[0].power_w * cone_share * static_cast<double>(tables_.wavelengths.clusters.size()) / count;
      trace_one(cluster, watts, film);
    }
    return film;
  }

private:
  struct Contact {
    glm::dvec3 position, geometric, shading;
    int object = 0;
    std::uint32_t triangle = 0;
  };

  /// What a photon has behind it, by material: metres of glass, reflections of mirrors.
  struct Losses {
    std::vector<double> metres, reflections;
  };

  glm::dvec3 light() const { return scene_.lights[0].position; }
  double uniform() { return uniform_(random_); }
  const scatter::Material& material(int object) const {
    return scene_.materials[static_cast<std::size_t>(scene_.objects[static_cast<std::size_t>(object)].material)];
  }

  bool meet(const glm::dvec3& from, const glm::dvec3& direction, double t_max, Contact& contact) const {
    const Hit hit = tracer_.closest(
        {.origin = glm::vec3(from), .t_max = static_cast<float>(t_max), .direction = glm::vec3(direction)});
    const scene::Mesh& mesh = scene_.geometry;
    double nearest = hit.primitive == no_primitive ? t_max : double(hit.t);
    bool found = false;
    for (std::uint32_t i = 0; i < mesh.ellipsoids.size(); ++i) {
      const double t = first_hit(mesh.ellipsoids[i], from, direction);
      if (!(t < nearest)) continue;
      nearest = t;
      found = true;
      contact.position = from + t * direction;
      contact.geometric = contact.shading = normal_at(mesh.ellipsoids[i], contact.position);
      contact.triangle = static_cast<std::uint32_t>(mesh.triangles.size()) + i;
      contact.object = static_cast<int>(scene_.object_of_primitive[contact.triangle]);
    }
    if (found || hit.primitive == no_primitive) return found;
    const glm::uvec3 c = mesh.triangles[hit.primitive];
    const glm::dvec3 a = mesh.positions[c.x], ab = glm::dvec3(mesh.positions[c.y]) - a,
                     ac = glm::dvec3(mesh.positions[c.z]) - a;
    const double u = hit.u, v = hit.v;
    contact.position = a + u * ab + v * ac;
    contact.geometric = contact.shading = glm::normalize(glm::cross(ab, ac));
    contact.object = static_cast<int>(scene_.object_of_primitive[hit.primitive]);
    contact.triangle = hit.primitive;
    if (scene_.objects[static_cast<std::size_t>(contact.object)].smooth)
      contact.shading = glm::normalize((1 - u - v) * glm::dvec3(mesh.normals[c.x]) + u * glm::dvec3(mesh.normals[c.y]) +
                                       v * glm::dvec3(mesh.normals[c.z]));
    return true;
  }

  /// Reflects or refracts about `normal`, which is on the near side. True: went through.
  bool bend(glm::dvec3& direction, const glm::dvec3& normal, double n_i, double n_t, bool mirror) {
    const double cos_i = -glm::dot(direction, normal);
    if (mirror || uniform() < optics::fresnel_reflectance(cos_i, n_i, n_t)) {
      direction = glm::normalize(direction + 2 * cos_i * normal);
      return false;
    }
    const double eta = n_i / n_t;
    direction = glm::normalize(eta * direction + (eta * cos_i - *optics::refracted_cosine(cos_i, n_i, n_t)) * normal);
    return true;
  }

  void trace_one(int cluster, double watts, ReferenceFilm& film) {
    const double cosine = 1 - uniform() * (1 - std::cos(half_angle_)), phi = 2 * M_PI * uniform(),
                 sine = std::sqrt(1 - cosine * cosine);
    const glm::dvec3 x =
        glm::normalize(glm::cross(axis_, std::abs(axis_.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    glm::dvec3 direction = cosine * axis_ + sine * (std::cos(phi) * x + std::sin(phi) * glm::cross(axis_, x)),
               from = light();
    std::vector<int> inside; // the dielectric objects around it, in the order in which it entered them
    Losses losses{std::vector<double>(scene_.materials.size(), 0.0), std::vector<double>(scene_.materials.size(), 0.0)};
    for (int surface = 0; surface <= 32; ++surface) {
      Contact contact;
      if (!meet(from, direction, INFINITY, contact)) return;
      if (const int medium = medium_of(inside); medium >= 0)
        losses.metres[material_number(medium)] += glm::distance(from, contact.position) * scene_.metres_per_unit;
      const scatter::Material& here = material(contact.object);
      if (here.type == scatter::Material::Type::diffuse) {
        if (surface > 0) deposit(contact, direction, cluster, watts, losses, film);
        return;
      }
      const double side = glm::dot(direction, contact.geometric) < 0 ? 1 : -1;
      const bool mirror = here.type == scatter::Material::Type::mirror;
      if (mirror) losses.reflections[material_number(contact.object)] += 1;
      const std::vector<int> beyond = mirror ? inside : across(inside, contact.object, side > 0);
      const double n_i = index_in(inside, cluster), n_t = index_in(beyond, cluster);
      bool through = !mirror && n_i == n_t; // nothing changes there
      if (!through) through = bend_at(direction, contact, side, n_i, n_t, mirror);
      if (through) inside = beyond;
      from = contact.position + 1e-5 * (through ? -side : side) * contact.geometric;
    }
  }

  /// Bends about the shading normal, unless that sends light to the wrong side of the triangle. True: went through.
  bool bend_at(glm::dvec3& direction, const Contact& contact, double side, double n_i, double n_t, bool mirror) {
    glm::dvec3 next = direction;
    bool through =
        bend(next, side * (glm::dot(direction, side * contact.shading) < 0 ? contact.shading : contact.geometric), n_i,
             n_t, mirror);
    if ((glm::dot(next, side * contact.geometric) < 0) != through) {
      next = direction;
      through = bend(next, side * contact.geometric, n_i, n_t, mirror);
    }
    direction = next;
    return through;
  }

  std::size_t material_number(int object) const {
    return static_cast<std::size_t>(scene_.objects[static_cast<std::size_t>(object)].material);
  }

  /// Of nested objects the one whose material is there: the highest priority, of equals the one entered last; -1: air.
  int medium_of(const std::vector<int>& objects) const {
    int medium = -1;
    for (const int object : objects)
      if (medium < 0 || scene_.objects[static_cast<std::size_t>(object)].priority >=
                            scene_.objects[static_cast<std::size_t>(medium)].priority)
        medium = object;
    return medium;
  }

  double index_in(const std::vector<int>& objects, int cluster) const {
    const int medium = medium_of(objects);
    return medium < 0
               ? 1
               : tables_.wavelengths.index_of_cluster[static_cast<std::size_t>(cluster) * scene_.materials.size() +
                                                      material_number(medium)];
  }

  /// The objects around what has crossed a surface of one of them.
  static std::vector<int> across(std::vector<int> objects, int object, bool enters) {
    if (enters)
      objects.push_back(object);
    else if (const auto last = std::find(objects.rbegin(), objects.rend(), object); last != objects.rend())
      objects.erase(std::next(last).base());
    return objects;
  }

  /// What is left of a wavelength: Beer and Lambert in glass, the reflectance of each mirror.
  double left(const Losses& losses, int wavelength) const {
    const auto w = static_cast<std::size_t>(wavelength);
    double share = 1;
    for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
      const scatter::Material& one = scene_.materials[m];
      if (losses.metres[m] > 0)
        share *= std::exp(-4 * M_PI * one.k[w] * losses.metres[m] / ((380 + wavelength) * 1e-9));
      if (losses.reflections[m] > 0) share *= std::pow(one.reflectance[w], losses.reflections[m]);
    }
    return share;
  }

  void deposit(const Contact& contact, const glm::dvec3& arriving, int cluster, double watts, const Losses& losses,
               ReferenceFilm& film) {
    const scene::Camera& camera = scene_.camera;
    const glm::dvec3 way = glm::dvec3(camera.position) - contact.position;
    const double distance = glm::length(way), cos_camera = glm::dot(way, contact.geometric) / distance;
    if (cos_camera * -glm::dot(arriving, contact.geometric) <= 0) return;
    const glm::dvec3 seen = -way;
    const double z = glm::dot(seen, glm::dvec3(camera.forward));
    if (z <= 0) return;
    const double px = (glm::dot(seen, glm::dvec3(camera.right)) / (z * camera.tan_x) + 1) / 2 * camera.width;
    const double py = (1 - glm::dot(seen, glm::dvec3(camera.up)) / (z * camera.tan_y)) / 2 * camera.height;
    if (px < 0 || py < 0 || px >= camera.width || py >= camera.height) return;
    Contact between;
    const glm::dvec3 start = contact.position + 1e-5 * (cos_camera > 0 ? 1.0 : -1.0) * contact.geometric;
    if (meet(start, way / distance, distance, between)) return;
    // The pixel sees the solid angle dA cos / distance^2 of the deposit's surface; on the plane at distance 1 that is
    // larger by 1 / cos^3.
    const double cos_axis = z / distance,
                 pixel_area = 4 * camera.tan_x * camera.tan_y / (double(camera.width) * camera.height);
    const double metres = distance * scene_.metres_per_unit;
    const double weight = std::abs(cos_camera) / (metres * metres * std::pow(cos_axis, 3) * pixel_area);
    const auto& diffuse = material(contact.object).reflectance;
    glm::dvec3 xyz(0);
    for (const int w : tables_.wavelengths.clusters[static_cast<std::size_t>(cluster)]) {
      const shared::float4& light = tables_.wavelengths.light_xyz[static_cast<std::size_t>(w)];
      xyz += left(losses, w) * diffuse[static_cast<std::size_t>(w)] * glm::dvec3(light.x, light.y, light.z);
    }
    xyz *= watts * weight / M_PI;
    const auto pixel = static_cast<std::size_t>(static_cast<int>(py) * camera.width + static_cast<int>(px));
    film.sum[pixel] += xyz;
    film.sum_of_squares[pixel] += xyz * xyz;
  }

  const scene::Scene& scene_;
  const photons::RunTables& tables_;
  EmbreeTracer tracer_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  glm::dvec3 axis_{0};
  double half_angle_ = 0;
};

} // namespace nephroid::test
