// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 scene: in metres, +y up, cameras and lights look along -z, as here.
#include "base/files.h"
#include "formats/import/description.h"
#include "formats/import/gltf_scene.h"
#include "formats/import/textures.h"
#include "image/image.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <tuple>
#include <utility>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

/// Extensions, and the note on what is left out with them; empty where all of it is done. Others are named.
constexpr std::pair<const char*, const char*> extension_notes[] = {
    {"EXT_mesh_gpu_instancing", ""},
    {"KHR_lights_punctual", ""},
    {"KHR_materials_clearcoat", ""},
    {"KHR_materials_dispersion", ""},
    {"KHR_materials_emissive_strength", ""},
    {"KHR_materials_ior", ""},
    {"KHR_materials_transmission", ""},
    {"KHR_materials_volume", ""},
    {"KHR_mesh_quantization", ""},
    {"KHR_node_visibility", ""},
    {"KHR_texture_transform", ""},
    {"EXT_lights_image_based", "the file's surroundings (EXT_lights_image_based) are left out"},
    {"KHR_materials_pbrSpecularGlossiness",
     "of KHR_materials_pbrSpecularGlossiness the diffuse colour is taken, its gloss is left out"},
    {"KHR_materials_unlit", "materials that need no light (KHR_materials_unlit) are lit as others are"},
    {"KHR_materials_variants", "variants (KHR_materials_variants) are left out: meshes have the materials they name"}};

class GltfReader {
public:
  GltfReader(const GltfFile& file, Description& into) : root_(file.json, file.where()), meshes_(file), d_(into) {
    d_.source = file.file;
    d_.fits_white = true;
    read_animations();
    const std::vector<GltfNode> nodes = nodes_of(file);
    for (const GltfNode& node : nodes) worlds_[node.index] = node.to_world;
    for (const GltfNode& node : nodes) {
      if (node.value.has("camera")) add_camera(node);
      if (!node.is_visible) d_.note("what the file hides (KHR_node_visibility) is left out");
      if (!node.is_visible) continue;
      if (node.value.has("mesh")) add_mesh(node);
      if (node.value.object("extensions").has("KHR_lights_punctual")) add_light(node);
    }
    note_extensions();
  }

private:
  static constexpr std::size_t none = ~std::size_t{0};

  /// How the weights of a node's morph targets change: the numbers of all targets at each time.
  struct WeightKeys {
    std::vector<double> seconds, weights;
  };

  /// The first of the file's animations that moves weights; the others play instead of it, not with it.
  void read_animations() {
    const std::vector<GltfValue> animations = root_.list("animations");
    for (const GltfValue& animation : animations) {
      for (const GltfValue& channel : animation.list("channels")) {
        const GltfValue target = channel.object("target");
        if (target.text("path") != "weights" || !target.has("node")) {
          d_.note("animations are left out, but those of morph targets");
          continue;
        }
        if (!weights_.empty() && animated_by_ != animation.where().text()) {
          d_.note("of several animations of morph targets the first is taken");
          continue;
        }
        animated_by_ = animation.where().text();
        weights_[target.index("node", root_, "nodes")] = weight_keys(channel.item("sampler", animation, "samplers"));
      }
    }
  }

