// SPDX-License-Identifier: Apache-2.0
// A PBRT scene, imported. What comes out is a preset that can be read.
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  const fs::path preset = folder() / "imported.json";
  formats::import_scene(write("scene.pbrt", input), preset);
  try {
    preset::read_preset(preset.string());
  } catch (const Error& refusal) {
    finding("an imported scene cannot be read: " + refusal.line());
  }
}

std::vector<std::string> seeds() {
  return {R"(LookAt 1 3 6 0 0 0 0 1 0 Camera "perspective" "float fov" 45 WorldBegin
LightSource "spot" "rgb I" [ 1 2 3 ] "float coneangle" 30
MakeNamedMaterial "g" "string type" "dielectric" "float eta" 1.5
AttributeBegin NamedMaterial "g" Rotate 30 0 1 0 Shape "sphere" "float radius" 2 AttributeEnd
ObjectBegin "o" Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ] ObjectEnd
Translate 1 2 3 ObjectInstance "o" AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] Shape "disk")",
          R"(Film "image" WorldBegin MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_a" [ 1 2 3 ]
Attribute "shape" "float radius" 2 NamedMaterial "later" MediumInterface "m" "" Shape "sphere" ReverseOrientation
Material "dielectric" "spectrum eta" [ 400 1.5 700 1.4 ] Shape "sphere" "float radius" 0.5
Material "thindielectric" "rgb Kt" [ 1 0 1 ] Shape "bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]
Material "interface" Shape "loopsubdiv" "integer levels" 1 "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ]
ObjectBegin "a" Shape "sphere" ObjectEnd ObjectBegin "b" ObjectInstance "a" ObjectEnd ObjectInstance "b"
MakeNamedMaterial "later" "string type" "dielectric" "spectrum eta" "glass-BK7"
AreaLightSource "diffuse" "spectrum L" "stdillum-A" "bool twosided" true "float power" 9 Shape "disk"
LightSource "point" "blackbody I" 3000 LightSource "infinite" "spectrum L" [ 400 1 700 2 ])"};
}

} // namespace nephroid::fuzz
