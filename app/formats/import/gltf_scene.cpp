// SPDX-License-Identifier: Apache-2.0
#include "formats/import/gltf_scene.h"

#include "base/error.h"
#include "base/lower_case.h"
#include "formats/import/described_colour.h"
#include "formats/import/dielectrics.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scatter/spectra.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nephroid::formats {
namespace {

using std::numbers::pi;

glm::dmat4 local_matrix(const GltfValue& node) {
  if (node.has("matrix")) return glm::make_mat4(node.numbers<16>("matrix", {}).data()); // both list columns
  const auto t = node.numbers<3>("translation", {0, 0, 0}), s = node.numbers<3>("scale", {1, 1, 1});
  const auto [x, y, z, w] = node.numbers<4>("rotation", {0, 0, 0, 1});
  const glm::dmat4 turn = glm::mat4_cast(glm::normalize(glm::dquat(w, x, y, z)));
  return glm::scale(glm::translate(glm::dmat4(1), scene::to_dvec3(t)) * turn, scene::to_dvec3(s));
}

std::vector<std::size_t> roots_of(const GltfValue& root) {
  if (root.list("scenes").empty()) throw bad_input(root.where(), "has no scene", "expected nodes to import");
  return root.item("scenes", root.has("scene") ? root.index("scene", root, "scenes") : 0)
      .indices("nodes", root, "nodes");
}

// In micrometres, as Cauchy's formula has them.
constexpr double line_f = optics::line_f_nm / 1000, line_d = optics::line_d_nm / 1000,
                 line_c = optics::line_c_nm / 1000;

/// The names of those textures of a material that are left out.
std::string textures_left_out(const GltfValue& material, const preset::Material& made) {
  const GltfValue pbr = material.object("pbrMetallicRoughness");
  std::string names;
  const auto add = [&](const GltfValue& from, const char* key) {
    if (from.has(key)) names += (names.empty() ? "" : ", ") + std::string(key);
  };
  if (!is_matt(made.type) && !is_refractive(made.type)) add(pbr, "baseColorTexture");
  if (!takes_roughness_texture(made))
    add(pbr, "metallicRoughnessTexture");
  else if (!is_refractive(made.type) && pbr.has("metallicRoughnessTexture"))
    names += (names.empty() ? "" : ", ") + std::string("the metalness of metallicRoughnessTexture");
  if (made.type != preset::Material::Type::diffuse) add(material, "normalTexture");
  add(material.extension("KHR_materials_transmission"), "transmissionTexture");
  return names;
}

double metal_part(const GltfValue& material) {
  if (material.object("extensions").has("KHR_materials_pbrSpecularGlossiness")) return 0;
  return material.object("pbrMetallicRoughness").number("metallicFactor", 1);
}

/// The part of the light at its surface that goes through; none through metal.
double transmitted_part(const GltfValue& material) {
  return material.extension("KHR_materials_transmission").number("transmissionFactor", 0) * (1 - metal_part(material));
}

preset::Material glass(const GltfValue& material, const std::string& name, std::vector<std::string>& notes) {
  preset::Material glass;
  glass.type = preset::Material::Type::dielectric;
  double ior = material.extension("KHR_materials_ior").number("ior", 1.5);
  if (ior < 1 || ior > 100) {
    notes.push_back(
        fmt::format("material '{}': an index of refraction of {} means nothing here; 1.5 takes its place", name, ior));
    ior = 1.5;
  }
  glass.dispersion = dispersion_of(ior, material.extension("KHR_materials_dispersion").number("dispersion", 0));
  const GltfValue volume = material.extension("KHR_materials_volume");
  glass.thin = volume.number("thicknessFactor", 0) == 0;
  if (glass.thin)
    notes.push_back(fmt::format("material '{}' has no thickness, so light passes it straight on; if it is meant as "
                                "solid glass, and its meshes are closed: --set 'scene.materials.{}.thin=false'",
                                name, name));
  const GltfValue pbr = material.object("pbrMetallicRoughness");
  const auto tint = pbr.numbers<4>("baseColorFactor", {1, 1, 1, 1});
  glass.tint = reflectance_of({tint[0], tint[1], tint[2]});
  if (const double roughness = std::clamp(pbr.number("roughnessFactor", 1), 0.0, 1.0); !glass.thin)
    glass.roughness = roughness;
  else if (roughness > 0.1)
    notes.push_back(fmt::format("material '{}' is a rough pane in the file and a polished one here", name));
  if (const double part = transmitted_part(material); part < 1)
    notes.push_back(
        fmt::format("material '{}' lets {:.3g} of the light through in the file and all of it here, but for "
                    "reflections",
                    name, part));
  return glass;
}

/// What in the file speaks for glass, of a material that is not taken as such; empty where nothing does.
std::string sign_of_glass(const GltfValue& material, const std::string& name) {
  if (const double part = transmitted_part(material); part > 0) return fmt::format("its transmission is {:.3g}", part);
  if (material.extension("KHR_materials_volume").number("thicknessFactor", 0) > 0) return "it has a volume";
  const double alpha = material.object("pbrMetallicRoughness").numbers<4>("baseColorFactor", {1, 1, 1, 1})[3];
  if (material.text("alphaMode") == "BLEND" && alpha < 0.5) return fmt::format("its alpha is {}", alpha);
  for (const char* word : {"glass", "crystal", "diamond", "water", "gem", "quartz", "sapphire", "acrylic", "lens"})
    if (lower_case(name).find(word) != std::string::npos) return "so says its name";
  return {};
}

std::string advice_on_glass(const GltfValue& material, const std::string& name) {
  const std::string sign = sign_of_glass(material, name);
  if (sign.empty()) return {};
  return fmt::format(
      "material '{}' may be meant as glass ({}) and is opaque here; to make it glass, where its meshes are closed: "
      "--set 'scene.materials.{}={{\"type\": \"dielectric\", \"dispersion\": {}}}'",
      name, sign, name, material.extension("KHR_materials_ior").number("ior", 1.5));
}

} // namespace

