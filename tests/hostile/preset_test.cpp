// SPDX-License-Identifier: Apache-2.0
// Bad presets: each is refused with exactly one line that says where, what is wrong, what is expected and what to do.
#include "preset/read.h"
#include "tests/support/process_state.h"

namespace nephroid::preset_test {

/// What is given, and the line that refuses it (for a preset's text: after the file's name).
struct Case {
  std::string text, line;
};

std::string top(const std::string& fields) { return R"({"engine":"spectral",)" + fields + "}"; }
std::string scene(const std::string& fields) { return top(R"("scene":{)" + fields + "}"); }
std::string object(const std::string& json) {
  return scene(R"("materials":{"m":{"type":"diffuse"}},"objects":[)" + json + "]");
}
std::string light(const std::string& json) { return scene(R"("lights":[)" + json + "]"); }
std::string sky(const std::string& fields) { return scene(R"("environment":{"type":"sky",)" + fields + "}"); }
std::string camera(const std::string& fields) { return scene(R"("camera":{)" + fields + "}"); }
std::string material(const std::string& name, const std::string& json) {
  return scene(R"("materials":{")" + name + R"(":)" + json + "}");
}
std::string shape(const std::string& json) { return object(R"({"material":"m","shape":)" + json + "}"); }
std::string spectral_with(const std::string& fields) { return top(R"("spectral":{)" + fields + "}"); }
std::string glass(const std::string& dispersion) {
  return material("glass", R"({"type":"dielectric","dispersion":)" + dispersion + "}");
}

/// "[1,2,...,count]"
std::string numbers(int count) {
  std::string list = "[1";
  for (int i = 2; i <= count; ++i) list += fmt::format(",{}", i);
  return list + "]";
}

std::string zeros(int count) {
  std::string pointer;
  for (int i = 0; i < count; ++i) pointer += "/0";
  return pointer;
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

class BadPresets : public testing::Test {
protected:
  test::TemporaryFolder folder;
  test::CurrentFolder here{folder.path()}; // so that lines show short names
};

TEST_F(BadPresets, AreRefusedInOneLine) {
  const std::string shapes = "quad, box, sphere, cylinder, prism, plate, brilliant, curtain_wall, water, relief";
  const std::vector<Case> cases = {
      {R"()", R"(: is empty; expected a preset: one JSON object)"},
      {"\n\n  ", R"(: is empty; expected a preset: one JSON object)"},
      {"{\"engine\":\"spectral\",\n  \"seed\" 1}",
       R"(:2:10: is not JSON; syntax error while parsing object separator - unexpected number literal; expected ':')"},
      {R"({"engine":"spectral","scene":{"camera")",
       R"(:1:39: is not JSON; syntax error while parsing object separator - unexpected end of input; expected ':')"},
      {"{\"engine\":\"spectral\" // which\n}",
       R"(:1:22: is not JSON; syntax error while parsing object - invalid literal; last read: '"spectral" /'; expected '}')"},
      {R"({"engine":"spectral",})",
       R"(:1:22: is not JSON; syntax error while parsing object key - unexpected '}'; expected string literal)"},
      {R"({"engine":"spectral"} {})",
       R"(:1:23: is not JSON; syntax error while parsing value - unexpected '{'; expected end of input)"},
      {"{\"engine\":\"spectral\",\n\"white\":1e999}", R"(:2:13: is not JSON; number overflow parsing '1e999')"},
      {top(R"("white":NaN)"),
       R"(:1:30: is not JSON; syntax error while parsing value - invalid literal; last read: '"white":N')"},
      {"{\"engine\":\"spectral\",\"name\":\"\xff\"}",
       R"(:1:30: is not JSON; syntax error while parsing value - invalid string: ill-formed UTF-8 byte; last read: '"')"},
      {R"([1, 2])", R"(#: is a list of 2 items; expected a preset: one JSON object)"},
      {"GemCad 5.0\ng 96 0.0\n",
       R"(: is no preset; expected JSON, which begins with {; `nephroid import` takes scenes of other programs, a preset's object a mesh)"},
      {R"(3)", R"(#: is 3; expected a preset: one JSON object)"},
      {top(R"("seed":1,"seed":2)"), R"(#/seed: key 'seed' is given twice; expected each key once)"},
      {camera(R"("fov_deg":30,"fov_deg":40)"),
       R"(#/scene/camera/fov_deg: key 'fov_deg' is given twice; expected each key once)"},
      {R"({"seed":1})", R"(#: has no 'engine'; expected one of spectral, environment, inverse)"},
      {R"({"engine":"spectrel"})",
       R"(#/engine: is the string 'spectrel'; expected one of spectral, environment, inverse; did you mean 'spectral'?)"},
      {R"({"engine":7})", R"(#/engine: is 7; expected one of spectral, environment, inverse)"},
      {top(R"("sceen":{})"),
       R"(#/sceen: unknown key 'sceen'; the keys here are name, description, not_imported, engine, unit, seed, white, display, scene, spectral, stop, reference, measure, animation, leave_out; did you mean 'scene'?)"},
      {top(R"("quux":"a.exr")"),
       R"(#/quux: unknown key 'quux'; the keys here are name, description, not_imported, engine, unit, seed, white, display, scene, spectral, stop, reference, measure, animation, leave_out)"},
      {camera(R"("fov":40)"),
       R"(#/scene/camera/fov: unknown key 'fov'; the keys here are position, target, up, projection, fov_deg, height, shift, aperture, focus_distance, resolution; did you mean 'fov_deg'?)"},
      {top(R"("a/b~c":1)"),
       R"(#/a~1b~0c: unknown key 'a/b~c'; the keys here are name, description, not_imported, engine, unit, seed, white, display, scene, spectral, stop, reference, measure, animation, leave_out)"},
      {top(R"("a\nb":1)"),
       R"(#/a\nb: unknown key 'a\nb'; the keys here are name, description, not_imported, engine, unit, seed, white, display, scene, spectral, stop, reference, measure, animation, leave_out)"},
      {top(R"("seed":"1")"), R"(#/seed: is the string '1'; expected a whole number from 0 to 18446744073709551615)"},
      {top(R"("seed":1.5)"), R"(#/seed: is 1.5; expected a whole number from 0 to 18446744073709551615)"},
      {top(R"("seed":-1)"), R"(#/seed: is -1; expected a whole number from 0 to 18446744073709551615)"},
      {top(R"("seed":18446744073709551616)"),
       R"(#/seed: is 1.8446744073709552e+19; expected a whole number from 0 to 18446744073709551615)"},
      {top(R"("seed":null)"), R"(#/seed: is null; expected a whole number from 0 to 18446744073709551615)"},
      {top(R"("unit":"inch")"), R"(#/unit: is the string 'inch'; expected one of mm, cm, m)"},
      {top(R"("white":0)"), R"(#/white: is 0; expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")"},
      {top(R"("display":"clip")"), R"(#/display: is the string 'clip'; expected an object)"},
      {top(R"("display":{"gamut":"oklhc"})"),
       R"(#/display/gamut: is the string 'oklhc'; expected one of oklch, clip; did you mean 'oklch'?)"},
      {top(R"("display":{"tone":2})"), R"(#/display/tone: is 2; expected one of reinhard, filmic, clip)"},
      {top(R"("display":{"white_balance":6500})"), R"(#/display/white_balance: is 6500; expected one of D65, light)"},
      {top(R"("display":{"white_balance":"light"})"),
       R"(#/display/white_balance: is "light", and the scene has no lamp; expected one in scene.lights, or "D65")"},
      {top(R"("spectral":3)"), R"(#/spectral: is 3; expected an object)"},
      {spectral_with(R"("threshold_deg":0)"),
       R"(#/spectral/threshold_deg: is 0; expected a number above 0 and below 90 degrees)"},
      {spectral_with(R"("threshold_deg":90)"),
       R"(#/spectral/threshold_deg: is 90; expected a number above 0 and below 90 degrees)"},
      {spectral_with(R"("photons_per_pass":0)"),
       R"(#/spectral/photons_per_pass: is 0; expected a whole number from 1 to 16777216)"},
      {spectral_with(R"("photons_per_pass":16777217)"),
       R"(#/spectral/photons_per_pass: is 16777217; expected a whole number from 1 to 16777216)"},
      {spectral_with(R"("direct":1)"), R"(#/spectral/direct: is 1; expected true or false)"},
      {spectral_with(R"("method":"bruteforce")"),
       R"(#/spectral/method: is the string 'bruteforce'; expected one of optimal, thesis, brute_force; did you mean 'brute_force'?)"},
      {top(R"("stop":{"seconds":0})"), R"(#/stop/seconds: is 0; expected a number from 0.001 to 10000000 s)"},
      {top(R"("stop":{"passes":0.5})"), R"(#/stop/passes: is 0.5; expected a whole number from 1 to 1048576)"},
      {top(R"("description":"a\nb")"),
       R"(#/description: is the string 'a\nb'; expected one line without control characters)"},
      {camera(R"("fov_deg":0)"), R"(#/scene/camera/fov_deg: is 0; expected a number from 0.001 to 179.9 degrees)"},
      {camera(R"("fov_deg":180)"), R"(#/scene/camera/fov_deg: is 180; expected a number from 0.001 to 179.9 degrees)"},
      {camera(R"("resolution":[512,0])"),
       R"(#/scene/camera/resolution/1: is 0; expected a whole number from 1 to 16384 pixels)"},
      {camera(R"("resolution":[512,16385])"),
       R"(#/scene/camera/resolution/1: is 16385; expected a whole number from 1 to 16384 pixels)"},
      {camera(R"("resolution":[512])"),
       R"(#/scene/camera/resolution: is a list of 1 item; expected a list of 2 items, each a whole number from 1 to 16384 pixels)"},
      {camera(R"("aperture":-0.1)"),
       R"(#/scene/camera/aperture: is -0.1; expected a number from 0 to 10000000 length units)"},
      {camera(R"("position":[0,0,3],"target":[0,0,0],"aperture":6.5)"),
       R"(#/scene/camera/aperture: is 6.5, and the lens is focused at 3; expected at most twice the focus distance; is it in the scene's unit?)"},
      {camera(R"("aperture":0.1,"focus_distance":0)"),
       R"(#/scene/camera/focus_distance: is 0; expected a number from 1e-06 to 10000000 length units)"},
      {camera(R"("aperture":0.1,"focus_distance":-2)"),
       R"(#/scene/camera/focus_distance: is -2; expected a number from 1e-06 to 10000000 length units)"},
      {camera(R"("shift":[0,1e9])"), R"(#/scene/camera/shift/1: is 1000000000.0; expected a number from -10 to 10)"},
      {camera(R"("projection":"fisheye")"),
       R"(#/scene/camera/projection: is the string 'fisheye'; expected one of perspective, orthographic)"},
      {camera(R"("projection":"orthographic","height":0)"),
       R"(#/scene/camera/height: is 0; expected a number from 1e-06 to 10000000 length units)"},
      {camera(R"("height":2)"),
       R"(#/scene/camera/height: is of an orthographic camera only; expected 'scene.camera.projection' orthographic, or null; use fov_deg)"},
      {camera(R"("position":[0,1])"),
       R"(#/scene/camera/position: is a list of 2 items; expected a list of 3 items, each a number from -10000000 to 10000000 length units)"},
      {camera(R"("position":[0,"1",2])"),
       R"(#/scene/camera/position/1: is the string '1'; expected a number from -10000000 to 10000000 length units)"},
      {camera(R"("position":[1,2,3],"target":[1,2,3])"),
       R"(#/scene/camera/target: is where the camera stands; expected another point)"},
      {camera(R"("position":[0,5,0],"target":[0,0,0])"),
       R"(#/scene/camera/up: points along the line of sight or of light; expected a direction across it)"},
      {camera(R"("up":[0,0,0])"), R"(#/scene/camera/up: has no length; expected a direction)"},
      {camera(R"("position":[0,0,1e8])"),
       R"(#/scene/camera/position/2: is 100000000.0; expected a number from -10000000 to 10000000 length units)"},
      {scene(R"("materials":[])"),
       R"(#/scene/materials: is an empty list; expected an object of names with at most 1000 items, each an object)"},
      {material("glass", R"({})"),
       R"(#/scene/materials/glass: has no 'type'; expected one of diffuse, dielectric, mirror, conductor, plastic, varnished_metal, glazing)"},
      {material("m", R"({"type":"difuse"})"),
       R"(#/scene/materials/m/type: is the string 'difuse'; expected one of diffuse, dielectric, mirror, conductor, plastic, varnished_metal, glazing; did you mean 'diffuse'?)"},
      {material("m", R"({"type":"glass"})"),
       R"(#/scene/materials/m/type: is the string 'glass'; expected one of diffuse, dielectric, mirror, conductor, plastic, varnished_metal, glazing; did you mean 'dielectric'?)"},
      {material("glass", R"({"type":"dielectric"})"),
       R"(#/scene/materials/glass: has no 'dispersion'; this key is required)"},
      {material("m", R"({"type":"mirror","dispersion":1.5})"),
       R"(#/scene/materials/m/dispersion: 'dispersion' has no meaning for the type 'mirror'; it belongs to 'dielectric', 'plastic', 'varnished_metal'; remove it or change the type)"},
      {material("m", R"({"type":"glazing"})"), R"(#/scene/materials/m: has no 'panes'; this key is required)"},
      {material("m", R"({"type":"glazing","panes":[]})"),
       R"(#/scene/materials/m/panes: is an empty list; expected a list of 1 to 3 items, each a number, a string or an object)"},
      {material("m", R"({"type":"glazing","panes":[4,4,4,4]})"),
       R"(#/scene/materials/m/panes: is a list of 4 items; expected a list of 1 to 3 items, each a number, a string or an object)"},
      {material("m", R"({"type":"glazing","panes":[4,0]})"),
       R"(#/scene/materials/m/panes/1: is 0; expected a number from 0.01 to 1000 mm)"},
      {material("m", R"({"type":"glazing","panes":[{"type":"glass","thickness_mm":-1}]})"),
       R"(#/scene/materials/m/panes/0/thickness_mm: is -1; expected a number from 0.01 to 1000 mm)"},
      {material("m", R"({"type":"glazing","panes":[{"type":"measured","front_reflectance":0.1}]})"),
       R"(#/scene/materials/m/panes/0: has no 'transmittance'; this key is required)"},
      {material("m",
                R"({"type":"glazing","panes":[{"type":"glass","tint":{"type":"table","table":[[400,1],[400,0]]}}]})"),
       R"(#/scene/materials/m/panes/0/tint/table/1: 400 nm is given twice; expected each wavelength once)"},
      {material("m", R"({"type":"diffuse","reflectance":1.2})"),
       R"(#/scene/materials/m/reflectance: is 1.2; expected a number from 0 to 1)"},
      {material("m", R"({"type":"diffuse","reflectance":[1]})"),
       R"(#/scene/materials/m/reflectance: is a list of 1 item; expected a number, a string or an object)"},
      {glass(R"(0)"), R"(#/scene/materials/glass/dispersion: is 0; expected a number from 0.01 to 100)"},
      {glass(R"("")"), R"(#/scene/materials/glass/dispersion: is the string ''; expected the name of a file)"},
      {glass(R"("a\u0000b")"),
       R"(#/scene/materials/glass/dispersion: is the string 'a\u0000b'; expected one line without control characters)"},
      {glass(R"({"type":"selmeier","b":[1],"c_um2":[0]})"),
       R"(#/scene/materials/glass/dispersion/type: is the string 'selmeier'; expected one of constant, file, sellmeier, cauchy, table, points; did you mean 'sellmeier'?)"},
      {glass(R"({"type":"sellmeier","b":[1,2],"c_um2":[0.1]})"),
       R"(#/scene/materials/glass/dispersion: has 2 values in 'b' and 1 in 'c_um2'; expected as many of both)"},
      {glass(R"({"type":"cauchy","coefficients":[]})"),
       R"(#/scene/materials/glass/dispersion/coefficients: is an empty list; expected a list of 1 to 16 items, each a number from -1000000 to 1000000)"},
      {glass(R"({"type":"table","table":[[400,1.5],[500,1.4],[400,1.6]]})"),
       R"(#/scene/materials/glass/dispersion/table/2: 400 nm is given twice; expected each wavelength once)"},
      {material("m", R"({"type":"mirror","roughness":-1})"),
       R"(#/scene/materials/m/roughness: is -1; expected a number from 0 to 1)"},
      {material("m", R"({"type":"dielectric","dispersion":1.5,"coating":{"dispersion":1.4,"thickness_nm":20001}})"),
       R"(#/scene/materials/m/coating/thickness_nm: is 20001; expected a number from 0 to 20000 nm)"},
      {material("m", R"({"type":"mirror","texture":"a.png"})"),
       R"(#/scene/materials/m/texture: 'texture' has no meaning for the type 'mirror'; it belongs to 'diffuse', 'plastic'; remove it or change the type)"},
      {material("m", R"({"type":"plastic","roughness_texture":"a.png"})"),
       R"(#/scene/materials/m/roughness_texture: 'roughness_texture' has no meaning for the type 'plastic'; it belongs to 'dielectric', 'mirror', 'conductor'; remove it or change the type)"},
      {material("m", R"({"type":"diffuse","normal_scale":1000})"),
       R"(#/scene/materials/m/normal_scale: is 1000; expected a number from -100 to 100)"},
      {material("m", R"({"type":"diffuse","texture":{"type":"checkerboard","colour0":[0,0,1.5]}})"),
       R"(#/scene/materials/m/texture/colour0/2: is 1.5; expected a number from 0 to 1)"},
      {material("m", R"({"type":"diffuse","texture":{"type":"checkerboard","wrap":"clamp"}})"),
       R"(#/scene/materials/m/texture/wrap: 'wrap' has no meaning for the type 'checkerboard'; it belongs to 'file'; remove it or change the type)"},
      {glass(R"({"type":"points","table":[[400,1.5],[500,1.4,1]]})"),
       R"(#/scene/materials/glass/dispersion/table/1: is a list of 3 items; expected a row [wavelength, n])"},
      {glass(R"({"type":"points","table":[[400,1.5]]})"),
       R"(#/scene/materials/glass/dispersion/table: is a list of 1 item; expected a list of 2 to 100000 items, each [wavelength, n])"},
      {glass(R"({"type":"constant","n":1.5,"outside":"hold"})"),
       R"(#/scene/materials/glass/dispersion/outside: 'outside' has no meaning for the type 'constant'; it belongs to 'file', 'sellmeier', 'cauchy', 'table', 'points'; remove it or change the type)"},
      {object(R"({"material":"m"})"),
       R"(#/scene/objects/0: has neither 'mesh' nor 'shape'; expected exactly one of them)"},
      {object(R"({"material":"m","mesh":"a.obj","shape":{"type":"sphere"}})"),
       R"(#/scene/objects/0: has both 'mesh' and 'shape'; expected exactly one of them)"},
      {object(R"({"shape":{"type":"sphere"}})"), R"(#/scene/objects/0: has no 'material'; this key is required)"},
      {R"({"engine":"spectral","scene":{"materials":{"glass":{"type":"diffuse"}},"objects":[{"material":"glas","shape":{"type":"sphere"}}]}})",
       R"(#/scene/objects/0/material: there is no material 'glas'; scene.materials has glass; did you mean 'glass'?)"},
      {shape(R"({"type":"teapot"})"),
       "#/scene/objects/0/shape/type: is the string 'teapot'; expected one of " + shapes},
      {shape(R"({"type":"plane"})"),
       "#/scene/objects/0/shape/type: is the string 'plane'; expected one of " + shapes + "; did you mean 'quad'?"},
      {shape(R"({"radius":1})"), "#/scene/objects/0/shape: has no 'type'; expected one of " + shapes},
      {shape(R"({"type":"sphere","apex_deg":60})"),
       R"(#/scene/objects/0/shape/apex_deg: 'apex_deg' has no meaning for the type 'sphere'; it belongs to 'prism'; remove it or change the type)"},
      {shape(R"({"type":"sphere","radius":0})"),
       R"(#/scene/objects/0/shape/radius: is 0; expected a number from 1e-06 to 10000000 length units)"},
      {shape(R"({"type":"sphere","segments":256})"),
       R"(#/scene/objects/0/shape/segments: 'segments' has no meaning for the type 'sphere'; it belongs to 'cylinder', 'water', 'relief'; remove it or change the type)"},
      {shape(R"({"type":"cylinder","segments":2})"),
       R"(#/scene/objects/0/shape/segments: is 2; expected a whole number from 3 to 4096)"},
      {object(R"({"material":"m","shape":{"type":"sphere"},"transform":{"scale":[1,0,1]}})"),
       R"(#/scene/objects/0/transform/scale/1: is 0; expected a factor of at least 1e-06 or at most -1e-06; for a thin object use a plate)"},
      {light(R"({"power_w":1})"),
       R"(#/scene/lights/0: has no 'type'; expected one of point, spot, directional, area, mesh)"},
      {light(R"({"type":"spotlight"})"),
       R"(#/scene/lights/0/type: is the string 'spotlight'; expected one of point, spot, directional, area, mesh)"},
      {light(R"({"type":"point","power_w":-1})"),
       R"(#/scene/lights/0/power_w: is -1; expected a number from 0 to 1000000000 W)"},
      {light(R"({"type":"directional","power_w":1})"),
       R"(#/scene/lights/0/power_w: 'power_w' has no meaning for the type 'directional'; it belongs to 'point', 'spot', 'area', 'mesh'; remove it or change the type)"},
      {light(R"({"type":"spot","direction":[0,0,0]})"),
       R"(#/scene/lights/0/direction: has no length; expected a direction)"},
      {light(R"({"type":"area","direction":[0,-1,0],"up":[0,1,0]})"),
       R"(#/scene/lights/0/up: points along the line of sight or of light; expected a direction across it)"},
      {light(R"({"type":"point","photometry":"a.ies","direction":[0,0,0]})"),
       R"(#/scene/lights/0/direction: has no length; expected a direction)"},
      {light(R"({"type":"point","photometry":""})"),
       R"(#/scene/lights/0/photometry: is the string ''; expected the name of a file)"},
      {light(R"({"type":"spot","photometry":"a.ies"})"),
       R"(#/scene/lights/0/photometry: 'photometry' has no meaning for the type 'spot'; it belongs to 'point'; remove it or change the type)"},
      {light(R"({"type":"point","picture":"a.png"})"),
       R"(#/scene/lights/0/picture: 'picture' has no meaning for the type 'point'; it belongs to 'area'; remove it or change the type)"},
      {light(R"({"type":"mesh"})"), R"(#/scene/lights/0: has no 'object'; this key is required)"},
      {light(R"({"type":"mesh","object":"lamp"})"),
       R"(#/scene/lights/0/object: there is no object 'lamp'; scene.objects is empty)"},
      {scene(
           R"("materials":{"m":{"type":"diffuse"}},"objects":[{"name":"lamp","material":"m","shape":{"type":"sphere"}}],"lights":[{"type":"mesh","object":"lomp"}])"),
       R"(#/scene/lights/0/object: there is no object 'lomp'; scene.objects has lamp; did you mean 'lamp'?)"},
      {light(R"({"type":"point","spectrum":5})"), R"(#/scene/lights/0/spectrum: is 5; expected a string or an object)"},
      {light(R"({"type":"point","spectrum":{"type":"blackbody","temperature_k":0}})"),
       R"(#/scene/lights/0/spectrum/temperature_k: is 0; expected a number from 300 to 1000000 K)"},
      {light(R"({"type":"point","spectrum":{"type":"table","table":[[400,0],[700,0]]}})"),
       R"(#/scene/lights/0/spectrum/table: has no power at any wavelength; expected at least one power above 0)"},
      {light(R"({"type":"point","spectrum":{"type":"lines","table":[[1064,1]]}})"),
       R"(#/scene/lights/0/spectrum/table: has no line that is rendered; expected at least one from 380 to 780 nm)"},
      {scene(R"("environment":{"type":"constant","colour":[1,1,1],"lights":1})"),
       R"(#/scene/environment/lights: is 1; expected true or false)"},
      {sky(R"("sun_direction":[0,1,0],"turbidity":0)"),
       R"(#/scene/environment/turbidity: is 0; expected a number from 2 to 10)"},
      {sky(R"("sun_direction":[0,1,0],"turbidity":100)"),
       R"(#/scene/environment/turbidity: is 100; expected a number from 2 to 10)"},
      {sky(R"("sun_direction":[0,0,0])"), R"(#/scene/environment/sun_direction: has no length; expected a direction)"},
      {sky(R"("sun_direction":[0,1,0],"place":{"latitude_deg":50,"longitude_deg":7,"date":"2026-06-21","hour":12})"),
       R"(#/scene/environment: has both 'place' and 'sun_direction'; expected one of them)"},
      {sky(R"("place":{"latitude_deg":95,"longitude_deg":7,"date":"2026-06-21","hour":12})"),
       R"(#/scene/environment/place/latitude_deg: is 95; expected a number from -90 to 90 degrees)"},
      {sky(R"("place":{"latitude_deg":50,"longitude_deg":7,"date":"2026-02-31","hour":12})"),
       R"(#/scene/environment/place/date: is '2026-02-31'; expected a day from 1950-01-01 to 2050-12-31 as YYYY-MM-DD)"},
      {sky(R"("place":{"latitude_deg":50,"longitude_deg":7,"date":"2026-02-21","hour":12,"time_zone":"Europe/Londn"})"),
       R"(#/scene/environment/place/time_zone: there is no time zone 'Europe/Londn'; expected a name such as 'Europe/London'; did you mean 'Europe/London'?)"},
      {sky(R"("place":{"latitude_deg":50,"longitude_deg":7,"date":"2026-02-21","hour":12,"time_zone":"UTC","utc_offset_h":0})"),
       R"(#/scene/environment/place/time_zone: is given, and utc_offset_h besides; expected one of them)"},
      {sky(R"("place":{"latitude_deg":50,"longitude_deg":7,"date":"2038-02-21","hour":12,"time_zone":"Europe/London"})"),
       R"(#/scene/environment/place/time_zone: has no known summer time on 2038-02-21; expected a date until 2037; give utc_offset_h in its place)"},
      {light(R"({"type":"point","angular_diameter_deg":1})"),
       R"(#/scene/lights/0/angular_diameter_deg: 'angular_diameter_deg' has no meaning for the type 'point'; it belongs to 'directional'; remove it or change the type)"},
      {top(R"("parent":"nobody.json")"),
       R"(#/parent: there is no preset 'nobody.json'; expected a file or the name of a shipped preset; see `nephroid presets`)"},
      {top(R"("parent":["first-light"])"),
       R"(#/parent: is a list of 1 item; expected a path or the name of a shipped preset)"},
      {top(R"("parent":"bad.json")"), R"(#/parent: parents go round in a circle: bad.json -> bad.json)"},
      {top(R"("$schema":1)"), R"(#/$schema: is 1; expected a string)"},
      {top(R"("sweep":[1,2])"),
       R"(#/sweep: is a list of 2 items; expected an object of lists, for instance {"seed": [1, 2]})"},
      {top(R"("sweep":{"seed":[]})"), R"(#/sweep/seed: is an empty list; expected a list of at least one value)"},
      {top(R"("sweep":{"seed":3})"), R"(#/sweep/seed: is 3; expected a list of at least one value)"},
      {top(R"("sweep":{"spectral.treshold_deg":[0.1]})"),
       R"(#/sweep/spectral.treshold_deg/0: unknown key 'treshold_deg'; the keys here are method, threshold_deg, step_nm, estimator, effort, importance, jitter, low_discrepancy, smoothing, relight, photons_per_pass, indirect_photons_per_pass, pixel_samples, max_surfaces, sppm, direct, caustic, indirect, background; did you mean 'threshold_deg'?)"},
      {top(R"("sweep":{"seed":[1,-2]})"),
       R"(#/sweep/seed/1: is -2; expected a whole number from 0 to 18446744073709551615)"},
      {top(R"("sweep":{"spectral":[{}],"spectral.direct":[true]})"),
       R"(#/sweep/spectral.direct: 'spectral.direct' lies inside 'spectral', which is swept too; expected keys apart from each other)"},
      {top("\"sweep\":{\"seed\":" + numbers(101) + ",\"white\":" + numbers(100) + "}"),
       R"(#/sweep: gives 10100 runs; expected at most 10000)"},
      {"{\"engine\":\"spectral\",\"scene\":" + std::string(70, '[') + std::string(70, ']') + "}",
       fmt::format("#/scene{}: is nested deeper than 64 levels", zeros(63))},
  };
  for (const Case& c : cases) {
    write("bad.json", c.text);
    EXPECT_EQ(refusal_of([] { preset::read_presets("bad.json"); }), "bad.json" + c.line) << c.text;
  }
}

TEST_F(BadPresets, OverridesAreRefusedInOneLine) {
  const std::vector<Case> cases = {
      {R"(seed)", R"(--set seed: has no '='; expected KEY=VALUE, for instance scene.lights.0.power_w=2)"},
      {R"(.seed=1)",
       R"(--set .seed=1: has an empty key; expected keys joined by dots, for instance scene.lights.0.power_w=2)"},
      {R"(spectral.treshold_deg=0.1)",
       R"(--set spectral.treshold_deg=0.1: unknown key 'treshold_deg'; the keys here are method, threshold_deg, step_nm, estimator, effort, importance, jitter, low_discrepancy, smoothing, relight, photons_per_pass, indirect_photons_per_pass, pixel_samples, max_surfaces, sppm, direct, caustic, indirect, background; did you mean 'threshold_deg'?)"},
      {R"(spectra.threshold_deg=0.1)",
       R"(--set spectra.threshold_deg=0.1: unknown key 'spectra'; the keys here are name, description, not_imported, engine, unit, seed, white, display, scene, spectral, stop, reference, measure, animation, leave_out; did you mean 'spectral'?)"},
      {R"(scene.lights.0.power_w=2)",
       R"(--set scene.lights.0.power_w=2: 'scene.lights' is a list and has no item '0'; it is empty)"},
      {R"(scene.lights[0].power_w=2)",
       R"(--set scene.lights[0].power_w=2: 'lights[0]' is no key; items of a list go by number after a dot; for instance scene.lights.0.power_w=2)"},
      {R"(scene.objects.first.material=m)",
       R"(--set scene.objects.first.material=m: 'scene.objects' is a list and has no item 'first'; it is empty)"},
      {R"(seed.low=2)", R"(--set seed.low=2: is an object; expected a whole number from 0 to 18446744073709551615)"},
      {R"(scene.camera={"fov_deg":})",
       R"(--set scene.camera={"fov_deg":}:1:12: is not JSON; syntax error while parsing value - unexpected '}'; expected '[', '{', or a literal)"},
      {R"(spectral.threshold_deg=180)",
       R"(--set spectral.threshold_deg=180: is 180; expected a number above 0 and below 90 degrees)"},
      {R"(seed=many)",
       R"(--set seed=many: is the string 'many'; expected a whole number from 0 to 18446744073709551615)"},
      {R"(white=nan)",
       R"(--set white=nan: is the string 'nan'; expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")"},
      {R"(white=+-3)",
       R"(--set white=+-3: is the string '+-3'; expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")"},
      {R"(white=.)",
       R"(--set white=.: is the string '.'; expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")"},
      {R"(white=1,5)",
       R"(--set white=1,5: is the string '1,5'; expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")"},
      {R"(seed=007)", R"(--set seed=007: is the string '007'; expected a whole number from 0 to 18446744073709551615)"},
      {R"(scene.camera.position=[.5 1])",
       R"(--set scene.camera.position=[.5 1]:1:2: is not JSON; syntax error while parsing value - invalid literal; last read: '[.')"},
      {R"(white=1e999)",
       R"(--set white=1e999: is the string '1e999'; expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")"},
      {"name=\xff\x41", "--set: 'name=\xef\xbf\xbd\x41' is not UTF-8; expected KEY=VALUE in UTF-8"},
      {"\xc3=1", "--set: '\xef\xbf\xbd=1' is not UTF-8; expected KEY=VALUE in UTF-8"},
      {R"(scene.camera={"fov":30})",
       R"(--set scene.camera={"fov":30}: unknown key 'fov'; the keys here are position, target, up, projection, fov_deg, height, shift, aperture, focus_distance, resolution; did you mean 'fov_deg'?)"},
  };
  write("good.json", scene(R"("objects":[],"lights":[])"));
  for (const Case& c : cases)
    EXPECT_EQ(refusal_of([&] { preset::read_presets("good.json", {c.text}); }), c.line) << c.text;
}

TEST_F(BadPresets, FilesThatAreNone) {
  fs::create_directory("folder");
  fs::create_symlink("gone.json", "link.json");
  std::ofstream("huge.json").put('{');
  fs::resize_file("huge.json", std::uintmax_t(1) << 30); // sparse: takes no space
  const std::vector<Case> cases = {
      {"folder", "preset: 'folder' is a folder; expected a file"},
      {"link.json", "preset: there is no preset 'link.json'; expected a file or the name of a shipped preset; see "
                    "`nephroid presets`"},
      {"", "preset: the name of a preset is empty or holds a NUL"},
      {"/dev/zero", "/dev/zero: is not a regular file; expected a preset in JSON"},
      {"huge.json", "huge.json: is 1073741824 bytes long; expected at most 8388608"},
      {"first-ligth", "preset: there is no preset 'first-ligth'; expected a file or the name of a shipped preset; did "
                      "you mean 'first-light'?"},
  };
  for (const Case& c : cases) EXPECT_EQ(refusal_of([&] { preset::read_preset(c.text); }), c.line) << c.text;
}

TEST_F(BadPresets, ErrorsNameTheFileThatTheyStandIn) {
  write("parent.json",
        top(R"("spectral":{"threshold_deg":90,"method":"optimal"},"scene":{"materials":{"m":{"type":"diffuse"}}})"));
  const std::vector<Case> cases = {
      {R"("seed":2)", "parent.json#/spectral/threshold_deg: is 90; expected a number above 0 and below 90 degrees"},
      {R"("spectral":{"method":"thesis"})",
       "parent.json#/spectral/threshold_deg: is 90; expected a number above 0 and below 90 degrees"},
      {R"("spectral":{"threshold_deg":91})",
       "child.json#/spectral/threshold_deg: is 91; expected a number above 0 and below 90 degrees"},
      {R"("scene":{"materials":{"m":{"type":"dielectric"}}})",
       "child.json#/scene/materials/m: has no 'dispersion'; this key is required"},
  };
  for (const Case& c : cases) {
    write("child.json", R"({"parent":"parent.json",)" + c.text + "}");
    EXPECT_EQ(refusal_of([] { preset::read_preset("child.json"); }), c.line) << c.text;
  }
  write("parent.json", R"({"parent":"child.json"})");
  EXPECT_EQ(refusal_of([] { preset::read_preset("child.json"); }),
            "parent.json#/parent: parents go round in a circle: child.json -> parent.json -> child.json");
}

TEST_F(BadPresets, HugeAndDeepTextEndsQuickly) {
  const std::string deep(1'000'000, '[');
  EXPECT_EQ(refusal_of([&] { preset::parse_preset(deep, "bad.json"); }),
            fmt::format("bad.json#{}: is nested deeper than 64 levels", zeros(64)));
  std::string keys = top(R"("seed":1)");
  keys.pop_back();
  for (int i = 0; i < 1000; ++i) keys += fmt::format(",\"k{}\":0", i);
  EXPECT_EQ(refusal_of([&] { preset::parse_preset(keys + "}", "bad.json"); }),
            "bad.json#/k998: too many keys; expected at most 1000 in one object");
}

TEST_F(BadPresets, ASweepIsNotOnePreset) {
  const std::string sweep = top(R"("sweep":{"seed":[1,2,3]})");
  EXPECT_EQ(
      refusal_of([&] { preset::parse_preset(sweep, "bad.json"); }),
      "bad.json#/sweep: gives 3 runs; one preset is wanted here; fix the swept keys by --set, or --set sweep=null");
  EXPECT_EQ(preset::parse_preset(sweep, "bad.json", {"seed=7"}).seed, 7u);
  EXPECT_EQ(refusal_of([&] {
              preset::parse_preset(top(R"("sweep":{"scene.camera":[{}]})"), "bad.json", {"scene.camera.fov_deg=30"});
            }),
            "--set scene.camera.fov_deg=30: the preset sweeps 'scene.camera', which would overwrite it; set "
            "scene.camera as a whole");
}

} // namespace nephroid::preset_test
