// SPDX-License-Identifier: Apache-2.0
#include "inverse/object_view.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "optics/fresnel.h"
#include "scene/scene.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Surfaces that a path is followed through; what it sees then is left out.
constexpr int most_surfaces = 6;
constexpr double without_end = std::numeric_limits<double>::infinity();
/// A receiver's sheet where no light falls, its rim, and how wide that is in parts of its shorter side.
constexpr double empty_sheet = 0.02, rim = 0.25, rim_width = 0.008;
/// What is left of red, green and blue after a way as long as the object's longer side.
constexpr dvec3 tint{0.72, 0.88, 0.84};

/// The light of a mirror's back and sides, and what its face reflects.
constexpr double back = 0.08, face_reflectance = 0.9;

/// A dark room: what is seen beside the glass.
dvec3 backdrop(const dvec3& d) {
  return glm::mix(dvec3(0.012, 0.013, 0.016), dvec3(0.03, 0.035, 0.045), 0.5 + 0.5 * d.z);
}
/// The room with six upright lamps, which only the glass shows: seen directly they would outshine the pictures.
dvec3 room(const dvec3& d) {
  const double lamps = std::pow(std::abs(std::cos(3 * std::atan2(d.y, d.x))), 6) * std::exp(-2 * d.z * d.z);
  return backdrop(d) + lamps * dvec3(0.55, 0.62, 0.7);
}

class ObjectRenderer {
public:
  explicit ObjectRenderer(const ObjectView& object)
      : object_(object), l_(object.layout), half_(l_.size / 2.0), gradients_(object.slopes.size()) {
    for_ranges(gradients_.size(), 4096, [&](std::size_t, Range range) {
      for (std::size_t i = range.begin; i < range.end; ++i)
        gradients_[i] = facet_gradient(object.slopes[i], l_.n, l_.sines_on(i));
    });
    for (std::size_t i = 0; i < gradients_.size(); ++i)
      lowest_ = std::min(lowest_, object.heights[i] - glm::dot(glm::abs(gradients_[i]), l_.facet()) / 2);
  }

  dvec3 seen(const dvec3& from, const dvec3& d) const {
    const double down = (lowest_ - from.z) / d.z, up = (l_.thickness - from.z) / d.z, first = std::min(down, up);
    const dvec2 sides = within_sides(from, d);
    const double enter = std::max({sides.x, first, 0.0}), leave = std::min(sides.y, std::max(down, up));
    const dvec3 beside = backdrop(d) + sheets(from, d, without_end);
    if (!(enter < leave)) return beside;
    dvec3 at = from + enter * d, out(0);
    bool is_face = false;
    if (at.z < surface(at).z) { // still in the air below the facets
      const auto met = way_from_below(at, d, leave - enter);
      if (!met) return beside;
      at += *met * d;
      out = surface(at).normal;
      is_face = true;
    } else if (enter == 0)
      return l_.is_mirror() ? dvec3(back) : inside(from, d, dvec3(1));
    else
      out = first == enter ? dvec3(0, 0, 1) : side_normal(at);
    if (l_.is_mirror()) {
      const dvec3 before = sheets(from, d, glm::distance(from, at)), away = glm::reflect(d, out);
      return before + (is_face ? face_reflectance * (room(away) + sheets(at, away, without_end)) : dvec3(back));
    }
    const double mirrored = optics::fresnel_reflectance(std::clamp(-glm::dot(d, out), 0.0, 1.0), 1, l_.n);
    return sheets(from, d, glm::distance(from, at)) + mirrored * room(glm::reflect(d, out)) +
           inside(at, glm::refract(d, out, 1 / l_.n), dvec3(1 - mirrored));
  }

private:
  /// From where to where a line is between the object's upright sides.
  dvec2 within_sides(const dvec3& from, const dvec3& d) const {
    const dvec2 p = dvec2(from) / half_, way = dvec2(d) / half_;
    if (!l_.round) {
      const dvec2 a = (-1.0 - p) / way, b = (1.0 - p) / way, first = glm::min(a, b), last = glm::max(a, b);
      return {std::max(first.x, first.y), std::min(last.x, last.y)};
    }
    const double a = glm::dot(way, way), b = glm::dot(p, way),
                 root = b * b - a * (glm::dot(p, p) - 1); // |p + t way| = 1
    if (root < 0 || a == 0) return root < 0 ? dvec2(without_end, -without_end) : dvec2(-without_end, without_end);
    return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
  }

