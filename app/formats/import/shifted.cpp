// SPDX-License-Identifier: Apache-2.0
// Meshes whose vertices move along their normals: surfaces that become sheets, bodies that reach into others.
#include "formats/import/dielectrics.h"

namespace nephroid::formats {

void reach_out(scene::Mesh& body, const std::set<Place>* places) {
  scene::Mesh even = body;
  scene::compute_smooth_normals(even);
  glm::vec3 low(1e30f), high(-1e30f);
  for (const glm::vec3& p : body.positions) low = glm::min(low, p), high = glm::max(high, p);
  const float distance = static_cast<float>(reach) * glm::length(high - low);
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    if (!places || places->contains(place_of(body.positions[i]))) body.positions[i] += distance * even.normals[i];
}

scene::Mesh sheet_about(const scene::Mesh& mesh, double thickness) {
  scene::Mesh about = mesh;
  scene::compute_smooth_normals(about);
  scene::Mesh sheet;
  const bool smooth = !mesh.normals.empty();
  const auto add = [&](std::uint32_t vertex, float side, const glm::vec3& normal) {
    sheet.positions.push_back(mesh.positions[vertex] +
                              side * static_cast<float>(thickness / 2) * about.normals[vertex]);
    if (smooth) sheet.normals.push_back(normal);
    return static_cast<std::uint32_t>(sheet.positions.size() - 1);
  };
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  for (const float side : {1.0f, -1.0f})
    for (std::uint32_t i = 0; i < count; ++i) add(i, side, smooth ? side * mesh.normals[i] : glm::vec3(0));
  // An edge is on the rim where no triangle has it the other way round. Vertices at one place count as one.
  const auto place = [&](std::uint32_t i) { return place_of(mesh.positions[i]); };
  std::set<std::pair<Place, Place>> edges;
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) edges.emplace(place(t[i]), place(t[(i + 1) % 3]));
  for (const glm::uvec3& t : mesh.triangles) {
    sheet.triangles.push_back(t);
    sheet.triangles.emplace_back(count + t.x, count + t.z, count + t.y);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (edges.contains({place(b), place(a)})) continue;
      const glm::vec3 across = glm::cross(mesh.positions[b] - mesh.positions[a], about.normals[a] + about.normals[b]);
      const glm::vec3 out = glm::length(across) > 0 ? glm::normalize(across) : about.normals[a];
      const std::uint32_t top_a = add(a, 1, out), top_b = add(b, 1, out), low_a = add(a, -1, out),
                          low_b = add(b, -1, out);
      sheet.triangles.emplace_back(top_b, top_a, low_a);
      sheet.triangles.emplace_back(top_b, low_a, low_b);
    }
  }
  return sheet;
}

} // namespace nephroid::formats
