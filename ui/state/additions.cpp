// SPDX-License-Identifier: Apache-2.0
#include "ui/state/additions.h"

#include "base/files.h"
#include "preset/settings_type.h"
#include "scene/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::ui {
namespace {

using Kind = Selection::Kind;
using scene::Bounds;
using scene::to_dvec3;

/// What an object takes up, in the preset's coordinates.
struct Body {
  Bounds box;
  bool room = false; ///< its inside is where everything is
};

bool holds(const Bounds& box, const glm::dvec3& p) {
  return glm::all(glm::lessThan(box.low, p)) && glm::all(glm::lessThan(p, box.high));
}

/// What has heights without them, as a box.
preset::Shape plain(preset::Shape shape) {
  const bool relief = shape.type == preset::Shape::Type::relief;
  if (relief || shape.type == preset::Shape::Type::water) shape.type = preset::Shape::Type::box;
  if (relief) shape.size[1] += 2 * shape.height; // on both sides of its middle
  return shape;
}

/// Those of the objects that can be read; a run says what is wrong with the others.
std::vector<Body> bodies_of(const preset::Preset& preset) {
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  const glm::dvec3 eye = to_dvec3(preset.scene.camera.position);
  std::vector<Body> bodies;
  for (const preset::Object& object : preset.scene.objects) try {
      const auto mesh = object.shape ? std::make_shared<const scene::Mesh>(scene::make_shape(plain(*object.shape)))
                                     : scene::load_mesh_once(finder.find(object.mesh.value_or(""), {}));
      glm::dmat3 linear = scene::rotation(object.transform.rotate_deg);
      for (int i = 0; i < 3; ++i) linear[i] *= object.transform.scale[static_cast<std::size_t>(i)];
      const glm::dvec3 offset = to_dvec3(object.transform.translate);
      Body body;
      const auto add = [&](const glm::dvec3& p, const glm::dvec3& about) {
        const glm::dvec3 at = linear * (mesh->middle + p) + offset;
        body.box = scene::enclosing(body.box, {at - about, at + about});
      };
      for (const glm::vec3& p : mesh->positions) add(p, {});
      for (const scene::Ellipsoid& ellipsoid : mesh->ellipsoids) {
        glm::dvec3 squares(0);
        for (const glm::vec3& axis : ellipsoid.half_axes)
          squares += glm::dvec3(linear * glm::dvec3(axis)) * (linear * glm::dvec3(axis));
        add(ellipsoid.centre, glm::sqrt(squares));
      }
      body.room = (object.shape && object.shape->inwards) || holds(body.box, eye);
      bodies.push_back(body);
    } catch (const std::exception&) {
      continue;
    }
  return bodies;
}

/// Unit vectors on the ground: to the right of the camera, and away from it.
struct GroundAxes {
  glm::dvec3 right{1, 0, 0}, away{0, 0, -1};
};
GroundAxes ground_axes(const preset::Camera& camera) {
  const glm::dvec3 forward = to_dvec3(camera.target) - to_dvec3(camera.position), up = to_dvec3(camera.up);
  glm::dvec3 right = glm::cross(forward, up);
  right.y = 0;
  if (!(glm::length(right) > 1e-6 * glm::length(forward) * glm::length(up))) return {};
  right = glm::normalize(right);
  return {right, glm::cross(glm::dvec3(0, 1, 0), right)};
}

/// Whether the picture's middle part shows the point.
bool is_seen(const preset::Camera& camera, const glm::dvec3& p) {
  const glm::dvec3 forward = glm::normalize(to_dvec3(camera.target) - to_dvec3(camera.position)),
                   right = glm::normalize(glm::cross(forward, to_dvec3(camera.up))), up = glm::cross(right, forward),
                   arm = p - to_dvec3(camera.position);
  const bool parallel = camera.projection == preset::Camera::Projection::orthographic;
  const double ahead = glm::dot(arm, forward),
               high = 0.4 * preset::height_at_target(camera) * (parallel ? 1 : ahead / preset::target_distance(camera));
  return ahead > 0 && std::abs(glm::dot(arm, up)) < high &&
         std::abs(glm::dot(arm, right)) < high * camera.resolution[0] / camera.resolution[1];
}

/// The height of what is below the target and as wide as the foot of a body there.
std::optional<double> ground_at(const std::vector<Body>& bodies, const glm::dvec3& at, const glm::dvec3& size) {
  std::optional<double> ground;
  for (const auto& [box, room] : bodies) {
    const double top = room ? box.low.y : box.high.y;
    const bool below = box.low.x <= at.x - size.x / 2 && box.high.x >= at.x + size.x / 2 &&
                       box.low.z <= at.z - size.z / 2 && box.high.z >= at.z + size.z / 2 && top <= at.y + size.y / 100;
    if (below) ground = std::max(ground.value_or(top), top);
  }
  return ground;
}

bool is_free(const std::vector<Body>& bodies, const Bounds& box) {
  const glm::dvec3 play = (box.high - box.low) / 1000.0; // what stands on something touches it
  return std::ranges::none_of(bodies, [&](const Body& body) {
    return !body.room && glm::all(glm::lessThan(body.box.low + play, box.high)) &&
           glm::all(glm::lessThan(box.low + play, body.box.high));
  });
}

glm::dvec3 free_place(const preset::Camera& camera, const std::vector<Body>& bodies, const glm::dvec3& size) {
  const glm::dvec3 target = to_dvec3(camera.target);
  const auto [right, away] = ground_axes(camera);
  const double step = 0.4 * std::max(size.x, size.z);
  const std::optional<double> below_target = ground_at(bodies, target, size);
  glm::dvec3 best = target;
  double least = std::numeric_limits<double>::infinity();
  for (int row = -20; row <= 20; ++row)
    for (int column = -20; column <= 20; ++column) {
      glm::dvec3 at = target + step * (double(column) * right + double(row) * away);
      const auto ground = ground_at(bodies, at, size);
      at.y = ground.value_or(below_target.value_or(target.y));
      const glm::dvec3 half{size.x / 2, 0, size.z / 2};
      if (!is_free(bodies, {at - half, at + half + glm::dvec3(0, size.y, 0)})) continue;
      // To the right before to the left, and aside before away; in sight and on the ground before all that.
      const double cost = std::hypot(column, 1.1 * row) - 0.01 * column + 0.005 * row +
                          (below_target && !ground ? 100 : 0) +
                          (is_seen(camera, at + glm::dvec3(0, size.y / 2, 0)) ? 0 : 50);
      if (cost < least) least = cost, best = at;
    }
  return best;
}

/// A light and plain diffuse material; without one new white.
std::string white_of(preset::Scene& scene) {
  using Type = preset::Material::Type;
  for (const auto& [name, material] : scene.materials)
    if (material.type == Type::diffuse && !material.texture &&
        material.reflectance.type == preset::Reflectance::Type::constant && material.reflectance.value >= 0.5)
      return name;
  const std::string name = untaken_name("white", [&](const std::string& n) { return scene.materials.contains(n); });
  scene.materials[name].type = Type::diffuse;
  return name;
}

Selection add_object(preset::Scene& scene, const char* name, const preset::Shape& shape, std::string material,
                     const preset::Vec3& place) {
  preset::Object object;
  object.name = untaken_name(
      name, [&](const std::string& n) { return std::ranges::count(scene.objects, n, &preset::Object::name) > 0; });
  object.shape = shape;
  object.material = std::move(material);
  object.transform.translate = place;
  scene.objects.push_back(std::move(object));
  return {Kind::object, scene.objects.size() - 1};
}

Selection add_ball(preset::Preset& preset, Thing thing) {
  preset::Shape shape;
  shape.radius = with_digits(0.15 * view_at_target(preset.scene.camera), 2);
  const double size = 2 * shape.radius;
  glm::dvec3 place = ui::free_place(preset, glm::dvec3(size));
  place.y += shape.radius;
  const bool glass = thing == Thing::glass;
  std::string material = glass ? glass_of(preset.scene) : white_of(preset.scene);
  return add_object(preset.scene, glass ? "glass" : "sphere", shape, std::move(material), rounded_place(place, size));
}

/// A floor for what hangs in the air; a slab where there is a floor.
Selection add_table(preset::Preset& preset) {
  const preset::Camera& camera = preset.scene.camera;
  const std::vector<Body> bodies = bodies_of(preset);
  const double view = view_at_target(camera), edge = with_digits(0.6 * view, 2), wide = with_digits(4 * view, 2);
  glm::dvec3 place = to_dvec3(camera.target);
  preset::Shape shape;
  if (ground_at(bodies, place, glm::dvec3(edge))) {
    shape.type = preset::Shape::Type::box;
    shape.size = {edge, edge / 4, edge};
    place = free_place(camera, bodies, to_dvec3(shape.size));
    place.y += shape.size[1] / 2;
  } else {
    shape.type = preset::Shape::Type::quad;
    shape.size = {wide, 1, wide};
    for (const Body& body : bodies) place.y = std::min(place.y, body.box.low.y);
  }
  std::string material = white_of(preset.scene);
  return add_object(preset.scene, "table", shape, std::move(material), rounded_place(place, edge));
}

/// The way to a sun that stands at the left, behind what the camera looks at: shadows and caustics come to the front.
glm::dvec3 ground_way_to_sun(const preset::Camera& camera) {
  const auto [right, away] = ground_axes(camera);
  return glm::normalize(0.6 * away - right);
}

Selection add_lamp(preset::Preset& preset) {
  preset::Scene& scene = preset.scene;
  const std::vector<Body> bodies = bodies_of(preset);
  const double view = view_at_target(scene.camera);
  const auto [right, away] = ground_axes(scene.camera);
  const auto is_good = [&](const glm::dvec3& p) {
    return std::ranges::all_of(bodies, [&](const Body& body) { return holds(body.box, p) == body.room; }) &&
           std::ranges::none_of(scene.lights, [&](const preset::Light& light) {
             return preset::has(light.type, LIGHT_HAS_POSITION) &&
                    glm::distance(to_dvec3(light.position), p) < view / 8;
           });
  };
  const glm::dvec3 target = to_dvec3(scene.camera.target);
  glm::dvec3 place = target;
  bool found = false;
  for (int higher = 0; higher < 4 && !found; ++higher)
    for (const int aside : {-1, 1, -2, 2, 0, -3, 3}) {
      place = target + view * (0.18 * aside * right + 0.1 * away + glm::dvec3(0, 0.42 + 0.3 * higher, 0));
      if ((found = is_good(place))) break;
    }
  preset::Light lamp;
  lamp.position = rounded_place(place, view);
  lamp.power_w = 10;
  for (const preset::Light& light : scene.lights) lamp.power_w = std::max(lamp.power_w, light.power_w);
  scene.lights.push_back(lamp);
  return {Kind::light, scene.lights.size() - 1};
}

Selection add_sun(preset::Scene& scene) {
  preset::Light sun;
  sun.type = preset::Light::Type::directional;
  sun.irradiance_w_m2 = 500; // of 380 to 780 nm, at noon
  sun.angular_diameter_deg = 0.533;
  const glm::dvec3 way = ground_way_to_sun(scene.camera);
  for (int turn = 0; turn < 12; ++turn) { // a second one stands elsewhere
    const double angle = turn * std::numbers::pi / 6, c = std::cos(angle), s = std::sin(angle);
    const glm::dvec3 direction{-(c * way.x + s * way.z), -1.2, -(c * way.z - s * way.x)};
    for (std::size_t i = 0; i < 3; ++i) sun.direction[i] = rounded(direction[static_cast<int>(i)], 3);
    if (std::ranges::count(scene.lights, sun.direction, &preset::Light::direction) == 0) break;
  }
  scene.lights.push_back(sun);
  return {Kind::light, scene.lights.size() - 1};
}

/// Today at noon in Crete, where the sun is high on any day, turned so that it stands as an added sun does.
Selection add_sky(preset::Scene& scene) {
  const auto days = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day today(days);
  preset::Environment sky;
  sky.type = preset::Environment::Type::sky;
  sky.lights = true;
  sky.place = preset::PlaceAndTime{
      .latitude_deg = 35.3,
      .longitude_deg = 25.1,
      .date = fmt::format("{:04}-{:02}-{:02}", std::min(static_cast<int>(today.year()), 2050),
                          static_cast<unsigned>(today.month()), static_cast<unsigned>(today.day())),
      .hour = 12,
      .utc_offset_h = 2};
  const glm::dvec3 way = ground_way_to_sun(scene.camera); // at noon the sun is in the south, +z
  sky.rotate_deg = std::round(std::atan2(way.x, way.z) * 180 / std::numbers::pi);
  scene.environment = sky;
  return {Kind::environment, 0};
}

Selection add(preset::Preset& preset, Thing thing) {
  switch (thing) {
  case Thing::sphere:
  case Thing::glass: return add_ball(preset, thing);
  case Thing::table: return add_table(preset);
  case Thing::lamp: return add_lamp(preset);
  case Thing::sun: return add_sun(preset.scene);
  case Thing::sky: return add_sky(preset.scene);
  }
  return {};
}

} // namespace

