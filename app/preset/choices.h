// SPDX-License-Identifier: Apache-2.0
// The words of every enumeration of the preset, and what each struct is called: the sentences that describe.h does not repeat
// for every field.
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
struct About<Dispersion> {
  using Type = Dispersion::Type;
  static constexpr std::string_view name = "Dispersion", sentence = "Index of refraction over wavelength.";
  static constexpr Shorthand<Type> shorthands[] = {{Bare::number, Type::constant, "n"}, {Bare::text, Type::file, "file"}};
};
template <>
struct About<LightSpectrum> {
  using Type = LightSpectrum::Type;
  static constexpr std::string_view name = "LightSpectrum", sentence = "How a light's power is spread over wavelength.";
  static constexpr Shorthand<Type> shorthands[] = {{Bare::text, Type::illuminant, "illuminant"}};
};
template <>
struct About<Reflectance> {
  using Type = Reflectance::Type;
  static constexpr std::string_view name = "Reflectance", sentence = "The part of the light that is reflected, over wavelength.";
  static constexpr Shorthand<Type> shorthands[] = {{Bare::number, Type::constant, "value"}, {Bare::text, Type::patch, "patch"}};
};
template <>
struct About<Material> {
  using Type = Material::Type;
  static constexpr std::string_view name = "Material", sentence = "What a surface does with light.";
};
template <>
struct About<Transform> {
  static constexpr std::string_view name = "Transform", sentence = "Scale, then rotate (about x, then y, then z), then translate.";
};
template <>
struct About<Shape> {
  using Type = Shape::Type;
  static constexpr std::string_view name = "Shape", sentence = "A simple shape, centred on the origin with y up.";
};
template <>
struct About<Object> {
  static constexpr std::string_view name = "Object", sentence = "A mesh or a shape, put in its place.";
};
template <>
struct About<Light> {
  using Type = Light::Type;
  static constexpr std::string_view name = "Light", sentence = "A source of light.";
};
template <>
struct About<Camera> {
  static constexpr std::string_view name = "Camera", sentence = "A pinhole camera.";
};
template <>
struct About<Scene> {
  static constexpr std::string_view name = "Scene", sentence = "What there is to see.";
};
template <>
struct About<Environment> {
  using Type = Environment::Type;
  static constexpr std::string_view name = "Environment", sentence = "What is behind everything, infinitely far.";
  static constexpr Shorthand<Type> shorthands[] = {{Bare::text, Type::file, "file"}};
};
template <>
struct About<Stop> {
  static_assert(default_passes == 64, "the sentence says so");
  static constexpr std::string_view name = "Stop", sentence = "When a run is done: at the first of these; without any, after 64 passes.";
};
template <>
struct About<Reference> {
  using Type = Reference::Type;
  static constexpr std::string_view name = "Reference", sentence = "What a picture is measured against.";
  static constexpr Shorthand<Type> shorthands[] = {{Bare::text, Type::file, "file"}};
};
template <>
struct About<Measure> {
  static constexpr std::string_view name = "Measure", sentence = "What a run notes about its error.";
};
template <>
struct About<Preset> {
  static constexpr std::string_view name = "Preset", sentence = "A Nephroid preset: everything a run depends on.";
};

} // namespace nephroid::preset
