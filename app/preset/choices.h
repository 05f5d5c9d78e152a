// SPDX-License-Identifier: Apache-2.0
// The words of every enumeration of the preset.
#pragma once
#include "preset/field.h"
#include "preset/preset.h"

namespace nephroid::preset {

template <>
struct Choices<Outside> {
  static constexpr Choice<Outside> all[] = {{Outside::automatic, "automatic", "Extrapolate a formula, hold a table."},
                                            {Outside::hold, "hold", "The value at the nearer end of the range."},
                                            {Outside::extrapolate, "extrapolate", "What the formula gives."},
                                            {Outside::refuse, "refuse", "An error."}};
};

template <>
struct Choices<Dispersion::Type> {
  using Type = Dispersion::Type;
  static constexpr Choice<Type> all[] = {{Type::constant, "constant", "The same n at every wavelength."},
                                         {Type::file, "file", "A file of the refractiveindex.info database."},
                                         {Type::sellmeier, "sellmeier", "n^2 = 1 + sum of b l^2 / (l^2 - c), l in micrometres."},
                                         {Type::cauchy, "cauchy", "n = c0 + c1 / l^2 + c2 / l^4 + ..., l in micrometres."},
                                         {Type::table, "table", "Measured points, straight lines between them."},
                                         {Type::points, "points", "Control points of a smooth curve (monotone cubic)."}};
};

template <>
struct Choices<LightSpectrum::Type> {
  using Type = LightSpectrum::Type;
  static constexpr Choice<Type> all[] = {{Type::illuminant, "illuminant", "A CIE standard illuminant."},
                                         {Type::blackbody, "blackbody", "Planck's law."},
                                         {Type::lines, "lines", "Single wavelengths, as of a laser or a gas lamp."},
                                         {Type::table, "table", "Measured points, straight lines between them, nothing outside."}};
};

template <>
struct Choices<Reflectance::Type> {
  using Type = Reflectance::Type;
  static constexpr Choice<Type> all[] = {{Type::constant, "constant", "The same at every wavelength."},
                                         {Type::patch, "patch", "One of the 24 patches of the ColorChecker."},
                                         {Type::table, "table", "Measured points, straight lines between them, the ends held outside."}};
};

template <>
struct Choices<Material::Type> {
  using Type = Material::Type;
  static constexpr Choice<Type> all[] = {
      {Type::diffuse, "diffuse", "Scatters light equally to all sides (Lambert): what caustics fall on."},
      {Type::dielectric, "dielectric", "Glass, water, diamond: refracts and reflects."},
      {Type::mirror, "mirror", "Reflects like polished metal."}};
};

template <>
struct Choices<Shape::Type> {
  using Type = Shape::Type;
  static constexpr Choice<Type> all[] = {{Type::quad, "quad", "A rectangle in the x-z plane that faces +y."},
                                         {Type::box, "box", "A box."},
                                         {Type::sphere, "sphere", "A ball."},
                                         {Type::cylinder, "cylinder", "A closed cylinder about the y axis."},
                                         {Type::prism, "prism", "A prism along y whose cross-section is an isosceles triangle."},
                                         {Type::plate, "plate", "A plane-parallel plate, y thick."},
                                         {Type::brilliant, "brilliant", "A brilliant-cut stone with its table up."}};
};

template <>
struct Choices<Object::Normals> {
  static constexpr Choice<Object::Normals> all[] = {
      {Object::Normals::faceted, "faceted", "Every triangle is flat."},
      {Object::Normals::smooth, "smooth", "Normals are interpolated between the corners of a triangle."}};
};

template <>
struct Choices<Light::Type> {
  using Type = Light::Type;
  static constexpr Choice<Type> all[] = {{Type::point, "point", "A point that shines equally to all sides."},
                                         {Type::spot, "spot", "A point that shines into a cone."},
                                         {Type::directional, "directional", "Parallel light, as from the sun."},
                                         {Type::area, "area", "A rectangle that shines to one side by the cosine law."}};
};

template <>
struct Choices<Environment::Type> {
  using Type = Environment::Type;
  static constexpr Choice<Type> all[] = {{Type::file, "file", "A latitude-longitude picture."},
                                         {Type::constant, "constant", "One colour."}};
};

template <>
struct Choices<Scene::DamagedMeshes> {
  using DamagedMeshes = Scene::DamagedMeshes;
  static constexpr Choice<DamagedMeshes> all[] = {{DamagedMeshes::report, "report", "Say which, mend what can be mended, and go on."},
                                                  {DamagedMeshes::refuse, "refuse", "An error."}};
};

template <>
struct Choices<Stop::Metric> {
  using Metric = Stop::Metric;
  static constexpr Choice<Metric> all[] = {
      {Metric::lab_mean, "lab_mean", "Mean distance in CIELAB; about 2.3 is just noticeable."},
      {Metric::lab_rms, "lab_rms", "Root mean square of the distance in CIELAB."},
      {Metric::mse, "mse", "Mean square of the difference."},
      {Metric::rel_mse, "rel_mse", "Mean of the squared difference over the squared reference plus .01."},
      {Metric::rel_l2, "rel_l2", "Norm of the difference over the norm of the reference."}};
};

template <>
struct Choices<Reference::Type> {
  using Type = Reference::Type;
  static constexpr Choice<Type> all[] = {
      {Type::file, "file", "A picture file."},
      {Type::recipe, "recipe", "Rendered once from this scene with two other seeds, then kept in the cache."}};
};

template <>
struct Choices<Preset::Unit> {
  static constexpr Choice<Preset::Unit> all[] = {
      {Preset::Unit::mm, "mm", "Millimetres."}, {Preset::Unit::cm, "cm", "Centimetres."}, {Preset::Unit::m, "m", "Metres."}};
};

template <>
struct Choices<Track::Interpolation> {
  using Interpolation = Track::Interpolation;
  static constexpr Choice<Interpolation> all[] = {
      {Interpolation::linear, "linear", "Straight lines between keys."},
      {Interpolation::smooth, "smooth", "A smooth curve through the keys that never goes beyond them (monotone cubic)."}};
};

} // namespace nephroid::preset
