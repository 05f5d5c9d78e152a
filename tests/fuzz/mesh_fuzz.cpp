// SPDX-License-Identifier: Apache-2.0
// OBJ, PLY and STL files; what the mesh reader's program answers, and what is made of a mesh that is believed.
#include "scene/bvh.h"
#include "scene/mesh_parts.h"
#include "scene/mesh_raw.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

template <class Item>
std::string list(const std::vector<Item>& items) {
  const std::uint64_t count = items.size();
  std::string bytes(sizeof count + count * sizeof(Item), '\0');
  std::memcpy(bytes.data(), &count, sizeof count);
  if (count > 0) std::memcpy(bytes.data() + sizeof count, static_cast<const void*>(items.data()), count * sizeof(Item));
  return bytes;
}

std::string answer(const std::vector<char>& refusal, const std::vector<glm::vec3>& normals) {
  const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<glm::uvec3> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return list(refusal) + list(corners) + list(normals) + list(triangles) + list(std::vector<std::uint32_t>{0}) +
         list(std::vector<double>{5, 0, 0});
}

scene::Mesh mesh_of(std::string_view bytes) {
  try {
    if (bytes.starts_with("ply")) return finished(scene::read_ply(bytes));
    if (bytes.starts_with("solid") || bytes.starts_with("STL")) return finished(scene::read_stl(bytes));
    if (bytes.starts_with("v ") || bytes.starts_with("#")) return finished(scene::read_obj(std::string(bytes)));
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
        fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"), std::fclose);
    std::optional<scene::MeshAnswer> answer = scene::take_answer(stream.get());
    if (!answer) throw std::runtime_error("it is cut");
    return scene::mesh_of(std::move(*answer));
  } catch (const std::runtime_error& refusal) { // load_mesh() says which file
    throw bad_input("mesh", scene::printable(refusal.what()));
  }
}

} // namespace

void read(std::string_view input) {
  if (input.empty()) return;
  scene::Mesh mesh = mesh_of(input);
  scene::inspect(mesh);
  scene::drop_useless(mesh);
  if (mesh.triangles.empty()) return; // load_mesh() refuses it
  scene::compute_smooth_normals(mesh);
  scene::enclosing_sphere(mesh, mesh.triangles);
  scene::signed_volume(mesh, 0, static_cast<std::uint32_t>(mesh.triangles.size()));
  scene::build_bvh(mesh);
}

std::vector<std::string> seeds() {
  return {
      answer({}, {}),
      answer({}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}),
      answer({'n', 'o'}, {}),
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty "
      "float nx\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "5e5 .5 0 1\n500001 .5 0 1\n500000 1.5 0 1\n500000 .5 1 1\n9 0 2 1 3 0 2 -1 0 1\n",
      "ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list uchar short vertex_index\nend_header\n\1aa",
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar short i\nend_header\n\3aabbcc",
      "v .5 0 0\nv 1E0 0 0 2\nv 0 1,0 0\nv 0 0 1 1 1 1\nvn 0 0 1\nf 1//1 2//-1 3 \\\n 4/1/1\nf -1 -2 -3\n",
      "# a map\nv 500000.07 100.45 5400000.32\nv 500000.17 100.45 5400000.32\nv 500000.07 100.55 5400000.32\nf 1 2 3\n",
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n",
      "STL" + std::string(77, ' ') + std::string("\1\0\0\0", 4) + std::string(50, 'a')};
}

} // namespace nephroid::fuzz
