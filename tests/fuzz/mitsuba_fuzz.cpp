// SPDX-License-Identifier: Apache-2.0
// A Mitsuba scene, imported. What comes out is a preset that can be read.
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  const fs::path preset = folder() / "imported.json";
  formats::import_scene(write("scene.xml", input), preset);
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
<shape type="serialized"><string name="filename" value="scene.xml"/></shape><emitter type="point">
<spectrum type="blackbody" name="intensity"><float name="temperature" value="3000"/></spectrum></emitter></scene>)"};
}

} // namespace nephroid::fuzz
