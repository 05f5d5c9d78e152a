// SPDX-License-Identifier: Apache-2.0
#include "preset/read.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/nearest.h"
#include "preset/choices.h"
#include "preset/meters.h"
#include "preset/place.h"
#include "preset/settings_type.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::preset {
namespace {

using Rows = std::vector<std::array<double, 2>>;

double length(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

/// Single precision cannot make an orthonormal frame from two directions less than about 0.01 degrees apart.
bool parallel(const Vec3& a, const Vec3& b) {
  const Vec3 cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return length(cross) <= 2e-4 * length(a) * length(b);
}

/// Shorter ones have a square that single precision rounds to 0.
bool no_direction(const Vec3& v) { return length(v) < 1e-12; }

void check_direction(const Vec3& v, const std::string& pointer, const Where& where) {
  if (no_direction(v)) throw bad_input(where(pointer), "has no length", "expected a direction");
}

void check_up(const Vec3& up, const Vec3& forward, const std::string& pointer, const Where& where) {
  check_direction(up, pointer, where);
  if (parallel(up, forward))
    throw bad_input(where(pointer), "points along the line of sight or of light", "expected a direction across it");
}

/// Two values at one wavelength contradict each other.
void check_rows(const Rows& rows, const std::string& pointer, const Where& where) {
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rows[a][0] < rows[b][0]; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (rows[order[i]][0] == rows[order[i - 1]][0])
      throw bad_input(where(child(pointer, order[i])), fmt::format("{} nm is given twice", rows[order[i]][0]),
                      "expected each wavelength once");
}

void check_dispersion(const Dispersion& d, const std::string& pointer, const Where& where) {
  if (d.type == Dispersion::Type::sellmeier && d.b.size() != d.c_um2.size())
    throw bad_input(where(pointer),
                    fmt::format("has {} in 'b' and {} in 'c_um2'", counted(d.b.size(), "value"), d.c_um2.size()),
                    "expected as many of both");
  if (d.type == Dispersion::Type::table || d.type == Dispersion::Type::points)
    check_rows(d.table, child(pointer, "table"), where);
}

void check_reflectance(const Reflectance& reflectance, const std::string& pointer, const Where& where) {
  if (reflectance.type == Reflectance::Type::table) check_rows(reflectance.table, child(pointer, "table"), where);
}

void check_pane(const Pane& p, const std::string& pointer, const Where& where) {
  check_dispersion(p.dispersion, child(pointer, "dispersion"), where);
  check_reflectance(p.tint, child(pointer, "tint"), where);
  check_reflectance(p.transmittance, child(pointer, "transmittance"), where);
  check_reflectance(p.front_reflectance, child(pointer, "front_reflectance"), where);
  check_reflectance(p.back_reflectance, child(pointer, "back_reflectance"), where);
  for (const auto& [films, field] : {std::pair(&p.front_films, "front_films"), {&p.back_films, "back_films"}})
    for (std::size_t i = 0; i < films->size(); ++i)
      check_dispersion((*films)[i].dispersion, child(child(child(pointer, field), i), "dispersion"), where);
}

void check_material(const Material& m, const std::string& pointer, const Where& where) {
  check_reflectance(m.reflectance, child(pointer, "reflectance"), where);
  check_dispersion(m.dispersion, child(pointer, "dispersion"), where);
  check_reflectance(m.tint, child(pointer, "tint"), where);
  for (std::size_t i = 0; i < m.panes.size(); ++i) check_pane(m.panes[i], child(child(pointer, "panes"), i), where);
  if (m.coating) check_dispersion(m.coating->dispersion, child(child(pointer, "coating"), "dispersion"), where);
}

void check_spectrum(const LightSpectrum& s, const std::string& pointer, const Where& where) {
  const bool lines = s.type == LightSpectrum::Type::lines;
  if (!lines && s.type != LightSpectrum::Type::table) return;
  const std::string table = child(pointer, "table");
  if (!lines) check_rows(s.table, table, where);
  if (std::none_of(s.table.begin(), s.table.end(), [](const auto& row) { return row[1] > 0; }))
    throw bad_input(where(table), "has no power at any wavelength", "expected at least one power above 0");
  if (lines && std::none_of(s.table.begin(), s.table.end(),
                            [](const auto& row) { return row[0] >= 380 && row[0] <= 780 && row[1] > 0; }))
    throw bad_input(where(table), "has no line that is rendered", "expected at least one from 380 to 780 nm");
}

/// what: of "material", "object". names: those that there are.
[[noreturn]] void refuse_name(const std::string& what, const std::string& name, std::vector<std::string> names,
                              const Location& where) {
  const std::string similar = nearest(name.substr(0, 64), names);
  if (names.size() > 12) names.resize(12);
  throw bad_input(where, fmt::format("there is no {} {}", what, in_quotes(name)),
                  names.empty() ? fmt::format("scene.{}s is empty", what)
                                : fmt::format("scene.{}s has {}", what, fmt::join(names, ", ")),
                  similar.empty() ? "" : fmt::format("did you mean '{}'?", similar));
}

void require_object(const std::string& name, const Scene& scene, const Location& where) {
  std::vector<std::string> names;
  for (const Object& object : scene.objects)
    if (!object.name.empty()) names.push_back(object.name);
  if (name.empty() || std::ranges::find(names, name) == names.end())
    refuse_name("object", name, std::move(names), where);
}

void check_object(const Object& o, const Scene& scene, const std::string& pointer, const Where& where) {
  if (o.mesh.has_value() == o.shape.has_value())
    throw bad_input(where(pointer), o.mesh ? "has both 'mesh' and 'shape'" : "has neither 'mesh' nor 'shape'",
                    "expected exactly one of them");
  if (o.shape && !o.states.empty())
    throw bad_input(where(child(pointer, "states")), "is of a mesh only, and the object is a shape",
                    "expected 'mesh', or no states", "a shape's own numbers can be animated");
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(o.transform.scale[axis]) < 1e-6)
      throw bad_input(where(child(child(child(pointer, "transform"), "scale"), axis)),
                      fmt::format("is {}", o.transform.scale[axis]),
                      "expected a factor of at least 1e-06 or at most -1e-06", "for a thin object use a plate");
  if (o.shape && o.shape->type == Shape::Type::curtain_wall) {
    const Shape& s = *o.shape;
    const double turn = s.arc_deg * std::numbers::pi / 180 / s.panes[0], along = s.size[0] / s.panes[0],
                 chord = turn == 0 ? along : along * std::sin(turn / 2) / (turn / 2),
                 pane = std::min(chord, s.size[1] / s.panes[1]);
    if (s.gap > 0.99 * pane)
      throw bad_input(where(child(child(pointer, "shape"), "gap")),
                      fmt::format("is {:g}, and a pane with its gap is {:g} wide or high", s.gap, pane),
                      "expected less: nothing is left of the panes");
  }
  if (scene.materials.contains(o.material)) return;
  std::vector<std::string> names;
  for (const auto& [name, material] : scene.materials) names.push_back(name);
  refuse_name("material", o.material, std::move(names), where(child(pointer, "material")));
}

void check_environment(const Environment& e, const std::string& pointer, const Where& where) {
  if (e.type != Environment::Type::sky) return;
  if (e.place && e.sun_direction)
    throw bad_input(where(pointer), "has both 'place' and 'sun_direction'", "expected one of them");
  if (e.sun_direction) check_direction(*e.sun_direction, child(pointer, "sun_direction"), where);
  if (e.place) check_place(*e.place, child(pointer, "place"), where);
}

void check_light(const Light& l, const Scene& scene, const std::string& pointer, const Where& where) {
  check_spectrum(l.spectrum, child(pointer, "spectrum"), where);
  if (is_directed(l)) check_direction(l.direction, child(pointer, "direction"), where);
  if (is_framed(l)) check_up(l.up, l.direction, child(pointer, "up"), where);
  if (has(l.type, LIGHT_HAS_OBJECT)) require_object(l.object, scene, where(child(pointer, "object")));
}

void check_meter(const Meter& m, std::size_t index, const Scene& scene, const Where& where) {
  const std::string pointer = child("/scene/meters", index);
  const auto at = [&](const char* field) { return where(child(pointer, field)); };
  if (m.name.empty()) throw bad_input(at("name"), "is empty", "expected what tables and files may call the meter");
  for (std::size_t other = 0; other < index; ++other)
    if (file_stem(scene.meters[other]) == file_stem(m))
      throw bad_input(at("name"),
                      fmt::format("{} would have the files of meter {}, {}", in_quotes(m.name), other,
                                  in_quotes(scene.meters[other].name)),
                      "expected another name for each");
  if (m.type == Meter::Type::surface) {
    require_object(m.object, scene, at("object"));
    if (m.facing) check_direction(*m.facing, child(pointer, "facing"), where);
    for (std::size_t axis = 0; m.within && axis < 3; ++axis)
      if (!(m.within->low[axis] < m.within->high[axis]))
        throw bad_input(at("within"), "has no volume: low is not below high", "expected low below high on each axis");
  } else if (m.type == Meter::Type::goniometer) {
    check_direction(m.direction, child(pointer, "direction"), where);
    if (m.up) check_up(*m.up, m.direction, child(pointer, "up"), where);
  } else {
    check_direction(m.normal, child(pointer, "normal"), where);
    if (m.type == Meter::Type::plane && m.up) check_up(*m.up, m.normal, child(pointer, "up"), where);
  }
  const bool of_directions = m.type == Meter::Type::goniometer;
  if (is_intensity(m.unit) && !of_directions)
    throw bad_input(at("unit"), fmt::format("is {}", word(m.unit)), "expected a unit of light on an area",
                    "intensity is for meters of type goniometer");
  if (m.threshold && quantity_in(*m.threshold) && is_intensity(quantity_in(*m.threshold)->unit) != of_directions)
    throw bad_input(at("threshold"), fmt::format("is {}", in_quotes(*m.threshold)),
                    of_directions ? "expected cd or W/sr for a goniometer" : "expected a unit of light on an area");
  if (m.threshold && !quantity_in(*m.threshold))
    throw bad_input(at("threshold"), fmt::format("is {}", in_quotes(*m.threshold)),
                    fmt::format("expected a number and one of {}", fmt::join(meter_units(), ", ")),
                    "write \"2500 W/m^2\", say");
}

void check_camera(const Camera& c, const Where& where) {
  const Vec3 forward{c.target[0] - c.position[0], c.target[1] - c.position[1], c.target[2] - c.position[2]};
  if (no_direction(forward))
    throw bad_input(where("/scene/camera/target"), "is where the camera stands", "expected another point");
  check_up(c.up, forward, "/scene/camera/up", where);
  if (c.height && c.projection != Camera::Projection::orthographic)
    throw bad_input(where("/scene/camera/height"), "is of an orthographic camera only",
                    "expected 'scene.camera.projection' orthographic, or null", "use fov_deg");
  if (const double focus = c.focus_distance.value_or(target_distance(c)); c.aperture > 2 * focus)
    throw bad_input(where("/scene/camera/aperture"),
                    fmt::format("is {:g}, and the lens is focused at {:g}", c.aperture, focus),
                    "expected at most twice the focus distance", "is it in the scene's unit?");
}

/// What nothing can measure is refused before anything runs.
void check_stop(const Preset& preset, const Where& where) {
  if (preset.stop.error && !preset.reference && !preset.measure.estimate)
    throw bad_input(where("/stop/error"), "nothing measures the error of this run: 'measure.estimate' is false",
                    "expected a 'reference', or 'measure.estimate' true");
}

void check_display(const Preset& preset, const Where& where) {
  if (preset.display.white_balance == Display::WhiteBalance::light && preset.scene.lights.empty())
    throw bad_input(where("/display/white_balance"), "is \"light\", and the scene has no lamp",
                    "expected one in scene.lights, or \"D65\"");
}

/// Each frame has another picture.
void check_animation(const Preset& preset, const Where& where) {
  if (preset.animation && preset.reference && preset.reference->type == Reference::Type::file)
    throw bad_input(where("/reference"), "is one picture for all frames of the animation",
                    "expected a recipe, or no reference");
}

/// A reference that shares a seed with the run would share its noise, and call it right; one of another white is
/// another picture.
void check_reference(const Preset& preset, const Where& where) {
  if (!preset.white && preset.reference && preset.reference->type == Reference::Type::file)
    throw bad_input(where("/white"), "is not a number, and the reference is a picture with a white of its own",
                    "expected the number that the reference was made with");
  if (!preset.reference || preset.reference->type != Reference::Type::recipe) return;
  const std::uint64_t seed = preset.reference->seed;
  if (preset.seed == seed || preset.seed == seed + 1)
    throw bad_input(
        where("/reference/seed"),
        fmt::format("{} and {} are the reference's seeds, and {} is the run's", seed, seed + 1, preset.seed),
        "expected other seeds than the run's");
}

} // namespace

bool has_white(const Preset& preset) { return std::ranges::count(preset.settings.type().without, "white") == 0; }

void check(const Preset& preset, const Where& where) {
  const Scene& scene = preset.scene;
  check_camera(scene.camera, where);
  for (const auto& [name, material] : scene.materials) check_material(material, child("/scene/materials", name), where);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    check_object(scene.objects[i], scene, child("/scene/objects", i), where);
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    check_light(scene.lights[i], scene, child("/scene/lights", i), where);
  for (std::size_t i = 0; i < scene.meters.size(); ++i) check_meter(scene.meters[i], i, scene, where);
  if (scene.environment) check_environment(*scene.environment, "/scene/environment", where);
  check_display(preset, where);
  check_stop(preset, where);
  check_reference(preset, where);
  check_animation(preset, where);
  preset.settings.type().check(preset, where);
}

} // namespace nephroid::preset