  WeightKeys weight_keys(const GltfValue& sampler) {
    WeightKeys keys{meshes_.numbers(sampler, "input", 1), meshes_.numbers(sampler, "output", 1)};
    const std::string way = sampler.text("interpolation");
    const std::size_t times = keys.seconds.size(), parts = way == "CUBICSPLINE" ? 3 : 1,
                      width = keys.weights.size() / (times * parts);
    if (width == 0 || keys.weights.size() != width * times * parts)
      throw bad_input(sampler.where(), fmt::format("has {} numbers at {} times", keys.weights.size(), times));
    for (std::size_t i = 0; i < times; ++i)
      if (!std::isfinite(keys.seconds[i]) || (i > 0 && !(keys.seconds[i] > keys.seconds[i - 1])))
        throw bad_input(sampler.where(), "its times do not rise");
    for (double& weight : keys.weights)
      if (!std::isfinite(weight)) throw bad_input(sampler.where(), "has a weight that is not a finite number");
    if (parts == 3) { // a tangent, the value, a tangent
      std::vector<double> values;
      for (std::size_t i = 0; i < times; ++i)
        for (std::size_t w = 0; w < width; ++w) values.push_back(keys.weights[(3 * i + 1) * width + w]);
      keys.weights = std::move(values);
      d_.note("weights of morph targets go straight from key to key where the file has curves");
    }
    if (way == "STEP") d_.note("weights of morph targets go straight from key to key where the file has steps");
    return keys;
  }

