// SPDX-License-Identifier: Apache-2.0
// PBRT's scenes of version 4, and of 3 where only names differ. A camera has +x to the right and looks along +z, so
// coordinates are left-handed unless the file mirrors them.
#include "base/error.h"
#include "formats/import/description.h"
#include "formats/import/gltf_scene.h"
#include "formats/import/pbrt_mesh.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

using std::numbers::pi;

constexpr std::size_t max_shapes = 1000000; ///< instances of instances multiply

/// What is done without: it says how to render, not what.
const std::set<std::string> about_rendering{"Sampler",     "Integrator",  "SurfaceIntegrator", "VolumeIntegrator",
                                            "PixelFilter", "Accelerator", "Renderer",          "ColorSpace",
                                            "Option",      "Attribute"};
/// n at 587.6 nm, of the named_glasses that PBRT names.
const std::map<std::string, double> named_glasses{
    {"glass-BK7", 1.5168}, {"glass-BAF10", 1.6700}, {"glass-FK51A", 1.4866}, {"glass-LASF9", 1.8503},
    {"glass-F5", 1.6034},  {"glass-SF5", 1.6727},   {"glass-SF10", 1.7283},  {"glass-SF11", 1.7847}};

struct State {
  glm::dmat4 to_world{1};
  std::string material = "plain";
  std::optional<glm::dvec3> glow;
  bool reversed = false;
};

class Pbrt {
public:
  explicit Pbrt(const fs::path& file) : tokens_(pbrt_tokens(file)) {
    d_.source = file;
    d_.materials["plain"].reflectance.value = 0.5;
    while (next_ < tokens_.size()) directive();
    if (!stack_.empty()) throw bad_input(file.string(), "an AttributeBegin has no end", "expected AttributeEnd");
  }
  Description take() { return std::move(d_); }

private:
  const PbrtToken& token(const Place& where) {
    if (next_ >= tokens_.size())
      throw bad_input(where, "the file ends here", "expected more", "check that the file is whole");
    return tokens_[next_++];
  }
  std::string string(const Place& where) {
    const PbrtToken& t = token(where);
    if (!t.quoted) throw bad_input(t.where, "\"" + t.text + "\" is no string", "expected a text in quotes");
    return t.text;
  }
  std::vector<double> numbers(const Place& where, std::size_t count) {
    PbrtParameter list{{}, "the transform", {}, where};
    const bool bracket = next_ < tokens_.size() && tokens_[next_].text == "[";
    if (bracket) ++next_;
    while (list.values.size() < count) list.values.push_back(token(where).text);
    if (bracket && token(where).text != "]")
      throw bad_input(where, "has too many numbers", fmt::format("expected {}", count));
    return list.numbers();
  }

  PbrtParameters parameters(const Place& where) {
    PbrtParameters result{{}, where};
    while (next_ < tokens_.size() && tokens_[next_].quoted) {
      const PbrtToken& declared = tokens_[next_++];
      const std::size_t space = declared.text.find_first_of(" \t"),
                        name = declared.text.find_first_not_of(" \t", space);
      if (space == std::string::npos || name == std::string::npos)
        throw bad_input(declared.where, "\"" + declared.text + "\" is no parameter", "expected \"type name\"");
      PbrtParameter p{declared.text.substr(0, space), declared.text.substr(name), {}, declared.where};
      p.name.erase(p.name.find_last_not_of(" \t") + 1);
      if (const PbrtToken& first = token(declared.where); first.quoted || first.text != "[")
        p.values.push_back(first.text);
      else
        while (true) {
          const PbrtToken& value = token(declared.where);
          if (!value.quoted && value.text == "]") break;
          p.values.push_back(value.text);
        }
      result.all.push_back(std::move(p));
    }
    return result;
  }

