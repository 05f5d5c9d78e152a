// SPDX-License-Identifier: Apache-2.0
// Everything in the section "scene" described.
#include "preset/describe.h"

#include "preset/choices.h"

namespace nephroid::preset {

void describe(Fields& v, Dispersion& d)
{
  v.about("Dispersion", "Index of refraction over wavelength.");
  v.shorthand(Bare::number, Dispersion::Type::constant, "n");
  v.shorthand(Bare::text, Dispersion::Type::file, "file");
  using Type = Dispersion::Type;
  v.type({.name = "type", .sentence = "Where n comes from."}, d.type);
  const Column nm{"wavelength", "nm", wavelength_bounds}, n{"n", "", index_bounds};
  switch (d.type) {
  case Type::constant:
    v.field({.name = "n", .sentence = "Index of refraction.", .bounds = index_bounds, .required = true}, d.n);
    return; // a constant has no range to leave
  case Type::file:
    v.field({.name = "file", .sentence = "A YAML file of refractiveindex.info.", .text = Text::file, .required = true}, d.file);
    break;
  case Type::sellmeier:
    v.field({.name = "b", .sentence = "Strength of each term.", .bounds = coefficient_bounds, .count = term_count, .required = true}, d.b);
    v.field({.name = "c_um2",
             .sentence = "Resonance of each term: its wavelength squared.",
             .unit = "square micrometres",
             .bounds = coefficient_bounds,
             .count = term_count,
             .required = true},
            d.c_um2);
    break;
  case Type::cauchy:
    v.field({.name = "coefficients",
             .sentence = "c0, c1, c2, ...: c_i in micrometres to the power 2 i.",
             .bounds = coefficient_bounds,
             .count = term_count,
             .required = true},
            d.coefficients);
    break;
  case Type::table:
    v.field({.name = "table", .sentence = "Rows of wavelength and n.", .count = {1, max_rows}, .columns = {nm, n}, .required = true},
            d.table);
    break;
  case Type::points:
    v.field(
        {.name = "table", .sentence = "Control points: wavelength and n.", .count = {2, max_rows}, .columns = {nm, n}, .required = true},
        d.table);
    break;
  }
  v.field({.name = "outside", .sentence = "What n is at wavelengths outside the data's own range."}, d.outside);
}

void describe(Fields& v, LightSpectrum& s)
{
  v.about("LightSpectrum", "How a light's power is spread over wavelength.");
  v.shorthand(Bare::text, LightSpectrum::Type::illuminant, "illuminant");
  using Type = LightSpectrum::Type;
  v.type({.name = "type", .sentence = "Where the spectrum comes from."}, s.type);
  const Column nm{"wavelength", "nm", wavelength_bounds}, power{"relative power", "", power_bounds};
  switch (s.type) {
  case Type::illuminant:
    v.field({.name = "illuminant",
             .sentence = "A, D50, D65, E or F1 to F12.",
             .text = Text::line,
             .names = Names::illuminant,
             .required = true},
            s.illuminant);
    break;
  case Type::blackbody:
    v.field({.name = "temperature_k", .sentence = "Temperature.", .unit = "K", .bounds = within(300, 1e6), .required = true},
            s.temperature_k);
    break;
  case Type::lines:
    v.field({.name = "table",
             .sentence = "Wavelength and relative power of each line.",
             .count = {1, max_rows},
             .columns = {nm, power},
             .required = true},
            s.table);
    break;
  case Type::table:
    v.field({.name = "table",
             .sentence = "Rows of wavelength and relative power.",
             .count = {2, max_rows},
             .columns = {nm, power},
             .required = true},
            s.table);
    break;
  }
}

void describe(Fields& v, Reflectance& r)
{
  v.about("Reflectance", "The part of the light that is reflected, over wavelength.");
  v.shorthand(Bare::number, Reflectance::Type::constant, "value");
  v.shorthand(Bare::text, Reflectance::Type::patch, "patch");
  using Type = Reflectance::Type;
  v.type({.name = "type", .sentence = "Where the reflectance comes from."}, r.type);
  switch (r.type) {
  case Type::constant:
    v.field({.name = "value", .sentence = "Reflectance.", .bounds = within(0, 1), .required = true}, r.value);
    break;
  case Type::patch:
    v.field({.name = "patch",
             .sentence = "Name of a ColorChecker patch, such as \"blue sky\".",
             .text = Text::line,
             .names = Names::patch,
             .required = true},
            r.patch);
    break;
  case Type::table:
    v.field({.name = "table",
             .sentence = "Rows of wavelength and reflectance.",
             .count = {1, max_rows},
             .columns = {{"wavelength", "nm", wavelength_bounds}, {"reflectance", "", within(0, 1)}},
             .required = true},
            r.table);
    break;
  }
}

void describe(Fields& v, Material& m)
{
  v.about("Material", "What a surface does with light.");
  v.type({.name = "type", .sentence = "What kind of surface."}, m.type);
  if (m.type == Material::Type::dielectric) {
    v.field({.name = "dispersion", .sentence = "Index of refraction: a number, a file or an object.", .required = true}, m.dispersion);
    v.field({.name = "absorption", .sentence = "Absorb light inside where the dispersion file has k."}, m.absorption);
  } else
    v.field({.name = "reflectance", .sentence = "Part of the light that is reflected: a number, a ColorChecker patch or an object."},
            m.reflectance);
}

void describe(Fields& v, Transform& t)
{
  v.about("Transform", "Scale, then rotate (about x, then y, then z), then translate.");
  v.field({.name = "scale", .sentence = "Factors along x, y and z; not 0, negative ones mirror.", .bounds = within(-1e6, 1e6)}, t.scale);
  v.field({.name = "rotate_deg", .sentence = "Angles about x, y and z.", .unit = "degrees", .bounds = within(-3600, 3600)}, t.rotate_deg);
  v.field({.name = "translate", .sentence = "Where the origin goes.", .unit = length_unit, .bounds = position_bounds}, t.translate);
}

void describe(Fields& v, Shape& s)
{
  v.about("Shape", "A simple shape, centred on the origin with y up.");
  using Type = Shape::Type;
  const auto length = [&](std::string_view name, std::string_view sentence, auto& value) {
    v.field({.name = name, .sentence = sentence, .unit = length_unit, .bounds = length_bounds}, value);
  };
  v.type({.name = "type", .sentence = "Which shape."}, s.type);
  switch (s.type) {
  case Type::quad:
    length("size", "Edge lengths along x and z; the middle number is not used.", s.size);
    break;
  case Type::box:
  case Type::plate:
    length("size", "Edge lengths along x, y and z.", s.size);
    break;
  case Type::sphere:
  case Type::cylinder:
    length("radius", "Radius.", s.radius);
    if (s.type == Type::sphere) break;
    length("height", "Length along y.", s.height);
    v.field({.name = "segments", .sentence = "Facets around.", .bounds = within(3, 4096)}, s.segments);
    break;
  case Type::prism:
    length("height", "Length along y.", s.height);
    v.field({.name = "apex_deg",
             .sentence = "Angle between the two equal sides; their edge is at +z.",
             .unit = "degrees",
             .bounds = within(0.1, 179)},
            s.apex_deg);
    length("side", "Length of the two equal sides.", s.side);
    break;
  case Type::brilliant:
    length("radius", "Radius of the girdle.", s.radius);
    break;
  }
  v.field({.name = "inwards", .sentence = "Turn the shape inside out, for a room."}, s.inwards);
}

void describe(Fields& v, Object& o)
{
  v.about("Object", "A mesh or a shape, put in its place.");
  v.field({.name = "name", .sentence = "What messages call it.", .text = Text::line}, o.name);
  v.field({.name = "mesh", .sentence = "A mesh file (OBJ, PLY, STL, glTF, ...); give either this or a shape.", .text = Text::file}, o.mesh);
  v.field({.name = "shape", .sentence = "A simple shape; give either this or a mesh."}, o.shape);
  v.field({.name = "material",
           .sentence = "One of the names in scene.materials.",
           .text = Text::line,
           .names = Names::material,
           .required = true},
          o.material);
  v.field({.name = "transform", .sentence = "Its size, turn and place."}, o.transform);
  v.field({.name = "normals", .sentence = "Flat or smooth."}, o.normals);
  v.field({.name = "priority",
           .sentence = "Where two dielectrics overlap the higher one is there; of equals the one entered last.",
           .bounds = within(-1000000, 1000000)},
          o.priority);
}

void describe(Fields& v, Light& l)
{
  v.about("Light", "A source of light.");
  using Type = Light::Type;
  v.type({.name = "type", .sentence = "What kind of source."}, l.type);
  v.field({.name = "spectrum", .sentence = "A CIE illuminant by name, or an object."}, l.spectrum);
  if (l.type == Type::directional)
    v.field({.name = "irradiance_w_m2",
             .sentence = "Irradiance of 380 to 780 nm on a plane that faces the light.",
             .unit = "W/m^2",
             .bounds = power_bounds},
            l.irradiance_w_m2);
  else {
    v.field({.name = "power_w", .sentence = "Radiant power of 380 to 780 nm.", .unit = "W", .bounds = power_bounds}, l.power_w);
    v.field({.name = "position", .sentence = "Where it is; of an area light its centre.", .unit = length_unit, .bounds = position_bounds},
            l.position);
  }
  if (l.type != Type::point)
    v.field({.name = "direction", .sentence = "The way the light goes; any length but 0.", .bounds = position_bounds}, l.direction);
  if (l.type == Type::spot)
    v.field({.name = "half_angle_deg",
             .sentence = "Between the cone's axis and its edge: constant intensity inside, none outside.",
             .unit = "degrees",
             .bounds = within(0.01, 180)},
            l.half_angle_deg);
  if (l.type == Type::area) {
    v.field({.name = "size", .sentence = "Edge lengths.", .unit = length_unit, .bounds = length_bounds}, l.size);
    v.field({.name = "up", .sentence = "Along the second edge, as far as the direction allows.", .bounds = position_bounds}, l.up);
  }
}

void describe(Fields& v, Camera& c)
{
  v.about("Camera", "A pinhole camera.");
  v.field({.name = "position", .sentence = "Where it stands.", .unit = length_unit, .bounds = position_bounds}, c.position);
  v.field({.name = "target", .sentence = "What it looks at.", .unit = length_unit, .bounds = position_bounds}, c.target);
  v.field({.name = "up", .sentence = "What is up in the picture.", .bounds = position_bounds}, c.up);
  v.field({.name = "fov_deg", .sentence = "Vertical field of view.", .unit = "degrees", .bounds = within(0.001, 179.9)}, c.fov_deg);
  v.field({.name = "resolution", .sentence = "Width and height of the picture.", .unit = "pixels", .bounds = within(1, 16384)},
          c.resolution);
}

void describe(Fields& v, Environment& e)
{
  v.about("Environment", "What is behind everything, infinitely far.");
  v.shorthand(Bare::text, Environment::Type::file, "file");
  v.type({.name = "type", .sentence = "Where the surroundings come from."}, e.type);
  if (e.type == Environment::Type::file)
    v.field({.name = "file", .sentence = "A latitude-longitude picture.", .text = Text::file, .required = true}, e.file);
  else
    v.field({.name = "colour", .sentence = "Linear sRGB.", .bounds = within(0, 1e6), .required = true}, e.colour);
  v.field({.name = "radiance", .sentence = "Luminance Y of the colour (1, 1, 1).", .unit = "W/(m^2 sr)", .bounds = within(0, 1e9)},
          e.radiance);
  if (e.type == Environment::Type::file)
    v.field({.name = "rotate_deg",
             .sentence = "Turns the surroundings about +y, counterclockwise as seen from above.",
             .unit = "degrees",
             .bounds = within(-3600, 3600)},
            e.rotate_deg);
  v.field({.name = "lights", .sentence = "Whether it lights the scene, where the engine leaves that open; if not, it is only seen."},
          e.lights);
}

void describe(Fields& v, Scene& s)
{
  v.about("Scene", "What there is to see.");
  v.field({.name = "camera", .sentence = "The camera."}, s.camera);
  v.field({.name = "materials", .sentence = "Materials by name.", .count = {0, 1000}}, s.materials);
  v.field({.name = "objects", .sentence = "Everything that light can hit.", .count = {0, 10000}}, s.objects);
  v.field({.name = "lights", .sentence = "The lights.", .count = {0, 1000}}, s.lights);
  v.field({.name = "environment", .sentence = "What is behind everything, and may light it."}, s.environment);
  v.field({.name = "damaged_meshes", .sentence = "What is done about glass whose mesh has a hole or is inside out."}, s.damaged_meshes);
}

} // namespace nephroid::preset
