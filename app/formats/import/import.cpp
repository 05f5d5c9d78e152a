// SPDX-License-Identifier: Apache-2.0
// From what a file describes to a preset and its meshes: in one place, for all formats.
#include "formats/import/import.h"

#include "base/counted.h"
#include "base/files.h"
#include "formats/import/backs.h"
#include "formats/import/dielectrics.h"
#include "formats/import/emitter.h"
#include "formats/import/gltf_scene.h"
#include "formats/import/surroundings.h"
#include "preset/field.h"
#include "preset/read.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <system_error>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

using std::numbers::pi;

constexpr std::size_t most_objects = 10000, most_lights = 1000; ///< of a preset

/// Those that a material has.
std::vector<preset::Texture*> textures_of(preset::Material& material) {
  std::vector<preset::Texture*> textures;
  for (auto* texture : {&material.texture, &material.roughness_texture, &material.tint_texture, &material.normal_map})
    if (*texture) textures.push_back(&**texture);
  return textures;
}

class PresetBuilder {
public:
  /// folder: the name of the meshes' folder, beside the preset.
  PresetBuilder(Description& from, std::string folder) : from_(from), folder_(std::move(folder)) {
    // A picture is right as our camera sees it where x, y and -z of the camera are right-handed. Else the whole world
    // is mirrored.
    if (from_.camera && glm::determinant(glm::dmat3(from_.camera->to_world)) > 0) to_preset_[0][0] = -1;
    // A preset's sky is up along +y.
    const glm::dvec3 up = glm::dmat3(to_preset_) * from_.up, y(0, 1, 0), axis = glm::cross(up, y);
    if (glm::length(axis) > 1e-9)
      to_preset_ = glm::rotate(glm::dmat4(1), std::acos(std::clamp(up.y, -1.0, 1.0)), axis) * to_preset_;
    else if (up.y < 0)
      to_preset_ = glm::rotate(glm::dmat4(1), pi, glm::dvec3(1, 0, 0)) * to_preset_;
  }

  preset::Preset make(const std::string& name) {
    made_.name = name;
    made_.description = "Imported from " + name_of(from_.source.filename().string(), "a scene");
    made_.unit = from_.length;
    made_.scene.materials = from_.materials;
    for (auto& [key, material] : made_.scene.materials) {
      std::vector<std::string*> files{&material.dispersion.file, &material.metal};
      for (preset::Texture* texture : textures_of(material)) files.push_back(&texture->file);
      for (std::string* file : files)
        if (from_.files.contains(*file)) *file = folder_ + "/" + *file;
    }
    if (from_.shapes.size() > most_objects)
      throw bad_input(from_.source.string(), fmt::format("has {} objects", from_.shapes.size()),
                      fmt::format("expected at most {}", most_objects),
                      "join those of one material in the program that made them");
    for (const DescribedShape& shape : from_.shapes) add(shape);
    if (made_.scene.objects.empty())
      throw bad_input(from_.source.string(), "has no triangles in its scene, and no sphere",
                      "expected a surface that can be taken over");
    made_.scene.lights.insert(made_.scene.lights.end(), from_.lamps.begin(), from_.lamps.end());
    for (const DescribedLight& light : from_.lights) add(light);
    if (from_.surroundings) surround(*from_.surroundings);
    if (from_.camera)
      aim(*from_.camera);
    else
      look_at_all();
    if (made_.scene.lights.size() == details_ && !made_.scene.environment) light_all();
    for (const DescribedShape& shape : from_.shapes) cover_back(shape);
    expose();
    dim();
    for (std::string& line : made_.not_imported = from_.notes)
      std::ranges::replace_if(
          line, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' '); // of names in the file
    return made_;
  }

