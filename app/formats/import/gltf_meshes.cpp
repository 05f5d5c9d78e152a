// SPDX-License-Identifier: Apache-2.0
// Accessors of a glTF file, decoded (sections 3.6.2 and 3.7.2 of the specification). Whatever a file says of them is
// held against the bytes that are there.
#include "formats/import/gltf_scene.h"

#include "base/base64.h"
#include "base/files.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

/// "a%20b.bin" as the name of a file.
std::string decoded(std::string_view uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char value = 0;
    const char *const digits = uri.data() + i + 1, *const end = digits + 2;
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, end, value, 16).ptr == end;
    name += escaped ? static_cast<char>(value) : uri[i];
    if (escaped) i += 2;
  }
  return name;
}

/// The bytes of "data:KIND;base64,TEXT", whatever the kind.
std::string bytes_of_data(std::string_view uri, const Location& where) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) throw bad_input(where, "is a data URI without data", "expected data:...,DATA");
  const std::string_view data = uri.substr(comma + 1);
  if (!uri.substr(0, comma).ends_with(";base64")) return decoded(data);
  std::optional<std::string> bytes = from_base64(data);
  if (!bytes) throw bad_input(where, "is no base64", "expected A-Z, a-z, 0-9, + and /");
  return std::move(*bytes);
}

template <class Number>
double read_as(const char* from) {
  Number number{};
  std::memcpy(&number, from, sizeof number); // little-endian, as every machine that this runs on
  return static_cast<double>(number);
}

struct ComponentType {
  std::size_t bytes = 0; ///< 0: there is no such type
  double (*read)(const char*) = nullptr;
  double largest = 0; ///< which is 1 where numbers are normalized; 0: they never are
};

constexpr std::uint64_t first_component_type = 5120;
constexpr std::array<ComponentType, 7> component_types{{{1, read_as<std::int8_t>, 127},
                                                        {1, read_as<std::uint8_t>, 255},
                                                        {2, read_as<std::int16_t>, 32767},
                                                        {2, read_as<std::uint16_t>, 65535},
                                                        {},
                                                        {4, read_as<std::uint32_t>, 0},
                                                        {4, read_as<float>, 0}}};

const ComponentType& component_type(const GltfValue& value) {
  const std::uint64_t type = value.count("componentType", 0) - first_component_type; // what is smaller wraps round
  if (type >= component_types.size() || component_types[type].bytes == 0)
    throw bad_input(value.where() / "componentType", "is no type of glTF", "expected 5120 to 5126, but for 5124");
  return component_types[type];
}

const char* type_of_width(std::size_t width) {
  constexpr std::array<const char*, 5> types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  return width == 16 ? "MAT4" : types.at(width);
}

/// Each corner of a strip or a fan has a triangle with the two before it, or with the one before it and the first.
std::vector<glm::uvec3> triangles_of(const std::vector<std::uint32_t>& corners, std::uint64_t mode) {
  constexpr std::uint64_t strip = 5, fan = 6;
  std::vector<glm::uvec3> triangles;
  if (mode == strip || mode == fan)
    for (std::size_t i = 2; i < corners.size(); ++i)
      triangles.emplace_back(mode == fan  ? glm::uvec3(corners[0], corners[i - 1], corners[i])
                             : i % 2 == 0 ? glm::uvec3(corners[i - 2], corners[i - 1], corners[i])
                                          : glm::uvec3(corners[i - 1], corners[i - 2], corners[i]));
  else
    for (std::size_t i = 2; i < corners.size(); i += 3)
      triangles.emplace_back(corners[i - 2], corners[i - 1], corners[i]);
  return triangles;
}

} // namespace

GltfMeshes::GltfMeshes(const GltfFile& file) : file_(file), root_(file.json, file.where()) {}