std::vector<GltfNode> nodes_of(const GltfFile& file) {
  const GltfValue root(file.json, file.where());
  const std::vector<GltfValue> all = root.list("nodes");
  std::vector<bool> seen(all.size());
  std::vector<GltfNode> nodes;
  struct Task {
    std::size_t index;
    glm::dmat4 parent;
    bool is_visible;
  };
  // A list of tasks and no recursion: a file may nest its nodes as deep as it likes.
  std::vector<Task> tasks;
  const auto add = [&](const std::vector<std::size_t>& indices, const glm::dmat4& parent, bool is_visible) {
    for (auto index = indices.rbegin(); index != indices.rend(); ++index) tasks.push_back({*index, parent, is_visible});
  };
  add(roots_of(root), glm::dmat4(1), true);
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const GltfValue& node = all[task.index];
    if (seen[task.index])
      throw bad_input(node.where(), "the node has two parents, or nodes go round in a circle", "expected a tree");
    seen[task.index] = true;
    const bool is_visible = task.is_visible && node.extension("KHR_node_visibility").truth("visible", true);
    nodes.push_back({node, task.index, task.parent * local_matrix(node), is_visible});
    add(node.indices("children", root, "nodes"), nodes.back().to_world, is_visible);
  }
  return nodes;
}

std::optional<preset::Transform> transform_of(const glm::dmat4& matrix) {
  glm::dmat3 axes(matrix);
  glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (std::min({scale.x, scale.y, scale.z}) < 1e-6 || std::max({scale.x, scale.y, scale.z}) > 1e6) return std::nullopt;
  if (glm::determinant(axes) < 0) scale.x = -scale.x; // a mirror
  for (int i = 0; i < 3; ++i) axes[i] /= scale[i];
  for (int i = 0; i < 3; ++i)
    if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > 1e-6) return std::nullopt;
  // R = Rz Ry Rx, so its third row is (-sin y, cos y sin x, cos y cos x) and its first column (cos y cos z, cos y sin
  // z, -sin y).
  const double sin_y = std::clamp(-axes[0][2], -1.0, 1.0), y = std::asin(sin_y);
  const bool pole = std::abs(sin_y) > 1 - 1e-12; // x and z turn about one axis: all of it is x
  const double x = pole ? std::atan2(-axes[2][1], axes[1][1]) : std::atan2(axes[1][2], axes[2][2]);
  const double z = pole ? 0 : std::atan2(axes[0][1], axes[0][0]);
  preset::Transform transform;
  for (std::size_t i = 0; i < 3; ++i) {
    transform.scale[i] = scale[static_cast<int>(i)];
    transform.translate[i] = matrix[3][static_cast<int>(i)];
    if (!std::isfinite(transform.translate[i]) || std::abs(transform.translate[i]) > 1e7) return std::nullopt;
  }
  transform.rotate_deg = {glm::degrees(x), glm::degrees(y), glm::degrees(z)};
  return transform;
}

preset::Dispersion dispersion_of(double ior, double dispersion) {
  preset::Dispersion glass;
  if (!(dispersion > 0)) {
    glass.n = ior;
    return glass;
  }
  const double abbe = 20 / dispersion;
  const double b = (ior - 1) / (abbe * (1 / (line_f * line_f) - 1 / (line_c * line_c)));
  glass.type = preset::Dispersion::Type::cauchy;
  glass.coefficients = {ior - b / (line_d * line_d), b};
  return glass;
}

