// SPDX-License-Identifier: Apache-2.0
#include "formats/import/gltf_file.h"

#include "base/files.h"
#include "base/foreign_kind.h"
#include "base/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nephroid::formats {
namespace {

constexpr const char* expected = "a glTF 2.0 file, .gltf or .glb";
constexpr const char* scenes = "expected glTF (.gltf, .glb), Mitsuba (.xml), PBRT (.pbrt) or GemCad (.asc)";
constexpr int max_depth = 64;

/// Without these the file's triangles cannot be read, where it requires them.
constexpr std::array compressions{"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};

/// Lists and objects within each other. A callback of the parser would tell as well, and take quadratic time in the
/// length of a list of objects (nlohmann-json 3.11: end_object).
int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_string = !is_string;
    if (is_string && c == '\\') ++i; // and what it escapes
    if (is_string) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

/// Of a file that is not JSON.
Error foreign(const std::filesystem::path& file, std::string_view text) {
  if (const ForeignKind* kind = foreign_kind(file, text))
    return bad_input(file.string(), fmt::format("is {}, which is not read", kind->what), scenes,
                     std::string(kind->remedy));
  constexpr std::array meshes{".obj", ".ply", ".stl", ".off", ".3ds", ".3mf"};
  if (std::ranges::count(meshes, lower_case(file.extension().string())) > 0)
    return bad_input(file.string(), "is a mesh and no scene", scenes, "name it as an object's \"mesh\" in a preset");
  return bad_input(file.string(), "is no scene that is read here", scenes);
}

GltfJson parse(const std::string& text, const std::string& name) {
  if (depth_of(text) > max_depth)
    throw bad_input(name, fmt::format("is nested deeper than {} levels", max_depth), expected);
  try {
    return GltfJson::parse(text);
  } catch (const GltfJson::parse_error& error) {
    throw bad_input(name, fmt::format("its JSON is broken at byte {}", error.byte), expected,
                    "check that the file is whole");
  } catch (const GltfJson::exception& error) {
    throw bad_input(name, fmt::format("its JSON cannot be read ({})", error.what()), expected);
  }
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value); // little-endian, as every machine that this runs on
  return value;
}

/// Section 4.4 of the specification: a header of 12 bytes, a chunk of JSON, then at most one of binary data.
void split_glb(const std::string& bytes, const std::string& name, std::string& json, std::string& bin) {
  constexpr std::uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;
  if (bytes.size() < 20) throw bad_input(name, fmt::format("is cut: it has {} bytes", bytes.size()), expected);
  if (word(bytes, 4) != 2) throw bad_input(name, fmt::format("is glTF of version {}", word(bytes, 4)), expected);
  if (word(bytes, 8) > bytes.size())
    throw bad_input(name, fmt::format("is cut: it has {} of its {} bytes", bytes.size(), word(bytes, 8)), expected,
                    "copy the file again");
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = word(bytes, at);
    if (size > bytes.size() - at - 8)
      throw bad_input(name, fmt::format("a chunk of {} bytes does not fit into it", size), expected);
    const std::uint32_t kind = word(bytes, at + 4);
    if (kind == json_chunk && json.empty()) json = bytes.substr(at + 8, size);
    if (kind == bin_chunk && bin.empty()) bin = bytes.substr(at + 8, size);
    at += 8 + size;
  }
  if (json.empty()) throw bad_input(name, "has no chunk of JSON", expected);
}

const GltfJson empty_object = GltfJson::object();

[[noreturn]] void refuse(const Location& where, const char* wanted) {
  throw bad_input(where, "is of a wrong kind", std::string("expected ") + wanted);
}

} // namespace

GltfFile read_gltf(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::string text = read_file(file);
  if (text.empty()) throw bad_input(name, "is empty", expected);
  GltfFile gltf{file, {}, {}};
  if (text.starts_with("glTF")) {
    std::string json;
    split_glb(text, name, json, gltf.bin);
    text = std::move(json);
  } else if (const std::size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
             first == text.npos || (text[first] != '{' && text[first] != '[')) // which is JSON's
    throw foreign(file, text);
  gltf.json = parse(text, name);
  const GltfValue root(gltf.json, gltf.where());
  if (!gltf.json.is_object() || !root.has("asset")) throw bad_input(name, "is no glTF: it has no \"asset\"", expected);
  const std::string version = root.object("asset").text("version");
  if (!version.starts_with("2."))
    throw bad_input(gltf.where() / "asset" / "version", "is \"" + version + "\"", expected);
  for (const std::string& required : root.texts("extensionsRequired"))
    if (std::ranges::count(compressions, required) > 0)
      throw bad_input(gltf.where() / "extensionsRequired", "the file's triangles are compressed by " + required,
                      "expected triangles that are not", "export it without that compression");
  return gltf;
}