  /// Whether an object has the mesh with this key, and whether one with a texture has.
  bool uses(const std::string& mesh) const { return used_.contains(mesh); }
  bool is_textured(const std::string& mesh) const { return textured_.contains(mesh); }

private:
  /// A mesh that is sheared or flattened, as it is then, about its place. Returns its key.
  std::string own_sheared(const DescribedShape& shape, const std::string& from, const glm::dmat4& to_world) {
    scene::Mesh mesh = from_.meshes.at(from);
    mesh.normals.clear();
    for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dmat3(to_world) * glm::dvec3(p));
    if (glm::determinant(glm::dmat3(to_world)) < 0) scene::turn_triangles(mesh);
    return from_.own_mesh(shape.name, std::move(mesh));
  }

  /// What the object's mesh becomes, and tracks of it. keys: of the states' meshes.
  void add_states(preset::Object& object, const DescribedShape& shape, const std::vector<std::string>& keys) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const DescribedState& from = shape.states[i];
      const auto weight = [](double value) { return std::clamp(value, -100.0, 100.0); };
      used_.insert(keys[i]);
      preset::State& state = object.states.emplace_back(preset::State{folder_ + "/" + keys[i], weight(from.weight)});
      if (from.keys.empty()) continue;
      if (!made_.animation) made_.animation.emplace().frames = 1;
      preset::Track track;
      track.path = fmt::format("scene.objects.{}.states.{}.weight", made_.scene.objects.size(), i);
      for (const DescribedState::Key& key : from.keys) {
        const double frame = std::clamp(std::round(key.seconds * made_.animation->fps), 0.0, preset::max_frames - 1.0);
        if (!track.keys.empty() && track.keys.back().frame == static_cast<int>(frame)) track.keys.pop_back();
        track.keys.push_back({static_cast<int>(frame), {weight(key.weight)}});
      }
      state.weight = track.keys.front().value[0];
      made_.animation->frames = std::max(made_.animation->frames, track.keys.back().frame + 1);
      made_.animation->tracks.push_back(std::move(track));
    }
  }

  void see(const glm::dvec3& p) { bounds_ = scene::enclosing(bounds_, {p, p}); }
  glm::dvec3 middle() const { return 0.5 * (bounds_.low + bounds_.high); }
  double size() const { return std::max(glm::length(bounds_.high - bounds_.low), 1e-3); }

  void add(const DescribedShape& shape) {
    glm::dmat4 to_world = to_preset_ * shape.to_world;
    if (shape.mesh.empty()) to_world = to_world * glm::dmat4(glm::dmat3(shape.radius));
    if (shape.glow) return glow(shape, to_world);
    preset::Object object;
    object.name = unique(name_of(shape.name, "object"), names_);
    object.material = material_of(shape);
    auto transform = transform_of(to_world);
    if (shape.mesh.empty()) {
      if (!transform) return from_.note(shape.where, "a sphere that is sheared is left out");
      object.shape.emplace();
      object.shape->radius = 1;
      for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
          for (const double z : {-1.0, 1.0}) see(to_world * glm::dvec4(x, y, z, 1));
    } else {
      std::string key = shape.mesh;
      std::vector<std::string> states;
      for (const DescribedState& state : shape.states) states.push_back(state.mesh);
      if (!transform) {
        key = own_sheared(shape, key, to_world);
        for (std::string& state : states) state = own_sheared(shape, state, to_world);
        if (textured_.contains(shape.mesh)) textured_.insert(key);
        to_world = glm::translate(glm::dmat4(1), glm::dvec3(to_world[3]));
        transform = transform_of(to_world);
        if (!transform)
          throw bad_input(shape.where, "stands too far from the origin of the scene", "expected at most 1e7 units",
                          "move the scene to its origin in the program that made it");
      }
      const scene::Mesh& mesh = from_.meshes.at(key);
      using enum preset::Object::Normals;
      object.normals = shape.smooth.value_or(!from_.meshes.at(shape.mesh).normals.empty()) ? smooth : faceted;
      object.crease_deg = shape.crease_deg;
      for (const glm::vec3& p : mesh.positions) see(to_world * glm::dvec4(glm::dvec3(p), 1));
      object.mesh = folder_ + "/" + key;
      used_.insert(key);
      add_states(object, shape, states);
    }
    object.transform = *transform;
    object.priority = shape.priority;
    made_.scene.objects.push_back(std::move(object));
  }

  /// A texture is of no use where the surface does not say where it is.
  std::string material_of(const DescribedShape& shape) {
    const preset::Material& material = made_.scene.materials.at(shape.material);
    const bool has_texcoords = !shape.mesh.empty() && !from_.meshes.at(shape.mesh).texcoords.empty();
    preset::Material without = material;
    const bool is_textured = !textures_of(without).empty();
    if (is_textured && has_texcoords) textured_.insert(shape.mesh);
    if (!is_textured || has_texcoords) return shape.material;
    std::string& plain = plain_[shape.material];
    if (!plain.empty()) return plain;
    std::string instead;
    if (material.texture) {
      without = {};
      without.reflectance.value = 0.5;
      instead = ": grey of 0.5 takes its place";
    }
    if (material.tint_texture) instead += ": the glass is clear";
    if (material.roughness_texture) {
      without.roughness /= 2;
      instead += fmt::format(": a roughness of {:.3g} takes its place", without.roughness);
    }
    if (material.normal_map) instead += ": it is even";
    from_.note(shape.where, "what pictures say of it is left out, as the surface has no u, v" + instead);
    for (plain = shape.material + " plain"; made_.scene.materials.contains(plain);) plain += " 2";
    without.roughness_texture = without.tint_texture = without.normal_map = std::nullopt;
    made_.scene.materials[plain] = without;
    return plain;
  }

  /// A surface that shines stays and is a lamp; one that is flat and shines on both sides becomes two, back to back.
  void glow(const DescribedShape& shape, const glm::dmat4& to_world) {
    const LightColour colour = light_colour(*shape.glow);
    const auto power_of = [&](double area) { // of a radiance in W m^-2 sr^-1
      return watts(colour) * shape.glow_power.value_or(pi * area);
    };
    preset::Light light;
    light.spectrum = colour.spectrum;
    if (shape.mesh.empty()) {
      light.position = scene::to_vec3(glm::dvec3(to_world[3]));
      light.power_w = power_of(ellipsoid_area(glm::dmat3(to_world)));
      if (!shape.inside_out) return keep_glowing(shape, light);
      from_.note(shape.where, "a sphere whose inside shines is left out: a point light of its power is in its centre");
      if (light.power_w > 0) made_.scene.lights.push_back(light);
      return;
    }
    const Emitter e = emitter_of(from_.meshes.at(shape.mesh), to_world);
    light.position = scene::to_vec3(e.centre);
    light.power_w = power_of(e.area);
    const bool both = shape.glows_on_both_sides && e.flat;
    // The areas of a closed surface add up to 0 as vectors.
    if (shape.glows_on_both_sides && !e.flat && glm::length(e.normal) > 1e-3 * e.area)
      from_.note("a curved surface that shines on both sides shines on its outside alone");
    if (both && shape.glow_power) light.power_w /= 2; // that of both
    keep_glowing(shape, light);
    if (!both) return;
    DescribedShape back = behind(shape, to_preset_, 1e-4 * std::sqrt(e.area), from_);
    back.inside_out = !shape.inside_out;
    keep_glowing(std::move(back), light);
  }

  /// A surface with the material of its back behind what shows that. To be called when all is seen and lit.
  void cover_back(const DescribedShape& shape) {
    if (!shape.back) return;
    std::vector<glm::dvec3> places{scene::to_dvec3(made_.scene.camera.position)};
    for (const preset::Light& light : made_.scene.lights)
      if (!shape.glow && light.type != preset::Light::Type::directional)
        places.push_back(scene::to_dvec3(light.position));
    if (!shows_back(shape, to_preset_, places, from_)) return;
    if (made_.scene.objects.size() >= most_objects)
      return from_.note(fmt::format("backs of surfaces beyond {} objects are as their fronts", most_objects));
    DescribedShape back = behind(shape, to_preset_, 4e-6 * size(), from_); // a thin wall may be there
    back.material = *shape.back;
    back.name = shape.name + " back";
    back.glow.reset();
    add(back);
  }

  bool has_material(const DescribedShape& shape) const { return made_.scene.materials.contains(shape.material); }

  /// light: with its power and spectrum, in the middle.
  void keep_glowing(DescribedShape shape, preset::Light light) {
    shape.glow.reset();
    if (!has_material(shape)) {
      if (!(light.power_w > 0)) return;
      if (black_.empty())
        for (black_ = "lamp"; made_.scene.materials.contains(black_);) black_ += " 2";
      made_.scene.materials[black_].reflectance.value = 0;
      shape.material = black_;
    } else if (!preset::is_matt(made_.scene.materials.at(shape.material).type))
      from_.note(shape.where, "a surface of glass or metal that shines lights the scene, but is not seen to shine");
    if (shape.inside_out && !shape.mesh.empty()) {
      if (!shape.states.empty()) from_.note(shape.where, "morph targets of a surface whose back shines are left out");
      shape.states.clear();
      scene::Mesh mesh = from_.meshes.at(shape.mesh);
      mesh.normals.clear();
      scene::turn_triangles(mesh);
      shape.mesh = from_.own_mesh(shape.name, std::move(mesh));
    }
    const std::size_t objects = made_.scene.objects.size();
    add(shape);
    if (made_.scene.objects.size() == objects) return; // it could not be taken over
    if (!(light.power_w > 0)) return;
    if (made_.scene.lights.size() >= most_lights)
      return from_.note(shape.where, fmt::format("there are more than {} lights: it does not shine", most_lights));
    light.type = preset::Light::Type::mesh;
    light.object = made_.scene.objects.back().name;
    if (shape.glows_by_mean) ++details_;
    made_.scene.lights.push_back(std::move(light));
  }

  double watts(const LightColour& colour) const { return colour.watts_per_lumen * most_lumens * from_.unit; }

  void add(const DescribedLight& light) {
    const LightColour colour = light_colour(light.colour);
    preset::Light made;
    made.type = light.type;
    made.spectrum = colour.spectrum;
    made.position = scene::to_vec3(glm::dvec3(to_preset_ * glm::dvec4(light.position, 1)));
    const glm::dvec3 way = glm::dmat3(to_preset_) * light.direction;
    if (!(glm::length(way) > 0)) throw bad_input(light.where, "the light has no direction");
    made.direction = scene::to_vec3(glm::normalize(way));
    made.half_angle_deg = std::clamp(light.half_angle_deg, 0.01, 90.0);
    const bool spot = light.type == preset::Light::Type::spot;
    made.power_w = watts(colour) * (spot ? 2 * pi * (1 - std::cos(glm::radians(made.half_angle_deg))) : 4 * pi);
    made.irradiance_w_m2 = watts(colour);
    if (!(watts(colour) > 0)) return from_.note(light.where, "a light that is black is left out");
    made_.scene.lights.push_back(made);
  }

  void surround(const DescribedSurroundings& s) {
    preset::Environment& e = made_.scene.environment.emplace();
    e.lights = s.lights;
    e.radiance = s.scale * from_.unit;
    if (s.sky) {
      e = *s.sky;
      e.sun_direction = scene::to_vec3(glm::dmat3(to_preset_) * scene::to_dvec3(*e.sun_direction));
      return;
    }
    if (s.file.empty()) {
      e.type = preset::Environment::Type::constant;
      const double largest = std::max({s.colour.x, s.colour.y, s.colour.z, 1.0});
      e.colour = scene::to_vec3(s.colour / largest);
      e.radiance *= largest;
      return;
    }
    const glm::dmat3 to_preset = glm::dmat3(to_preset_) * s.to_world;
    const glm::dvec3 top = glm::normalize(to_preset[1]);
    const glm::dvec3& centre = to_preset[2];
    if (!s.is_equal_area && top.y > 1 - 1e-9 && glm::determinant(to_preset) > 0) {
      e.file = fs::absolute(s.file).lexically_normal().string();
      // Ours looks along -z, and a turn is counterclockwise seen from above: (-sin a, 0, -cos a).
      e.rotate_deg = glm::degrees(std::atan2(-centre.x, -centre.z));
      return;
    }
    ByteStore exr;
    image::write_exr(exr, map_in_preset(s, to_preset));
    e.file = folder_ + "/" + from_.own_bytes("surroundings", ".exr", exr);
  }

  void aim(const DescribedCamera& c) {
    preset::Camera& made = made_.scene.camera;
    const glm::dmat4 to_world = to_preset_ * c.to_world;
    const glm::dvec3 position(to_world[3]), forward(to_world[2]), up(to_world[1]);
    if (!(glm::length(forward) > 0) || !(glm::length(up) > 0)) throw bad_input(c.where, "the camera has no direction");
    made.position = scene::to_vec3(position);
    made.up = scene::to_vec3(glm::normalize(up));
    made.fov_deg = std::clamp(c.fov_deg, 0.001, 179.9);
    made.resolution = c.resolution;
    if (c.height) {
      made.projection = preset::Camera::Projection::orthographic;
      made.height = std::clamp(*c.height * glm::length(up), 1e-6, 1e7);
    }
    made.shift = {std::clamp(c.shift.x, -10.0, 10.0), std::clamp(c.shift.y, -10.0, 10.0)};
    if (c.lens_radius > 0) {
      made.focus_distance = std::clamp(c.focus_distance * glm::length(forward), 1e-6, 1e7);
      made.aperture = std::min(2 * c.lens_radius * glm::length(up), 1e7);
      if (made.aperture > 2 * *made.focus_distance) {
        from_.note(c.where, "the lens is wider than twice its focus distance: it is made as wide as that");
        made.aperture = 2 * *made.focus_distance;
      }
    }
    // The file's camera looks along a line; ours at a point, about which the window turns it.
    const double ahead = glm::dot(middle() - position, glm::normalize(forward));
    made.target = scene::to_vec3(position + glm::normalize(forward) * (ahead > 1e-3 * size() ? ahead : size()));
  }

  void look_at_all() {
    from_.note("the file has no camera that can be taken over: one that sees everything takes its place");
    made_.scene.camera.target = scene::to_vec3(middle());
    made_.scene.camera.position = scene::to_vec3(middle() + size() * glm::dvec3(0.3, 0.7, 1.2));
  }

  void light_all() {
    from_.note("the file has no lights that can be taken over: a lamp above everything takes their place");
    preset::Light lamp;
    lamp.position = scene::to_vec3(middle() + size() * glm::dvec3(-0.5, 1, 0.4));
    lamp.power_w = 10 * size() * size() * from_.unit;
    made_.scene.lights.push_back(lamp);
  }

  /// Where the file does not say what is white, it is a white surface in the middle of everything that faces every
  /// light.
  void expose() {
    double white = from_.unit;
    if (from_.fits_white) {
      double irradiance = 0;
      const double m = preset::metres(made_.unit);
      for (const preset::Light& light : made_.scene.lights)
        irradiance +=
            luminous_irradiance(light, middle()) / (light.type == preset::Light::Type::directional ? 1 : m * m);
      white = irradiance > 0 ? irradiance / pi : 1;
    }
    made_.white = white / from_.exposure;
  }

  /// A preset's lights have at most so much light. Where one has more, as in a scene of millimetres that is read as one
  /// of metres, all light and what is white become less by the same factor: the picture stays.
  void dim() {
    double most = preset::power_bounds.high;
    for (const preset::Light& light : made_.scene.lights) {
      if (!std::isfinite(light.power_w + light.irradiance_w_m2))
        throw bad_input(from_.source.string(), "has a lamp whose light is no finite number");
      most = std::max({most, light.power_w, light.irradiance_w_m2});
    }
    if (made_.scene.environment) most = std::max(most, made_.scene.environment->radiance);
    const double part = preset::power_bounds.high / most;
    if (part < 1)
      from_.note(
          fmt::format("a light has more than {:g} W, or its radiance is more than that: all light is {:.3g} times "
                      "that of the file, and so is what is white",
                      preset::power_bounds.high, part));
    for (preset::Light& light : made_.scene.lights) light.power_w *= part, light.irradiance_w_m2 *= part;
    if (made_.scene.environment) {
      made_.scene.environment->radiance *= part;
      made_.scene.environment->sun_scale *= part;
    }
    made_.white = std::clamp(*made_.white * part, 1e-12, 1e12);
  }

  Description& from_;
  std::string folder_;
  preset::Preset made_;
  glm::dmat4 to_preset_{1}; ///< from the file's world, mirrored or turned
  TakenNames names_;
  std::string black_;                        ///< material of what shines; empty: none yet
  std::map<std::string, std::string> plain_; ///< materials without a texture, by those with it
  scene::Bounds bounds_;
  std::size_t details_ = 0;               ///< lights that are pictures' means
  std::set<std::string> used_, textured_; ///< keys of the objects' meshes
};

