// SPDX-License-Identifier: Apache-2.0
// A glTF scene as JSON or as a .glb, imported with the mesh reader. What comes out is a preset that can be read.
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

/// A triangle in a data URI, under a lamp, before a camera.
constexpr const char* scene = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":40,"color":[1,0.5,0.2],"spot":{"outerConeAngle":0.5}}]}},
"nodes":[{"name":"t","mesh":0,"rotation":[0,0.7071068,0,0.7071068],"scale":[1,2,1]},
 {"camera":0,"translation":[0,0,3]},{"extensions":{"KHR_lights_punctual":{"light":0}},"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,4,0,1]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1,"aspectRatio":1.5}}],
"materials":[{"name":"glass","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":0,"roughnessFactor":0},
 "extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.5},
 "KHR_materials_dispersion":{"dispersion":0.3},
 "KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":0.5,"attenuationColor":[0.8,0.9,1]}}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}]})";

/// Instances, quantized and sparse numbers, a strip, what is hidden; one buffer has no data URI's usual head.
constexpr const char* shapes = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"extensionsUsed":["EXT_mesh_gpu_instancing","KHR_mesh_quantization","KHR_node_visibility","KHR_texture_transform"],
"extensionsRequired":["KHR_mesh_quantization","KHR_materials_variants"],
"nodes":[{"mesh":0,"scale":[-1,1,1],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,"ROTATION":2,"SCALE":0}}}},
 {"mesh":0,"children":[],"extensions":{"KHR_node_visibility":{"visible":false}}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":3},"mode":5},{"attributes":{"POSITION":1},"indices":4,"mode":6}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
 {"bufferView":1,"byteOffset":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"},
 {"bufferView":0,"componentType":5120,"normalized":true,"count":3,"type":"VEC4"},
 {"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":0}}},
 {"bufferView":2,"componentType":5121,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteLength":36,"byteStride":8},{"buffer":1,"byteLength":3}],
"buffers":[{"byteLength":42,"uri":"data:application/gltf-buffer;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"},
 {"byteLength":3,"uri":"data:,%00%01%02"}]})";

std::string glb(std::string json) {
  while (json.size() % 4 != 0) json += ' ';
  const std::uint32_t words[] = {2, static_cast<std::uint32_t>(20 + json.size()),
                                 static_cast<std::uint32_t>(json.size())};
  std::string file = "glTF" + std::string(sizeof words, '\0') + "JSON" + json;
  std::memcpy(file.data() + 4, words, sizeof words);
  return file;
}

} // namespace

void read(std::string_view input) {
  const fs::path preset = folder() / "imported.json";
  formats::import_scene(write(input.starts_with("glTF") ? "scene.glb" : "scene.gltf", input), preset);
  try {
    preset::read_preset(preset.string());
  } catch (const Error& refusal) {
    finding("an imported scene cannot be read: " + refusal.line());
  }
}

std::vector<std::string> seeds() { return {scene, glb(scene), shapes}; }

} // namespace nephroid::fuzz
