// SPDX-License-Identifier: Apache-2.0
// What Mitsuba's scenes mean, those of version 3 and 2, and of 0.6 where only names differ. Right-handed; a camera
// looks along its +z axis with +x to the left.
#include "base/error.h"
#include "base/numbers.h"
#include "formats/import/mitsuba_scene.h"
#include "formats/import/serialized.h"
#include "formats/import/textures.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scene/scene.h"
#include "scene/sky.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

constexpr int most_instances_in_each_other = 16;

class Mitsuba {
public:
  Mitsuba(const fs::path& file, Description& into) : scene_{MitsubaFile(file), into} {
    d_.source = file;
    d_.unit =
        optics::to_xyz(optics::constant_spectrum(1))[1]; // spectra are per nanometre: a radiance of 1 is this bright
    for (const xml_node named : file_.nodes()) {
      const xml_node node = file_.meant(named);
      const std::string kind = node.name();
      if (kind == "sensor")
        add_camera(node);
      else if (kind == "shape" && file_.attribute(node, "type") != "shapegroup")
        add_shape(node, glm::dmat4(1), 0);
      else if (kind == "emitter")
        add_light(node);
      else if (kind == "integrator")
        note_integrator(node);
    }
  }

private:
  DescribedColour colour(xml_node parent, const std::string& name, double standard) {
    return mitsuba_colour(scene_, parent, name, standard);
  }

  /// What of it changes the picture.
  void note_integrator(xml_node node) {
    if (file_.flag(node, "hide_emitters"))
      d_.note(file_.at(node), "hide_emitters is left out: lamps and surroundings are seen");
    d_.note_length_of_paths(file_.at(node), "max_depth", file_.number(node, "max_depth", -1));
  }

  void add_camera(xml_node node) {
    const std::string type = file_.attribute(node, "type");
    if (type != "perspective" && type != "thinlens" && type != "orthographic")
      return d_.note(file_.at(node), "the sensor " + type + " is left out");
    if (d_.camera) return d_.note(file_.at(node), "only the first camera is taken: this one is left out");
    DescribedCamera& camera = d_.camera.emplace();
    camera.where = file_.at(node);
    camera.to_world = file_.to_world(node) * glm::scale(glm::dmat4(1), {-1, 1, 1});
    const xml_node film = file_.object(node, "film");
    const double w = std::clamp(file_.number(film, "width", 768), 1.0, 16384.0),
                 h = std::clamp(file_.number(film, "height", 576), 1.0, 16384.0);
    camera.resolution = {static_cast<int>(w), static_cast<int>(h)};
    if (type == "thinlens") {
      camera.lens_radius = std::max(file_.number(node, "aperture_radius", 0), 0.0);
      camera.focus_distance = std::max(file_.number(node, "focus_distance", 1), 0.0);
    }
    if (type == "orthographic") { // its width is 2
      camera.height = 2 * h / w;
      return crop_camera(node, film);
    }
    camera.shift = {file_.number(node, "principal_point_offset_x", 0),
                    0 - file_.number(node, "principal_point_offset_y", 0)};
    for (const char* shift : {"shift_x", "shift_y"})
      if (file_.number(node, shift, 0) != 0) d_.note(file_.at(node), "the picture's shift is left out");
    std::string axis = file_.text(node, "fov_axis", "x");
    double fov = file_.number(node, "fov", 0);
    if (!file_.child(node, "fov")) { // by a film of 36 by 24 mm
      const std::string length = file_.text(node, "focal_length", "50mm");
      const double mm =
          number_in<double>(std::string_view(length).substr(0, length.find_first_not_of("0123456789."))).value_or(50);
      fov = glm::degrees(2 * std::atan(std::hypot(36.0, 24.0) / (2 * std::max(mm, 1e-3))));
      axis = "diagonal";
    }
    const double across = axis == "y"          ? h
                          : axis == "diagonal" ? std::hypot(w, h)
                          : axis == "smaller"  ? std::min(w, h)
                          : axis == "larger"   ? std::max(w, h)
                                               : w;
    camera.fov_deg = vertical_fov_deg(fov, h, across);
    crop_camera(node, film);
  }