GltfValue GltfValue::object(const char* key) const {
  const Location where = where_ / key;
  if (!has(key)) return {empty_object, where};
  const GltfJson& value = (*json_)[key];
  if (!value.is_object()) refuse(where, "an object");
  return {value, where};
}

std::vector<GltfValue> GltfValue::list(const char* key) const {
  std::vector<GltfValue> items;
  if (!has(key)) return items;
  const GltfJson& value = (*json_)[key];
  const Location where = where_ / key;
  if (!value.is_array()) refuse(where, "a list");
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!value[i].is_object()) refuse(where / i, "an object");
    items.emplace_back(value[i], where / i);
  }
  return items;
}

GltfValue GltfValue::item(const char* key, std::size_t index) const {
  const Location where = where_ / key;
  if (!has(key) || !(*json_)[key].is_array() || index >= (*json_)[key].size())
    throw bad_input(where, fmt::format("has no item {}", index));
  const GltfJson& value = (*json_)[key][index];
  if (!value.is_object()) refuse(where / index, "an object");
  return {value, where / index};
}

double GltfValue::number(const char* key, double standard) const {
  if (!has(key)) return standard;
  const GltfJson& value = (*json_)[key];
  if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(where_ / key, "a number");
  return value.get<double>();
}

std::uint64_t GltfValue::count(const char* key, std::uint64_t standard) const {
  const double value = number(key, static_cast<double>(standard));
  if (value < 0 || value >= 4294967296.0 || value != std::floor(value))
    refuse(where_ / key, "a whole number from 0 to 2^32");
  return static_cast<std::uint64_t>(value);
}

std::string GltfValue::text(const char* key) const {
  if (!has(key)) return {};
  const GltfJson& value = (*json_)[key];
  if (!value.is_string()) refuse(where_ / key, "a text");
  return value.get<std::string>();
}

std::vector<std::string> GltfValue::texts(const char* key) const {
  std::vector<std::string> texts_of_list;
  if (!has(key)) return texts_of_list;
  const GltfJson& value = (*json_)[key];
  if (!value.is_array()) refuse(where_ / key, "a list of texts");
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!value[i].is_string()) refuse(where_ / key / i, "a text");
    texts_of_list.push_back(value[i].get<std::string>());
  }
  return texts_of_list;
}

bool GltfValue::truth(const char* key, bool standard) const {
  if (!has(key)) return standard;
  if (!(*json_)[key].is_boolean()) refuse(where_ / key, "true or false");
  return (*json_)[key].get<bool>();
}

std::size_t GltfValue::checked_index(const GltfJson& json, const Location& where, const GltfValue& root,
                                     const char* list) const {
  const std::size_t size = root.has(list) && root.json()[list].is_array() ? root.json()[list].size() : 0;
  if (!json.is_number_integer() || json.get<double>() < 0) refuse(where, "an index");
  if (json.get<double>() >= static_cast<double>(size))
    throw bad_input(where, fmt::format("is {}, and there are {} {}", json.dump(), size, list));
  return json.get<std::size_t>();
}

std::size_t GltfValue::index(const char* key, const GltfValue& root, const char* list) const {
  if (!has(key)) throw bad_input(where_, fmt::format("has no \"{}\"", key));
  return checked_index((*json_)[key], where_ / key, root, list);
}

GltfValue GltfValue::item(const char* key, const GltfValue& root, const char* list) const {
  return root.item(list, index(key, root, list));
}

std::vector<std::size_t> GltfValue::indices(const char* key, const GltfValue& root, const char* list) const {
  std::vector<std::size_t> all;
  if (!has(key)) return all;
  const GltfJson& value = (*json_)[key];
  if (!value.is_array()) refuse(where_ / key, "a list of indices");
  for (std::size_t i = 0; i < value.size(); ++i) all.push_back(checked_index(value[i], where_ / key / i, root, list));
  return all;
}

std::vector<double> GltfValue::number_list(const char* key) const {
  if (!has(key)) return {};
  if (!(*json_)[key].is_array()) refuse(where_ / key, "a list of numbers");
  std::vector<double> values((*json_)[key].size());
  read_numbers(key, values.data(), values.size());
  return values;
}

void GltfValue::read_numbers(const char* key, double* values, std::size_t count) const {
  if (!has(key)) return;
  const GltfJson& value = (*json_)[key];
  if (!value.is_array() || value.size() != count) refuse(where_ / key, fmt::format("{} numbers", count).c_str());
  for (std::size_t i = 0; i < count; ++i) {
    if (!value[i].is_number() || !std::isfinite(value[i].get<double>())) refuse(where_ / key / i, "a number");
    values[i] = value[i].get<double>();
  }
}

} // namespace nephroid::formats