/// Writes what the description says.
Imported written(Description& description, const fs::path& preset, const Watch& watch) {
  watch.begin(fmt::format("placing {}", counted(description.shapes.size(), "object")));
  const std::string name = preset.stem().string();
  PresetBuilder builder(description, name + "-meshes");
  // What cannot be read again is not written. The other programs follow light from wall to wall, so this one does.
  const preset::Preset made =
      preset::parse_preset(preset::to_json(builder.make(name)), preset.string(), {"spectral.indirect=true"});
  std::erase_if(description.meshes, [&](const auto& mesh) { return !builder.uses(mesh.first); });
  for (auto& [key, mesh] : description.meshes)
    if (!builder.is_textured(key)) mesh.texcoords.clear();

  const fs::path folder = preset.parent_path() / (name + "-meshes");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw failed(folder.string(), "cannot be made: " + error.message(), {}, "choose another folder with -o");
  for (const auto& [key, bytes] : description.files) write_file_whole(folder / key, bytes);
  std::size_t count = 0;
  for (const auto& [key, mesh] : description.meshes) {
    watch.begin(fmt::format("writing mesh {} of {}", ++count, description.meshes.size()));
    write_file_whole(folder / key, [&mesh = mesh](ByteSink& to) { scene::write_ply(mesh, to); });
  }
  if (!made.not_imported.empty())
    write_file_whole(preset.parent_path() / (name + "-not-imported.txt"),
                     fmt::format("{}\n", fmt::join(made.not_imported, "\n")));
  write_file_whole(preset, preset::to_json(made));
  return {preset, made.scene.objects.size(), description.meshes.size(), made.scene.lights.size(),
          std::move(description.notes)};
}