const std::string& GltfMeshes::buffer(std::size_t index) const {
  const auto [found, is_new] = buffers_.try_emplace(index);
  std::string& bytes = found->second;
  if (!is_new) return bytes;
  const GltfValue value = root_.item("buffers", index);
  const std::uint64_t length = value.count("byteLength", 0);
  const GltfJson* const uri = value.has("uri") ? &value.json()["uri"] : nullptr;
  if (uri == nullptr) {
    if (index != 0 || file_.bin.empty())
      throw bad_input(value.where(), "has no \"uri\", and the file has no binary data for it");
    bytes = file_.bin;
  } else if (!uri->is_string()) {
    value.text("uri"); // refuses it
  } else if (const auto& text = uri->get_ref<const std::string&>(); text.starts_with("data:")) {
    bytes = bytes_of_data(text, value.where() / "uri");
  } else {
    const fs::path meant = fs::absolute(file_.file).parent_path() / decoded(text);
    std::error_code error;
    if (!fs::is_regular_file(meant, error))
      throw bad_input(value.where() / "uri", "there is no file '" + meant.string() + "'", {},
                      "put it beside the glTF file");
    bytes = read_file(meant);
  }
  if (bytes.size() < length)
    throw bad_input(value.where() / "byteLength", fmt::format("is {}, and there are {} bytes", length, bytes.size()),
                    {}, "copy the files again, or export the scene again");
  return bytes;
}

GltfMeshes::Picture GltfMeshes::picture(const GltfValue& image) const {
  if (!image.has("uri")) {
    if (!image.has("bufferView")) return {};
    const std::uint64_t length = image.item("bufferView", root_, "bufferViews").count("byteLength", 0);
    if (length == 0) return {};
    return {std::string(items(image, 1, length).first, length), {}};
  }
  const std::string uri = image.text("uri");
  if (uri.starts_with("data:")) return {bytes_of_data(uri, image.where() / "uri"), {}};
  return {{}, fs::absolute(file_.file).parent_path() / decoded(uri)};
}

/// The bytes of `count` items of `item` bytes each, with their distance. value: what has the items, and the view's
/// index.
GltfMeshes::Items GltfMeshes::items(const GltfValue& value, std::uint64_t count, std::size_t item) const {
  const GltfValue view = value.item("bufferView", root_, "bufferViews");
  const std::uint64_t stride = std::max<std::uint64_t>(view.count("byteStride", item), item),
                      offset = value.count("byteOffset", 0), length = view.count("byteLength", 0),
                      begin = view.count("byteOffset", 0), end = offset + (count - 1) * stride + item;
  if (end > length)
    throw bad_input(value.where(),
                    fmt::format("its {} items end at byte {} of a buffer view of {}", count, end, length));
  const std::string& bytes = buffer(view.index("buffer", root_, "buffers"));
  if (begin + length > bytes.size())
    throw bad_input(view.where(), fmt::format("ends at byte {} of a buffer of {}", begin + length, bytes.size()));
  return {bytes.data() + begin + offset, stride};
}

std::vector<double> GltfMeshes::numbers(const GltfValue& from, const char* key, std::size_t width) const {
  const GltfValue accessor = from.item(key, root_, "accessors");
  const std::string type = accessor.text("type");
  if (type != type_of_width(width))
    throw bad_input(accessor.where() / "type", "is \"" + type + "\"", std::string("expected ") + type_of_width(width));
  const ComponentType& component = component_type(accessor);
  const std::uint64_t count = accessor.count("count", 0);
  if (count == 0) throw bad_input(accessor.where() / "count", "is 0", "expected at least one item");
  const bool is_normalized = accessor.truth("normalized", false) && component.largest > 0;
  const auto read_item = [&](const char* bytes, double* to) {
    for (std::size_t i = 0; i < width; ++i) {
      const double number = component.read(bytes + i * component.bytes);
      to[i] = is_normalized ? std::max(number / component.largest, -1.0) : number;
    }
  };
  std::vector<double> numbers;
  if (accessor.has("bufferView")) {
    const Items at = items(accessor, count, component.bytes * width);
    numbers.resize(count * width);
    for (std::uint64_t i = 0; i < count; ++i) read_item(at.first + i * at.stride, &numbers[i * width]);
  }
  if (!accessor.has("sparse")) {
    if (numbers.empty())
      throw bad_input(accessor.where(), "has no data that is read here: no \"bufferView\"",
                      "expected triangles without compression (Draco, meshopt)", "export the scene without it");
    return numbers;
  }
  // Items that differ from those of the view, or from zeros.
  const GltfValue sparse = accessor.object("sparse"), places = sparse.object("indices");
  const std::uint64_t changed = sparse.count("count", 0);
  const ComponentType& place = component_type(places);
  if (changed == 0 || changed > count)
    throw bad_input(sparse.where() / "count", fmt::format("is {} of {} items", changed, count));
  const Items at = items(places, changed, place.bytes),
              values = items(sparse.object("values"), changed, component.bytes * width);
  constexpr std::uint64_t most_zeros = 1 << 20; // these are in no buffer that could be too short
  if (numbers.empty() && count > most_zeros)
    throw bad_input(accessor.where() / "count", fmt::format("is {} with {} items of data", count, changed));
  numbers.resize(count * width);
  for (std::uint64_t i = 0; i < changed; ++i) {
    const double index = place.read(at.first + i * at.stride);
    if (!(index >= 0 && index < static_cast<double>(count)))
      throw bad_input(places.where(), fmt::format("has item {} of {}", index, count));
    read_item(values.first + i * values.stride, &numbers[static_cast<std::size_t>(index) * width]);
  }
  return numbers;
}