  void crop_camera(xml_node node, xml_node film) {
    const glm::dvec2 whole(d_.camera->resolution[0], d_.camera->resolution[1]),
        corner(file_.number(film, "crop_offset_x", 0), file_.number(film, "crop_offset_y", 0)),
        size(file_.number(film, "crop_width", whole.x), file_.number(film, "crop_height", whole.y));
    if (size.x < 1 || size.y < 1 || glm::any(glm::greaterThan(corner + size, whole)) ||
        glm::any(glm::lessThan(corner, glm::dvec2(0))))
      throw bad_input(file_.at(film), "the crop is no part of the picture",
                      fmt::format("expected one within {} x {}", whole.x, whole.y));
    crop(*d_.camera, corner, size);
    note_unasked(scene_, node);
    note_unasked(scene_, film);
  }

  void add_light(xml_node node) {
    const std::string type = file_.attribute(node, "type");
    DescribedLight light;
    light.where = file_.at(node);
    const glm::dmat4 to_world = file_.to_world(node);
    light.position = glm::dvec3(to_world[3]);
    light.direction = glm::dvec3(to_world[2]);
    if (type == "point") {
      light.position = file_.point(node, "position", light.position);
      light.colour = colour(node, "intensity", 1);
    } else if (type == "spot") {
      light.type = preset::Light::Type::spot;
      light.colour = colour(node, "intensity", 1);
      const double cutoff = std::clamp(file_.number(node, "cutoff_angle", 20), 0.01, 90.0);
      const double beam = std::clamp(file_.number(node, "beam_width", cutoff * 0.75), 0.0, cutoff);
      light.half_angle_deg = same_power_half_angle_deg(cutoff, [&](double a) {
        const double degrees = glm::degrees(a);
        return degrees <= beam ? 1.0 : (cutoff - degrees) / (cutoff - beam);
      });
      if (beam < cutoff) d_.note(light.where, "the spot's fading edge is left out: a sharp cone has its power");
      if (file_.child(node, "texture")) d_.note(light.where, "the spot's texture is left out");
    } else if (type == "directional") {
      light.type = preset::Light::Type::directional;
      light.direction = file_.point(node, "direction", light.direction);
      light.colour = colour(node, "irradiance", 1);
    } else if (type == "constant" || type == "envmap") {
      DescribedSurroundings s;
      s.where = light.where;
      if (type == "constant")
        s.colour = linear_srgb_of(colour(node, "radiance", 1));
      else {
        s.file = file_.find(node, file_.text(node, "filename", ""));
        if (!fs::is_regular_file(s.file))
          throw bad_input(light.where, "the picture " + s.file.string() + " is not there");
        s.scale = file_.number(node, "scale", 1);
        require_inverse(to_world, light.where);
        s.to_world = glm::dmat3(to_world);
      }
      d_.surroundings = s;
      return note_unasked(scene_, node);
    } else if (type == "sky" || type == "sun" || type == "sunsky") {
      return add_sky(node, type, glm::dmat3(to_world));
    } else if (type == "area" && node.attribute("id")) {
      return; // shapes refer to it
    } else
      return d_.note(light.where, "the emitter " + type + " is left out");
    note_unasked(scene_, node);
    d_.lights.push_back(light);
  }

