// SPDX-License-Identifier: Apache-2.0
// Runs engine 1 on a preset built in a test and hands back what it made.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/engine.h"

#include <stdexcept>

namespace nephroid::test {

/// One context for all tests of a program: opening a device takes a second.
inline const compute::Context& shared_context()
{
  static const compute::Context context = compute::Context::open();
  return context;
}

inline job::Snapshot render(const preset::Preset& preset, const compute::Context& context = shared_context())
{
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const plan::Plan plan = spectral::make_plan(preset, scene, bvh);
  const auto job = spectral::make_job(preset, scene, bvh, plan, context);
  while (!job->finished()) job->step();
  return job->snapshot();
}

inline const job::Layer& layer(const job::Snapshot& snapshot, const std::string& name)
{
  for (const job::Layer& candidate : snapshot.picture->layers)
    if (candidate.name == name) return candidate;
  throw std::runtime_error("no layer " + name);
}

/// A preset in metres with nothing in it but a camera.
inline preset::Preset empty_preset(int resolution = 64)
{
  preset::Preset p;
  p.name = "test";
  p.unit = preset::Preset::Unit::m;
  p.scene.camera.resolution = {resolution, resolution};
  p.spectral.direct = false;
  p.spectral.photons_per_pass = 1 << 16;
  p.stop.passes = 1;
  return p;
}

inline preset::Material glass(double n)
{
  preset::Material m;
  m.type = preset::Material::Type::dielectric;
  m.dispersion.type = preset::Dispersion::Type::constant;
  m.dispersion.n = n;
  return m;
}

inline preset::Material white(double reflectance = 1)
{
  preset::Material m;
  m.reflectance.value = reflectance;
  return m;
}

inline preset::Object object(const std::string& name, const preset::Shape& shape, const std::string& material,
                             const preset::Transform& transform = {})
{
  preset::Object o;
  o.name = name;
  o.shape = shape;
  o.material = material;
  o.transform = transform;
  return o;
}

inline preset::Shape quad(double x, double z)
{
  preset::Shape s;
  s.type = preset::Shape::Type::quad;
  s.size = {x, 1, z};
  return s;
}

inline preset::Shape box(double x, double y, double z)
{
  preset::Shape s;
  s.type = preset::Shape::Type::box;
  s.size = {x, y, z};
  return s;
}

inline preset::Transform at(preset::Vec3 translate, preset::Vec3 rotate_deg = {0, 0, 0})
{
  preset::Transform t;
  t.translate = translate;
  t.rotate_deg = rotate_deg;
  return t;
}

/// A single wavelength.
inline preset::LightSpectrum line(double nm)
{
  preset::LightSpectrum s;
  s.type = preset::LightSpectrum::Type::lines;
  s.table = {{nm, 1}};
  return s;
}

} // namespace nephroid::test
