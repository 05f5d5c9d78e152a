// SPDX-License-Identifier: Apache-2.0
// Everything in the section "scene" described.
#include "preset/describe.h"

#include "preset/choices.h"

namespace nephroid::preset {

void describe(Fields& v, Dispersion& d) {
  v.about("Dispersion", "Index of refraction over wavelength.");
  v.shorthand(BareValue::number, Dispersion::Type::constant, "n");
  v.shorthand(BareValue::text, Dispersion::Type::file, "file");
  using Type = Dispersion::Type;
  v.type("type", "Where n comes from.", d.type);
  const Column nm{"wavelength", "nm", wavelength_bounds}, n{"n", "", index_bounds};
  const auto coefficients = [&](std::string_view name, std::string_view sentence, auto& values,
                                std::string_view unit = {}) {
    v.field(name, sentence, values,
            {.unit = unit, .bounds = coefficient_bounds, .count = term_count, .required = true});
  };
  if (d.type == Type::constant) // which has no range to leave
    return v.field("n", "Index of refraction.", d.n, {.bounds = index_bounds, .required = true});
  if (d.type == Type::file)
    v.field("file", "A YAML file of refractiveindex.info, or one glass of Zemax (.agf).", d.file,
            {.text = Text::file, .names = Names::glass, .required = true});
  if (d.type == Type::sellmeier) {
    coefficients("b", "Strength of each term.", d.b);
    coefficients("c_um2", "Resonance of each term: its wavelength squared.", d.c_um2, "square micrometres");
  }
  if (d.type == Type::cauchy)
    coefficients("coefficients", "c0, c1, c2, ...: c_i in micrometres to the power 2 i.", d.coefficients);
  if (d.type == Type::table)
    v.field("table", "Rows of wavelength and n.", d.table,
            {.count = {1, max_rows}, .columns = {nm, n}, .required = true});
  if (d.type == Type::points)
    v.field("table", "Control points: wavelength and n.", d.table,
            {.count = {2, max_rows}, .columns = {nm, n}, .required = true});
  v.field("outside", "What n is at wavelengths outside the data's own range.", d.outside);
}

void describe(Fields& v, LightSpectrum& s) {
  v.about("LightSpectrum", "How a light's power is spread over wavelength.");
  v.shorthand(BareValue::text, LightSpectrum::Type::illuminant, "illuminant");
  using Type = LightSpectrum::Type;
  v.type("type", "Where the spectrum comes from.", s.type);
  const Column nm{"wavelength", "nm", wavelength_bounds}, power{"relative power", "", power_bounds};
  if (s.type == Type::illuminant)
    v.field("illuminant", "A, D50, D65, E or F1 to F12.", s.illuminant,
            {.text = Text::line, .names = Names::illuminant, .required = true});
  if (s.type == Type::blackbody)
    v.field("temperature_k", "Temperature.", s.temperature_k,
            {.unit = "K", .bounds = within(300, 1e6), .required = true});
  if (s.type == Type::lines)
    v.field("table", "Wavelength and relative power of each line.", s.table,
            {.count = {1, max_rows}, .columns = {nm, power}, .required = true});
  if (s.type == Type::table)
    v.field("table", "Rows of wavelength and relative power.", s.table,
            {.count = {2, max_rows}, .columns = {nm, power}, .required = true});
}

void describe(Fields& v, Reflectance& r) {
  v.about("Reflectance", "The part of the light that is reflected, over wavelength.");
  v.shorthand(BareValue::number, Reflectance::Type::constant, "value");
  v.shorthand(BareValue::text, Reflectance::Type::patch, "patch");
  using Type = Reflectance::Type;
  v.type("type", "Where the reflectance comes from.", r.type);
  if (r.type == Type::constant) v.field("value", "Reflectance.", r.value, {.bounds = within(0, 1), .required = true});
  if (r.type == Type::patch)
    v.field("patch", "Name of a ColorChecker patch, such as \"blue sky\".", r.patch,
            {.text = Text::line, .names = Names::patch, .required = true});
  if (r.type == Type::table)
    v.field("table", "Rows of wavelength and reflectance.", r.table,
            {.count = {1, max_rows},
             .columns = {{"wavelength", "nm", wavelength_bounds}, {"reflectance", "", within(0, 1)}},
             .required = true});
}

void describe(Fields& v, Texture& t) {
  v.about("Texture", "A picture on a surface, by the mesh's own u, v.");
  v.shorthand(BareValue::text, Texture::Type::file, "file");
  using Type = Texture::Type;
  v.type("type", "Where the colours come from.", t.type);
  if (t.type == Type::file) {
    v.field("file", "A picture; integers of colours are taken as sRGB.", t.file,
            {.text = Text::file, .required = true});
    v.field("wrap", "What is beyond the picture's edges.", t.wrap);
  } else {
    v.field("colour0", "Linear sRGB of the lower left and the upper right quarter.", t.colour0,
            {.bounds = within(0, 1)});
    v.field("colour1", "Linear sRGB of the other two quarters.", t.colour1, {.bounds = within(0, 1)});
  }
  v.field("scale", "How often it repeats while u and v go from 0 to 1.", t.scale, {.bounds = within(-1e6, 1e6)});
  v.field("rotate_deg", "Turns u and v counterclockwise, after the scale.", t.rotate_deg,
          {.unit = "degrees", .bounds = within(-3600, 3600)});
  v.field("offset", "Is added to u and v in the end.", t.offset, {.bounds = within(-1e6, 1e6)});
}

void describe(Fields& v, Coating& c) {
  v.about("Coating", "One thin layer on a surface of glass, with the interference of light in it.");
  v.field("dispersion", "The layer's index of refraction: a number, a file or an object.", c.dispersion,
          {.required = true});
  v.field("thickness_nm", "The layer's thickness.", c.thickness_nm,
          {.unit = "nm", .bounds = within(0, 20000), .required = true});
}

void describe(Fields& v, Pane& p) {
  v.about("Pane", "A pane of a glazing.");
  v.shorthand(BareValue::number, Pane::Type::glass, "thickness_mm");
  v.shorthand(BareValue::text, Pane::Type::file, "file");
  using Type = Pane::Type;
  v.type("type", "How the pane is known.", p.type);
  if (p.type == Type::glass) {
    v.field("thickness_mm", "The pane's thickness.", p.thickness_mm, {.unit = "mm", .bounds = within(0.01, 1000)});
    v.field("dispersion", "The glass: its n, and its k where the data have it. A number, a file or an object.",
            p.dispersion);
    v.field("tint", "Part of the light that the straight way through the glass leaves, besides what k takes.", p.tint);
    v.field("front_films", "Thin layers on its front, from the front to the back.", p.front_films, {.count = {0, 20}});
    v.field("back_films", "Thin layers on its back, from the front to the back.", p.back_films, {.count = {0, 20}});
    return;
  }
  if (p.type == Type::measured) {
    v.field("transmittance", "Part of the light that passes straight on.", p.transmittance, {.required = true});
    v.field("front_reflectance", "Part of the light from the front that comes back.", p.front_reflectance);
    v.field("back_reflectance", "Part of the light from the back that comes back.", p.back_reflectance);
  } else
    v.field("file", "A text of rows, as IGDB has them: wavelength in nm or um, transmittance, front, back reflectance.",
            p.file, {.text = Text::file, .required = true});
  v.field("flipped", "Whether it is the other way round: the data's front is at the back.", p.flipped);
  v.field("coated", "Whether a face has a coating; if not, angles are by the index and absorption that the data give.",
          p.coated);
}

void describe(Fields& v, Transform& t) {
  v.about("Transform", "Scale, then rotate (about x, then y, then z), then translate.");
  v.field("scale", "Factors along x, y and z; not 0, negative ones mirror.", t.scale, {.bounds = within(-1e6, 1e6)});
  v.field("rotate_deg", "Angles about x, y and z.", t.rotate_deg, {.unit = "degrees", .bounds = within(-3600, 3600)});
  v.field("translate", "Where the origin goes.", t.translate, {.unit = length_unit, .bounds = position_bounds});
}

void describe(Fields& v, Shape& s) {
  v.about("Shape", "A simple shape, centred on the origin with y up.");
  using Type = Shape::Type;
  const auto length = [&](std::string_view name, std::string_view sentence, auto& value) {
    v.field(name, sentence, value, {.unit = length_unit, .bounds = length_bounds});
  };
  v.type("type", "Which shape.", s.type);
  if (s.type == Type::quad) length("size", "Edge lengths along x and z; the middle number is not used.", s.size);
  if (s.type == Type::box || s.type == Type::plate) length("size", "Edge lengths along x, y and z.", s.size);
  if (s.type == Type::water) length("size", "Edge lengths along x, y and z at rest; y is the depth.", s.size);
  if (s.type == Type::relief) length("size", "Edge lengths along x, y and z; y where the picture is black.", s.size);
  if (s.type == Type::curtain_wall) {
    length("size", "Its width along the arc and its height; the last number is not used.", s.size);
    v.field("arc_deg", "How much it bends from edge to edge; above 0 its front is hollow.", s.arc_deg,
            {.unit = "degrees", .bounds = within(-180, 180)});
    v.field("panes", "How many panes there are along x and y.", s.panes, {.bounds = within(1, 300)});
    v.field("gap", "Between panes.", s.gap, {.unit = length_unit, .bounds = within(0, 1e6)});
    v.field("pillow", "How far the middle of a pane stands out at the front; below 0 it is dented.", s.pillow,
            {.unit = length_unit, .bounds = within(-1e6, 1e6)});
  }
  if (s.type == Type::sphere || s.type == Type::cylinder) length("radius", "Radius.", s.radius);
  if (s.type == Type::brilliant) length("radius", "Radius of the girdle.", s.radius);
  if (s.type == Type::cylinder || s.type == Type::prism) length("height", "Length along y.", s.height);
  if (s.type == Type::relief) length("height", "How much higher white is than black.", s.height);
  if (s.type == Type::cylinder) v.field("segments", "Facets around.", s.segments, {.bounds = within(3, 4096)});
  if (s.type == Type::water || s.type == Type::relief)
    v.field("segments", "Squares along the longer edge.", s.segments, {.bounds = within(3, 4096)});
  if (s.type == Type::relief)
    v.field("picture", "A picture of heights: its green, as a plain number; its top is at -z.", s.picture,
            {.text = Text::file, .required = true});
  if (s.type == Type::water) {
    v.field("wind_m_s", "Speed of the wind that raises the waves; 0: the water is at rest.", s.wind_m_s,
            {.unit = "m/s", .bounds = within(0, 60)});
    v.field("wind_deg", "Where the wind goes to, counterclockwise from +x as seen from above.", s.wind_deg,
            {.unit = "degrees", .bounds = within(-3600, 3600)});
    v.field("fetch_m", "The length of water that the wind has blown over: longer waves come of a longer one.",
            s.fetch_m, {.unit = "m", .bounds = within(0.1, 1e6)});
    v.field("time_s", "The waves run with it.", s.time_s, {.unit = "s", .bounds = within(-1e6, 1e6)});
    v.field("seed", "Which waves of those that this wind may raise.", s.seed);
  }
  if (s.type == Type::prism) {
    v.field("apex_deg", "Angle between the two equal sides; their edge is at +z.", s.apex_deg,
            {.unit = "degrees", .bounds = within(0.1, 179)});
    length("side", "Length of the two equal sides.", s.side);
  }
  v.field("inwards", "Turn the shape inside out, for a room.", s.inwards);
}

void describe(Fields& v, State& s) {
  v.about("State", "What an object's mesh can become.");
  v.field("mesh", "A mesh file with as many triangles as the object's, in the same order.", s.mesh,
          {.text = Text::file, .required = true});
  v.field("weight", "How far it is there: 0 the object's mesh, 1 this one.", s.weight, {.bounds = within(-100, 100)});
}

void describe(Fields& v, Object& o) {
  v.about("Object", "A mesh or a shape, put in its place.");
  v.field("name", "What messages call it.", o.name, {.text = Text::line});
  v.field("mesh", "A mesh file (OBJ, PLY, STL, glTF, ...); give either this or a shape.", o.mesh, {.text = Text::file});
  v.field("states", "What the mesh can become: its vertices go a part of the way to each.", o.states,
          {.count = {0, 1000}});
  v.field("shape", "A simple shape; give either this or a mesh.", o.shape);
  v.field("material", "One of the names in scene.materials.", o.material,
          {.text = Text::line, .names = Names::material, .required = true});
  v.field("transform", "Its size, turn and place.", o.transform);
  v.field("normals", "Flat or smooth.", o.normals);
  v.field("crease_deg", "Where smooth normals are made, edges that bend more than this stay sharp; 180: none does.",
          o.crease_deg, {.unit = "degrees", .bounds = within(0, 180)});
  v.field("priority", "Where two dielectrics overlap the higher one is there; of equals the one entered last.",
          o.priority, {.bounds = within(-1000000, 1000000)});
}

void describe(Fields& v, Camera& c) {
  v.about("Camera", "A pinhole camera, or one with a thin lens.");
  v.field("position", "Where it stands.", c.position, {.unit = length_unit, .bounds = position_bounds});
  v.field("target", "What it looks at.", c.target, {.unit = length_unit, .bounds = position_bounds});
  v.field("up", "What is up in the picture.", c.up, {.bounds = position_bounds});
  v.field("projection", "How the picture is taken.", c.projection);
  v.field("fov_deg", "Vertical field of view; orthographic: what it would show at the target, if height is null.",
          c.fov_deg, {.unit = "degrees", .bounds = within(0.001, 179.9)});
  v.field("height", "Height of what an orthographic picture shows; null: by fov_deg.", c.height,
          {.unit = length_unit, .bounds = length_bounds});
  v.field("shift", "How far the picture moves to the right and up, in its widths and heights, as a shift lens does.",
          c.shift, {.bounds = within(-10, 10)});
  v.field("aperture", "Diameter of the lens; 0: a pinhole, and all is sharp.", c.aperture,
          {.unit = length_unit, .bounds = within(0, 1e7)});
  v.field("focus_distance", "How far along the view the lens is focused; null: at the target.", c.focus_distance,
          {.unit = length_unit, .bounds = length_bounds});
  v.field("resolution", "Width and height of the picture.", c.resolution,
          {.unit = "pixels", .bounds = within(1, 16384)});
}

void describe(Fields& v, PlaceAndTime& p) {
  v.about("PlaceAndTime", "Where and when the sun is seen.");
  v.field("latitude_deg", "Latitude, north of the equator positive.", p.latitude_deg,
          {.unit = "degrees", .bounds = within(-90, 90), .required = true});
  v.field("longitude_deg", "Longitude, east of Greenwich positive.", p.longitude_deg,
          {.unit = "degrees", .bounds = within(-180, 180), .required = true});
  v.field("date", "YYYY-MM-DD, of the years 1950 to 2050.", p.date, {.text = Text::line, .required = true});
  v.field("hour", "Hour by the clock, with its fraction: 14.5 is half past two.", p.hour,
          {.unit = "h", .bounds = within(0, 24), .required = true});
  v.field("utc_offset_h",
          "What the clock is ahead of UTC, summer time included: 2 in Berlin in June; null: as time_zone says, or 0.",
          p.utc_offset_h, {.unit = "h", .bounds = within(-14, 14)});
  v.field("time_zone", "The clock's time zone, with its summer time, in place of utc_offset_h: \"Europe/Berlin\".",
          p.time_zone, {.text = Text::line});
}

void describe(Fields& v, Environment& e) {
  v.about("Environment", "What is behind everything, infinitely far.");
  v.shorthand(BareValue::text, Environment::Type::file, "file");
  using Type = Environment::Type;
  v.type("type", "Where the surroundings come from.", e.type);
  if (e.type == Type::file)
    v.field("file", "A latitude-longitude picture.", e.file, {.text = Text::file, .required = true});
  if (e.type == Type::constant)
    v.field("colour", "Linear sRGB.", e.colour, {.bounds = within(0, 1e6), .required = true});
  if (e.type == Type::sky) {
    v.field("place", "Where and when the sun is seen. Without this and sun_direction it is 45 degrees up in the south.",
            e.place);
    v.field("sun_direction", "The way to the sun: north is -z, east is +x.", e.sun_direction,
            {.bounds = position_bounds});
    v.field("turbidity", "How hazy the air is: 2 is very clear, 3 clear, 6 light haze.", e.turbidity,
            {.bounds = within(2, 10)});
    v.field("albedo", "Part of the light that the ground below the horizon reflects.", e.albedo,
            {.bounds = within(0, 1)});
    v.field("sun_scale", "Factor of the sun's own light; 0 leaves the sun out.", e.sun_scale,
            {.bounds = within(0, 1e6)});
  }
  v.field("radiance", "Luminance Y of the colour (1, 1, 1); of a sky a factor of it.", e.radiance,
          {.unit = "W/(m^2 sr)", .bounds = within(0, 1e9)});
  if (e.type != Type::constant)
    v.field("rotate_deg", "Turns the surroundings about +y, counterclockwise as seen from above.", e.rotate_deg,
            {.unit = "degrees", .bounds = within(-3600, 3600)});
  v.field("lights", "Whether it lights the scene, where the engine leaves that open; if not, it is only seen.",
          e.lights);
}

void describe(Fields& v, Box& b) {
  v.about("Box", "A box along the axes.");
  v.field("low", "Its lowest corner.", b.low, {.unit = length_unit, .bounds = position_bounds, .required = true});
  v.field("high", "Its highest corner.", b.high, {.unit = length_unit, .bounds = position_bounds, .required = true});
}

void describe(Fields& v, Meter& m) {
  v.about("Meter", "Measures the light that falls on a surface. Light takes no notice of it.");
  using Type = Meter::Type;
  v.type("type", "What it measures on.", m.type);
  v.field("name", "What tables and files call it.", m.name, {.text = Text::line, .required = true});
  if (m.type == Type::surface) {
    v.field("object", "The name of an object: what falls on its front.", m.object,
            {.text = Text::line, .names = Names::object, .required = true});
    v.field("facing", "Only what faces this way, to 45 degrees; null: all of it.", m.facing,
            {.bounds = position_bounds});
    v.field("within", "Only what is in this box; null: all of it.", m.within);
  } else {
    v.field("position", "Its centre.", m.position, {.unit = length_unit, .bounds = position_bounds});
    if (m.type != Type::goniometer)
      v.field("normal", "The way that it looks: light is measured that comes from there.", m.normal,
              {.bounds = position_bounds});
  }
  if (m.type == Type::goniometer) {
    v.field("direction", "Where gamma = 0, straight down in a luminaire's file, is.", m.direction,
            {.bounds = position_bounds});
    v.field("up", "Where the plane C = 0 is, as far as the direction allows; null: +z.", m.up,
            {.bounds = position_bounds});
    v.field("step_deg", "About the angle between its directions.", m.step_deg,
            {.unit = "degrees", .bounds = within(0.5, 30)});
  }
  if (m.type == Type::plane) {
    v.field("up", "What is up in its map; null: +y, or -z where it is level.", m.up, {.bounds = position_bounds});
    v.field("size", "Its width, and its height along `up`.", m.size, {.unit = length_unit, .bounds = length_bounds});
  }
  if (m.type == Type::point)
    v.field("diameter", "Of the window that light enters by.", m.diameter,
            {.unit = length_unit, .bounds = length_bounds});
  else if (m.type != Type::goniometer)
    v.field("cell", "The edge of a cell; null: a 64th of the longest edge.", m.cell,
            {.unit = length_unit, .bounds = length_bounds});
  v.field(
      "unit",
      "Of its map; it says whether watts or lux decide where the peak is and when it has enough. A goniometer has W/sr "
      "for units of watts, and cd for those of lux.",
      m.unit);
  v.field(
      "threshold",
      "A value with its unit, such as \"2500 W/m^2\": the share of the area, or of the directions, above it is told.",
      m.threshold, {.text = Text::line});
  v.field("until_percent",
          "It has measured enough where the 95 % intervals of mean and peak are no wider than this each way.",
          m.until_percent, {.unit = "%", .bounds = within(0.01, 100)});
}

void describe(Fields& v, Scene& s) {
  v.about("Scene", "What there is to see.");
  v.field("camera", "The camera.", s.camera);
  v.field("materials", "Materials by name.", s.materials, {.count = {0, 1000}});
  v.field("objects", "Everything that light can hit.", s.objects, {.count = {0, 10000}});
  v.field("lights", "The lights.", s.lights, {.count = {0, 1000}});
  v.field("environment", "What is behind everything, and may light it.", s.environment);
  v.field("meters", "What measures light, for nephroid measure.", s.meters, {.count = {0, 100}});
  v.field("damaged_meshes", "What is done about glass whose mesh has a hole or is inside out.", s.damaged_meshes);
}

} // namespace nephroid::preset