  /// targets: keys of meshes.
  std::vector<DescribedState> states_of(const GltfNode& node, const GltfValue& mesh,
                                        const std::vector<std::string>& targets) {
    const GltfValue& weighted = node.value.has("weights") ? node.value : mesh;
    const std::vector<double> weights = weighted.number_list("weights");
    const auto animated = weights_.find(node.index);
    std::vector<DescribedState> states;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      DescribedState& state = states.emplace_back();
      state.mesh = targets[k];
      if (k < weights.size()) state.weight = weights[k];
      if (animated == weights_.end()) continue;
      const WeightKeys& keys = animated->second;
      const std::size_t width = keys.weights.size() / keys.seconds.size();
      if (width != targets.size())
        throw bad_input(node.value.where(),
                        fmt::format("has {} weights a key of {} morph targets", width, targets.size()));
      for (std::size_t i = 0; i < keys.seconds.size(); ++i)
        state.keys.push_back({keys.seconds[i], keys.weights[i * width + k]});
    }
    return states;
  }

  /// What each joint of a node's skin does to a mesh, into the world; empty without a skin.
  std::vector<glm::dmat4> joints_of(const GltfNode& node) const {
    if (!node.value.has("skin")) return {};
    const GltfValue skin = node.value.item("skin", root_, "skins");
    const std::vector<std::size_t> joints = skin.indices("joints", root_, "nodes");
    std::vector<double> inverse;
    if (skin.has("inverseBindMatrices")) inverse = meshes_.numbers(skin, "inverseBindMatrices", 16);
    if (!inverse.empty() && inverse.size() < 16 * joints.size())
      throw bad_input(skin.where(), fmt::format("has {} matrices of {} joints", inverse.size() / 16, joints.size()));
    std::vector<glm::dmat4> moves;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto world = worlds_.find(joints[i]);
      if (world == worlds_.end())
        throw bad_input(skin.where() / "joints" / i, fmt::format("node {} is not in the scene", joints[i]));
      moves.push_back(inverse.empty() ? world->second : world->second * glm::make_mat4(&inverse[16 * i]));
    }
    return moves;
  }

  /// What is left of the light behind: from the least to the most of a surface.
  struct Alpha {
    double least = 1, most = 1;
    void times(double low, double high) { least *= low, most *= high; }
  };

  /// Calls `use` with the file of a picture, which may be one of the moment, where there is one.
  template <class Use>
  void with_file_of(std::size_t image, const Use& use) {
    GltfMeshes::Picture picture = meshes_.picture(root_.item("images", image));
    std::optional<TemporaryFolder> folder;
    if (picture.file.empty()) {
      picture.file = folder.emplace().path() / (picture.bytes.starts_with("\x89PNG") ? "picture.png" : "picture.jpg");
      write_file_whole(picture.file, picture.bytes);
    }
    if (is_there(picture.file)) use(picture.file);
  }

  /// Of a file's picture.
  Alpha alpha_of_picture(std::size_t image) {
    const auto [found, is_new] = alphas_.try_emplace(image);
    if (!is_new) return found->second;
    image::Image read;
    with_file_of(image, [&](const fs::path& file) {
      try {
        read = image::read_image(file);
      } catch (const Error&) { // who takes its colours says so
      }
    });
    const auto channel = static_cast<std::size_t>(std::ranges::find(read.channels, "A") - read.channels.begin());
    if (read.data.empty() || channel == read.channels.size()) return {};
    float low = 1, high = 0;
    for (std::size_t i = channel; i < read.data.size(); i += read.channels.size()) {
      low = std::min(low, read.data[i]);
      high = std::max(high, read.data[i]);
    }
    return found->second = {low, high};
  }

  /// The radiance of a surface, in cd/m^2; the picture of its light by its mean.
  glm::dvec3 glow_of(const GltfValue& material, const std::string& name) {
    const auto emission = emission_of(material);
    const glm::dvec3 rgb(emission[0], emission[1], emission[2]);
    const GltfValue info = material.object("emissiveTexture");
    if (rgb == glm::dvec3(0) || !info.has("index")) return rgb;
    if (root_.object("asset").text("generator") == "Nephroid") {
      d_.note(fmt::format("material '{}': the caustics that the export has drawn are left out: they are computed here",
                          name));
      return glm::dvec3(0);
    }
    const GltfValue texture = info.item("index", root_, "textures");
    std::optional<glm::dvec3> mean;
    if (texture.has("source")) {
      const std::size_t image = texture.index("source", root_, "images");
      const bool is_new = !means_.contains(image);
      std::optional<glm::dvec3>& known = means_[image];
      if (is_new) with_file_of(image, [&](const fs::path& file) { known = mean_of({.file = file.string()}, true); });
      mean = known;
    }
    d_.note(fmt::format("material '{}': {}", name,
                        mean ? "the picture of its light is taken by its mean"
                             : "it does not shine here: the picture of its light cannot be read"));
    return rgb * mean.value_or(glm::dvec3(0));
  }

  /// Whether some of a primitive is there, by its alpha.
  bool is_there_by_alpha(const GltfValue& primitive) {
    if (!primitive.has("material")) return true;
    const std::size_t index = primitive.index("material", root_, "materials");
    const GltfValue material = root_.item("materials", index);
    const std::string mode = material.text("alphaMode");
    if (mode != "MASK" && mode != "BLEND") return true;
    const GltfValue pbr = material.object("pbrMetallicRoughness"),
                    older = material.extension("KHR_materials_pbrSpecularGlossiness"); // takes the other's place
    const bool is_older = material.object("extensions").has("KHR_materials_pbrSpecularGlossiness");
    const double factor = std::clamp((is_older ? older.numbers<4>("diffuseFactor", {1, 1, 1, 1})
                                               : pbr.numbers<4>("baseColorFactor", {1, 1, 1, 1}))[3],
                                     0.0, 1.0);
    Alpha alpha;
    const GltfValue base = is_older ? older.object("diffuseTexture") : pbr.object("baseColorTexture");
    if (base.has("index"))
      if (const GltfValue texture = base.item("index", root_, "textures"); texture.has("source")) {
        const Alpha picture = alpha_of_picture(texture.index("source", root_, "images"));
        alpha.times(picture.least, picture.most);
      }
    const GltfValue attributes = primitive.object("attributes");
    if (attributes.has("COLOR_0") && attributes.item("COLOR_0", root_, "accessors").text("type") == "VEC4") {
      const std::vector<double> colours = meshes_.numbers(attributes, "COLOR_0", 4);
      double low = 1, high = 0;
      for (std::size_t i = 3; i < colours.size(); i += 4) {
        low = std::min(low, std::clamp(colours[i], 0.0, 1.0));
        high = std::max(high, std::clamp(colours[i], 0.0, 1.0));
      }
      alpha.times(low, high);
    }
    alpha.times(factor, factor);
    const double cutoff = material.number("alphaCutoff", 0.5);
    if (mode == "MASK" ? alpha.most < cutoff : !(alpha.most > 0)) return false;
    const std::string name = name_of(material.text("name"), fmt::format("material {}", index));
    if (mode == "MASK" && alpha.least < cutoff)
      d_.note(fmt::format("material '{}' has holes by its alpha in the file and is whole here", name));
    if (mode == "BLEND" && alpha.least < factor)
      d_.note(fmt::format("material '{}' is opaque here, also where its picture or corners are not", name));
    return true;
  }

  void add_mesh(const GltfNode& node) {
    const std::size_t index = node.value.index("mesh", root_, "meshes");
    const GltfValue mesh = root_.item("meshes", index);
    const std::string name =
        name_of(node.value.text("name"), name_of(mesh.text("name"), fmt::format("mesh {}", index)));
    const std::vector<GltfValue> primitives = mesh.list("primitives");
    const std::vector<glm::dmat4> places = meshes_.instances(node.value), joints = joints_of(node);
    const std::size_t skin = joints.empty() ? none : node.value.index("skin", root_, "skins");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (primitives[p].count("mode", 4) < 4) {
        d_.note(fmt::format("points and lines of '{}' are left out", name));
        continue;
      }
      if (primitives[p].object("attributes").has("COLOR_0"))
        d_.note(fmt::format("the colours of the corners of '{}' are left out", name));
      // What its joints move stands where they do, wherever its node is.
      const bool is_skinned = !joints.empty() && primitives[p].object("attributes").has("JOINTS_0");
      if (!joints.empty() && !is_skinned)
        d_.note(fmt::format("a part of '{}' has no joints: its skin does not move it", name));
      const auto [keys, is_new] = keys_.try_emplace({index, p, is_skinned ? skin : none});
      if (is_new && is_there_by_alpha(primitives[p]))
        keys->second = own_meshes(primitives[p], name, is_skinned ? joints : std::vector<glm::dmat4>());
      if (keys->second.empty()) continue;
      DescribedShape shape;
      shape.where = primitives[p].where();
      shape.name = name;
      shape.material = material(primitives[p]);
      shape.mesh = keys->second[0];
      shape.states = states_of(node, mesh, {keys->second.begin() + 1, keys->second.end()});
      if (primitives[p].has("material")) {
        const GltfValue surface = root_.item("materials", primitives[p].index("material", root_, "materials"));
        const glm::dvec3 rgb = glow_of(surface, shape.material);
        if (rgb != glm::dvec3(0)) shape.glow.emplace().rgb = rgb / most_lumens;
        shape.glows_by_mean = surface.has("emissiveTexture");
        shape.glows_on_both_sides = surface.truth("doubleSided", false);
      }
      for (const glm::dmat4& instance : places) {
        shape.to_world = is_skinned ? instance : node.to_world * instance;
        d_.shapes.push_back(shape);
      }
    }
  }

  /// The mesh's key, then those of its morph targets; empty where nothing of it can be seen. joints: of its skin.
  std::vector<std::string> own_meshes(const GltfValue& primitive, const std::string& name,
                                      const std::vector<glm::dmat4>& joints) {
    if (!primitive.object("attributes").has("POSITION")) {
      d_.note(fmt::format("a part of '{}' has no positions and is left out", name));
      return {};
    }
    scene::Mesh mesh = meshes_.read(primitive);
    std::vector<scene::Mesh> targets;
    for (const GltfValue& target : primitive.list("targets"))
      targets.push_back(meshes_.target(mesh, primitive, target));
    if (!joints.empty()) {
      if (const std::size_t loose = meshes_.move_by_joints(mesh, primitive, joints); loose > 0)
        d_.note(
            fmt::format("{} vertices of '{}' have no weights: the first joint of its skin moves them", loose, name));
      for (scene::Mesh& target : targets) meshes_.move_by_joints(target, primitive, joints);
    }
    if (!scene::has_area(mesh)) {
      d_.note(fmt::format("a part of '{}' has no triangle with an area and is left out", name));
      return {};
    }
    std::vector<std::string> keys{{}};
    for (scene::Mesh& target : targets) keys.push_back(d_.own_mesh(name + " target", std::move(target)));
    turn_upside_down(mesh);
    keys[0] = d_.own_mesh(name, std::move(mesh));
    return keys;
  }

  void note_extensions() {
    std::set<std::string> named;
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      for (const std::string& name : root_.texts(list)) named.insert(name);
    std::string others;
    for (const std::string& name : named) {
      const auto* const extension =
          std::ranges::find(extension_notes, name, [](const auto& one) { return std::string_view(one.first); });
      if (extension == std::end(extension_notes))
        others += (others.empty() ? "" : ", ") + name;
      else if (*extension->second != 0)
        d_.note(extension->second);
    }
    if (!others.empty()) d_.note("extensions that are left out: " + others);
  }

  std::string material(const GltfValue& primitive) {
    const std::size_t index = primitive.has("material") ? primitive.index("material", root_, "materials") : none;
    const auto [found, is_new] = material_names_.try_emplace(index);
    std::string& name = found->second;
    if (!is_new) return name;
    if (index == none) {
      name = unique("plain", taken_materials_);
      d_.materials[name] = {};
      return name;
    }
    const GltfValue value = root_.item("materials", index);
    name = unique(name_of(value.text("name"), fmt::format("material {}", index)), taken_materials_);
    preset::Material& made = d_.materials[name] = material_of(value, name, d_.notes);
    const GltfValue pbr = value.object("pbrMetallicRoughness"),
                    older = value.extension("KHR_materials_pbrSpecularGlossiness"), // takes the other's place
        base = older.has("diffuseTexture") ? older.object("diffuseTexture") : pbr.object("baseColorTexture");
    if (is_matt(made.type)) made.texture = texture_of(base, name);
    if (takes_roughness_texture(made)) // whose green it is here, too
      made.roughness_texture = texture_of(pbr.object("metallicRoughnessTexture"), name);
    if (made.type == preset::Material::Type::diffuse) {
      made.normal_map = texture_of(value.object("normalTexture"), name);
      made.normal_scale = std::clamp(value.object("normalTexture").number("scale", 1), -100.0, 100.0);
    }
    if (made.type != preset::Material::Type::dielectric) return name;
    made.tint_texture = texture_of(base, name);
    if (std::string glass = absorbing_glass_file(value, made.dispersion); !glass.empty()) {
      made.dispersion = {};
      made.dispersion.type = preset::Dispersion::Type::file;
      made.dispersion.file = d_.own_file(name, ".yml");
      d_.files.emplace(made.dispersion.file, std::move(glass));
    }
    return name;
  }

  /// info: of a material, where it names one. Nothing where it has none that is taken over.
  std::optional<preset::Texture> texture_of(const GltfValue& info, const std::string& name) {
    if (!info.has("index")) return std::nullopt;
    const auto leave_out = [&](const char* why) {
      d_.note(fmt::format("material '{}': its texture is left out: {}", name, why));
      return std::nullopt;
    };
    const GltfValue transform = info.extension("KHR_texture_transform");
    if ((transform.has("texCoord") ? transform : info).count("texCoord", 0) != 0)
      return leave_out("its mesh has several sets of u, v, and the first is not meant");
    const GltfValue texture = info.item("index", root_, "textures");
    if (!texture.has("source")) return leave_out("it has no picture that is read here");
    const auto scale = transform.numbers<2>("scale", {1, 1}), offset = transform.numbers<2>("offset", {0, 0});
    const double angle = transform.number("rotation", 0);
    const glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
    const TextureMap map = upside_down({turn * glm::dmat2(scale[0], 0, 0, scale[1]), glm::dvec2(offset[0], offset[1])});
    constexpr std::uint64_t clamp = 33071, mirror = 33648, repeat = 10497; // of OpenGL
    std::uint64_t wrap = repeat;
    if (texture.has("sampler")) {
      const GltfValue sampler = texture.item("sampler", root_, "samplers");
      wrap = sampler.count("wrapS", repeat);
      if (sampler.count("wrapT", repeat) != wrap)
        d_.note(fmt::format("material '{}': its texture goes on beyond its edges across as it does along", name));
    }
    const GltfMeshes::Picture found = meshes_.picture(texture.item("source", root_, "images"));
    const auto way = wrap == clamp    ? preset::Texture::Wrap::clamp
                     : wrap == mirror ? preset::Texture::Wrap::mirror
                                      : preset::Texture::Wrap::repeat;
    if (!found.file.empty()) return picture(found.file, way, map, info.where(), d_);
    const bool is_png = found.bytes.starts_with("\x89PNG");
    if (!is_png && !found.bytes.starts_with("\xff\xd8")) return leave_out("it is neither PNG nor JPEG");
    preset::Texture made;
    made.wrap = way;
    made.file = d_.own_file(name, is_png ? ".png" : ".jpg");
    d_.files.emplace(made.file, found.bytes);
    return placed(made, map, info.where(), d_);
  }

  void add_camera(const GltfNode& node) {
    const GltfValue camera = node.value.item("camera", root_, "cameras");
    const bool orthographic = camera.text("type") == "orthographic";
    if (!orthographic && camera.text("type") != "perspective") return d_.note("a camera of another type is left out");
    if (d_.camera) return d_.note("only the first camera is taken");
    const GltfValue lens = camera.object(orthographic ? "orthographic" : "perspective");
    const double fov = lens.number("yfov", 0.7), half_height = std::max(std::abs(lens.number("ymag", 1)), 1e-6),
                 aspect = std::clamp(orthographic ? std::abs(lens.number("xmag", 1)) / half_height
                                                  : lens.number("aspectRatio", 1),
                                     0.1, 10.0);
    DescribedCamera& made = d_.camera.emplace();
    made.where = node.value.where();
    if (orthographic)
      made.height = 2 * half_height;
    else
      made.fov_deg = glm::degrees(fov);
    made.resolution = aspect >= 1 ? std::array{static_cast<int>(std::lround(512 * aspect)), 512}
                                  : std::array{512, static_cast<int>(std::lround(512 / aspect))};
    // A camera's node does not scale it.
    const glm::dvec3 up = glm::normalize(glm::dvec3(node.to_world[1])),
                     forward = -glm::normalize(glm::dvec3(node.to_world[2]));
    made.to_world = {glm::dvec4(glm::cross(forward, up), 0), glm::dvec4(up, 0), glm::dvec4(forward, 0),
                     node.to_world[3]};
  }

  void add_light(const GltfNode& node) {
    const GltfValue lights = root_.extension("KHR_lights_punctual");
    const GltfValue light = node.value.extension("KHR_lights_punctual").item("light", lights, "lights");
    d_.lamps.push_back(light_of(light, node.to_world,
                                name_of(light.text("name"), name_of(node.value.text("name"), "light")), d_.notes));
  }

  GltfValue root_;
  GltfMeshes meshes_;
  Description& d_;
  std::map<std::size_t, glm::dmat4> worlds_; ///< from each node of the scene
  std::map<std::size_t, Alpha> alphas_;      ///< of pictures
  std::map<std::size_t, std::optional<glm::dvec3>> means_;
  /// Of meshes, by mesh, primitive and skin.
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::vector<std::string>> keys_;
  std::map<std::size_t, WeightKeys> weights_; ///< by the node
  std::string animated_by_;                   ///< the animation that they are of
  std::map<std::size_t, std::string> material_names_;
  TakenNames taken_materials_;
};

} // namespace

void describe_gltf(const fs::path& file, Description& into) {
  const GltfFile gltf = read_gltf(file);
  GltfReader(gltf, into);
}

} // namespace nephroid::formats
