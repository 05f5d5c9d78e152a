// SPDX-License-Identifier: Apache-2.0
// Mitsuba's scenes: XML of version 3 and 2, and of 0.6 where only names differ ("toWorld" is read as "to_world").
// Right-handed; a camera looks along its +z axis with +x to the left.
#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "formats/import/description.h"
#include "formats/import/gltf_scene.h"
#include "formats/import/mitsuba_names.h"
#include "optics/colour.h"
#include "optics/spectrum.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <list>
#include <sstream>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

using pugi::xml_node;
constexpr int max_files = 100;
class Mitsuba {
public:
  explicit Mitsuba(const fs::path& file) {
    d_.source = file;
    d_.unit =
        optics::to_xyz(optics::constant_spectrum(1))[1]; // spectra are per nanometre: a radiance of 1 is this bright
    read_all(load(file));
  }
  Description take() { return std::move(d_); }

private:
  struct Document {
    fs::path file;
    std::string text;
    pugi::xml_document xml;
  };

  xml_node load(const fs::path& file) {
    if (documents_.size() >= max_files) throw bad_input(file.string(), "is included too often, perhaps by itself");
    Document& document = documents_.emplace_back();
    document.file = file;
    document.text = read_file(file);
    const auto result = document.xml.load_buffer(document.text.data(), document.text.size());
    if (!result)
      throw bad_input(Place(file.string(), line_of(document, result.offset)),
                      std::string("its XML is broken: ") + result.description(), "expected a Mitsuba scene",
                      "check that the file is whole");
    const xml_node scene = document.xml.child("scene");
    if (!scene) throw bad_input(file.string(), "is no Mitsuba scene: it has no <scene>", "expected a Mitsuba scene");
    return scene;
  }

  static std::size_t line_of(const Document& document, std::ptrdiff_t offset) {
    const auto end = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    const std::string before = document.text.substr(0, end);
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  }

  const Document& document_of(xml_node node) const {
    for (const Document& document : documents_)
      if (document.xml.root() == node.root()) return document;
    return documents_.front();
  }
  Place at(xml_node node) const {
    const Document& document = document_of(node);
    return {document.file.string(), line_of(document, node.offset_debug())};
  }
  fs::path beside(xml_node node, const std::string& file) const { return document_of(node).file.parent_path() / file; }

  /// An attribute with its $names replaced.
  std::string attribute(xml_node node, const char* key) const {
    std::string text = node.attribute(key).value();
    for (std::size_t from = text.find('$'); from != std::string::npos; from = text.find('$', from)) {
      std::size_t to = from + 1;
      while (to < text.size() && (std::isalnum(static_cast<unsigned char>(text[to])) || text[to] == '_')) ++to;
      const auto found = defaults_.find(text.substr(from + 1, to - from - 1));
      if (found == defaults_.end())
        throw bad_input(at(node), text.substr(from, to - from) + " has no value", "expected a <default>");
      text.replace(from, to - from, found->second);
      from += found->second.size();
    }
    return text;
  }