scene::Mesh GltfMeshes::read(const GltfValue& primitive) const {
  scene::Mesh mesh;
  const GltfValue attributes = primitive.object("attributes");
  const std::vector<double> places = numbers(attributes, "POSITION", 3);
  for (std::size_t i = 0; i < places.size(); i += 3)
    mesh.positions.emplace_back(places[i], places[i + 1], places[i + 2]);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (const glm::vec3& p = mesh.positions[i]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw bad_input(primitive.where(), fmt::format("vertex {} has a coordinate that is not a finite number", i));
  if (attributes.has("NORMAL")) {
    const std::vector<double> normals = numbers(attributes, "NORMAL", 3);
    if (normals.size() != places.size())
      throw bad_input(primitive.where(),
                      fmt::format("has {} normals of {} vertices", normals.size() / 3, mesh.positions.size()));
    for (std::size_t i = 0; i < normals.size(); i += 3) {
      const glm::dvec3 normal(normals[i], normals[i + 1], normals[i + 2]);
      const double length = glm::length(normal);
      mesh.normals.emplace_back(length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0));
    }
  }
  std::vector<std::uint32_t> corners(mesh.positions.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  if (primitive.has("indices")) {
    corners.clear();
    for (const double index : numbers(primitive, "indices", 1)) {
      if (!(index >= 0 && index < static_cast<double>(mesh.positions.size())))
        throw bad_input(primitive.where(), fmt::format("has vertex {} of {}", index, mesh.positions.size()));
      corners.push_back(static_cast<std::uint32_t>(index));
    }
  }
  mesh.triangles = triangles_of(corners, primitive.count("mode", 4));
  if (!attributes.has("TEXCOORD_0")) return mesh;
  const std::vector<double> texcoords = numbers(attributes, "TEXCOORD_0", 2);
  if (texcoords.size() != 2 * mesh.positions.size()) return mesh;
  const auto texcoord = [&](std::size_t vertex) {
    const glm::vec2 place(texcoords[2 * vertex], texcoords[2 * vertex + 1]);
    return std::isfinite(place.x) && std::isfinite(place.y) ? place : glm::vec2(0);
  };
  for (const glm::uvec3& t : mesh.triangles) mesh.texcoords.push_back({texcoord(t.x), texcoord(t.y), texcoord(t.z)});
  return mesh;
}

scene::Mesh GltfMeshes::target(const scene::Mesh& own, const GltfValue& primitive, const GltfValue& target) const {
  scene::Mesh mesh = own;
  mesh.texcoords.clear();
  const auto add = [&](const char* key, std::vector<glm::vec3>& to) {
    if (!target.has(key) || to.empty()) return;
    const std::vector<double> ways = numbers(target, key, 3);
    if (ways.size() != 3 * to.size())
      throw bad_input(primitive.where() / "targets",
                      fmt::format("has {} {}S of {} vertices", ways.size() / 3, key, to.size()));
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] += glm::vec3(ways[3 * i], ways[3 * i + 1], ways[3 * i + 2]);
      if (!std::isfinite(glm::dot(to[i], to[i])))
        throw bad_input(primitive.where() / "targets", fmt::format("vertex {} is not a finite number there", i));
    }
  };
  add("POSITION", mesh.positions);
  add("NORMAL", mesh.normals);
  for (glm::vec3& normal : mesh.normals)
    if (const float length = glm::length(normal); length > 0) normal /= length;
  return mesh;
}

