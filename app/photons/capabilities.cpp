// SPDX-License-Identifier: Apache-2.0
#include "photons/capabilities.h"

#include "base/counted.h"
#include "lights/lights.h"
#include "photons/describe_settings.h"
#include "tracing/omissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace nephroid::photons {
namespace {

using Estimator = Settings::Estimator;
using Effort = Settings::Effort;

/// What a scene or a setting may ask of a way to estimate light.
struct Demand {
  const char* who; ///< the subject of a sentence
  bool (*is_there)(const Settings&, const scene::Scene&);
};

template <bool (*is)(const scatter::Material&)>
bool of_materials(const Settings&, const scene::Scene& scene) {
  return any_material(scene, is);
}

template <Estimator estimator>
bool of_estimator(const Settings& settings, const scene::Scene&) {
  return settings.estimator == estimator;
}

/// Whether the environment is a light.
bool environment_lights(const Settings&, const scene::Scene& scene) {
  return scene.environment && scene.environment->lights && !scene.environment->is_black();
}

bool object_shines(const Settings&, const scene::Scene& scene) {
  return std::ranges::any_of(scene.lights, [&](const scene::Light& light) {
    return light.object >= 0 && is_matt(material_of(scene, scene.objects[static_cast<std::size_t>(light.object)]).type);
  });
}

constexpr Demand rough{"a rough surface", of_materials<scatter::is_rough>};
constexpr Demand coating{"a coating", of_materials<scatter::is_coated>};
constexpr Demand glazing{"a glazing", of_materials<scatter::is_tabulated>};
constexpr Demand plastic{"plastic", of_materials<scatter::has_coat>};
constexpr Demand texture{"a texture", of_materials<scatter::has_pictures>};
constexpr Demand shining{"an object that shines", object_shines};
constexpr Demand sky{"an environment that lights", environment_lights};
constexpr Demand sppm{"the estimator sppm", of_estimator<Estimator::sppm>};
constexpr Demand tiles{"the estimator tiles", of_estimator<Estimator::tiles>};
constexpr Demand lens{"a camera with a lens, a shift or parallel rays",
                      [](const Settings&, const scene::Scene& scene) { return !scene.camera.is_plain(); }};
constexpr Demand whole_clusters{"spectral.jitter false",
                                [](const Settings& s, const scene::Scene&) { return !s.jitter; }};
constexpr Demand walls{"spectral.indirect",
                       [](const Settings& s, const scene::Scene&) { return s.indirect.value_or(false); }};
constexpr Demand allotted{"spectral.effort", [](const Settings& s, const scene::Scene&) {
                            return s.effort != Effort::automatic && s.effort != Effort::power;
                          }};
constexpr Demand one_film{"an estimator that is not sppm",
                          [](const Settings& s, const scene::Scene&) { return s.estimator != Estimator::sppm; }};

/// What a way cannot do, and why: the rest of a sentence about the demand.
struct Limit {
  const Demand& demand;
  const char* why;
};

constexpr Limit limits_of_layers[] = {{coating, "splits the wavelengths of a cluster, which a layer holds together"},
                                      {glazing, "leaves each wavelength another part, and a layer is of one loss"},
                                      {plastic, "reflects a part of the light, and a layer holds what is scattered"},
                                      {texture, "has many colours, and a layer is of one"},
                                      {shining, "sends light of its own, and a layer holds what is scattered"},
                                      {lens, "sees otherwise than a pinhole, from which layers are seen"},
                                      {sky, "has a spectrum for each texel, and a layer is of one light's"},
                                      {walls, "is light that met several reflectors, and a layer is of one"},
                                      {sppm, "adds up colours, not layers"},
                                      {tiles, "sweeps a part of the wavelengths, and a layer holds whole clusters"},
                                      {allotted, "goes by the present light, and layers are for lights to come"}};
constexpr Limit limits_of_tiles[] = {{coating, "reflects each wavelength otherwise"},
                                     {lens, "sees points only"},
                                     {rough, "scatters the corners of a tile"},
                                     {plastic, "reflects a part of the light, which tiles do not follow"},
                                     {texture, "has many colours, and a tile has one"},
                                     {whole_clusters, "sends a cluster one way, and tiles sweep it"}};
constexpr Limit limits_of_whole_clusters[] = {{coating, "reflects each wavelength otherwise"}};
constexpr Limit limits_of_variance[] = {{sppm, "has no film that all photons share"},
                                        {tiles, "sends its photons on lattices"}};
constexpr Limit limits_of_random[] = {{one_film, "has no pass of its own for each cluster"}};

/// A clause for each demand that these limits exclude; empty where there is none.
std::string why_not(std::span<const Limit> limits, const Settings& settings, const scene::Scene& scene) {
  std::vector<std::string> clauses;
  for (const Limit& limit : limits)
    if (limit.demand.is_there(settings, scene)) clauses.push_back(fmt::format("{} {}", limit.demand.who, limit.why));
  return fmt::format("{}", fmt::join(clauses, "; "));
}

/// Whether two objects of glass meet, or one is in the other, as far as the spheres about them tell.
bool glass_meets_glass(const scene::Scene& scene) {
  std::vector<scene::Sphere> bodies;
  for (const scene::Object& object : scene.objects)
    if (is_specular(material_of(scene, object).type)) bodies.push_back(object.bounds);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (glm::distance(bodies[i].centre, bodies[j].centre) < bodies[i].radius + bodies[j].radius) return true;
  return false;
}

/// Why points have less error than tiles, which could be (docs/notebook/tiles.md); empty where they have more.
std::string why_points(const Settings& wanted, const scene::Scene& scene) {
  if (wanted.method == Settings::Method::brute_force || wanted.effort != Effort::automatic || !wanted.low_discrepancy)
    return "spectral.method, effort or low_discrepancy ask for points";
  if (environment_lights(wanted, scene))
    return "an environment has too many directions: a lattice for each would be coarse";
  if (std::ranges::any_of(
          scene.lights, [](const scene::Light& light) { return !is_environment(light) && lights::has_places(light); }))
    return "a lamp of a size has too many places: a lattice for each would be coarse";
  if (tracing::count_objects(scene).mirrors > 0) return "mirrors spread a cell too far";
  if (glass_meets_glass(scene)) return "glass meets glass: photons would have too many branches";
  constexpr std::uint32_t most_facets = 40, most_smooth = 4096;
  std::uint32_t facets = 0, smooth = 0; // triangles of glass
  for (const scene::Object& object : scene.objects)
    if (is_specular(material_of(scene, object).type)) (object.smooth ? smooth : facets) += object.triangle_count;
  if (facets > most_facets || smooth > most_smooth)
    return fmt::format("glass has {}: a cell would meet several at once", counted(facets + smooth, "triangle"));
  return "";
}

/// Why diffuse surfaces do not light each other; empty where they may.
std::string why_no_indirect(const scene::Scene& scene) {
  std::optional<scene::Plane> plane;
  for (const scene::Object& object : scene.objects) {
    if (!is_matt(material_of(scene, object).type)) continue;
    if (!plane && !(plane = plane_of(scene, object))) return "";
    bool is_outside = false;
    for_each_corner(scene, object, [&](const glm::dvec3& p) {
      is_outside = is_outside || std::abs(plane->height(p)) > plane->tolerance;
    });
    if (is_outside) return "";
  }
  if (!plane) return "";
  const tracing::ObjectCounts counts = tracing::count_objects(scene);
  if (counts.mirrors > 0) return "";
  return counts.throw_caustics()
             ? "diffuse surfaces are in one plane; spectral.indirect true adds what glass throws back at it"
             : "diffuse surfaces are in one plane, and light none of it";
}

} // namespace

