// SPDX-License-Identifier: Apache-2.0
// The directives of PBRT's version 4, and of 3 where only names differ. A camera has +x to the right and looks along
// +z, so coordinates are left-handed unless the file mirrors them.
#include "base/error.h"
#include "formats/import/pbrt_scene.h"
#include "formats/import/textures.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace nephroid::formats {
namespace {

constexpr char parting = '\n';        ///< which no name in a file has
constexpr const char* unnamed = "\n"; ///< at the end of a name that the file does not give

/// What is done without: it says how to render, not what.
const std::set<std::string> about_rendering{"Sampler",          "Integrator",  "SurfaceIntegrator",
                                            "VolumeIntegrator", "PixelFilter", "Accelerator",
                                            "Renderer",         "ColorSpace",  "Option"};

/// To the world at the first of both times, and at the second; which of them the next transforms are for.
struct Transforms {
  glm::dmat4 start{1}, end{1};
  bool at_start = true, at_end = true;
};

struct State {
  Transforms to_world;
  std::string material; ///< a key of PbrtScene::materials
  Location material_where{};
  std::string inside; ///< the medium in what is described
  std::optional<PbrtThing> glow;
  bool reversed = false;
  std::map<std::string, std::vector<PbrtParameter>> attributes; ///< by the directives that they are for
};

class Pbrt {
public:
  Pbrt(const std::filesystem::path& file, Description& into) : file_(file), scene_{into, file_} {
    d_.source = file;
    scene_.materials[""].type = "diffuse";
    while (!file_.ended()) {
      const PbrtToken& head = file_.token({});
      if (head.quoted)
        throw bad_input(head.where, "\"" + head.text + "\" is no directive", "expected a word such as Shape");
      if (!is_block(head.text, head.where) && !is_transform(head.text, head.where) &&
          !is_mention(head.text, head.where))
        add_typed(head.text, head.where);
    }
    if (!stack_.empty()) throw bad_input(file.string(), "an AttributeBegin has no end", "expected AttributeEnd");
    expose();
    give_materials();
  }

private:
  // Directives by what they do. Each function returns false for a word that is none of its own.

  bool is_block(const std::string& word, const Location& where) {
    if (word == "AttributeBegin" || word == "TransformBegin" || word == "ObjectBegin") {
      stack_.push_back({state_, word});
      if (word != "ObjectBegin") return true;
      if (object_) throw bad_input(where, "an object is within another", "expected ObjectEnd before it");
      object_name_ = file_.string(where);
      object_ = &objects_[object_name_];
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
    std::function<glm::dmat4(const glm::dmat4&)> change;
    if (word == "WorldBegin" || word == "Identity") {
      if (word == "WorldBegin") {
        systems_["world"] = glm::dmat4(1);
        state_.to_world.at_start = state_.to_world.at_end = true;
      }
      change = [](const glm::dmat4&) { return glm::dmat4(1); };
    } else if (word == "Translate" || word == "Scale") {
      const auto v = file_.numbers(where, 3);
      const glm::dvec3 by(v[0], v[1], v[2]);
      change = [=](const glm::dmat4& m) { return word == "Scale" ? glm::scale(m, by) : glm::translate(m, by); };
    } else if (word == "Rotate") {
      const auto v = file_.numbers(where, 4);
      change = [=](const glm::dmat4& m) { return rotated(m, v[0], {v[1], v[2], v[3]}, where); };
    } else if (word == "LookAt") {
      const auto v = file_.numbers(where, 9);
      const glm::dmat4 to_camera =
          glm::inverse(look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}, where));
      change = [=](const glm::dmat4& m) { return m * to_camera; };
    } else if (word == "Transform" || word == "ConcatTransform") {
      const glm::dmat4 given = glm::make_mat4(file_.numbers(where, 16).data());
      change = [=](const glm::dmat4& m) { return word == "Transform" ? given : m * given; };
    } else if (word == "CoordinateSystem") {
      systems_[file_.string(where)] = state_.to_world.start;
      return true;
    } else if (word == "CoordSysTransform") {
      const std::string name = file_.string(where);
      if (!systems_.contains(name)) throw bad_input(where, "there is no coordinate system \"" + name + "\" above it");
      change = [this, name](const glm::dmat4&) { return systems_[name]; };
    } else
      return false;
    if (state_.to_world.at_start) state_.to_world.start = change(state_.to_world.start);
    if (state_.to_world.at_end) state_.to_world.end = change(state_.to_world.end);
    return true;
  }

