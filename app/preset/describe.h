// SPDX-License-Identifier: Apache-2.0
// Every struct of the preset described once: reading, writing, the schema and the editor are visitors over these functions.
//
// A visitor V has these members:
//   v.type(field, e)    the enumeration that chooses which further fields mean something. A reader must set e here, before it
//                       returns, because describe() goes on with the fields of that type only. To see the fields of
//                       another type, set `type` of a struct to it and describe that struct (see for_each_type).
//   v.field(field, x)   any other field. x is a bool, int, std::uint64_t, double, std::string, an enumeration, a std::array
//                       or std::vector of numbers, a std::vector of std::string, a table (vector of pairs), a described struct, a
//                       vector of them, a map from names to them, or a std::optional of any of these.
//   v.engine(field, s)  the word that names the preset's engine. A reader gives the preset::Settings s that engine's type.
//   v.settings(s)       the section of settings that is called as their engine; of a std::optional, that of the preset's engine.
// Fields come in the order in which files are written. A described struct inside is visited by calling describe again.
//
// Limits are chosen so that nothing later overflows: lengths and positions stay below 1e7 units, so that their squares and
// cubes fit single precision; scales between 1e-6 and 1e6.
#pragma once
#include "preset/choices.h"
#include "preset/describe_animation.h"
#include "preset/field.h"
#include "preset/preset.h"