  dvec3 side_normal(const dvec3& at) const {
    const dvec2 p = dvec2(at) / half_;
    if (l_.round) return glm::normalize(dvec3(p / half_, 0));
    return std::abs(p.x) > std::abs(p.y) ? dvec3(glm::sign(p.x), 0, 0) : dvec3(0, glm::sign(p.y), 0);
  }

  struct Surface {
    double z = 0;
    dvec3 normal{0, 0, -1}; ///< out of the glass
  };

  /// The facets' side at a place.
  Surface surface(const dvec3& p) const {
    const dvec2 at = glm::clamp(dvec2(p.x + half_.x, half_.y - p.y) / l_.facet(), dvec2(0), dvec2(l_.facets) - 1e-9);
    if (!object_.smooth) {
      const std::size_t i = index_at(static_cast<int>(at.x), static_cast<int>(at.y), l_.facets.x);
      const dvec2 g = gradients_[i];
      return {object_.heights[i] + glm::dot(g, dvec2(p) - l_.middle(i)), glm::normalize(dvec3(g, -1))};
    }
    const dvec2 between = glm::clamp(at - 0.5, dvec2(0), dvec2(l_.facets - 1)),
                whole = glm::min(glm::floor(between), dvec2(glm::max(l_.facets - 2, 0)));
    Surface mean;
    dvec2 g(0);
    for (int k = 0; k < 4; ++k) {
      const glm::ivec2 corner = glm::min(glm::ivec2(whole) + glm::ivec2(k & 1, k >> 1), l_.facets - 1);
      const dvec2 part = 1.0 - glm::abs(between - whole - dvec2(k & 1, k >> 1));
      const std::size_t i = index_at(corner.x, corner.y, l_.facets.x);
      mean.z += part.x * part.y * object_.heights[i];
      g += part.x * part.y * gradients_[i];
    }
    mean.normal = glm::normalize(dvec3(g, -1));
    return mean;
  }

  /// Where a way inside meets the facets' side: some steps towards the height that the place before had.
  double way_to_facets(const dvec3& from, const dvec3& d) const {
    double t = -from.z / d.z;
    for (int i = 0; i < 3; ++i) t = (surface(from + t * d).z - from.z) / d.z;
    return std::max(0.0, t);
  }

  /// The same from below them, within so long a way: between two of some steps.
  std::optional<double> way_from_below(const dvec3& from, const dvec3& d, double way) const {
    constexpr int steps = 32;
    const auto below = [&](double t) { return from.z + t * d.z < surface(from + t * d).z; };
    for (int i = 1; i <= steps; ++i)
      if (const double t = way * i / steps; !below(t)) return last_good(t - way / steps, t, 8, below);
    return std::nullopt;
  }

  dvec3 inside(dvec3 from, dvec3 d, dvec3 weight) const {
    for (int i = 0; i < most_surfaces; ++i) {
      double way = std::max(0.0, within_sides(from, d).y);
      dvec3 out = side_normal(from + way * d);
      if (const double t = d.z > 0       ? (l_.thickness - from.z) / d.z
                           : d.z < -1e-9 ? way_to_facets(from, d)
                                         : way;
          t < way) {
        way = t;
        out = d.z > 0 ? dvec3(0, 0, 1) : surface(from + t * d).normal;
      }
      if (!std::isfinite(way)) break;
      from += way * d;
      weight *= glm::pow(tint, dvec3(way / std::max(l_.size.x, l_.size.y)));
      const double mirrored = optics::fresnel_reflectance(std::clamp(glm::dot(d, out), 0.0, 1.0), l_.n, 1);
      if (glm::dot(d, out) > 0 && mirrored < 1) {
        d = glm::refract(d, -out, l_.n);
        return weight * (1 - mirrored) * (room(d) + sheets(from, d, without_end));
      }
      d = glm::reflect(d, out);
    }
    return dvec3(0);
  }

  /// The light of all receivers on the way.
  dvec3 sheets(const dvec3& from, const dvec3& d, double to) const {
    dvec3 sum(0);
    for (std::size_t j = 0; j < l_.distances.size(); ++j) {
      const double t = (-l_.distances[j] - from.z) / d.z;
      if (!(t > 0) || t > to) continue;
      const dvec2 at = dvec2(from + t * d) - l_.offset(j), inwards = l_.receiver / 2.0 - glm::abs(at);
      const double edge = std::min(inwards.x, inwards.y) / std::min(l_.receiver.x, l_.receiver.y);
      if (edge < 0) continue;
      if (edge < rim_width) sum += rim;
      if (const auto cell = l_.cell_at(at)) {
        const float* const rgb = object_.receivers[j]->rgb.data() + 3 * *cell;
        sum += empty_sheet + glm::max(dvec3(rgb[0], rgb[1], rgb[2]), 0.0);
      }
    }
    return sum * dvec3(1, 0.97, 0.9);
  }