std::string absorbing_glass_file(const GltfValue& material, const preset::Dispersion& clear) {
  const GltfValue volume = material.extension("KHR_materials_volume");
  const double distance = volume.number("attenuationDistance", 0);
  const auto colour = volume.numbers<3>("attenuationColor", {1, 1, 1});
  if (!(distance > 0) || volume.number("thicknessFactor", 0) == 0 || colour == std::array<double, 3>{1, 1, 1})
    return {};
  constexpr double least = 1e-4; // black glass has no k
  optics::Spectrum absorption = scatter::make_reflectance(reflectance_of(colour), "attenuationColor");
  for (double& a : absorption) a = std::log(1 / std::max(a, least)) / distance; // in 1/m: the file's lengths are metres
  return absorbing_glass_file(clear, absorption,
                              "n as KHR_materials_ior and KHR_materials_dispersion say it, k as "
                              "KHR_materials_volume does");
}

preset::Reflectance reflectance_of(const std::array<double, 3>& rgb) {
  preset::Reflectance reflectance;
  std::array<double, 3> colour = rgb;
  for (double& c : colour) c = std::clamp(c, 0.0, 1.0);
  reflectance.value = colour[1];
  if (std::abs(colour[0] - colour[1]) < 1e-3 && std::abs(colour[2] - colour[1]) < 1e-3) return reflectance;
  // sRGB's primaries add up to D65, under which a reflectance of 1 is white.
  const optics::Spectrum d65 = optics::illuminant("D65");
  const double white = optics::to_xyz(d65)[1];
  reflectance.type = preset::Reflectance::Type::table;
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10) {
    const auto i = static_cast<std::size_t>(nm - optics::first_nm);
    double power = 0;
    for (std::size_t c = 0; c < 3; ++c) power += colour[c] * optics::primary_spectra()[c][i];
    reflectance.table.push_back({static_cast<double>(nm), std::clamp(power * white / d65[i], 0.0, 1.0)});
  }
  return reflectance;
}

bool takes_roughness_texture(const preset::Material& material) {
  return is_specular(material.type) && material.type != preset::Material::Type::plastic && material.roughness > 0;
}

namespace {

preset::Material material_without_textures(const GltfValue& value, const std::string& name,
                                           std::vector<std::string>& notes) {
  const bool is_glass = transmitted_part(value) >= 0.5, is_metal = metal_part(value) >= 0.5;
  const bool shines = value.numbers<3>("emissiveFactor", {0, 0, 0}) != std::array<double, 3>{0, 0, 0};
  if (shines && is_glass)
    notes.push_back(fmt::format("material '{}' does not shine here: only matt and metal surfaces do", name));
  if (is_glass) return glass(value, name, notes);
  const GltfValue pbr = value.object("pbrMetallicRoughness");
  const GltfValue older = value.extension("KHR_materials_pbrSpecularGlossiness"); // takes the other's place
  const bool is_older = value.object("extensions").has("KHR_materials_pbrSpecularGlossiness");
  const auto base =
      is_older ? older.numbers<4>("diffuseFactor", {1, 1, 1, 1}) : pbr.numbers<4>("baseColorFactor", {1, 1, 1, 1});
  preset::Material material;
  material.reflectance = reflectance_of({base[0], base[1], base[2]});
  const double roughness = pbr.number("roughnessFactor", 1);
  if (is_metal) {
    material.type = preset::Material::Type::mirror;
    material.roughness = std::clamp(roughness, 0.0, 1.0);
  }
  const GltfValue varnish = value.extension("KHR_materials_clearcoat");
  const bool is_varnished = varnish.number("clearcoatFactor", 0) >= 0.5;
  if (!is_metal && !is_older && (roughness < 0.5 || is_varnished))
    make_plastic(material, value.extension("KHR_materials_ior").number("ior", 1.5),
                 std::clamp(is_varnished ? varnish.number("clearcoatRoughnessFactor", 0) : roughness, 0.0, 1.0), false);
  else if (is_metal && is_varnished)
    notes.push_back(fmt::format("material '{}' has no clear coat here", name));
  if (is_metal && value.extension("KHR_materials_transmission").number("transmissionFactor", 0) > 0)
    notes.push_back(fmt::format("material '{}': no light goes through it in the file either, as it is metal", name));
  if (std::string advice = advice_on_glass(value, name); !advice.empty())
    notes.push_back(std::move(advice));
  else if (base[3] < 1 && value.text("alphaMode") == "BLEND")
    notes.push_back(fmt::format("material '{}' is opaque here", name));
  return material;
}

} // namespace

