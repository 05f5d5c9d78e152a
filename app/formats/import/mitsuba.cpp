// SPDX-License-Identifier: Apache-2.0
// What Mitsuba's scenes mean, those of version 3 and 2, and of 0.6 where only names differ. Right-handed; a camera
// looks along its +z axis with +x to the left.
#include "base/error.h"
#include "base/numbers.h"
#include "formats/import/description.h"
#include "formats/import/gltf_scene.h"
#include "formats/import/mitsuba_file.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

/// Mitsuba's own figures of the indices of refraction that it names.
const std::map<std::string, double> iors{{"vacuum", 1},
                                         {"air", 1.000277},
                                         {"water", 1.3330},
                                         {"water ice", 1.31},
                                         {"fused quartz", 1.458},
                                         {"pyrex", 1.470},
                                         {"acrylic glass", 1.49},
                                         {"polypropylene", 1.49},
                                         {"bk7", 1.5046},
                                         {"sodium chloride", 1.544},
                                         {"amber", 1.55},
                                         {"pet", 1.5750},
                                         {"diamond", 2.419},
                                         {"acetone", 1.36},
                                         {"ethanol", 1.361},
                                         {"benzene", 1.501},
                                         {"silicone oil", 1.52045},
                                         {"glycerol", 1.4729},
                                         {"hydrogen", 1.000132},
                                         {"helium", 1.000036},
                                         {"carbon dioxide", 1.00045},
                                         {"bromine", 1.661},
                                         {"carbon tetrachloride", 1.461}};

class Mitsuba {
public:
  explicit Mitsuba(const fs::path& file) {
    d_.source = file;
    d_.unit =
        optics::to_xyz(optics::constant_spectrum(1))[1]; // spectra are per nanometre: a radiance of 1 is this bright
    read_all(file_.load(file));
  }
  Description take() { return std::move(d_); }

private:
  glm::dvec3 colour(xml_node parent, const std::string& name, const glm::dvec3& standard) {
    const xml_node node = file_.child(parent, name);
    if (!node) return standard;
    const std::string kind = node.name();
    if (kind == "rgb" || kind == "float") return file_.vector_of(node, 0);
    if (kind == "spectrum" && node.attribute("value") && file_.attribute(node, "value").find(':') == std::string::npos)
      return file_.vector_of(node, 0);
    d_.note(file_.at(node), fmt::format("this {} is left out: {:.3g} {:.3g} {:.3g} takes its place", kind, standard.x,
                                        standard.y, standard.z));
    return standard;
  }

  void read_all(xml_node scene) {
    for (const xml_node node : scene.children()) {
      const std::string kind = node.name();
      if (node.attribute("id")) ids_[file_.attribute(node, "id")] = node;
      if (kind == "default")
        file_.set_default(node);
      else if (kind == "include")
        read_all(file_.load(file_.beside(node, file_.attribute(node, "filename"))));
      if (kind == "sensor")
        add_camera(node);
      else if (kind == "shape")
        add_shape(node);
      else if (kind == "emitter")
        add_light(node);
      else if (kind == "medium" || kind == "volume")
        d_.note(file_.at(node), "a " + kind + " is left out: there is clear space in its place");
    }
  }