  /// The plugins of Mitsuba 3.7 and later. Theirs is the sky of Hosek and Wilkie (2012, 2013) over a z axis that is
  /// up, with -x to the north and -y to the east, turned by to_world. A sun_direction is one of the world.
  void add_sky(xml_node node, const std::string& type, const glm::dmat3& to_world) {
    const auto whole = [&](const char* name, int standard) {
      return static_cast<int>(std::clamp(file_.number(node, name, standard), 0.0, 9999.0));
    };
    preset::Environment sky;
    sky.type = preset::Environment::Type::sky;
    sky.lights = true;
    const double turbidity = file_.number(node, "turbidity", 3);
    sky.turbidity = std::clamp(turbidity, 2.0, 10.0);
    if (sky.turbidity != turbidity)
      d_.note(file_.at(node), fmt::format("a turbidity of {:g} is taken as {:g}", turbidity, sky.turbidity));
    sky.albedo = 0.3;
    if (const xml_node given = file_.child(node, "albedo")) {
      const std::vector<double> albedo = file_.numbers(given);
      if (albedo.size() == 1 || albedo.size() == 3)
        sky.albedo = std::clamp(std::accumulate(albedo.begin(), albedo.end(), 0.0) / double(albedo.size()), 0.0, 1.0);
      else
        d_.note(file_.at(node), "the ground's albedo is taken as 0.3");
    }
    sky.radiance = type == "sun" ? 0 : std::clamp(file_.number(node, "sky_scale", 1), 0.0, 1e6);
    sky.sun_scale = type == "sky" ? 0 : std::clamp(file_.number(node, "sun_scale", 1), 0.0, 1e6);
    glm::dvec3 to_sun;
    if (file_.child(node, "sun_direction"))
      to_sun = file_.point(node, "sun_direction", glm::dvec3(0));
    else {
      const preset::PlaceAndTime place{
          .latitude_deg = std::clamp(file_.number(node, "latitude", 35.6894), -90.0, 90.0),
          .longitude_deg = std::clamp(file_.number(node, "longitude", 139.6917), -180.0, 180.0),
          .date = fmt::format("{:04}-{:02}-{:02}", whole("year", 2010), whole("month", 7), whole("day", 10)),
          .hour = file_.number(node, "hour", 15) + file_.number(node, "minute", 0) / 60 +
                  file_.number(node, "second", 0) / 3600,
          .utc_offset_h = file_.number(node, "timezone", 9)};
      if (!preset::days_since_2000(place.date))
        throw bad_input(file_.at(node), "its date is " + place.date, "expected a day of 1950 to 2050");
      const glm::dvec3 enu = scene::to_sky(scene::sun_place(place)); // east, up, south
      to_sun = to_world * glm::dvec3(enu.z, -enu.x, enu.y);
    }
    const glm::dvec3& up = to_world[2];
    if (!(glm::length(to_sun) > 0) || !(glm::length(up) > 0))
      throw bad_input(file_.at(node), "its sun has no direction");
    if (!(glm::dot(to_sun, up) > 0))
      return d_.note(file_.at(node),
                     "the sun is below the horizon, as up is the z of its to_world: the emitter is left out");
    sky.sun_direction = scene::to_vec3(glm::normalize(to_sun));
    d_.up = glm::normalize(up);
    file_.child(node, "sun_aperture"); // Mitsuba's keeps its irradiance, and so is the sun's own here
    d_.note(file_.at(node), "the sky is Preetham's model in place of Hosek's, with the ground below the horizon; the "
                            "sun has its own width, and its disc is not seen");
    DescribedSurroundings surroundings;
    surroundings.where = file_.at(node);
    surroundings.sky = sky;
    d_.surroundings = surroundings;
    note_unasked(scene_, node);
  }

  /// around: of the instance that it is in.
  void add_shape(xml_node node, const glm::dmat4& around, int depth) {
    if (depth > most_instances_in_each_other) throw bad_input(file_.at(node), "instances go round in a circle");
    if (d_.shapes.size() >= max_shapes) throw bad_input(file_.at(node), "there are too many shapes");
    const std::string type = file_.attribute(node, "type");
    const glm::dmat4 to_world = around * file_.to_world(node);
    if (type == "instance" || type == "merge" || type == "shapegroup") {
      for (const xml_node part : file_.objects(node, "shape")) add_shape(part, to_world, depth + 1);
      return;
    }
    DescribedShape shape;
    shape.where = file_.at(node);
    shape.name = name_of(file_.attribute(node, "id"), type);
    shape.to_world = to_world;
    shape.inside_out = file_.flag(node, "flip_normals");
    if (!give_form(node, type, shape)) return d_.note(shape.where, "the shape " + type + " is left out");
    note_unasked(scene_, node);
    shape.material = mitsuba_material(scene_, node, &shape.back);
    if (const xml_node emitter = file_.object(node, "emitter")) {
      shape.glow = colour(emitter, "radiance", 1);
      note_unasked(scene_, emitter);
    } else if (shape.material.empty())
      return; // light goes on through it
    d_.shapes.push_back(std::move(shape));
  }