Agreed agree(const Settings& wanted, const scene::Scene& scene) {
  Agreed agreed;
  Settings& s = agreed.settings = wanted;
  // Empty where the value of a field can be done; else its note is written.
  const auto why_other = [&](const char* field, const char* value, std::span<const Limit> limits, const char* instead) {
    std::string why = why_not(limits, s, scene);
    if (!why.empty())
      agreed.notes.push_back(
          fmt::format("spectral.{}: {} cannot be done here, so it is {}: {}", field, value, instead, why));
    return why;
  };
  if (!s.jitter) s.jitter = !why_other("jitter", "false", limits_of_whole_clusters, "true").empty();
  std::string no_tiles; // though they are wanted
  if (s.estimator == Estimator::tiles) {
    no_tiles = why_other("estimator", "tiles", limits_of_tiles, "points");
    if (!no_tiles.empty()) s.estimator = Estimator::points;
  }
  if ((s.effort == Effort::variance && !why_other("effort", "variance", limits_of_variance, "automatic").empty()) ||
      (s.effort == Effort::random && !why_other("effort", "random", limits_of_random, "automatic").empty()))
    s.effort = Effort::automatic;
  agreed.why_no_layers = why_not(limits_of_layers, s, scene);
  if (s.relight) s.relight = why_other("relight", "true", limits_of_layers, "false").empty();
  if (s.estimator == Estimator::automatic) {
    std::string why =
        s.relight ? "spectral.relight is true: layers hold whole clusters" : why_not(limits_of_tiles, s, scene);
    if (why.empty()) why = why_points(s, scene);
    s.estimator = why.empty() ? Estimator::tiles : Estimator::points;
    agreed.tiles = {"tiles", why.empty(),
                    why.empty() ? "each photon lights the piece that its cell of a lattice stands for" : why};
  } else
    agreed.tiles = {"tiles", s.estimator == Estimator::tiles,
                    no_tiles.empty() ? fmt::format("spectral.estimator is {}", preset::word(s.estimator)) : no_tiles};
  if (!s.indirect) {
    // By what is wanted, not by what is agreed: so is a reference's, which has no layers.
    agreed.why_no_indirect =
        wanted.relight ? "spectral.relight is true, and layers are of one reflector each" : why_no_indirect(scene);
    s.indirect = agreed.why_no_indirect.empty();
  } else if (!*s.indirect)
    agreed.why_no_indirect = "spectral.indirect is false";
  return agreed;
}

std::string why_no_differentials(const scene::Scene& scene) { return why_not(limits_of_whole_clusters, {}, scene); }

} // namespace nephroid::photons