  void add_camera(xml_node node) {
    const std::string type = file_.attribute(node, "type");
    if (type != "perspective" && type != "thinlens")
      return d_.note(file_.at(node), "the sensor " + type + " is left out");
    if (d_.camera) return d_.note(file_.at(node), "only the first camera is taken: this one is left out");
    if (type == "thinlens") d_.note(file_.at(node), "the lens is left out: everything is sharp");
    DescribedCamera& camera = d_.camera.emplace();
    camera.where = file_.at(node);
    camera.to_world = file_.to_world(node) * glm::scale(glm::dmat4(1), {-1, 1, 1});
    const xml_node film = node.child("film");
    const double w = std::clamp(file_.number(film, "width", 768), 1.0, 16384.0),
                 h = std::clamp(file_.number(film, "height", 576), 1.0, 16384.0);
    camera.resolution = {static_cast<int>(w), static_cast<int>(h)};
    if (file_.child(film, "crop_width")) d_.note(file_.at(film), "the crop is left out: the whole picture is taken");
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
      light.colour = colour(node, "intensity", glm::dvec3(1));
    } else if (type == "spot") {
      light.type = preset::Light::Type::spot;
      light.colour = colour(node, "intensity", glm::dvec3(1));
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
      light.colour = colour(node, "irradiance", glm::dvec3(1));
    } else if (type == "constant" || type == "envmap") {
      DescribedSurroundings s;
      s.where = light.where;
      if (type == "constant")
        s.colour = colour(node, "radiance", glm::dvec3(1));
      else {
        s.file = file_.beside(node, file_.text(node, "filename", ""));
        if (!fs::is_regular_file(s.file))
          throw bad_input(light.where, "the picture " + s.file.string() + " is not there");
        s.scale = file_.number(node, "scale", 1);
        s.centre = light.direction;
        if (glm::normalize(glm::dvec3(to_world[1])).y < 1 - 1e-6)
          d_.note(light.where, "the surroundings' tilt is left out: they turn about +y alone");
      }
      d_.surroundings = s;
      return;
    } else
      return d_.note(light.where, "the emitter " + type + " is left out");
    d_.lights.push_back(light);
  }

  /// The named or nested material of a shape.
  xml_node bsdf_of(xml_node node, int depth = 0) const {
    if (const xml_node own = node.child("bsdf")) return own;
    for (const xml_node ref : node.children("ref"))
      if (const auto found = ids_.find(file_.attribute(ref, "id")); found != ids_.end()) {
        if (std::string(found->second.name()) == "bsdf") return found->second;
      } else if (depth == 0)
        throw bad_input(file_.at(ref), "there is no \"" + file_.attribute(ref, "id") + "\" above it");
    return {};
  }

  std::string material(xml_node shape) {
    xml_node node = bsdf_of(shape);
    for (int depth = 0; node; ++depth) {
      const std::string type = mitsuba_name(file_.attribute(node, "type"));
      if (type != "twosided" && type != "bumpmap" && type != "normalmap" && type != "mask" && type != "blendbsdf")
        break;
      if (type != "twosided") d_.note(file_.at(node), "the " + type + " is left out: the material in it is taken");
      if (depth > 16) throw bad_input(file_.at(node), "materials go round in a circle");
      node = bsdf_of(node, 1);
    }
    const std::string id = node ? file_.attribute(node, "id") : std::string();
    const std::string key = !node ? "plain" : name_of(id, fmt::format("material {}", file_.at(node).line));
    if (!d_.materials.contains(key)) d_.materials[key] = node ? material_of(node) : matt(glm::dvec3(0.5));
    return key;
  }

  static preset::Material matt(const glm::dvec3& colour) {
    preset::Material made;
    made.reflectance = reflectance_of(scene::to_vec3(colour));
    return made;
  }

  preset::Material material_of(xml_node node) {
    const std::string type = mitsuba_name(file_.attribute(node, "type"));
    const Location where = file_.at(node);
    if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric") {
      if (type != "dielectric") d_.note(where, "a film or roughness is left out: the glass is solid and polished");
      return glass_of(ior(node, "int_ior", "bk7") / ior(node, "ext_ior", "air"), where);
    }
    if (type == "conductor" || type == "roughconductor") {
      preset::Material mirror = matt(colour(node, "specular_reflectance", glm::dvec3(1)));
      mirror.type = preset::Material::Type::mirror;
      if (file_.child(node, "material") ? file_.text(node, "material", "") != "none" : bool(file_.child(node, "eta")))
        d_.note(where, "the metal is left out: a mirror of its specular_reflectance takes its place");
      if (type == "roughconductor") d_.note(where, "roughness is left out: the mirror is polished");
      return mirror;
    }
    const char* const name = type == "diffuse"      ? "reflectance"
                             : type == "principled" ? "base_color"
                                                    : "diffuse_reflectance";
    const preset::Material made = matt(colour(node, name, glm::dvec3(0.5)));
    if (type != "diffuse")
      d_.note(where, "the bsdf " + type + " is left out: a matt surface of its colour takes its place");
    return made;
  }

  double ior(xml_node node, const char* name, const char* standard) const {
    const xml_node given = file_.child(node, name);
    const std::string value = given ? file_.attribute(given, "value") : standard;
    if (const auto known = iors.find(value); known != iors.end()) return known->second;
    if (const double n = file_.number_of(given, 1); n > 0) return n;
    throw bad_input(file_.at(given), "an index of refraction is above 0");
  }

  void add_shape(xml_node node) {
    const std::string type = file_.attribute(node, "type");
    DescribedShape shape;
    shape.where = file_.at(node);
    shape.name = name_of(file_.attribute(node, "id"), type);
    shape.to_world = file_.to_world(node);
    if (type == "obj" || type == "ply")
      shape.mesh = d_.mesh_file(file_.beside(node, file_.text(node, "filename", "")), shape.where);
    else if (type == "sphere") {
      shape.to_world = glm::translate(shape.to_world, file_.point(node, "center", glm::dvec3(0)));
      shape.radius = file_.number(node, "radius", 1);
      if (!(shape.radius > 0)) throw bad_input(shape.where, "its radius is not above 0");
    } else if (type == "rectangle")
      shape.mesh = d_.own_mesh(shape.name, polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}));
    else if (type == "cube")
      shape.mesh = d_.own_mesh(shape.name, cube());
    else if (type == "disk")
      shape.mesh = d_.own_mesh(shape.name, disk(1));
    else if (type == "cylinder") {
      const glm::dvec3 from = file_.point(node, "p0", glm::dvec3(0)), to = file_.point(node, "p1", glm::dvec3(0, 0, 1));
      const double radius = file_.number(node, "radius", 1);
      if (from == to || !(radius > 0)) throw bad_input(shape.where, "the cylinder has no size");
      shape.mesh = d_.own_mesh(shape.name, open_cylinder(from, to, radius));
    } else
      return d_.note(shape.where, "the shape " + type + " is left out");
    if (node.child("medium")) d_.note(shape.where, "the medium in it is left out: the glass is clear");
    if (const xml_node emitter = node.child("emitter"))
      shape.glow = colour(emitter, "radiance", glm::dvec3(1));
    else
      shape.material = material(node);
    d_.shapes.push_back(std::move(shape));
  }

  MitsubaFile file_;
  Description d_;
  std::map<std::string, xml_node> ids_;
};

} // namespace

Description describe_mitsuba(const fs::path& file) { return Mitsuba(file).take(); }

} // namespace nephroid::formats