  /// False for a type that is not known.
  bool give_form(xml_node node, const std::string& type, DescribedShape& shape) {
    if (type == "obj" || type == "ply" || type == "serialized") {
      const fs::path file = file_.find(node, file_.text(node, "filename", ""));
      shape.smooth = !file_.flag(node, "face_normals"); // where a file has no normals, Mitsuba makes them
      if (type == "serialized")
        take_serialized(file, file_.number(node, "shape_index", 0), shape);
      else
        shape.mesh = d_.mesh_file(file, shape.where);
      // Mitsuba counts v from the top, and turns that of OBJ files round unless they say otherwise.
      const bool is_turned = file_.text(node, "flip_tex_coords", type == "obj" ? "true" : "false") == "true";
      if (!is_turned && turned_.insert(shape.mesh).second) turn_upside_down(d_.meshes.at(shape.mesh));
      if (file_.child(node, "max_smooth_angle") && !d_.meshes.at(shape.mesh).normals.empty())
        d_.note(shape.where, "the greatest angle that is smoothed is left out: the mesh has normals of its own");
      shape.crease_deg = std::clamp(file_.number(node, "max_smooth_angle", 180), 0.0, 180.0);
    } else if (type == "sphere") {
      shape.to_world = glm::translate(shape.to_world, file_.point(node, "center", glm::dvec3(0)));
      shape.radius = file_.number(node, "radius", 1);
      if (!(shape.radius > 0)) throw bad_input(shape.where, "its radius is not above 0");
    } else if (type == "rectangle") {
      shape.mesh = own(type, [] {
        return polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
      });
    } else if (type == "cube") {
      shape.mesh = own(type, cube);
    } else if (type == "disk") {
      shape.mesh = own(type, [] { return disk(1); });
    } else if (type == "cylinder") {
      const glm::dvec3 from = file_.point(node, "p0", glm::dvec3(0)), to = file_.point(node, "p1", glm::dvec3(0, 0, 1));
      const double radius = file_.number(node, "radius", 1);
      if (from == to || !(radius > 0)) throw bad_input(shape.where, "the cylinder has no size");
      shape.mesh = d_.own_mesh(shape.name, open_cylinder(from, to, radius));
    } else
      return false;
    return true;
  }

  void take_serialized(const fs::path& file, double index, DescribedShape& shape) {
    const auto [known, is_new] = serialized_.try_emplace({file, index});
    auto& [key, faceted] = known->second;
    if (is_new) {
      SerializedMesh read = read_serialized(file, index, shape.where);
      key = d_.own_mesh(fmt::format("{}-{}", file.stem().string(), index), std::move(read.mesh));
      faceted = read.faceted;
    }
    shape.mesh = key;
    if (faceted) shape.smooth = false;
  }

  /// A mesh that all shapes of this type share.
  template <class Make>
  std::string own(const std::string& type, const Make& make) {
    std::string& key = own_[type];
    if (key.empty()) key = d_.own_mesh(type, make());
    return key;
  }

  MitsubaScene scene_;
  const MitsubaFile& file_ = scene_.file;
  Description& d_ = scene_.d;
  std::map<std::string, std::string> own_;
  std::set<std::string> turned_; ///< meshes whose v counts from the lower edge by now
  std::map<std::pair<fs::path, double>, std::pair<std::string, bool>> serialized_; ///< keys, and whether faceted
};

} // namespace

void describe_mitsuba(const fs::path& file, Description& into) { Mitsuba(file, into); }

} // namespace nephroid::formats
