// SPDX-License-Identifier: Apache-2.0
// A small glTF file, and importing one.
#pragma once
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/support/meshes.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

#include <cstring>

namespace nephroid::test {

/// A triangle with corners (0, 0, 0), (1, 0, 0), (0, 1, 0) and three indices.
inline std::string triangle_bytes() {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t indices[] = {0, 1, 2};
  std::string bytes(sizeof positions + sizeof indices, '\0');
  std::memcpy(bytes.data(), positions, sizeof positions);
  std::memcpy(bytes.data() + sizeof positions, indices, sizeof indices);
  return bytes;
}

inline nlohmann::json triangle() {
  return nlohmann::json::parse(
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"tri"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
    "materials":[{"name":"wall","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
    "buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)" +
      base64(triangle_bytes()) + R"("}]})");
}

inline std::string word(std::uint32_t value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

/// With its buffer in the binary chunk.
inline std::string glb(nlohmann::json json) {
  json["buffers"][0].erase("uri");
  std::string text = json.dump(), bin = triangle_bytes();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  const auto size = static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + bin.size());
  return "glTF" + word(2) + word(size) + word(static_cast<std::uint32_t>(text.size())) + "JSON" + text +
         word(static_cast<std::uint32_t>(bin.size())) + std::string("BIN\0", 4) + bin;
}

class GltfImport : public testing::Test {
protected:
  formats::Imported import(const std::string& bytes, const std::string& name = "in.gltf") {
    return formats::import_scene(folder.write(name, bytes), folder.path() / "out.json");
  }
  preset::Preset imported(const nlohmann::json& json) {
    made = import(json.dump());
    return preset::read_preset(made.preset.string());
  }
  /// What the import says; it has to leave nothing behind.
  std::string refusal(const nlohmann::json& json) {
    const std::string line = refusal_of([&] { import(json.dump()); });
    EXPECT_FALSE(fs::exists(folder.path() / "out.json"));
    return line.starts_with((folder.path() / "in.gltf").string())
               ? line.substr((folder.path() / "in.gltf").string().size())
               : line;
  }

  TemporaryFolder folder;
  formats::Imported made;
};

} // namespace nephroid::test