double view_at_target(const preset::Camera& camera) {
  return preset::height_at_target(camera) *
         std::min(1.0, static_cast<double>(camera.resolution[0]) / camera.resolution[1]);
}

glm::dvec3 free_place(const preset::Preset& preset, const glm::dvec3& size) {
  return free_place(preset.scene.camera, bodies_of(preset), size);
}

std::string glass_of(preset::Scene& scene) {
  for (const auto& [name, material] : scene.materials)
    if (is_body(material)) return name;
  const std::string name = untaken_name("glass", [&](const std::string& n) { return scene.materials.contains(n); });
  preset::Material& glass = scene.materials[name];
  glass.type = preset::Material::Type::dielectric;
  glass.dispersion.type = preset::Dispersion::Type::file;
  glass.dispersion.file = "N-BK7";
  return name;
}

Addition with_thing(preset::Preset preset, Thing thing) {
  const Selection selection = add(preset, thing);
  if (selection.kind != Kind::object && preset::has_white(preset)) preset.white.reset();
  return {std::move(preset), selection};
}

preset::Preset without_thing(preset::Preset preset, const Selection& selection) {
  preset::Scene& scene = preset.scene;
  const auto index = static_cast<std::ptrdiff_t>(selection.index);
  if (selection.kind == Kind::object) {
    const std::string name = scene.objects[selection.index].name;
    scene.objects.erase(scene.objects.begin() + index);
    if (!name.empty())
      std::erase_if(scene.lights, [&](const preset::Light& light) {
        return light.type == preset::Light::Type::mesh && light.object == name;
      });
  } else if (selection.kind == Kind::light)
    scene.lights.erase(scene.lights.begin() + index);
  else if (selection.kind == Kind::environment)
    scene.environment.reset();
  return preset;
}

