// SPDX-License-Identifier: Apache-2.0
#include "formats/export/glb.h"

#include "base/error.h"

#include <algorithm>
#include <limits>

namespace nephroid::formats {
namespace {

// Component types of glTF 2.0.
constexpr int type_float = 5126, type_unsigned = 5125;

void append(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

/// A chunk ends at a multiple of 4.
void append_chunk(std::string& bytes, const char (&type)[5], std::string content, char fill) {
  content.resize((content.size() + 3) / 4 * 4, fill);
  append(bytes, static_cast<std::uint32_t>(content.size()));
  bytes.append(type, 4);
  bytes += content;
}

} // namespace

std::size_t Glb::add(const char* list, Json item) {
  Json& items = json[list];
  items.push_back(std::move(item));
  return items.size() - 1;
}

void Glb::use(const char* extension) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

std::size_t Glb::view(const void* bytes, std::size_t count) {
  bin_.resize((bin_.size() + 3) / 4 * 4);
  const std::size_t offset = bin_.size();
  bin_.append(static_cast<const char*>(bytes), count);
  return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", count}});
}

std::size_t Glb::accessor(const void* bytes, std::size_t count, int component, const char* type, Json bounds) {
  const std::size_t width = std::string_view(type) == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
  Json accessor{
      {"bufferView", view(bytes, 4 * count * width)}, {"componentType", component}, {"count", count}, {"type", type}};
  accessor.update(bounds);
  return add("accessors", std::move(accessor));
}

std::size_t Glb::positions(const std::vector<glm::vec3>& values) {
  glm::vec3 low = values.front(), high = low;
  for (const glm::vec3& v : values) low = glm::min(low, v), high = glm::max(high, v);
  return accessor(values.data(), values.size(), type_float, "VEC3",
                  {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}});
}

std::size_t Glb::normals(const std::vector<glm::vec3>& values) {
  return accessor(values.data(), values.size(), type_float, "VEC3");
}

std::size_t Glb::places(const std::vector<glm::vec2>& values) {
  return accessor(values.data(), values.size(), type_float, "VEC2");
}

std::size_t Glb::corners(const std::vector<glm::uvec3>& triangles) {
  return accessor(triangles.data(), 3 * triangles.size(), type_unsigned, "SCALAR");
}

std::size_t Glb::png(std::string_view bytes) {
  return add("images", {{"bufferView", view(bytes.data(), bytes.size())}, {"mimeType", "image/png"}});
}

std::string Glb::bytes() const {
  Json complete = json;
  complete["buffers"] = {{{"byteLength", bin_.size()}}};
  std::string chunks;
  append_chunk(chunks, "JSON", complete.dump(), ' ');
  append_chunk(chunks, "BIN\0", bin_, '\0');
  if (chunks.size() > std::numeric_limits<std::uint32_t>::max() - 12)
    throw failed("scene.glb", "the scene is larger than 4 GiB, the most that the format holds");
  std::string file = "glTF";
  append(file, 2);
  append(file, static_cast<std::uint32_t>(12 + chunks.size()));
  return file + chunks;
}

} // namespace nephroid::formats