  void directive() {
    const PbrtToken& head = tokens_[next_++];
    const std::string& word = head.text;
    const Place& where = head.where;
    glm::dmat4& m = state_.to_world;
    if (head.quoted) throw bad_input(where, "\"" + word + "\" is no directive", "expected a word such as Shape");
    if (word == "WorldBegin") {
      m = glm::dmat4(1);
    } else if (word == "AttributeBegin" || word == "TransformBegin" || word == "ObjectBegin") {
      stack_.push_back({state_, word});
      if (word == "ObjectBegin") {
        if (object_) throw bad_input(where, "an object is within another", "expected ObjectEnd before it");
        object_ = &objects_[string(where)];
      }
    } else if (word == "AttributeEnd" || word == "TransformEnd" || word == "ObjectEnd") {
      const std::string begin = word.substr(0, word.size() - 3) + "Begin";
      if (stack_.empty() || stack_.back().second != begin)
        throw bad_input(where, word + " has no " + begin + " before it");
      if (word == "TransformEnd")
        m = stack_.back().first.to_world;
      else
        state_ = stack_.back().first;
      stack_.pop_back();
      if (word == "ObjectEnd") object_ = nullptr;
    } else if (word == "WorldEnd" || word == "Identity") {
      if (word == "Identity") m = glm::dmat4(1);
    } else if (word == "Translate" || word == "Scale") {
      const auto v = numbers(where, 3);
      const glm::dvec3 by(v[0], v[1], v[2]);
      m = word == "Scale" ? glm::scale(m, by) : glm::translate(m, by);
    } else if (word == "Rotate") {
      const auto v = numbers(where, 4);
      if (v[1] == 0 && v[2] == 0 && v[3] == 0) throw bad_input(where, "the axis has no direction");
      m = glm::rotate(m, glm::radians(v[0]), glm::dvec3(v[1], v[2], v[3]));
    } else if (word == "LookAt") {
      const auto v = numbers(where, 9);
      const glm::dvec3 eye(v[0], v[1], v[2]), way = glm::dvec3(v[3], v[4], v[5]) - eye,
                                              right = glm::cross(glm::dvec3(v[6], v[7], v[8]), way);
      if (!(glm::length(right) > 0)) throw bad_input(where, "looks nowhere, or up is the way it looks");
      const glm::dvec3 z = glm::normalize(way), x = glm::normalize(right);
      m = m * glm::inverse(
                  glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(eye, 1)));
    } else if (word == "Transform" || word == "ConcatTransform") {
      const auto v = numbers(where, 16);
      m = word == "Transform" ? glm::make_mat4(v.data()) : m * glm::make_mat4(v.data());
    } else if (word == "CoordinateSystem") {
      systems_[string(where)] = m;
    } else if (word == "CoordSysTransform") {
      if (const auto found = systems_.find(string(where)); found != systems_.end()) m = found->second;
    } else if (word == "ReverseOrientation") {
      state_.reversed = !state_.reversed;
    } else if (word == "ActiveTransform" || word == "TransformTimes") {
      if (word == "TransformTimes")
        numbers(where, 2);
      else
        token(where);
      d_.note(where, "motion is left out: everything stands still");
    } else if (word == "ObjectInstance") {
      instance(string(where), where);
    } else if (word == "NamedMaterial") {
      state_.material = name_of(string(where), "material");
      if (!d_.materials.contains(state_.material))
        throw bad_input(where, "there is no material \"" + state_.material + "\" above it");
    } else if (word == "MediumInterface") {
      while (next_ < tokens_.size() && tokens_[next_].quoted) ++next_;
      d_.note(where, "media are left out: there is clear space in their place");
    } else if (word == "Texture") {
      const std::string name = string(where), value = string(where), kind = string(where);
      const PbrtParameters p = parameters(where);
      if (kind == "constant" && p.find("value")) textures_[name] = *p.find("value");
    } else
      typed(word, where);
  }

  void typed(const std::string& word, const Place& where) {
    if (!about_rendering.contains(word) && word != "Film" && word != "Camera" && word != "Material" &&
        word != "MakeNamedMaterial" && word != "LightSource" && word != "AreaLightSource" && word != "Shape" &&
        word != "MakeNamedMedium")
      throw bad_input(where, word + " is no directive of PBRT", "expected a word such as Shape");
    const std::string type = string(where);
    const PbrtParameters p = parameters(where);
    if (word == "Film") {
      resolution_ = {static_cast<int>(std::clamp(p.number("xresolution", 1280), 1.0, 16384.0)),
                     static_cast<int>(std::clamp(p.number("yresolution", 720), 1.0, 16384.0))};
      if (d_.camera) frame();
    } else if (word == "Camera")
      add_camera(type, p);
    else if (word == "Material")
      state_.material = add_material(fmt::format("material {}", ++materials_), type, p);
    else if (word == "MakeNamedMaterial")
      add_material(name_of(type, "material"), p.text("type", "diffuse"), p);
    else if (word == "LightSource")
      add_light(type, p);
    else if (word == "AreaLightSource") {
      state_.glow = colour(p, "L", glm::dvec3(1)) * p.number("scale", 1);
      if (p.text("twosided", "false") == "true")
        d_.note(where, "the back of a light that shines on both sides is left out");
      if (p.find("power")) d_.note(where, "the light's power is left out: its L counts");
    } else if (word == "Shape")
      add_shape(type, p);
    else if (word == "MakeNamedMedium")
      d_.note(where, "media are left out: there is clear space in their place");
  }

  glm::dvec3 colour(const PbrtParameters& p, const std::string& name, const glm::dvec3& standard) {
    const PbrtParameter* given = p.find(name);
    if (given && given->type == "texture" && !given->values.empty())
      if (const auto found = textures_.find(given->values[0]); found != textures_.end()) given = &found->second;
    if (!given) return standard;
    if (given->type == "rgb" || given->type == "color" || given->type == "float") {
      const auto v = given->numbers();
      if (v.size() == 1) return glm::dvec3(v[0]);
      if (v.size() == 3) return {v[0], v[1], v[2]};
      throw bad_input(given->where, fmt::format("\"{}\" has {} values", name, v.size()), "expected one or three");
    }
    d_.note(given->where, fmt::format("the {} \"{}\" is left out: {:.3g} {:.3g} {:.3g} takes its place", given->type,
                                      name, standard.x, standard.y, standard.z));
    return standard;
  }

  void add_camera(const std::string& type, const PbrtParameters& p) {
    if (!(std::abs(glm::determinant(state_.to_world)) > 0)) throw bad_input(p.where, "the camera's transform is flat");
    systems_["camera"] = glm::inverse(state_.to_world);
    if (type != "perspective") return d_.note(p.where, "the camera " + type + " is left out");
    d_.camera.emplace().to_world = systems_["camera"];
    fov_ = p.number("fov", 90);
    if (p.number("lensradius", 0) > 0) d_.note(p.where, "the lens is left out: everything is sharp");
    if (p.find("screenwindow")) d_.note(p.where, "the screen window is left out");
    frame();
  }
  /// The film may come before the camera or after it. fov is that of the shorter edge.
  void frame() {
    d_.camera->resolution = resolution_;
    const double w = resolution_[0], h = resolution_[1];
    d_.camera->fov_deg =
        glm::degrees(2 * std::atan(std::tan(glm::radians(std::clamp(fov_, 0.001, 179.0)) / 2) * h / std::min(w, h)));
  }

  std::string add_material(const std::string& key, const std::string& type, const PbrtParameters& p) {
    preset::Material& made = d_.materials[key] = {};
    const auto reflect = [&](const char* name, double standard) {
      const glm::dvec3 c = colour(p, name, glm::dvec3(standard));
      made.reflectance = reflectance_of({c.x, c.y, c.z});
    };
    const double rough = p.find("roughness") && p.find("roughness")->type == "float" ? p.number("roughness", 0) : 0;
    if (type == "dielectric" || type == "thindielectric" || type == "glass") {
      made.type = preset::Material::Type::dielectric;
      const char* name = p.find("eta") ? "eta" : "index";
      const PbrtParameter* eta = p.find(name);
      if (eta && eta->type == "spectrum" && !eta->values.empty()) {
        const auto glass = named_glasses.find(eta->values[0]);
        made.dispersion.n = glass == named_glasses.end() ? 1.5 : glass->second;
        d_.note(eta->where, fmt::format("the spectrum of eta is left out: n = {} takes its place", made.dispersion.n));
      } else
        made.dispersion.n = p.number(name, 1.5);
      if (made.dispersion.n < 0.01 || made.dispersion.n > 100)
        throw bad_input(p.where, "its index of refraction is out of range");
      if (type == "thindielectric") d_.note(p.where, "a thin film is solid glass here");
      if (rough > 0) d_.note(p.where, "roughness is left out: the glass is polished");
    } else if (type == "conductor" || type == "mirror") {
      made.type = preset::Material::Type::mirror;
      reflect(type == "mirror" ? "Kr" : "reflectance", 0.9);
      if (type == "conductor" && !p.find("reflectance"))
        d_.note(p.where, "the metal is left out: a mirror of 0.9 takes its place");
      if (rough > 0) d_.note(p.where, "roughness is left out: the mirror is polished");
    } else {
      reflect(p.find("Kd") ? "Kd" : "reflectance", 0.5);
      if (type != "diffuse" && type != "matte")
        d_.note(p.where, "the material " + (type.empty() ? "\"\"" : type) +
                             " is left out: a matt surface of its colour takes its place");
    }
    return key;
  }

  /// The luminance of a white of 1 is 1 in version 4, which divides a light by the luminance of its spectrum.
  void add_light(const std::string& type, const PbrtParameters& p) {
    DescribedLight light;
    light.where = p.where;
    const double scale = p.number("scale", 1);
    const glm::dvec3 from = scene::to_dvec3(p.vector("from", {0, 0, 0})),
                     to = scene::to_dvec3(p.vector("to", {0, 0, 1}));
    light.position = glm::dvec3(state_.to_world * glm::dvec4(from, 1));
    light.direction = glm::dmat3(state_.to_world) * (to - from);
    light.colour = colour(p, type == "distant" || type == "infinite" ? "L" : "I", glm::dvec3(1)) * scale;
    const double power = p.number("power", -1);
    if (type == "point") {
      if (power > 0) light.colour *= power / (4 * pi);
    } else if (type == "spot") {
      light.type = preset::Light::Type::spot;
      const double cone = std::clamp(p.number("coneangle", 30), 0.01, 90.0);
      const double start = std::clamp(cone - p.number("conedeltaangle", 5), 0.0, cone);
      const double low = std::cos(glm::radians(cone)), high = std::cos(glm::radians(start));
      light.half_angle_deg = same_power_half_angle_deg(cone, [&](double a) {
        const double t = high > low ? std::clamp((std::cos(a) - low) / (high - low), 0.0, 1.0) : 1;
        return t * t * (3 - 2 * t);
      });
      if (power > 0) light.colour *= power / (2 * pi * (1 - std::cos(glm::radians(light.half_angle_deg))));
      if (start < cone) d_.note(p.where, "the spot's fading edge is left out: a sharp cone has its power");
    } else if (type == "distant") {
      light.type = preset::Light::Type::directional;
      if (const double lux = p.number("illuminance", -1); lux > 0) light.colour *= lux;
    } else if (type == "infinite" && !p.find("filename") && !p.find("mapname")) {
      DescribedSurroundings s;
      s.where = p.where;
      s.colour = light.colour;
      if (const double lux = p.number("illuminance", -1); lux > 0) s.scale = lux / pi;
      d_.surroundings = s;
      return;
    } else
      return d_.note(p.where, "the light " + type + (type == "infinite" ? " with a picture" : "") + " is left out");
    d_.lights.push_back(light);
  }

  void add_shape(const std::string& type, const PbrtParameters& p) {
    DescribedShape shape;
    shape.where = p.where;
    shape.name = type;
    shape.to_world = state_.to_world;
    shape.material = state_.material;
    shape.glow = state_.glow;
    if (type == "sphere") {
      shape.radius = p.number("radius", 1);
      if (!(shape.radius > 0)) throw bad_input(p.where, "its radius is not above 0");
      if (p.find("zmin") || p.find("zmax") || p.find("phimax")) d_.note(p.where, "a part of a sphere is whole here");
    } else if (type == "plymesh") {
      const fs::path file = fs::path(p.where.name).parent_path() / p.text("filename", "");
      shape.mesh = d_.mesh_file(file, p.where);
    } else if (type == "trianglemesh" || type == "bilinearmesh") {
      shape.mesh = d_.own_mesh(type, pbrt_mesh(type, p));
    } else if (type == "disk") {
      const double radius = p.number("radius", 1);
      if (!(radius > 0)) throw bad_input(p.where, "its radius is not above 0");
      shape.to_world = glm::translate(shape.to_world, glm::dvec3(0, 0, p.number("height", 0)));
      shape.mesh = d_.own_mesh(type, disk(radius));
    } else if (type == "cylinder") {
      const double radius = p.number("radius", 1), low = p.number("zmin", -1), high = p.number("zmax", 1);
      if (!(radius > 0) || !(low < high)) throw bad_input(p.where, "the cylinder has no size");
      shape.mesh = d_.own_mesh(type, open_cylinder({0, 0, low}, {0, 0, high}, radius));
    } else
      return d_.note(p.where, "the shape " + type + " is left out");
    if (state_.reversed && shape.glow && !shape.mesh.empty()) {
      scene::Mesh turned = d_.meshes.at(shape.mesh);
      scene::turn_round(turned);
      shape.mesh = d_.own_mesh(type, std::move(turned));
    }
    if (object_)
      object_->push_back(std::move(shape));
    else
      d_.shapes.push_back(std::move(shape));
  }

  void instance(const std::string& name, const Place& where) {
    const auto found = objects_.find(name);
    if (found == objects_.end()) throw bad_input(where, "there is no object \"" + name + "\" above it");
    if (object_) return d_.note(where, "an instance within an object is left out");
    if (d_.shapes.size() + found->second.size() > max_shapes) throw bad_input(where, "there are too many shapes");
    for (DescribedShape shape : found->second) {
      shape.to_world = state_.to_world * shape.to_world;
      d_.shapes.push_back(std::move(shape));
    }
  }

  Description d_;
  std::vector<PbrtToken> tokens_;
  std::size_t next_ = 0;
  State state_;
  std::vector<std::pair<State, std::string>> stack_;
  std::map<std::string, glm::dmat4> systems_;
  std::map<std::string, std::vector<DescribedShape>> objects_;
  std::vector<DescribedShape>* object_ = nullptr;
  std::map<std::string, PbrtParameter> textures_;
  std::array<int, 2> resolution_{1280, 720};
  double fov_ = 90;
  int materials_ = 0;
};

} // namespace

Description read_pbrt(const fs::path& file) { return Pbrt(file).take(); }

} // namespace nephroid::formats
