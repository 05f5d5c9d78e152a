// SPDX-License-Identifier: Apache-2.0
// The directives of PBRT's version 4, and of 3 where only names differ. A camera has +x to the right and looks along
// +z, so coordinates are left-handed unless the file mirrors them.
#include "base/error.h"
#include "formats/import/pbrt_scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace nephroid::formats {
namespace {

constexpr std::size_t max_shapes = 1000000; ///< instances of instances multiply

/// What is done without: it says how to render, not what.
const std::set<std::string> about_rendering{"Sampler",     "Integrator",  "SurfaceIntegrator", "VolumeIntegrator",
                                            "PixelFilter", "Accelerator", "Renderer",          "ColorSpace",
                                            "Option",      "Attribute"};

struct State {
  glm::dmat4 to_world{1};
  std::string material = "plain";
  std::optional<glm::dvec3> glow;
  bool reversed = false;
};

class Pbrt {
public:
  explicit Pbrt(const std::filesystem::path& file) : file_(file) {
    d_.source = file;
    d_.materials["plain"].reflectance.value = 0.5;
    while (!file_.ended()) {
      const PbrtToken& head = file_.token({});
      if (head.quoted)
        throw bad_input(head.where, "\"" + head.text + "\" is no directive", "expected a word such as Shape");
      if (!is_block(head.text, head.where) && !is_transform(head.text, head.where) &&
          !is_mention(head.text, head.where))
        add_typed(head.text, head.where);
    }
    if (!stack_.empty()) throw bad_input(file.string(), "an AttributeBegin has no end", "expected AttributeEnd");
  }
  Description take() { return std::move(d_); }

private:
  // Directives by what they do. Each function returns false for a word that is none of its own.

  bool is_block(const std::string& word, const Location& where) {
    if (word == "AttributeBegin" || word == "TransformBegin" || word == "ObjectBegin") {
      stack_.push_back({state_, word});
      if (word != "ObjectBegin") return true;
      if (object_) throw bad_input(where, "an object is within another", "expected ObjectEnd before it");
      object_ = &objects_[file_.string(where)];
    } else if (word == "AttributeEnd" || word == "TransformEnd" || word == "ObjectEnd") {
      const std::string begin = word.substr(0, word.size() - 3) + "Begin";
      if (stack_.empty() || stack_.back().second != begin)
        throw bad_input(where, word + " has no " + begin + " before it");
      if (word == "TransformEnd")
        state_.to_world = stack_.back().first.to_world;
      else
        state_ = stack_.back().first;
      stack_.pop_back();
      if (word == "ObjectEnd") object_ = nullptr;
    } else
      return false;
    return true;
  }