  const ObjectView& object_;
  const Layout& l_;
  dvec2 half_;
  std::vector<dvec2> gradients_;
  double lowest_ = 0; ///< z of the facets
};

/// A camera's unit vectors to the right, up and ahead.
struct Axes {
  dvec3 right, up, ahead;
};

Axes axes_of(const preset::Camera& camera) {
  const dvec3 ahead = glm::normalize(scene::to_dvec3(camera.target) - scene::to_dvec3(camera.position));
  dvec3 right = glm::cross(ahead, scene::to_dvec3(camera.up));
  right = glm::length(right) > 1e-9 ? glm::normalize(right) : dvec3(1, 0, 0); // it looks along its up
  return {right, glm::cross(right, ahead), ahead};
}

/// Half the picture's width and height, one length ahead of the camera.
dvec2 tangents(const preset::Camera& camera) {
  const double up = std::tan(glm::radians(camera.fov_deg) / 2);
  return {up * camera.resolution[0] / camera.resolution[1], up};
}

} // namespace

std::shared_ptr<const job::Picture> view_of(const ObjectView& object, const preset::Camera& camera) {
  const ObjectRenderer renderer(object);
  const Axes axes = axes_of(camera);
  const dvec2 half = tangents(camera);
  const dvec3 from = scene::to_dvec3(camera.position);
  auto picture = std::make_shared<job::Picture>();
  picture->width = camera.resolution[0];
  picture->height = camera.resolution[1];
  const auto width = static_cast<std::size_t>(picture->width), height = static_cast<std::size_t>(picture->height);
  picture->rgb.resize(3 * width * height);
  for_ranges(height, 8, [&](std::size_t, Range rows) {
    for (std::size_t y = rows.begin; y < rows.end; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        const dvec2 at = (2.0 * (dvec2(x, y) + 0.5) / dvec2(width, height) - 1.0) * half;
        const dvec3 seen = renderer.seen(from, glm::normalize(axes.ahead + at.x * axes.right - at.y * axes.up));
        for (int c = 0; c < 3; ++c)
          picture->rgb[3 * (y * width + x) + static_cast<std::size_t>(c)] = static_cast<float>(seen[c]);
      }
  });
  return picture;
}

preset::Camera view_camera(const preset::Preset& preset) {
  preset::Camera camera = preset.scene.camera, untouched;
  untouched.fov_deg = camera.fov_deg;
  untouched.resolution = camera.resolution;
  if (camera != untouched) return camera;
  const Settings& s = settings(preset);
  const auto receiver = s.receiver_mm.value_or(s.size_mm);
  dvec3 high(s.size_mm[0] / 2, s.size_mm[1] / 2, s.stock_mm.value_or(s.thickness_mm)),
      low(-high.x, -high.y, -s.receivers.back().distance_mm);
  for (const Receiver& r : s.receivers)
    for (int axis = 0; axis < 2; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      low[axis] = std::min(low[axis], r.offset_mm[i] - receiver[i] / 2);
      high[axis] = std::max(high[axis], r.offset_mm[i] + receiver[i] / 2);
    }
  const dvec3 middle = (low + high) / 2.0;
  const double up = glm::radians(28.0), aside = glm::radians(-25.0);
  const dvec3 to_camera(std::sin(aside) * std::cos(up), -std::cos(aside) * std::cos(up), std::sin(up));
  camera.up = {0, 0, 1};
  camera.target = scene::to_vec3(middle);
  camera.position = scene::to_vec3(middle + to_camera);
  const Axes axes = axes_of(camera);
  const dvec2 half = tangents(camera);
  double away = 0; // so far that every corner is in the picture
  for (int k = 0; k < 8; ++k) {
    const dvec3 corner = dvec3(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z) - middle;
    away = std::max({away, std::abs(glm::dot(corner, axes.right)) / half.x - glm::dot(corner, axes.ahead),
                     std::abs(glm::dot(corner, axes.up)) / half.y - glm::dot(corner, axes.ahead)});
  }
  camera.position = scene::to_vec3(middle + 1.03 * away * to_camera);
  return camera;
}

} // namespace nephroid::inverse
