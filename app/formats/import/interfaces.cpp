// SPDX-License-Identifier: Apache-2.0
// A glass of water as Mitsuba's manual draws it: open surfaces between glass and air, water and air, water and glass. A
// preset has bodies: each gets all surfaces that bound its medium.
#include "formats/import/dielectrics.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::formats {
namespace {

struct Surface {
  std::size_t shape = 0;
  double inside = 1, outside = 1; ///< inside: where the mesh's normals look away from
};

/// Open surfaces that say what is on both their sides.
std::vector<Surface> surfaces_of(const Description& d) {
  std::vector<Surface> surfaces;
  std::map<std::string, bool> closed; // by meshes, which instances share
  for (std::size_t i = 0; i < d.shapes.size(); ++i) {
    const DescribedShape& shape = d.shapes[i];
    const auto found = d.dielectrics.find(shape.material);
    if (found == d.dielectrics.end() || shape.glow || shape.mesh.empty()) continue;
    const DescribedGlass& glass = found->second;
    if (glass.is_ratio || glass.is_thin) continue;
    const auto [known, is_new] = closed.try_emplace(shape.mesh);
    if (is_new) known->second = scene::inspect(d.meshes.at(shape.mesh)).closed();
    if (known->second) continue;
    Surface surface{i, middle_index(glass.inside), glass.outside};
    if (shape.inside_out) std::swap(surface.inside, surface.outside);
    surfaces.push_back(surface);
  }
  return surfaces;
}

/// Adds the surface where it stands from `origin`, its normals away from the medium. reaching: gets the places that it
/// has.
void add_surface(scene::Mesh& body, const Description& d, const DescribedShape& shape, const glm::dvec3& origin,
                 bool turned, bool& smooth, std::set<Place>* reaching) {
  scene::Mesh mesh = d.meshes.at(shape.mesh);
  const bool has_normals = shape.smooth.value_or(!mesh.normals.empty());
  if (!has_normals) mesh.normals.clear();
  if (has_normals && mesh.normals.empty()) scene::compute_smooth_normals(mesh);
  smooth = smooth || has_normals;
  const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(shape.to_world)));
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(shape.to_world * glm::dvec4(glm::dvec3(p), 1)) - origin);
  for (glm::vec3& n : mesh.normals) n = glm::vec3(glm::normalize(turn * glm::dvec3(n)));
  if (glm::determinant(turn) < 0) scene::turn_triangles(mesh);
  if (turned) scene::turn_round(mesh);
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(body.positions.size());
    body.triangles.emplace_back(first, first + 1, first + 2);
    const glm::vec3 across =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    for (int i = 0; i < 3; ++i) {
      body.positions.push_back(mesh.positions[t[i]]);
      const bool flat = mesh.normals.empty();
      body.normals.push_back(!flat                     ? mesh.normals[t[i]]
                             : glm::length(across) > 0 ? glm::normalize(across)
                                                       : glm::vec3(0, 0, 1));
      if (reaching) reaching->insert(place_of(mesh.positions[t[i]]));
    }
  }
}

} // namespace

void join_interfaces(Description& d) {
  const std::vector<Surface> surfaces = surfaces_of(d);
  const auto is_interface = [](const Surface& s) { return !alike(s.inside, 1) && !alike(s.outside, 1); };
  if (surfaces.size() < 2 || std::ranges::none_of(surfaces, is_interface)) return;
  std::vector<double> media;
  for (const Surface& s : surfaces)
    for (const double n : {s.inside, s.outside})
      if (!alike(n, 1) && std::ranges::none_of(media, [&](double m) { return alike(n, m); })) media.push_back(n);
  std::ranges::sort(media);
  const glm::dvec3 origin(d.shapes[surfaces[0].shape].to_world[3]); // near all: single precision is about it
  std::vector<DescribedShape> bodies;
  for (const double n : media) {
    scene::Mesh mesh;
    bool smooth = false;
    std::set<Place> reaching;
    const Surface* owner = nullptr; // whose bsdf has the medium
    for (const Surface& s : surfaces) {
      if (!alike(s.inside, n) && !alike(s.outside, n)) continue;
      const bool turned = !alike(s.inside, n);
      const bool beside_denser = std::max(s.inside, s.outside) > n && !alike(std::max(s.inside, s.outside), n);
      add_surface(mesh, d, d.shapes[s.shape], origin, turned, smooth, beside_denser ? &reaching : nullptr);
      if (!owner || (alike(owner->inside, n) ? 0 : 1) > (turned ? 1 : 0)) owner = &s;
    }
    DescribedShape body = d.shapes[owner->shape];
    DescribedGlass glass = d.dielectrics.at(body.material);
    const bool is_own = alike(middle_index(glass.inside), n);
    if (!is_own) glass = {};
    if (!is_own) glass.inside.n = n;
    glass.outside = 1;
    body.material = name_of(fmt::format("n {:.4g}", n), "glass");
    for (int i = 2; d.dielectrics.contains(body.material); ++i) body.material = fmt::format("n {:.4g} {}", n, i);
    d.dielectrics[body.material] = glass;
    if (!scene::inspect(mesh).closed())
      d.note(body.where, fmt::format("the surfaces about what has n = {:.4g} leave a hole", n));
    reach_out(mesh, &reaching);
    if (!smooth) mesh.normals.clear();
    body.mesh = d.own_mesh(body.material, std::move(mesh));
    body.name = body.material;
    body.to_world = glm::translate(glm::dmat4(1), origin);
    body.inside_out = false;
    body.smooth.reset();
    body.priority = static_cast<int>(bodies.size());
    d.note(body.where, fmt::format("the surfaces about what has n = {:.4g} are one body here", n));
    bodies.push_back(std::move(body));
  }
  for (auto s = surfaces.rbegin(); s != surfaces.rend(); ++s)
    d.shapes.erase(d.shapes.begin() + static_cast<std::ptrdiff_t>(s->shape));
  d.shapes.insert(d.shapes.end(), bodies.begin(), bodies.end());
}

} // namespace nephroid::formats