preset::Camera camera_on_all(const preset::Preset& preset) {
  preset::Camera camera = preset.scene.camera;
  Bounds all, floors;
  for (const Body& body : bodies_of(preset)) {
    if (body.room) continue;
    const glm::dvec3 edges = body.box.high - body.box.low;
    const bool flat = std::min({edges.x, edges.y, edges.z}) < 1e-3 * std::max({edges.x, edges.y, edges.z});
    (flat ? floors : all) = scene::enclosing(flat ? floors : all, body.box);
  }
  if (all.low.x > all.high.x) all = floors;
  if (all.low.x > all.high.x) return camera;
  const glm::dvec3 middle = 0.5 * all.low + 0.5 * all.high, edges = all.high - all.low;
  const glm::dvec3 way = glm::normalize(to_dvec3(camera.position) - to_dvec3(camera.target));
  camera.target = rounded_place(middle, glm::length(edges));
  // Twice as wide as what there is, so that the caustics beside it are seen, too.
  const double factor = 2 * glm::length(edges) / view_at_target(camera);
  if (camera.height) *camera.height *= factor;
  camera.position = rounded_place(to_dvec3(camera.target) + factor * preset::target_distance(preset.scene.camera) * way,
                                  glm::length(edges));
  return camera;
}

} // namespace nephroid::ui