namespace nephroid::preset {

template <class V, Is<Dispersion> S>
void describe(V& v, S& d)
{
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

template <class V, Is<LightSpectrum> S>
void describe(V& v, S& s)
{
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

template <class V, Is<Reflectance> S>
void describe(V& v, S& r)
{
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

template <class V, Is<Material> S>
void describe(V& v, S& m)
{
  v.type({.name = "type", .sentence = "What kind of surface."}, m.type);
  if (m.type == Material::Type::dielectric) {
    v.field({.name = "dispersion", .sentence = "Index of refraction: a number, a file or an object.", .required = true}, m.dispersion);
    v.field({.name = "absorption", .sentence = "Absorb light inside where the dispersion file has k."}, m.absorption);
  } else
    v.field({.name = "reflectance", .sentence = "Part of the light that is reflected: a number, a ColorChecker patch or an object."},
            m.reflectance);
}

template <class V, Is<Transform> S>
void describe(V& v, S& t)
{
  v.field({.name = "scale", .sentence = "Factors along x, y and z; not 0, negative ones mirror.", .bounds = within(-1e6, 1e6)}, t.scale);
  v.field({.name = "rotate_deg", .sentence = "Angles about x, y and z.", .unit = "degrees", .bounds = within(-3600, 3600)}, t.rotate_deg);
  v.field({.name = "translate", .sentence = "Where the origin goes.", .unit = length_unit, .bounds = position_bounds}, t.translate);
}

template <class V, Is<Shape> S>
void describe(V& v, S& s)
{
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

template <class V, Is<Object> S>
void describe(V& v, S& o)
{
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

template <class V, Is<Light> S>
void describe(V& v, S& l)
{
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

template <class V, Is<Camera> S>
void describe(V& v, S& c)
{
  v.field({.name = "position", .sentence = "Where it stands.", .unit = length_unit, .bounds = position_bounds}, c.position);
  v.field({.name = "target", .sentence = "What it looks at.", .unit = length_unit, .bounds = position_bounds}, c.target);
  v.field({.name = "up", .sentence = "What is up in the picture.", .bounds = position_bounds}, c.up);
  v.field({.name = "fov_deg", .sentence = "Vertical field of view.", .unit = "degrees", .bounds = within(0.001, 179.9)}, c.fov_deg);
  v.field({.name = "resolution", .sentence = "Width and height of the picture.", .unit = "pixels", .bounds = within(1, 16384)},
          c.resolution);
}

template <class V, Is<Environment> S>
void describe(V& v, S& e)
{
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

template <class V, Is<Scene> S>
void describe(V& v, S& s)
{
  v.field({.name = "camera", .sentence = "The camera."}, s.camera);
  v.field({.name = "materials", .sentence = "Materials by name.", .count = {0, 1000}}, s.materials);
  v.field({.name = "objects", .sentence = "Everything that light can hit.", .count = {0, 10000}}, s.objects);
  v.field({.name = "lights", .sentence = "The lights.", .count = {0, 1000}}, s.lights);
  v.field({.name = "environment", .sentence = "What is behind everything, and may light it."}, s.environment);
  v.field({.name = "damaged_meshes", .sentence = "What is done about glass whose mesh has a hole or is inside out."}, s.damaged_meshes);
}

template <class V, Is<Stop> S>
void describe(V& v, S& s)
{
  v.field({.name = "seconds", .sentence = "Time of work.", .unit = "s", .bounds = within(0.001, 1e7)}, s.seconds);
  v.field({.name = "passes", .sentence = "Number of passes.", .bounds = within(1, max_passes)}, s.passes);
  v.field(
      {.name = "error",
       .sentence = "The error at which the picture is good enough: against the reference where there is one, else as the run estimates it.",
       .bounds = within(1e-9, 1e9)},
      s.error);
  v.field({.name = "metric", .sentence = "What `error` is measured in."}, s.metric);
}

template <class V, Is<Reference> S>
void describe(V& v, S& r)
{
  using Type = Reference::Type;
  v.type({.name = "type", .sentence = "Where the reference comes from."}, r.type);
  switch (r.type) {
  case Type::file:
    v.field({.name = "file", .sentence = "A picture of the run's size.", .text = Text::file, .required = true}, r.file);
    break;
  case Type::recipe:
    v.settings(r.settings);
    v.field({.name = "passes", .sentence = "Passes of each of the two seeds.", .bounds = within(1, max_passes)}, r.passes);
    v.field({.name = "seed",
             .sentence = "The first of its two seeds, the other is the next; neither may be the run's.",
             .bounds = within(0, 18446744073709551614.0)},
            r.seed);
    v.field(
        {.name = "seconds", .sentence = "Refuse to begin where making it would take longer.", .unit = "s", .bounds = within(0.001, 1e7)},
        r.seconds);
    break;
  }
}

template <class V, Is<Measure> S>
void describe(V& v, S& m)
{
  v.field({.name = "estimate", .sentence = "Estimate the error of the run without a reference, from two independent halves of it."},
          m.estimate);
  v.field({.name = "perceptual", .sentence = "Also log iw_ssim, flip and hdr_flip against the reference, which cost more."}, m.perceptual);
  v.field({.name = "mask",
           .sentence = "A picture of the run's size: its pixels that are not 0 are measured on their own too.",
           .text = Text::file},
          m.mask);
}

template <class V, Is<Preset> S>
void describe(V& v, S& p)
{
  v.field({.name = "name", .sentence = "A short name; without one, the file's name without .json.", .text = Text::line}, p.name);
  v.field({.name = "description", .sentence = "One line for `nephroid presets`.", .text = Text::line}, p.description);
  v.engine({.name = "engine", .sentence = "Which engine renders it."}, p.settings);
  v.field({.name = "unit", .sentence = "What one unit of length is."}, p.unit);
  v.field({.name = "seed",
           .sentence = "Seed of the random numbers: the same seed gives the same bits.",
           .bounds = within(0, 18446744073709551615.0)},
          p.seed);
  v.field({.name = "white",
           .sentence = "The luminance Y (without the factor 683) that becomes 1 in the picture.",
           .unit = "W/(m^2 sr)",
           .bounds = within(1e-12, 1e12)},
          p.white);
  v.field({.name = "scene", .sentence = "What there is to see."}, p.scene);
  v.settings(p.settings);
  v.field({.name = "stop", .sentence = "When the run is done."}, p.stop);
  v.field({.name = "reference", .sentence = "What the picture is measured against while it is rendered."}, p.reference);
  v.field({.name = "measure", .sentence = "What a run notes about its error."}, p.measure);
  v.field({.name = "animation", .sentence = "Frames in which fields of the preset change."}, p.animation);
  v.field({.name = "leave_out", .sentence = "Leave out what the scene does not need: it takes time and changes no picture."}, p.leave_out);
}

/// A struct's choosing enumeration.
template <Variant S>
auto& type_of(S& s)
{
  return s.type;
}

/// Calls f(choice, s) with a default-constructed S of each type.
template <Variant S, class F>
void for_each_type(F&& f)
{
  for (const auto& choice : Choices<typename About<S>::Type>::all) {
    S s;
    type_of(s) = choice.value;
    f(choice, s);
  }
}

} // namespace nephroid::preset