std::size_t GltfMeshes::move_by_joints(scene::Mesh& mesh, const GltfValue& primitive,
                                       const std::vector<glm::dmat4>& joints) const {
  const GltfValue attributes = primitive.object("attributes");
  std::vector<glm::dmat4> moves(mesh.positions.size(), glm::dmat4(0));
  std::vector<double> sums(moves.size());
  for (int set = 0; attributes.has(fmt::format("JOINTS_{}", set).c_str()); ++set) { // four joints each
    const std::vector<double> which = numbers(attributes, fmt::format("JOINTS_{}", set).c_str(), 4),
                              weights = numbers(attributes, fmt::format("WEIGHTS_{}", set).c_str(), 4);
    if (which.size() != 4 * moves.size() || weights.size() != which.size())
      throw bad_input(primitive.where(), fmt::format("has {} joints and {} weights of {} vertices", which.size() / 4,
                                                     weights.size() / 4, moves.size()));
    for (std::size_t i = 0; i < which.size(); ++i) {
      if (!(weights[i] > 0)) continue;
      if (!(which[i] >= 0 && which[i] < static_cast<double>(joints.size())))
        throw bad_input(primitive.where(), fmt::format("has joint {} of {}", which[i], joints.size()));
      moves[i / 4] += weights[i] * joints[static_cast<std::size_t>(which[i])];
      sums[i / 4] += weights[i];
    }
  }
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const glm::dmat4 move = sums[i] > 0 ? moves[i] / sums[i] : joints[0];
    mesh.positions[i] = glm::vec3(move * glm::dvec4(mesh.positions[i], 1));
    if (!std::isfinite(glm::dot(mesh.positions[i], mesh.positions[i])))
      throw bad_input(primitive.where(), fmt::format("its joints leave vertex {} nowhere", i),
                      "expected weights that add up to 1");
    if (mesh.normals.empty()) continue;
    const glm::dvec3 x(move[0]), y(move[1]), z(move[2]), n(mesh.normals[i]);
    const glm::dvec3 normal = n.x * glm::cross(y, z) + n.y * glm::cross(z, x) + n.z * glm::cross(x, y);
    const double length = glm::length(normal);
    mesh.normals[i] = length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0);
  }
  return static_cast<std::size_t>(std::ranges::count(sums, 0.0));
}

std::vector<glm::dmat4> GltfMeshes::instances(const GltfValue& node) const {
  constexpr const char* extension = "EXT_mesh_gpu_instancing";
  if (!node.object("extensions").has(extension)) return {glm::dmat4(1)};
  const GltfValue attributes = node.extension(extension).object("attributes");
  struct Attribute {
    const char* key;
    std::size_t width;
    std::vector<double> numbers;
  };
  std::array<Attribute, 3> all{{{"TRANSLATION", 3, {}}, {"ROTATION", 4, {}}, {"SCALE", 3, {}}}};
  std::size_t count = 0;
  for (Attribute& attribute : all) {
    if (!attributes.has(attribute.key)) continue;
    attribute.numbers = numbers(attributes, attribute.key, attribute.width);
    const std::size_t here = attribute.numbers.size() / attribute.width;
    if (count != 0 && here != count)
      throw bad_input(attributes.where() / attribute.key,
                      fmt::format("has {} items where others have {}", here, count));
    count = here;
  }
  std::vector<glm::dmat4> places(count, glm::dmat4(1));
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [t, r, s] = all;
    if (!t.numbers.empty()) places[i] = glm::translate(places[i], glm::make_vec3(&t.numbers[3 * i]));
    if (!r.numbers.empty()) {
      const double* const q = &r.numbers[4 * i];
      places[i] *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    }
    if (!s.numbers.empty()) places[i] = glm::scale(places[i], glm::make_vec3(&s.numbers[3 * i]));
  }
  return places;
}

} // namespace nephroid::formats