  /// What has no type.
  bool is_mention(const std::string& word, const Location& where) {
    if (word == "WorldEnd") return true;
    if (word == "ReverseOrientation") {
      state_.reversed = !state_.reversed;
    } else if (word == "TransformTimes") {
      file_.numbers(where, 2);
    } else if (word == "ActiveTransform") {
      const std::string& times = file_.token(where).text;
      if (times != "StartTime" && times != "EndTime" && times != "All")
        throw bad_input(where, "\"" + times + "\" is no time of a transform", "expected StartTime, EndTime or All");
      state_.to_world.at_start = times != "EndTime";
      state_.to_world.at_end = times != "StartTime";
    } else if (word == "ObjectInstance") {
      note_motion(where);
      instance(file_.string(where), where);
    } else if (word == "NamedMaterial") {
      state_.material = file_.string(where);
      state_.material_where = where;
    } else if (word == "MediumInterface") {
      state_.inside = file_.string(where);
      const std::string outside = file_.string_follows() ? file_.string(where) : state_.inside;
      if (!outside.empty()) note_medium(where);
    } else if (word == "Attribute") {
      const std::string target = file_.string(where);
      for (const PbrtParameter& parameter : file_.parameters(where).all)
        state_.attributes[target].insert(state_.attributes[target].begin(), parameter); // the last one counts
    } else if (word == "Texture") {
      const std::string name = file_.string(where), value = file_.string(where), kind = file_.string(where);
      const PbrtParameters p = parameters("texture", where);
      if (kind == "constant" && p.find("value"))
        scene_.textures[name] = *p.find("value");
      else
        (value == "float" ? scene_.numbers : scene_.pictures)[name] = {kind, p};
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
    static const std::map<std::string, const char*> targets{
        {"Shape", "shape"},       {"LightSource", "light"},          {"AreaLightSource", "light"},
        {"Material", "material"}, {"MakeNamedMaterial", "material"}, {"MakeNamedMedium", "medium"}};
    const std::string type = file_.string(where);
    const auto target = targets.find(word);
    const PbrtParameters p = parameters(target == targets.end() ? "" : target->second, where);
    if (word == "Film") {
      scene_.is_version_3 = type == "image";
      resolution_ = {static_cast<int>(std::clamp(p.number("xresolution", 1280), 1.0, 16384.0)),
                     static_cast<int>(std::clamp(p.number("yresolution", 720), 1.0, 16384.0))};
      if (p.find("sensor")) d_.note(where, "the film's sensor is left out");
      speed_ = p.number("iso", 100) / 100;
      crop_.clear();
      for (const char* name : {"cropwindow", "pixelbounds"})
        if (const PbrtParameter* given = p.find(name)) {
          crop_ = given->numbers();
          if (crop_.size() != 4) throw bad_input(given->where, "the crop has not four values", "expected x x y y");
          if (given->name == "cropwindow")
            for (std::size_t i = 0; i < 4; ++i) crop_[i] = std::ceil(crop_[i] * resolution_[i / 2] - 1e-4);
        }
      if (p.find("exposuretime")) open_s_ = p.number("exposuretime", 1);
      note_unasked(scene_, p);
      if (d_.camera) frame();
    } else if (word == "Camera")
      add_camera(type, p);
    else if (word == "Material") {
      state_.material = fmt::format("material {}", ++materials_) + unnamed;
      scene_.materials[state_.material] = {type, p};
    } else if (word == "MakeNamedMaterial")
      scene_.materials[type] = {p.text("type", "diffuse"), p};
    else if (word == "LightSource") {
      note_motion(where);
      add_pbrt_light(scene_, type, p, state_.to_world.start);
      note_unasked(scene_, p);
    } else if (word == "AreaLightSource")
      state_.glow = {type, p};
    else if (word == "Shape")
      add_shape(type, p);
    else if (word == "MakeNamedMedium")
      scene_.media[type] = {p.text("type", "homogeneous"), p};
    else if (word == "Integrator" || word == "SurfaceIntegrator")
      d_.note_length_of_paths(where, "maxdepth", p.number("maxdepth", 5));
    else if (word == "ColorSpace" && type != "srgb")
      d_.note(where, "the colour space " + type + " is left out: colours count as sRGB");
  }

  /// What follows, and what an Attribute gave before.
  PbrtParameters parameters(const std::string& target, const Location& where) {
    PbrtParameters p = file_.parameters(where);
    if (const auto given = state_.attributes.find(target); given != state_.attributes.end())
      p.add_missing(given->second);
    return p;
  }

  void note_motion(const Location& where) {
    if (state_.to_world.start != state_.to_world.end)
      d_.note(where, "motion is left out: it stands where it is at the first of both times");
  }

  void note_medium(const Location& where) { d_.note(where, "media are left out: there is clear space in their place"); }

  void add_camera(const std::string& type, const PbrtParameters& p) {
    if (!(std::abs(glm::determinant(state_.to_world.start)) > 0))
      throw bad_input(p.where, "the camera's transform is flat");
    systems_["camera"] = glm::inverse(state_.to_world.start);
    if (type != "perspective" && type != "orthographic") return d_.note(p.where, "the camera " + type + " is left out");
    note_motion(p.where);
    DescribedCamera& camera = d_.camera.emplace();
    camera.where = p.where;
    camera.to_world = systems_["camera"];
    orthographic_ = type == "orthographic";
    fov_ = orthographic_ ? 90 : p.number("fov", 90);
    camera.lens_radius = std::max(p.number("lensradius", 0), 0.0);
    camera.focus_distance = std::max(p.number("focaldistance", 1e6), 0.0);
    window_.clear();
    if (const PbrtParameter* window = p.find("screenwindow")) window_ = window->numbers();
    if (window_.size() != 4 || !(window_[1] > window_[0] && window_[3] > window_[2])) {
      if (!window_.empty()) d_.note(p.where, "its screenwindow is left out: it is no left, right, bottom and top");
      window_.clear();
    }
    if (p.find("shutterclose") || p.find("shutteropen"))
      open_s_ = p.number("shutterclose", 1) - p.number("shutteropen", 0);
    if (p.find("frameaspectratio")) d_.note(p.where, "its frameaspectratio is left out");
    note_unasked(scene_, p);
    frame();
  }

  /// The imaging ratio of version 4; in version 3 the shutter only says what moves.
  void expose() {
    if (scene_.is_version_3) return;
    d_.exposure = open_s_ * speed_;
    if (!(d_.exposure > 0) || !std::isfinite(d_.exposure))
      throw bad_input(d_.source.string(), "has a shutter that does not open, or a film of ISO 0");
  }

  /// The film may come before the camera or after it. fov is that of the shorter edge, which a window has from -1 to 1.
  void frame() {
    DescribedCamera& camera = *d_.camera;
    const double w = resolution_[0], h = resolution_[1], shorter = std::min(w, h);
    camera.resolution = resolution_;
    camera.shift = {0, 0};
    double height = 2 * h / shorter;
    if (!window_.empty()) {
      const double across = window_[1] - window_[0];
      height = window_[3] - window_[2];
      camera.shift = {(window_[0] + window_[1]) / 2 / across, (window_[2] + window_[3]) / 2 / height};
      if (std::abs(across / height - w / h) > 1e-3 * w / h)
        d_.note(camera.where, "its screenwindow has another shape than the film: only its height is taken");
    }
    camera.fov_deg = vertical_fov_deg(fov_, height, 2);
    if (orthographic_) camera.height = height;
    if (crop_.empty()) return;
    const glm::dvec2 whole(w, h), low = glm::clamp(glm::dvec2(crop_[0], crop_[2]), glm::dvec2(0), whole),
                                  high = glm::clamp(glm::dvec2(crop_[1], crop_[3]), glm::dvec2(0), whole);
    if (high.x - low.x < 1 || high.y - low.y < 1) throw bad_input(camera.where, "the film's crop has no pixels");
    crop(camera, low, high - low);
  }

  void add_shape(const std::string& type, const PbrtParameters& p) {
    note_motion(p.where);
    std::optional<DescribedShape> shape = pbrt_shape(scene_, type, p, state_.to_world.start);
    if (!shape) return;
    note_unasked(scene_, p);
    shape->inside_out = state_.reversed;
    shape->material = state_.material + parting + state_.inside;
    uses_.try_emplace(shape->material, Use{state_.material, state_.inside, state_.material_where, {}});
    if (state_.glow) {
      const PbrtParameters& light = state_.glow->parameters;
      shape->glow = pbrt_light_colour(scene_, light, "L");
      shape->glows_on_both_sides = light.text("twosided", "false") == "true";
      if (const double power = light.number("power", -1); power > 0) shape->glow_power = power;
      if (const std::string picture = light.text("filename", ""); !picture.empty()) {
        const auto mean = mean_of({.file = scene_.file.find(picture, light.where).string()}, true);
        d_.note(light.where, mean ? "the light's picture is taken by its mean"
                                  : "the light's picture cannot be read and is left out: it is white");
        if (mean && shape->glow->spectrum)
          *shape->glow = *shape->glow * glm::dot(*mean, {0.2126, 0.7152, 0.0722});
        else if (mean)
          shape->glow->rgb *= *mean;
      }
      note_unasked(scene_, light);
    }
    (object_ ? *object_ : d_.shapes).push_back(std::move(*shape));
  }

  /// A material may be named before it is made.
  void give_materials() {
    TakenNames taken;
    std::vector<DescribedShape> shapes;
    for (DescribedShape& shape : d_.shapes) {
      Use& use = uses_.at(shape.material);
      if (!use.key) use.key = key_of(use, taken);
      if (use.key->empty() && !shape.glow) continue; // no surface
      shape.material = *use.key;
      shapes.push_back(std::move(shape));
    }
    d_.shapes = std::move(shapes);
  }

  struct Use {
    std::string material, medium;
    Location where;
    std::optional<std::string> key; ///< empty: no surface
  };

  std::string key_of(const Use& use, TakenNames& taken) {
    const auto material = scene_.materials.find(use.material);
    if (material == scene_.materials.end()) throw bad_input(use.where, "there is no material \"" + use.material + "\"");
    const auto medium = scene_.media.find(use.medium);
    if (!use.medium.empty() && medium == scene_.media.end())
      throw bad_input(material->second.parameters.where, "there is no medium \"" + use.medium + "\"");
    const std::string name = use.material.substr(0, use.material.find(unnamed));
    const std::string key = unique(name_of(name, "plain"), taken);
    return add_pbrt_material(scene_, key, material->second, use.medium.empty() ? nullptr : &medium->second)
               ? key
               : std::string();
  }

  void instance(const std::string& name, const Location& where) {
    const auto found = objects_.find(name);
    if (found == objects_.end()) throw bad_input(where, "there is no object \"" + name + "\" above it");
    if (object_ && name == object_name_) throw bad_input(where, "the object \"" + name + "\" is in itself");
    std::vector<DescribedShape>& into = object_ ? *object_ : d_.shapes;
    if (into.size() + found->second.size() > max_shapes) throw bad_input(where, "there are too many shapes");
    for (DescribedShape shape : found->second) {
      shape.to_world = state_.to_world.start * shape.to_world;
      into.push_back(std::move(shape));
    }
  }

  PbrtFile file_;
  PbrtScene scene_;
  Description& d_ = scene_.d;
  std::map<std::string, Use> uses_; ///< by what shapes have until all is read
  State state_;
  std::vector<std::pair<State, std::string>> stack_;
  std::map<std::string, glm::dmat4> systems_;
  std::map<std::string, std::vector<DescribedShape>> objects_;
  std::vector<DescribedShape>* object_ = nullptr; ///< the one that is being described
  std::string object_name_;
  std::array<int, 2> resolution_{1280, 720};
  double open_s_ = 1, speed_ = 1; ///< of the shutter, and of the film over ISO 100
  double fov_ = 90;
  bool orthographic_ = false;
  std::vector<double> crop_;   ///< from and to in x and in y, in pixels; empty: none
  std::vector<double> window_; ///< left, right, bottom, top; empty: by the film
  int materials_ = 0;
};

} // namespace

void describe_pbrt(const std::filesystem::path& file, Description& into) { Pbrt(file, into); }

} // namespace nephroid::formats
