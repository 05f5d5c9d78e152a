// SPDX-License-Identifier: Apache-2.0
// What a camera sees of a thin medium about an ellipsoid of glass in parallel light: photons in double precision, by
// the laws themselves. Nothing here is the engine's: no spheres, no maps, no steps along a path from the eye.
//
// A photon that leaves the glass with power P sends on its way ds the power P ds extinction albedo into all directions,
// phase(cosine) of it into a steradian. A pixel of area A of the plane at distance 1 before the camera has the mean
// radiance of that area. The power that a piece of the way sends to a small pupil is radiance times solid angle, so
// with d the distance from the camera and c the cosine to its axis, the piece adds P ds extinction albedo phase
// exp(-extinction d) / (d^2 A c^3) to the pixel in which it is seen.
#pragma once
#include "base/parallel.h"
#include "optics/fresnel.h"
#include "tests/support/test.h"

#include <glm/glm.hpp>

namespace nephroid::test {

struct MediumScene {
  glm::dvec3 axes{1};               ///< half ones, of the ellipsoid about (0, 0, 0)
  double n = 1.5;                   ///< of its glass
  double largest = 4;               ///< the medium's radius
  glm::dvec3 light{0, -1, 0};       ///< the way it goes, unit; 1 W/m^2
  glm::dvec3 eye{0, 0, 10};         ///< looks at (0, 0, 0), with y up
  double fov_deg = 40;              ///< of the square picture
  int size = 64;                    ///< pixels a side
  double extinction = 0.1;          ///< of scattering alone
  std::optional<double> screen_y{}; ///< a black square lies at this height, about the y axis
  double screen_half = 0;           ///< half of its side
  std::function<double(double cosine)> phase{};
};

class MediumPhotons {
public:
  explicit MediumPhotons(const MediumScene& scene) : s_(scene), forward_(glm::normalize(-scene.eye)) {
    right_ = glm::normalize(glm::cross(forward_, glm::dvec3(0, 1, 0)));
    up_ = glm::cross(right_, forward_);
    tan_ = std::tan(glm::radians(scene.fov_deg) / 2);
  }

  /// The picture, row 0 at the top, of this many photons.
  std::vector<double> picture(int photons, unsigned seed) const {
    constexpr int blocks = 64;
    std::vector<std::vector<double>> films(blocks);
    for_blocks(blocks, [&](std::size_t block) {
      films[block].assign(static_cast<std::size_t>(s_.size) * static_cast<std::size_t>(s_.size), 0.0);
      std::mt19937_64 random(seed * 1000003ULL + block);
      for (int i = 0; i < photons / blocks; ++i) photon(films[block], photons, random);
    });
    std::vector<double> sum(films[0].size(), 0.0);
    for (const std::vector<double>& film : films)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += film[i];
    return sum;
  }

private:
  using Random = std::mt19937_64;
  static double uniform(Random& random) { return std::uniform_real_distribution<double>()(random); }

  /// Where a ray meets the ellipsoid after t = begin.
  std::optional<double> meets(const glm::dvec3& origin, const glm::dvec3& direction, double begin) const {
    const glm::dvec3 o = origin / s_.axes, d = direction / s_.axes;
    const double a = glm::dot(d, d), b = glm::dot(o, d), root2 = b * b - a * (glm::dot(o, o) - 1);
    if (root2 < 0) return std::nullopt;
    for (const double t : {(-b - std::sqrt(root2)) / a, (-b + std::sqrt(root2)) / a})
      if (t > begin) return t;
    return std::nullopt;
  }

  /// The part of the way where a straight line meets the screen; infinity: nowhere.
  double meets_screen(const glm::dvec3& origin, const glm::dvec3& direction) const {
    if (!s_.screen_y) return std::numeric_limits<double>::infinity();
    const double t = (*s_.screen_y - origin.y) / direction.y;
    const glm::dvec3 at = origin + t * direction;
    const bool on = t > 0 && std::max(std::abs(at.x), std::abs(at.z)) < s_.screen_half;
    return on ? t : std::numeric_limits<double>::infinity();
  }