  std::vector<double> numbers(xml_node node, const char* key) const {
    std::string text = attribute(node, key);
    std::ranges::replace(text, ',', ' ');
    std::vector<double> values;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      const auto value = typed_number<double>(word);
      if (!value || !(std::abs(*value) <= 1e12))
        throw bad_input(at(node), fmt::format("\"{}\" is no number", text), "expected numbers");
      values.push_back(*value);
    }
    return values;
  }
  double number_of(xml_node node, const char* key, double standard) const {
    if (!node.attribute(key)) return standard;
    const auto values = numbers(node, key);
    if (values.size() != 1)
      throw bad_input(at(node), std::string("\"") + key + "\" is no number", "expected one number");
    return values[0];
  }
  glm::dvec3 vector_of(xml_node node, const char* key, double standard) const {
    if (!node.attribute(key))
      return {number_of(node, "x", standard), number_of(node, "y", standard), number_of(node, "z", standard)};
    const auto v = numbers(node, key);
    if (v.size() == 1) return glm::dvec3(v[0]);
    if (v.size() != 3) throw bad_input(at(node), fmt::format("\"{}\" has {} numbers", key, v.size()), "expected three");
    return {v[0], v[1], v[2]};
  }

  xml_node child(xml_node parent, const std::string& name) const {
    for (const xml_node node : parent.children())
      if (mitsuba_name(node.attribute("name").value()) == name) return node;
    return {};
  }
  double number(xml_node parent, const std::string& name, double standard) const {
    return number_of(child(parent, name), "value", standard);
  }
  std::string text(xml_node parent, const std::string& name, const std::string& standard) const {
    const xml_node node = child(parent, name);
    return node ? attribute(node, "value") : standard;
  }
  glm::dvec3 point(xml_node parent, const std::string& name, const glm::dvec3& standard) const {
    const xml_node node = child(parent, name);
    return node ? vector_of(node, "value", 0) : standard;
  }

  glm::dvec3 colour(xml_node parent, const std::string& name, const glm::dvec3& standard) {
    const xml_node node = child(parent, name);
    if (!node) return standard;
    const std::string kind = node.name();
    if (kind == "rgb" || kind == "float") return vector_of(node, "value", 0);
    if (kind == "spectrum" && node.attribute("value") && attribute(node, "value").find(':') == std::string::npos)
      return vector_of(node, "value", 0);
    d_.note(at(node), fmt::format("this {} is left out: {:.3g} {:.3g} {:.3g} takes its place", kind, standard.x,
                                  standard.y, standard.z));
    return standard;
  }

  glm::dmat4 matrix(xml_node parent) const {
    glm::dmat4 all(1);
    for (const xml_node step : child(parent, "to_world").children()) {
      const std::string kind = mitsuba_name(step.name());
      glm::dmat4 m(1);
      if (kind == "translate")
        m = glm::translate(m, vector_of(step, "value", 0));
      else if (kind == "scale")
        m = glm::scale(m, vector_of(step, "value", 1));
      else if (kind == "rotate") {
        const glm::dvec3 axis = vector_of(step, "value", 0);
        if (!(glm::length(axis) > 0)) throw bad_input(at(step), "the axis has no direction");
        m = glm::rotate(m, glm::radians(number_of(step, "angle", 0)), axis);
      } else if (kind == "matrix") {
        const auto v = numbers(step, "value");
        if (v.size() == 16)
          m = glm::transpose(glm::make_mat4(v.data()));
        else if (v.size() == 9)
          m = glm::dmat4(glm::transpose(glm::make_mat3(v.data())));
        else
          throw bad_input(at(step), fmt::format("the matrix has {} numbers", v.size()), "expected 16 or 9");
      } else if (kind == "lookat" || kind == "look_at") {
        const glm::dvec3 origin = vector_of(step, "origin", 0), way = vector_of(step, "target", 0) - origin;
        const glm::dvec3 left = glm::cross(step.attribute("up") ? vector_of(step, "up", 0) : glm::dvec3(0, 1, 0), way);
        if (!(glm::length(left) > 0)) throw bad_input(at(step), "looks nowhere, or up is the way it looks");
        const glm::dvec3 z = glm::normalize(way), x = glm::normalize(left);
        m = {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
      } else if (step.type() == pugi::node_element)
        throw bad_input(at(step), "<" + kind + "> is no transform",
                        "expected translate, rotate, scale, matrix or lookat");
      all = m * all;
    }
    return all;
  }

  void read_all(xml_node scene) {
    for (const xml_node node : scene.children()) {
      const std::string kind = node.name();
      if (node.attribute("id")) ids_[attribute(node, "id")] = node;
      if (kind == "default")
        defaults_.try_emplace(node.attribute("name").value(), attribute(node, "value"));
      else if (kind == "include")
        read_all(load(beside(node, attribute(node, "filename"))));
      if (kind == "sensor")
        add_camera(node);
      else if (kind == "shape")
        add_shape(node);
      else if (kind == "emitter")
        add_light(node);
      else if (kind == "medium" || kind == "volume")
        d_.note(at(node), "a " + kind + " is left out: there is clear space in its place");
    }
  }

  void add_camera(xml_node node) {
    const std::string type = attribute(node, "type");
    if (type != "perspective" && type != "thinlens") return d_.note(at(node), "the sensor " + type + " is left out");
    if (d_.camera) return d_.note(at(node), "only the first camera is taken: this one is left out");
    if (type == "thinlens") d_.note(at(node), "the lens is left out: everything is sharp");
    DescribedCamera& camera = d_.camera.emplace();
    camera.to_world = matrix(node) * glm::scale(glm::dmat4(1), {-1, 1, 1});
    const xml_node film = node.child("film");
    const double w = std::clamp(number(film, "width", 768), 1.0, 16384.0),
                 h = std::clamp(number(film, "height", 576), 1.0, 16384.0);
    camera.resolution = {static_cast<int>(w), static_cast<int>(h)};
    if (child(film, "crop_width")) d_.note(at(film), "the crop is left out: the whole picture is taken");
    std::string axis = text(node, "fov_axis", "x");
    double fov = number(node, "fov", 0);
    if (!child(node, "fov")) { // of a film of 36 by 24 mm
      const std::string length = text(node, "focal_length", "50mm");
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
    camera.fov_deg =
        glm::degrees(2 * std::atan(std::tan(glm::radians(std::clamp(fov, 0.001, 179.0)) / 2) * h / across));
  }

  void add_light(xml_node node) {
    const std::string type = attribute(node, "type");
    DescribedLight light;
    light.where = at(node);
    const glm::dmat4 to_world = matrix(node);
    light.position = glm::dvec3(to_world[3]);
    light.direction = glm::dvec3(to_world[2]);
    if (type == "point") {
      light.position = point(node, "position", light.position);
      light.colour = colour(node, "intensity", glm::dvec3(1));
    } else if (type == "spot") {
      light.type = preset::Light::Type::spot;
      light.colour = colour(node, "intensity", glm::dvec3(1));
      const double cutoff = std::clamp(number(node, "cutoff_angle", 20), 0.01, 90.0);
      const double beam = std::clamp(number(node, "beam_width", cutoff * 0.75), 0.0, cutoff);
      light.half_angle_deg = same_power_half_angle_deg(cutoff, [&](double a) {
        const double degrees = glm::degrees(a);
        return degrees <= beam ? 1.0 : (cutoff - degrees) / (cutoff - beam);
      });
      if (beam < cutoff) d_.note(light.where, "the spot's fading edge is left out: a sharp cone has its power");
      if (child(node, "texture")) d_.note(light.where, "the spot's texture is left out");
    } else if (type == "directional") {
      light.type = preset::Light::Type::directional;
      light.direction = point(node, "direction", light.direction);
      light.colour = colour(node, "irradiance", glm::dvec3(1));
    } else if (type == "constant" || type == "envmap") {
      DescribedSurroundings s;
      s.where = light.where;
      if (type == "constant")
        s.colour = colour(node, "radiance", glm::dvec3(1));
      else {
        s.file = beside(node, text(node, "filename", ""));
        if (!fs::is_regular_file(s.file))
          throw bad_input(light.where, "the picture " + s.file.string() + " is not there");
        s.scale = number(node, "scale", 1);
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
      if (const auto found = ids_.find(attribute(ref, "id")); found != ids_.end()) {
        if (std::string(found->second.name()) == "bsdf") return found->second;
      } else if (depth == 0)
        throw bad_input(at(ref), "there is no \"" + attribute(ref, "id") + "\" above it");
    return {};
  }

  std::string material(xml_node shape) {
    xml_node node = bsdf_of(shape);
    for (int depth = 0; node; ++depth) {
      const std::string type = mitsuba_name(attribute(node, "type"));
      if (type != "twosided" && type != "bumpmap" && type != "normalmap" && type != "mask" && type != "blendbsdf")
        break;
      if (type != "twosided") d_.note(at(node), "the " + type + " is left out: the material in it is taken");
      if (depth > 16) throw bad_input(at(node), "materials go round in a circle");
      node = bsdf_of(node, 1);
    }
    const std::string id = node ? attribute(node, "id") : std::string();
    const std::string key = !node ? "plain" : name_of(id, fmt::format("material {}", at(node).line));
    if (d_.materials.contains(key)) return key;
    preset::Material& made = d_.materials[key];
    made.reflectance.value = 0.5;
    if (!node) return key;
    const std::string type = mitsuba_name(attribute(node, "type"));
    const auto reflect = [&](const char* name, double standard) {
      const glm::dvec3 c = colour(node, name, glm::dvec3(standard));
      made.reflectance = reflectance_of({c.x, c.y, c.z});
    };
    if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric") {
      made.type = preset::Material::Type::dielectric;
      made.dispersion.n = ior(node, "int_ior", "bk7") / ior(node, "ext_ior", "air");
      if (made.dispersion.n < 0.01 || made.dispersion.n > 100)
        throw bad_input(at(node), "its index of refraction is out of range");
      if (type != "dielectric") d_.note(at(node), "a film or roughness is left out: the glass is solid and polished");
    } else if (type == "conductor" || type == "roughconductor") {
      made.type = preset::Material::Type::mirror;
      reflect("specular_reflectance", 1);
      if (child(node, "material") ? text(node, "material", "") != "none" : bool(child(node, "eta")))
        d_.note(at(node), "the metal is left out: a mirror of its specular_reflectance takes its place");
      if (type == "roughconductor") d_.note(at(node), "roughness is left out: the mirror is polished");
    } else if (type == "diffuse") {
      reflect("reflectance", 0.5);
    } else {
      reflect(type == "principled" ? "base_color" : "diffuse_reflectance", 0.5);
      d_.note(at(node), "the bsdf " + type + " is left out: a matt surface of its colour takes its place");
    }
    return key;
  }

  double ior(xml_node node, const char* name, const char* standard) const {
    const xml_node given = child(node, name);
    const std::string value = given ? attribute(given, "value") : standard;
    if (const auto known = mitsuba_iors().find(value); known != mitsuba_iors().end()) return known->second;
    if (const double n = number_of(given, "value", 1); n > 0) return n;
    throw bad_input(at(given), "an index of refraction is above 0");
  }

  void add_shape(xml_node node) {
    const std::string type = attribute(node, "type");
    DescribedShape shape;
    shape.where = at(node);
    shape.name = name_of(attribute(node, "id"), type);
    shape.to_world = matrix(node);
    if (type == "obj" || type == "ply")
      shape.mesh = d_.mesh_file(beside(node, text(node, "filename", "")), shape.where);
    else if (type == "sphere") {
      shape.to_world = glm::translate(shape.to_world, point(node, "center", glm::dvec3(0)));
      shape.radius = number(node, "radius", 1);
      if (!(shape.radius > 0)) throw bad_input(shape.where, "its radius is not above 0");
    } else if (type == "rectangle")
      shape.mesh = d_.own_mesh(shape.name, polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}));
    else if (type == "cube")
      shape.mesh = d_.own_mesh(shape.name, cube());
    else if (type == "disk")
      shape.mesh = d_.own_mesh(shape.name, disk(1));
    else if (type == "cylinder") {
      const glm::dvec3 from = point(node, "p0", glm::dvec3(0)), to = point(node, "p1", glm::dvec3(0, 0, 1));
      const double radius = number(node, "radius", 1);
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

  Description d_;
  std::list<Document> documents_;
  std::map<std::string, std::string> defaults_;
  std::map<std::string, xml_node> ids_;
};

} // namespace

Description read_mitsuba(const fs::path& file) { return Mitsuba(file).take(); }

} // namespace nephroid::formats