preset::Material material_of(const GltfValue& value, const std::string& name, std::vector<std::string>& notes) {
  preset::Material made = material_without_textures(value, name, notes);
  if (const std::string textures = textures_left_out(value, made); !textures.empty())
    notes.push_back(fmt::format("material '{}': {} left out", name, textures));
  return made;
}

double lumens_per_watt(const optics::Spectrum& spectrum) {
  return most_lumens * optics::to_xyz(spectrum)[1] / std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
}

std::array<double, 3> emission_of(const GltfValue& material) {
  const double strength = material.extension("KHR_materials_emissive_strength").number("emissiveStrength", 1);
  std::array<double, 3> rgb = material.numbers<3>("emissiveFactor", {0, 0, 0});
  const bool shines = transmitted_part(material) < 0.5;
  for (double& x : rgb) x = shines ? std::max(x * strength, 0.0) : 0;
  return rgb;
}

LightColour light_colour(const std::array<double, 3>& rgb) {
  std::array<double, 3> colour = rgb;
  for (double& c : colour) c = std::max(c, 0.0);
  const double luminance = optics::linear_srgb_to_xyz(colour)[1];
  LightColour light; // D65
  const double largest = std::max({colour[0], colour[1], colour[2]}),
               least = std::min({colour[0], colour[1], colour[2]});
  if (!(largest > 0)) return light; // black: no watts
  if (largest - least < 1e-3 * largest) {
    light.watts_per_lumen = luminance / lumens_per_watt(optics::illuminant("D65"));
    return light;
  }
  for (double& c : colour) c /= largest;
  const optics::Spectrum spectrum = optics::light_of_colour(colour);
  light.spectrum.type = preset::LightSpectrum::Type::table;
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 5)
    light.spectrum.table.push_back(
        {static_cast<double>(nm), spectrum[static_cast<std::size_t>(nm - optics::first_nm)]});
  light.watts_per_lumen = luminance / lumens_per_watt(scatter::make_light_spectrum(light.spectrum, "spectrum"));
  return light;
}

preset::Light light_of(const GltfValue& value, const glm::dmat4& to_world, const std::string& name,
                       std::vector<std::string>& notes) {
  preset::Light light;
  const std::string type = value.text("type");
  const LightColour colour = light_colour(value.numbers<3>("color", {1, 1, 1}));
  const double intensity = std::max(0.0, value.number("intensity", 1));
  light.spectrum = colour.spectrum;
  light.position = scene::to_vec3(glm::dvec3(to_world[3]));
  const glm::dvec3 forward = -glm::dvec3(to_world[2]);
  light.direction = glm::length(forward) > 0 ? scene::to_vec3(glm::normalize(forward)) : preset::Vec3{0, 0, -1};
  if (type == "point") {
    light.power_w = 4 * pi * intensity * colour.watts_per_lumen; // candela over the whole sphere
  } else if (type == "spot") {
    const GltfValue spot = value.object("spot");
    const double outer = std::clamp(spot.number("outerConeAngle", pi / 4), 1e-3, pi / 2),
                 inner = spot.number("innerConeAngle", 0);
    light.type = preset::Light::Type::spot;
    light.half_angle_deg = outer * 180 / pi;
    // From the inner cone's edge to the outer one's the intensity falls with the square of a cosine's way to the edge:
    // the integral of that is a third.
    const double at_edge = std::cos(outer), inside = 1 - std::cos(std::clamp(inner, 0.0, outer));
    light.power_w = 2 * pi * (inside + (1 - inside - at_edge) / 3) * intensity * colour.watts_per_lumen;
    if (inner < 0.99 * outer)
      notes.push_back(
          fmt::format("light '{}' fades towards the edge of its cone in the file; here the same light is even", name));
  } else if (type == "directional") {
    light.type = preset::Light::Type::directional;
    light.irradiance_w_m2 = intensity * colour.watts_per_lumen;
  } else
    throw bad_input(value.where() / "type", "is \"" + type + "\"", "expected point, spot or directional");
  if (value.has("range"))
    notes.push_back(fmt::format("light '{}' ends at a range in the file and does not here", name));
  return light;
}

double luminous_irradiance(const preset::Light& light, const glm::dvec3& at) {
  const double seen = lumens_per_watt(scatter::make_light_spectrum(light.spectrum, "spectrum")) / most_lumens;
  if (light.type == preset::Light::Type::directional) return light.irradiance_w_m2 * seen;
  const glm::dvec3 way = at - scene::to_dvec3(light.position);
  const bool spot = light.type == preset::Light::Type::spot;
  const double solid_angle = spot ? 2 * pi * (1 - std::cos(light.half_angle_deg * pi / 180)) : 4 * pi;
  return light.power_w * seen / (solid_angle * std::max(glm::dot(way, way), 1e-6));
}

} // namespace nephroid::formats
