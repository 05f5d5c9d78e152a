// SPDX-License-Identifier: Apache-2.0
// A Mitsuba scene, or a mesh of Mitsuba's own in one, imported. What comes out is a preset that can be read.
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

constexpr const char* mesh_start = "\x1c\x04";

/// A triangle with normals, in a zlib stream that is not packed, so that its bytes are there to be damaged.
std::string serialized() {
  std::string data;
  const auto put = [&data](auto value) { data.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{0x1001});
  data += std::string("t") + '\0';
  put(std::uint64_t{3});
  put(std::uint64_t{1});
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(x);
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f}) put(x);
  for (const std::uint32_t corner : {0u, 1u, 2u}) put(corner);
  const auto size = static_cast<std::uint16_t>(data.size());
  const std::string block = std::exchange(data, mesh_start);
  put(std::uint16_t{4});
  data += "\x78\x01\x01";
  put(size);
  put(static_cast<std::uint16_t>(~size));
  return data + block;
}

} // namespace

void read(std::string_view input) {
  const fs::path preset = folder() / "imported.json";
  constexpr const char* around = R"(<scene version="3.0.0"><shape type="serialized">
<string name="filename" value="mesh.serialized"/></shape></scene>)";
  const bool is_mesh = input.starts_with(mesh_start);
  if (is_mesh) write("mesh.serialized", input);
  formats::import_scene(write("scene.xml", is_mesh ? around : input), preset);
  try {
    preset::read_preset(preset.string());
  } catch (const Error& refusal) {
    finding("an imported scene cannot be read: " + refusal.line());
  }
}

std::vector<std::string> seeds() {
  return {
      R"(<scene version="3.0.0"><default name="n" value="1.5"/><sensor type="perspective"><float name="fov" value="45"/>
<transform name="to_world"><lookat origin="1,3,6" target="0,0,0" up="0,1,0"/></transform></sensor>
<bsdf type="twosided" id="a"><bsdf type="diffuse"><rgb name="reflectance" value="0.5 0.2 0.1"/></bsdf></bsdf>
<shape type="rectangle"><transform name="toWorld"><rotate x="1" angle="-90"/><scale value="4"/></transform><ref id="a"/></shape>
<shape type="sphere"><bsdf type="dielectric"><float name="intIOR" value="$n"/></bsdf></shape>
<shape type="disk"><emitter type="area"><rgb name="radiance" value="1 2 3"/></emitter></shape>
<emitter type="spot"><float name="cutoff_angle" value="30"/></emitter></scene>)",
      R"(<scene version="3.0.0"><path value="."/><alias id="g" as="h"/><shape type="shapegroup" id="s"><shape type="cube">
<ref id="h"/><boolean name="flip_normals" value="true"/><ref name="interior" id="m"/></shape></shape>
<shape type="instance"><ref id="s"/><transform name="to_world"><scale value="0.5"/></transform></shape>
<bsdf type="dielectric" id="g"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1.33"/></bsdf>
<medium type="homogeneous" id="m"><rgb name="sigma_t" value="1 2 3"/><float name="albedo" value="0"/></medium>
<shape type="rectangle"><bsdf type="thindielectric"/></shape><shape type="disk"><bsdf type="null"/></shape>
<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="400:0.1, 700:0.9"/></bsdf></shape>
<emitter type="point">
<spectrum type="blackbody" name="intensity"><float name="temperature" value="3000"/></spectrum></emitter></scene>)",
      serialized()};
}

} // namespace nephroid::fuzz
