// SPDX-License-Identifier: Apache-2.0
// Presets and their parts, built in memory without files, for checks and tests.
#pragma once
#include "preset/preset.h"
#include "spectral/settings.h"

#include <cmath>
#include <string>

namespace nephroid::check {

/// A preset in metres with nothing in it but a camera. Its caustics are only splatted, which has closed forms; glass
/// and mirrors in view show none. Its photons are independent, so their numbers have the variance of chance: a
/// low-discrepancy sequence spreads photons more evenly, with less variance.
inline preset::Preset empty_preset(int resolution = 64) {
  preset::Preset p;
  p.name = "test";
  p.unit = preset::Preset::Unit::m;
  p.scene.camera.resolution = {resolution, resolution};
  spectral::settings(p).direct = false;
  spectral::settings(p).indirect = false;
  spectral::settings(p).estimator = photons::Settings::Estimator::splat;
  spectral::settings(p).low_discrepancy = false;
  spectral::settings(p).photons_per_pass = 1 << 16;
  spectral::settings(p).effort = photons::Settings::Effort::power;
  spectral::settings(p).smoothing = photons::Settings::Smoothing::off;
  p.stop.passes = 1;
  return p;
}

inline preset::Material mirror(double reflectance) {
  preset::Material m;
  m.type = preset::Material::Type::mirror;
  m.reflectance.value = reflectance;
  return m;
}

inline preset::Material glass(double n) {
  preset::Material m;
  m.type = preset::Material::Type::dielectric;
  m.dispersion.type = preset::Dispersion::Type::constant;
  m.dispersion.n = n;
  return m;
}

inline preset::Material conductor(const std::string& metal) {
  preset::Material m;
  m.type = preset::Material::Type::conductor;
  m.metal = metal;
  return m;
}

inline preset::Material white(double reflectance = 1) {
  preset::Material m;
  m.reflectance.value = reflectance;
  return m;
}

inline preset::Object object(const std::string& name, const preset::Shape& shape, const std::string& material,
                             const preset::Transform& transform = {}) {
  preset::Object o;
  o.name = name;
  o.shape = shape;
  o.material = material;
  o.transform = transform;
  return o;
}

inline preset::Shape quad(double x, double z) { return {.type = preset::Shape::Type::quad, .size = {x, 1, z}}; }

inline preset::Shape box(double x, double y, double z) { return {.type = preset::Shape::Type::box, .size = {x, y, z}}; }

inline preset::Transform at(preset::Vec3 translate, preset::Vec3 rotate_deg = {0, 0, 0}) {
  return {.rotate_deg = rotate_deg, .translate = translate};
}

/// A cylinder as high as wide, the one shape with interpolated normals.
inline preset::Shape rod(double radius, int segments) {
  return {.type = preset::Shape::Type::cylinder, .radius = radius, .height = 2 * radius, .segments = segments};
}

inline preset::Shape ball(double radius) { return {.type = preset::Shape::Type::sphere, .radius = radius}; }

inline preset::LightSpectrum line(double nm) {
  preset::LightSpectrum s;
  s.type = preset::LightSpectrum::Type::lines;
  s.table = {{nm, 1}};
  return s;
}

/// A narrow beam of one wavelength.
inline preset::Light pencil(const preset::Vec3& from, const preset::Vec3& direction, double half_angle_deg,
                            double nm = 550) {
  preset::Light light;
  light.type = preset::Light::Type::spot;
  light.position = from;
  light.direction = direction;
  light.half_angle_deg = half_angle_deg;
  light.spectrum = line(nm);
  return light;
}

/// A pencil of 0.01 degrees from 0.1 m before the origin, narrow at grazing angles too, `theta` radians from the plane
/// y = 0's normal.
inline preset::Light inclined_pencil(double theta, double nm = 550) {
  const double s = std::sin(theta), c = std::cos(theta);
  return pencil({-0.1 * s, 0.1 * c, 0}, {s, -c, 0}, 0.01, nm);
}

} // namespace nephroid::check