/// What was left out, for a line of an error.
std::string said_before(const std::vector<std::string>& notes) {
  constexpr std::size_t most = 8;
  std::string text = "said before: " + notes[0];
  for (std::size_t i = 1; i < std::min(notes.size(), most); ++i) text += "; " + notes[i];
  if (notes.size() > most) text += fmt::format("; and {} more", notes.size() - most);
  return text;
}

/// Meshes far from their origin are about a middle of their own: from here on it is in the places of their shapes.
void place_middles(Description& description) {
  for (DescribedShape& shape : description.shapes)
    if (!shape.mesh.empty()) shape.to_world = glm::translate(shape.to_world, description.meshes.at(shape.mesh).middle);
  for (auto& [key, mesh] : description.meshes) mesh.middle = glm::dvec3(0);
}

} // namespace

std::string Imported::counts() const {
  return fmt::format("{}, {}, {}", counted(objects, "object"), counted(meshes, "mesh", "meshes"),
                     counted(lights, "light"));
}

std::string Imported::summary() const {
  std::string text = fmt::format("{}: {}", preset.string(), counts());
  for (const std::string& note : notes) text += "; " + note;
  return text;
}

Imported import_scene(const fs::path& file, const fs::path& preset, const Watch& watch) {
  watch.begin("reading " + file.filename().string());
  Description description;
  try {
    describe_file(file, description);
    place_middles(description);
    settle_dielectrics(description);
    return written(description, preset, watch);
  } catch (const Error& error) {
    throw description.notes.empty() ? error : error.noting(said_before(description.notes));
  }
}

} // namespace nephroid::formats
