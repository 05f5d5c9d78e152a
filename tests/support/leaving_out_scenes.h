// SPDX-License-Identifier: Apache-2.0
// For each thing that engine 1 can leave out, a small scene that does not need it. Tests show that its picture stays
// the same without, the bench how much time that saves.
#pragma once
#include "spectral/settings.h"
#include "tests/support/presets.h"
#include "tests/support/standard.h"
#include "tracing/scene_tables.h"

namespace nephroid::test {

using tracing::LeaveOut;

struct Omission {
  std::string key; ///< the name of its pass, with _ for each space
  bool LeaveOut::*field;
  preset::Preset scene;
  bool same_bits = true; ///< else other photons make the picture, and it is the same within the noise
};

/// Leaves out what a scene does not need but for this.
inline LeaveOut all_but(const Omission& omission) {
  LeaveOut leave_out;
  leave_out.*omission.field = false;
  return leave_out;
}

inline void PrintTo(const Omission& omission, std::ostream* out) { *out << omission.key; }

/// A glass ball with facets over a floor, a point light above; the camera sees the floor beside and through the ball.
inline preset::Preset ball_scene() {
  preset::Preset p = empty_preset(24);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::cauchy;
  p.scene.materials["glass"].dispersion.coefficients = {1.5, 0.01};
  p.scene.materials["white"] = white(0.8);
  preset::Shape ball;
  p.scene.objects = {object("ball", ball, "glass", at({0, 1, 0})), object("floor", quad(8, 8), "white")};
  preset::Light light{.power_w = 10, .position = {0.3, 2.5, 0.2}};
  p.scene.lights = {light};
  p.scene.camera.position = {0, 3, 3};
  p.scene.camera.target = {0, 0.3, 0};
  spectral::settings(p).direct = true;
  spectral::settings(p).threshold_deg = 0.2;
  spectral::settings(p).photons_per_pass = 1 << 14;
  p.stop.passes = 2;
  return p;
}

using check::mirror;

/// Seven lamps that are switched off before one, an area light, that is on.
inline preset::Preset dark_lights_scene() {
  preset::Preset p = ball_scene();
  preset::Light off = p.scene.lights[0], on = off;
  off.power_w = 0;
  on.type = preset::Light::Type::area;
  on.size = {0.5, 0.5};
  p.scene.lights.assign(7, off);
  for (std::size_t i = 0; i < 7; ++i) p.scene.lights[i].position[0] += 0.1 * static_cast<double>(i);
  p.scene.lights.push_back(on);
  return p;
}

/// A spot on one ball; another, larger ball is outside its cone.
inline preset::Preset spot_scene(double half_angle_deg) {
  preset::Preset p = ball_scene();
  preset::Shape beside;
  p.scene.objects.push_back(object("beside", beside, "glass", at({3, 1, 0})));
  p.scene.objects.back().transform.scale = {1.8, 1.8, 1.8};
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::spot;
  light.position = {0, 3, 0};
  light.direction = {0, -1, 0};
  light.half_angle_deg = half_angle_deg;
  p.stop.passes = 24;
  return p;
}

/// The floor under the ball, seen from below the ball.
inline preset::Preset floor_scene() {
  preset::Preset p = ball_scene();
  p.scene.camera.position = {0, 0.4, 2};
  p.scene.camera.target = {0, -0.2, 0.5};
  return p;
}

/// A brass-like mirror on the floor's side under a light of three lines.
inline preset::Preset line_light_scene() {
  preset::Preset p = ball_scene();
  p.scene.materials["metal"] = mirror(0.5);
  p.scene.materials["metal"].reflectance.type = preset::Reflectance::Type::table;
  p.scene.materials["metal"].reflectance.table = {{380, 0.3}, {780, 0.9}};
  p.scene.objects.push_back(object("metal", quad(2, 2), "metal", at({-1.2, 1, 0}, {0, 0, -60})));
  p.scene.lights[0].spectrum = line(546);
  p.scene.lights[0].spectrum.table = {{436, 1}, {546, 2}, {611, 1}};
  return p;
}

inline std::vector<Omission> omissions() {
  using L = LeaveOut;
  const preset::Preset ball = ball_scene();
  preset::Preset no_floor = ball, no_glass = ball, close_light = ball, straight = ball;
  no_floor.scene.objects.pop_back();
  no_glass.scene.objects.erase(no_glass.scene.objects.begin());
  close_light.scene.lights[0].position = {0, 1.9, 0};
  close_light.stop.passes = 24;
  straight.scene.materials["glass"] = glass(1);
  straight.scene.objects[0].shape = box(1, 0.4, 1);
  preset::Preset no_glass_seen = floor_scene();
  spectral::settings(no_glass_seen).estimator = photons::Settings::Estimator::points;
  spectral::settings(no_glass_seen).jitter = false; // with maps, all photons of a cluster have one wavelength a pass
  preset::Preset lines = line_light_scene();
  spectral::settings(lines).jitter = false; // a streak ends with its cluster's wavelengths
  // A tree of a few triangles is soon searched: all other code has its largest share.
  preset::Preset slab = ball;
  slab.scene.objects[0].shape = box(1, 0.4, 1);
  return {{"direct", &L::direct, no_floor},
          {"photons", &L::photons, no_glass},
          {"light_on_receivers", &L::light_on_receivers, no_glass_seen},
          {"stray_photons", &L::stray_photons, close_light, false},
          {"unreached_targets", &L::unreached_targets, spot_scene(40), false},
          {"dark_lights", &L::dark_lights, dark_lights_scene()},
          {"unlit_wavelengths", &L::unlit_wavelengths, lines},
          {"occlusion", &L::occlusion, floor_scene()},
          {"light_types", &L::light_types, slab},
          {"mirrors", &L::mirrors, slab},
          {"bending", &L::bending, straight},
          {"attenuation", &L::attenuation, slab},
          {"smooth_normals", &L::smooth_normals, slab}};
}

} // namespace nephroid::test
