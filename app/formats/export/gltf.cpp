// SPDX-License-Identifier: Apache-2.0
#include "formats/export/glb.h"

#include "formats/import/gltf_scene.h"
#include "lights/lights.h"
#include "optics/colour.h"
#include "optics/spectrum.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace nephroid::formats {
namespace {

using Json = Glb::Json;
using std::numbers::pi;

double at(const optics::Spectrum& spectrum, double nm) {
  const double place = nm - optics::first_nm;
  const auto i = static_cast<std::size_t>(place);
  return std::lerp(spectrum[i], spectrum[i + 1], place - std::floor(place));
}

/// Above which values have `part` of the sum of all that is positive; 1 where nothing is.
float clipping(std::vector<float> values, double part) {
  std::ranges::sort(values, std::greater());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0,
                                     [](double so_far, float value) { return so_far + std::max(0.0f, value); });
  if (!(sum > 0)) return 1;
  double above = 0; // what is over the next value
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    above += static_cast<double>(i + 1) * (static_cast<double>(values[i]) - static_cast<double>(values[i + 1]));
    if (above > part * sum) return values[i];
  }
  return values.front();
}

/// A turn that takes -z to `forward` and y near to `up`.
Json turn_to(const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
  const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(right, forward), -forward)));
  return {q.x, q.y, q.z, q.w};
}