  bool is_transform(const std::string& word, const Location& where) {
    glm::dmat4& m = state_.to_world;
    if (word == "WorldBegin" || word == "Identity") {
      m = glm::dmat4(1);
    } else if (word == "Translate" || word == "Scale") {
      const auto v = file_.numbers(where, 3);
      const glm::dvec3 by(v[0], v[1], v[2]);
      m = word == "Scale" ? glm::scale(m, by) : glm::translate(m, by);
    } else if (word == "Rotate") {
      const auto v = file_.numbers(where, 4);
      m = rotated(m, v[0], {v[1], v[2], v[3]}, where);
    } else if (word == "LookAt") {
      const auto v = file_.numbers(where, 9);
      m = m * glm::inverse(look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}, where));
    } else if (word == "Transform" || word == "ConcatTransform") {
      const glm::dmat4 given = glm::make_mat4(file_.numbers(where, 16).data());
      m = word == "Transform" ? given : m * given;
    } else if (word == "CoordinateSystem") {
      systems_[file_.string(where)] = m;
    } else if (word == "CoordSysTransform") {
      if (const auto found = systems_.find(file_.string(where)); found != systems_.end()) m = found->second;
    } else
      return false;
    return true;
  }

  /// What has no type.
  bool is_mention(const std::string& word, const Location& where) {
    if (word == "WorldEnd") return true;
    if (word == "ReverseOrientation") {
      state_.reversed = !state_.reversed;
    } else if (word == "ActiveTransform" || word == "TransformTimes") {
      if (word == "TransformTimes")
        file_.numbers(where, 2);
      else
        file_.token(where);
      d_.note(where, "motion is left out: everything stands still");
    } else if (word == "ObjectInstance") {
      instance(file_.string(where), where);
    } else if (word == "NamedMaterial") {
      state_.material = name_of(file_.string(where), "material");
      if (!d_.materials.contains(state_.material))
        throw bad_input(where, "there is no material \"" + state_.material + "\" above it");
    } else if (word == "MediumInterface") {
      while (file_.string_follows()) file_.string(where);
      note_medium(where);
    } else if (word == "Texture") {
      const std::string name = file_.string(where), value = file_.string(where), kind = file_.string(where);
      const PbrtParameters p = file_.parameters(where);
      if (kind == "constant" && p.find("value")) scene_.textures[name] = *p.find("value");
    } else
      return false;
    return true;
  }

  /// A type in quotes and parameters follow.
  void add_typed(const std::string& word, const Location& where) {
    static const std::set<std::string> taken{"Film",        "Camera",          "Material", "MakeNamedMaterial",
                                             "LightSource", "AreaLightSource", "Shape",    "MakeNamedMedium"};
    if (!taken.contains(word) && !about_rendering.contains(word))
      throw bad_input(where, word + " is no directive of PBRT", "expected a word such as Shape");
    const std::string type = file_.string(where);
    const PbrtParameters p = file_.parameters(where);
    if (word == "Film") {
      resolution_ = {static_cast<int>(std::clamp(p.number("xresolution", 1280), 1.0, 16384.0)),
                     static_cast<int>(std::clamp(p.number("yresolution", 720), 1.0, 16384.0))};
      if (d_.camera) frame();
    } else if (word == "Camera")
      add_camera(type, p);
    else if (word == "Material")
      add_material(state_.material = fmt::format("material {}", ++materials_), type, p);
    else if (word == "MakeNamedMaterial")
      add_material(name_of(type, "material"), p.text("type", "diffuse"), p);
    else if (word == "LightSource")
      add_pbrt_light(scene_, type, p, state_.to_world);
    else if (word == "AreaLightSource") {
      state_.glow = pbrt_colour(scene_, p, "L", glm::dvec3(1)) * p.number("scale", 1);
      if (p.text("twosided", "false") == "true")
        d_.note(where, "the back of a light that shines on both sides is left out");
      if (p.find("power")) d_.note(where, "the light's power is left out: its L counts");
    } else if (word == "Shape")
      add_shape(type, p);
    else if (word == "MakeNamedMedium")
      note_medium(where);
  }

  void note_medium(const Location& where) { d_.note(where, "media are left out: there is clear space in their place"); }

  void add_camera(const std::string& type, const PbrtParameters& p) {
    if (!(std::abs(glm::determinant(state_.to_world)) > 0)) throw bad_input(p.where, "the camera's transform is flat");
    systems_["camera"] = glm::inverse(state_.to_world);
    if (type != "perspective") return d_.note(p.where, "the camera " + type + " is left out");
    DescribedCamera& camera = d_.camera.emplace();
    camera.where = p.where;
    camera.to_world = systems_["camera"];
    fov_ = p.number("fov", 90);
    if (p.number("lensradius", 0) > 0) d_.note(p.where, "the lens is left out: everything is sharp");
    if (p.find("screenwindow")) d_.note(p.where, "the screen window is left out");
    frame();
  }
  /// The film may come before the camera or after it. fov is that of the shorter edge.
  void frame() {
    d_.camera->resolution = resolution_;
    d_.camera->fov_deg = vertical_fov_deg(fov_, resolution_[1], std::min(resolution_[0], resolution_[1]));
  }

  void add_material(const std::string& key, const std::string& type, const PbrtParameters& p) {
    d_.materials[key] = pbrt_material(scene_, type, p);
  }

  void add_shape(const std::string& type, const PbrtParameters& p) {
    std::optional<DescribedShape> shape = pbrt_shape(scene_, type, p, state_.to_world);
    if (!shape) return;
    shape->material = state_.material;
    shape->glow = state_.glow;
    if (state_.reversed && shape->glow && !shape->mesh.empty()) {
      scene::Mesh turned = d_.meshes.at(shape->mesh);
      scene::turn_round(turned);
      shape->mesh = d_.own_mesh(type, std::move(turned));
    }
    (object_ ? *object_ : d_.shapes).push_back(std::move(*shape));
  }

  void instance(const std::string& name, const Location& where) {
    const auto found = objects_.find(name);
    if (found == objects_.end()) throw bad_input(where, "there is no object \"" + name + "\" above it");
    if (object_) return d_.note(where, "an instance within an object is left out");
    if (d_.shapes.size() + found->second.size() > max_shapes) throw bad_input(where, "there are too many shapes");
    for (DescribedShape shape : found->second) {
      shape.to_world = state_.to_world * shape.to_world;
      d_.shapes.push_back(std::move(shape));
    }
  }

  PbrtFile file_;
  PbrtScene scene_;
  Description& d_ = scene_.d;
  State state_;
  std::vector<std::pair<State, std::string>> stack_;
  std::map<std::string, glm::dmat4> systems_;
  std::map<std::string, std::vector<DescribedShape>> objects_;
  std::vector<DescribedShape>* object_ = nullptr; ///< the one that is being described
  std::array<int, 2> resolution_{1280, 720};
  double fov_ = 90;
  int materials_ = 0;
};

} // namespace

Description describe_pbrt(const std::filesystem::path& file) { return Pbrt(file).take(); }

} // namespace nephroid::formats
