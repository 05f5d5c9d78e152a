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
<emitter type="spot"><float name="cutoff_angle" value="30"/></emitter></scene>)"};
}

} // namespace nephroid::fuzz