  void photon(std::vector<double>& film, int photons, Random& random) const {
    const double disc = std::max({s_.axes.x, s_.axes.y, s_.axes.z});
    const glm::dvec3 across =
        glm::normalize(glm::cross(s_.light, std::abs(s_.light.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const double r = disc * std::sqrt(uniform(random)), turn = 2 * std::numbers::pi * uniform(random);
    glm::dvec3 at =
        r * (std::cos(turn) * across + std::sin(turn) * glm::cross(s_.light, across)) - 10 * disc * s_.light;
    glm::dvec3 way = s_.light;
    const double whole = std::numbers::pi * disc * disc / photons;
    double power = whole;
    bool inside = false;
    // What stays inside after that is a ten thousandth of the light or less.
    for (int surface = 0; surface < 64 && power > 1e-4 * whole; ++surface) {
      const std::optional<double> t = meets(at, way, 1e-9);
      if (!t) return; // it never met the glass
      at += *t * way;
      const glm::dvec3 outwards = glm::normalize(at / (s_.axes * s_.axes)), normal = inside ? -outwards : outwards;
      const double n_from = inside ? s_.n : 1, n_to = inside ? 1 : s_.n, cosine = -glm::dot(way, normal);
      const double share = optics::fresnel_reflectance(cosine, n_from, n_to);
      const glm::dvec3 reflected = way + 2 * cosine * normal;
      const std::optional<double> cos_t = optics::refracted_cosine(cosine, n_from, n_to);
      const glm::dvec3 refracted =
          cos_t ? glm::dvec3(n_from / n_to * way + (n_from / n_to * cosine - *cos_t) * normal) : glm::dvec3(0);
      const double leaves = inside ? 1 - share : share; // the rest goes on in the glass
      if (leaves > 0)
        deposit(film, at, inside ? refracted : reflected, leaves * power,
                1 + static_cast<int>(8 * leaves * power / whole), random);
      way = inside ? reflected : refracted;
      power *= 1 - leaves;
      inside = true;
    }
  }

  void deposit(std::vector<double>& film, const glm::dvec3& from, const glm::dvec3& way, double power, int pieces,
               Random& random) const {
    const double foot = -glm::dot(from, way);
    const double length = std::min(foot + std::sqrt(foot * foot + s_.largest * s_.largest - glm::dot(from, from)),
                                   meets_screen(from, way));
    const double offset = uniform(random), piece = length / pieces;
    for (int i = 0; i < pieces; ++i) scatter(film, from + (i + offset) * piece * way, way, power * piece);
  }

  void scatter(std::vector<double>& film, const glm::dvec3& place, const glm::dvec3& way,
               double power_times_way) const {
    const glm::dvec3 to_place = place - s_.eye;
    const double distance = glm::length(to_place), depth = glm::dot(to_place, forward_), cosine = depth / distance;
    const double x = (glm::dot(to_place, right_) / depth / tan_ + 1) / 2,
                 y = (1 - glm::dot(to_place, up_) / depth / tan_) / 2;
    if (!(depth > 0 && x >= 0 && x < 1 && y >= 0 && y < 1)) return;
    if (const auto hidden = meets(s_.eye, to_place, 0); hidden && *hidden < 1 - 1e-9) return;
    if (meets_screen(s_.eye, to_place) < 1) return;
    const double area = std::pow(2 * tan_ / s_.size, 2);
    const auto pixel = static_cast<std::size_t>(y * s_.size) * static_cast<std::size_t>(s_.size) +
                       static_cast<std::size_t>(x * s_.size);
    film[pixel] += power_times_way * s_.extinction * s_.phase(-glm::dot(way, to_place) / distance) *
                   std::exp(-s_.extinction * distance) / (distance * distance * area * cosine * cosine * cosine);
  }

  MediumScene s_;
  glm::dvec3 forward_, right_{0}, up_{0};
  double tan_ = 1;
};

} // namespace nephroid::test
