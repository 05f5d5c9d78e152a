// SPDX-License-Identifier: Apache-2.0
// From triangles to planar faces.
#include "inverse/light.h"
#include "inverse/step/step.h"

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <unordered_map>

namespace nephroid::inverse {
namespace {

std::uint64_t way(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

class FaceMaker {
public:
  FaceMaker(const Layout& layout, const Solid& solid) : layout_(layout), mesh_(solid.mesh), solid_(solid) {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) triangle_at_[way(mesh_.triangles[t][i], mesh_.triangles[t][(i + 1) % 3])] = t;
  }

  /// Each face has an edge in common with one before it: OpenCascade's readers search long for it elsewhere.
  StepSolid faces() {
    StepSolid made;
    made.vertices.assign(mesh_.positions.begin(), mesh_.positions.end());
    const std::vector<Key> keys = all_keys();
    std::vector<bool> done(keys.size());
    std::vector<std::size_t> group, seeds{0};
    for (std::size_t seed = 0; seed < seeds.size(); ++seed) {
      const std::size_t first = seeds[seed];
      if (done[first]) continue;
      // All triangles of one plane that hang together by edges, and the edges about them.
      std::unordered_map<std::uint32_t, std::uint32_t> next;
      group.assign(1, first);
      done[first] = true;
      for (std::size_t k = 0; k < group.size(); ++k) {
        const glm::uvec3& t = mesh_.triangles[group[k]];
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t a = t[i], b = t[(i + 1) % 3];
          const std::size_t other = triangle_at_.at(way(b, a));
          if (keys[other] != keys[first]) {
            if (!next.try_emplace(a, b).second) refuse();
            seeds.push_back(other);
          } else if (!done[other]) {
            done[other] = true;
            group.push_back(other);
          }
        }
      }
      made.faces.push_back(plane_of(first));
      made.faces.back().ring = ring_of(next);
    }
    return made;
  }

private:
  /// What triangles of one face have in common. Walls end with their facet, and so stay simple.
  struct Key {
    Part part = Part::front;
    std::size_t number = 0; ///< the facet's, the wall's, or the triangle's own
    int axis = 2;           ///< which the plane is across; +x and -x differ
    float at = 0;
    bool operator==(const Key&) const = default;
  };

  glm::dvec3 corner(std::size_t triangle, int i) const { return mesh_.positions[mesh_.triangles[triangle][i]]; }
  glm::dvec3 across(std::size_t triangle) const {
    return glm::cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
  }
  glm::dvec2 middle(std::size_t triangle) const {
    return glm::dvec2(corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0;
  }

  std::vector<Key> all_keys() const {
    std::vector<Key> keys;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      Key key{.part = solid_.parts[t]};
      const glm::uvec3& corners = mesh_.triangles[t];
      const glm::vec3 a = mesh_.positions[corners.x], b = mesh_.positions[corners.y], c = mesh_.positions[corners.z];
      if (key.part == Part::facet) key.number = facet_at(layout_, middle(t));
      if (key.part == Part::wall || key.part == Part::side) {
        const glm::dvec3 n = across(t);
        for (const int axis : {0, 1})
          if (a[axis] == b[axis] && a[axis] == c[axis]) {
            key.axis = n[axis] > 0 ? axis : axis + 3;
            key.at = a[axis];
          }
        if (key.axis == 2)
          key.number = t;
        else if (key.part == Part::wall)
          key.number =
              facet_at(layout_, middle(t) + layout_.facet() * glm::dvec2(key.axis % 3 == 0, key.axis % 3 == 1) * 0.25);
      }
      keys.push_back(key);
    }
    return keys;
  }

  StepFace plane_of(std::size_t triangle) const {
    StepFace face;
    if (solid_.parts[triangle] == Part::facet) {
      const std::size_t i = facet_at(layout_, middle(triangle));
      const Facet& facet = solid_.facets[i];
      face.at = {layout_.middle(i), facet.height};
      face.normal = glm::normalize(glm::dvec3(facet.gradient, -1));
    } else {
      face.at = corner(triangle, 0);
      face.normal = glm::normalize(across(triangle));
    }
    return face;
  }

  static std::vector<std::uint32_t> ring_of(const std::unordered_map<std::uint32_t, std::uint32_t>& next) {
    std::vector<std::uint32_t> ring{next.begin()->first};
    for (std::uint32_t id = next.begin()->second; id != ring.front(); id = next.at(id)) ring.push_back(id);
    if (ring.size() != next.size()) refuse();
    return ring;
  }

  [[noreturn]] static void refuse() {
    throw failed("object.step", "a face of the object has more than one ring", {},
                 "take the STL, and report this with the preset");
  }

  const Layout& layout_;
  const scene::Mesh& mesh_;
  const Solid& solid_;
  std::unordered_map<std::uint64_t, std::size_t> triangle_at_; ///< by its directed edges
};

} // namespace

StepSolid step_faces(const Layout& layout, const Solid& solid) { return FaceMaker(layout, solid).faces(); }

} // namespace nephroid::inverse