/// As triangles, some 3 degrees each.
void add(const scene::Ellipsoid& ellipsoid, scene::Mesh& mesh) {
  constexpr std::uint32_t around = 128, rings = 64;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto& [x, y, z] = ellipsoid.half_axes;
  const bool is_left_handed = glm::dot(glm::cross(x, y), z) < 0;
  for (std::uint32_t ring = 0; ring <= rings; ++ring)
    for (std::uint32_t i = 0; i <= around; ++i) {
      const double polar = ring * pi / rings, turn = i * 2 * pi / around;
      const glm::dvec3 unit(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
      glm::dvec3 place = ellipsoid.centre;
      for (int axis = 0; axis < 3; ++axis)
        place += unit[axis] * glm::dvec3(ellipsoid.half_axes[static_cast<std::size_t>(axis)]);
      mesh.positions.emplace_back(place);
      mesh.normals.emplace_back(scene::normal_at(ellipsoid, place));
      const std::uint32_t corner = first + ring * (around + 1) + i;
      if (ring == rings || i == around) continue;
      glm::uvec3 upper(corner, corner + 1, corner + around + 1),
          lower(corner + 1, corner + around + 2, corner + around + 1);
      if (is_left_handed != ellipsoid.inwards) std::swap(upper.y, upper.z), std::swap(lower.y, lower.z);
      if (ring > 0) mesh.triangles.push_back(upper);
      if (ring + 1 < rings) mesh.triangles.push_back(lower);
    }
}

/// What objects have in common that are one mesh of the file.
using Kind = std::tuple<std::optional<std::string>, std::string, preset::Object::Normals>;
Kind kind_of(const preset::Object& object) { return {object.mesh, object.material, object.normals}; }

class Writer {
public:
  Writer(const scene::Scene& scene, const preset::Preset& preset, const std::vector<Caustic>& caustics)
      : scene_(scene), metres_(scene.metres_per_unit) {
    glb_.json["asset"] = {{"version", "2.0"}, {"generator", "Nephroid"}};
    glb_.json["scene"] = 0;
    glb_.json["scenes"] = {{{"name", preset.name}, {"nodes", Json::array()}}};
    for (const preset::Object& object : preset.scene.objects) ++shared_[kind_of(object)].uses;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const auto caustic =
          std::ranges::find(caustics, static_cast<int>(i), [](const Caustic& c) { return c.receiver.object; });
      if (const preset::Object& meant = preset.scene.objects[i];
          caustic == caustics.end() && meant.mesh && meant.states.empty() && shared_[kind_of(meant)].uses > 1)
        add_instance(scene.objects[i], meant);
      else
        add_object(scene.objects[i], caustic == caustics.end() ? nullptr : &*caustic);
    }
    add_camera();
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      if (const auto light = lights::model(scene.lights[i]).punctual(scene.lights[i]))
        add_light(scene.lights[i], *light, i);
  }

  Glb take() { return std::move(glb_); }

private:
  /// The place in metres, from the scene's coordinates.
  glm::dvec3 placed(const glm::dvec3& p) const { return metres_ * (scene_.origin + p); }

  void add_node(Json node) {
    const std::size_t index = glb_.add("nodes", std::move(node)); // first: it moves what the list is in
    glb_.json["scenes"][0]["nodes"].push_back(index);
  }

  void add_object(const scene::Object& object, const Caustic* caustic) {
    if (is_empty(object)) return;
    const glm::dvec3 middle = object.bounds.centre;
    const scene::Mesh mesh = mesh_of(object);
    std::vector<glm::vec3> positions;
    for (const glm::vec3& p : mesh.positions) positions.emplace_back(metres_ * (glm::dvec3(p) - middle));
    Json attributes{{"POSITION", glb_.positions(positions)}};
    if (object.smooth || object.triangle_count == 0) attributes["NORMAL"] = glb_.normals(mesh.normals);
    if (caustic) {
      const Receiver& r = caustic->receiver;
      std::vector<glm::vec2> places;
      for (const glm::vec3& p : mesh.positions) {
        const glm::dvec3 way = glm::dvec3(p) - r.centre;
        places.emplace_back(0.5 + glm::dot(way, r.right) / r.width, 0.5 - glm::dot(way, r.up) / r.height);
      }
      attributes["TEXCOORD_0"] = glb_.places(places);
    }
    const std::size_t index = add_mesh(object, std::move(attributes), mesh, material_of_object(object, caustic));
    add_node({{"name", object.name}, {"mesh", index}, {"translation", three_numbers(placed(middle))}});
  }

  /// A node with the preset's transform; its mesh is written in its own frame, once.
  void add_instance(const scene::Object& object, const preset::Object& meant) {
    const glm::dvec3 shift = scene::to_dvec3(meant.transform.translate);
    const glm::dmat3 rotation = scene::rotation(meant.transform.rotate_deg);
    glm::dmat3 linear = rotation;
    for (int axis = 0; axis < 3; ++axis) linear[axis] *= meant.transform.scale[static_cast<std::size_t>(axis)];
    SharedMesh& shared = shared_.at(kind_of(meant));
    if (!shared.index) {
      const glm::dmat3 back = glm::inverse(linear);
      const glm::dvec3 middle = object.bounds.centre;
      shared.middle = back * (scene_.origin + middle - shift);
      scene::Mesh mesh = mesh_of(object);
      for (glm::vec3& p : mesh.positions) p = metres_ * (back * (glm::dvec3(p) - middle));
      for (glm::vec3& n : mesh.normals) n = glm::normalize(glm::transpose(linear) * glm::dvec3(n));
      if (glm::determinant(linear) < 0)
        for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
      Json attributes{{"POSITION", glb_.positions(mesh.positions)}};
      if (object.smooth) attributes["NORMAL"] = glb_.normals(mesh.normals);
      shared.index = add_mesh(object, std::move(attributes), mesh, material_of_object(object, nullptr));
    }
    const glm::dquat q = glm::quat_cast(rotation);
    add_node({{"name", object.name},
              {"mesh", *shared.index},
              {"translation", three_numbers(metres_ * (linear * shared.middle + shift))},
              {"rotation", {q.x, q.y, q.z, q.w}},
              {"scale", meant.transform.scale}});
  }

  std::size_t add_mesh(const scene::Object& object, Json attributes, const scene::Mesh& mesh, std::size_t material) {
    const std::size_t corners = glb_.corners(mesh.triangles);
    return glb_.add(
        "meshes",
        {{"name", object.name},
         {"primitives", {{{"attributes", std::move(attributes)}, {"indices", corners}, {"material", material}}}}});
  }

  /// With the vertices that it has alone.
  scene::Mesh mesh_of(const scene::Object& object) const {
    scene::Mesh mesh;
    std::unordered_map<std::uint32_t, std::uint32_t> own;
    for (const glm::uvec3& triangle : scene::triangles_of(scene_, object)) {
      glm::uvec3 corners;
      for (int c = 0; c < 3; ++c) {
        const auto [found, is_new] = own.try_emplace(triangle[c], static_cast<std::uint32_t>(own.size()));
        corners[c] = found->second;
        if (!is_new) continue;
        mesh.positions.push_back(scene_.geometry.positions[triangle[c]]);
        mesh.normals.push_back(scene_.geometry.normals[triangle[c]]);
      }
      mesh.triangles.push_back(corners);
    }
    for (const scene::Ellipsoid& ellipsoid : scene::ellipsoids_of(scene_, object)) add(ellipsoid, mesh);
    return mesh;
  }

  /// A receiver has one of its own.
  std::size_t material_of_object(const scene::Object& object, const Caustic* caustic) {
    if (caustic) return glb_.add("materials", lit(plain(material_of(scene_, object)), object.name, *caustic));
    const auto [found, is_new] = materials_.try_emplace(object.material);
    if (is_new) found->second = glb_.add("materials", plain(material_of(scene_, object)));
    return found->second;
  }

  Json plain(const scatter::Material& material) {
    const scatter::GltfSurface surface = gltf_surface(material);
    Json colour = Json(colour_of_reflectance(surface.base_colour));
    colour.push_back(1);
    Json made{{"name", material.name},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", std::move(colour)},
                {"metallicFactor", surface.metallic},
                {"roughnessFactor", surface.roughness}}}};
    if (surface.transmits)
      add_transmission(made, material);
    else
      made["doubleSided"] = true;
    return made;
  }

  /// The texture holds bytes, whose largest stands for the level above which a hundredth of the caustic's light is.
  Json lit(Json material, const std::string& name, const Caustic& caustic) {
    const image::Image& picture = caustic.irradiance;
    const float most = clipping(picture.data, 0.01);
    std::vector<float> scaled = picture.data;
    for (float& value : scaled) value = std::max(0.0f, value / most);
    const std::size_t png = glb_.png(image::png(picture.width, picture.height, scaled));
    const std::size_t texture = glb_.add("textures", {{"source", png}});
    const Json colour = material["pbrMetallicRoughness"]["baseColorFactor"];
    material["name"] = name + " with its caustic";
    material["emissiveFactor"] = {colour[0], colour[1], colour[2]};
    material["emissiveTexture"] = {{"index", texture}};
    glb_.use("KHR_materials_emissive_strength");
    material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", most * most_lumens / pi}};
    return material;
  }

  void add_transmission(Json& made, const scatter::Material& material) {
    double thickness = 0; // the largest object's, in metres
    for (const scene::Object& object : scene_.objects)
      if (&material_of(scene_, object) == &material)
        thickness = std::max(thickness, 2 * static_cast<double>(object.bounds.radius) * metres_);
    const double n = at(material.n, optics::line_d_nm),
                 spread = at(material.n, optics::line_f_nm) - at(material.n, optics::line_c_nm);
    Json& extensions = made["extensions"];
    extensions["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    extensions["KHR_materials_ior"] = {{"ior", n}};
    if (!material.thin) extensions["KHR_materials_volume"] = {{"thicknessFactor", thickness}};
    if (material.absorbs) {
      optics::Spectrum kept{};
      for (std::size_t w = 0; w < kept.size(); ++w)
        kept[w] = std::exp(-4 * pi * material.k[w] * thickness / (optics::first_nm + static_cast<double>(w)) * 1e9);
      extensions["KHR_materials_volume"]["attenuationDistance"] = thickness;
      extensions["KHR_materials_volume"]["attenuationColor"] = Json(colour_of_reflectance(kept));
    }
    if (n > 1 && spread > 0)
      extensions["KHR_materials_dispersion"] = {{"dispersion", 20 * spread / (n - 1)}}; // 20 over Abbe's number
    for (const auto& [name, value] : extensions.items()) glb_.use(name.c_str());
  }

  void add_camera() {
    const scene::Camera& camera = scene_.camera;
    const glm::dvec3 position = placed(camera.position);
    double farthest = 0;
    for (const scene::Object& object : scene_.objects)
      farthest = std::max(farthest, glm::length(placed(object.bounds.centre) - position) +
                                        metres_ * static_cast<double>(object.bounds.radius));
    Json seen{{"znear", 1e-4 * farthest}, {"zfar", 10 * farthest}};
    if (camera.orthographic)
      seen.update({{"xmag", metres_ * camera.tan_x}, {"ymag", metres_ * camera.tan_y}});
    else
      seen.update(
          {{"yfov", 2 * std::atan(camera.tan_y)}, {"aspectRatio", static_cast<double>(camera.width) / camera.height}});
    const char* const type = camera.orthographic ? "orthographic" : "perspective";
    const std::size_t lens = glb_.add("cameras", {{"type", type}, {type, std::move(seen)}});
    add_node({{"name", "camera"},
              {"camera", lens},
              {"translation", three_numbers(position)},
              {"rotation", turn_to(camera.forward, camera.up)}});
  }

  void add_light(const scene::Light& light, const lights::Punctual& punctual, std::size_t number) {
    const GltfColour colour = colour_of_light(light.spectrum);
    const std::string name = fmt::format("light {}", number);
    Json made{{"name", name},
              {"color", colour.rgb},
              {"type", punctual.type},
              {"intensity", punctual.intensity * colour.luminous_per_watt * most_lumens}};
    if (const auto angle = punctual.half_angle) // the inner one has to be smaller
      made["spot"] = {{"innerConeAngle", 0.999 * *angle}, {"outerConeAngle", *angle}};
    glb_.use("KHR_lights_punctual");
    Json& lights = glb_.json["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(made));
    const glm::dvec3 across = std::abs(light.direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    Json node{{"name", name},
              {"rotation", turn_to(light.direction, across)},
              {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}};
    if (!preset::has(light.type, LIGHT_HAS_IRRADIANCE)) node["translation"] = three_numbers(placed(light.position));
    add_node(std::move(node));
  }

  struct SharedMesh {
    int uses = 0;
    std::optional<std::size_t> index; ///< in the file, where it is written
    glm::dvec3 middle{0};             ///< of the first object that has it, in the mesh's frame
  };

  const scene::Scene& scene_;
  double metres_;
  Glb glb_;
  std::unordered_map<int, std::size_t> materials_;
  std::map<Kind, SharedMesh> shared_;
};

} // namespace

std::array<double, 3> colour_of_reflectance(const optics::Spectrum& reflectance) {
  optics::Spectrum light = optics::illuminant("D65");
  const double white = optics::to_xyz(light)[1];
  for (std::size_t w = 0; w < light.size(); ++w) light[w] *= reflectance[w] / white;
  optics::Colour rgb = optics::xyz_to_linear_srgb(optics::to_xyz(light));
  for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
  return rgb;
}

GltfColour colour_of_light(const optics::Spectrum& spectrum) {
  const optics::Colour xyz = optics::to_xyz(spectrum);
  GltfColour colour{optics::xyz_to_linear_srgb(xyz), 0};
  const double most = std::max({colour.rgb[0], colour.rgb[1], colour.rgb[2]});
  for (double& c : colour.rgb) c = std::max(0.0, c / most);
  colour.luminous_per_watt = xyz[1] / optics::linear_srgb_to_xyz(colour.rgb)[1];
  return colour;
}

Glb gltf_of(const scene::Scene& scene, const preset::Preset& preset, const std::vector<Caustic>& caustics) {
  return Writer(scene, preset, caustics).take();
}

} // namespace nephroid::formats
