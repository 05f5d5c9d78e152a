// SPDX-License-Identifier: Apache-2.0
// The words of every enumeration of the preset.
#pragma once
#include "preset/field.h"
#include "preset/preset.h"

namespace nephroid::preset {

template <>
inline constexpr Choice<Extrapolation> choices<Extrapolation>[] = {
    {Extrapolation::automatic, "automatic", "Extrapolate a formula, hold a table."},
    {Extrapolation::hold, "hold", "The value at the nearer end of the range."},
    {Extrapolation::extrapolate, "extrapolate", "What the formula gives."},
    {Extrapolation::refuse, "refuse", "An error."}};

template <>
inline constexpr Choice<Dispersion::Type> choices<Dispersion::Type>[] = {
    {Dispersion::Type::constant, "constant", "The same n at every wavelength."},
    {Dispersion::Type::file, "file", "A file of the refractiveindex.info database."},
    {Dispersion::Type::sellmeier, "sellmeier", "n^2 = 1 + sum of b l^2 / (l^2 - c), l in micrometres."},
    {Dispersion::Type::cauchy, "cauchy", "n = c0 + c1 / l^2 + c2 / l^4 + ..., l in micrometres."},
    {Dispersion::Type::table, "table", "Measured points, straight lines between them."},
    {Dispersion::Type::points, "points", "Control points of a smooth curve (monotone cubic)."}};

template <>
inline constexpr Choice<LightSpectrum::Type> choices<LightSpectrum::Type>[] = {
    {LightSpectrum::Type::illuminant, "illuminant", "A CIE standard illuminant."},
    {LightSpectrum::Type::blackbody, "blackbody", "Planck's law."},
    {LightSpectrum::Type::lines, "lines", "Single wavelengths, as of a laser or a gas lamp."},
    {LightSpectrum::Type::table, "table", "Measured points, straight lines between them, nothing outside."}};

template <>
inline constexpr Choice<Reflectance::Type> choices<Reflectance::Type>[] = {
    {Reflectance::Type::constant, "constant", "The same at every wavelength."},
    {Reflectance::Type::patch, "patch", "One of the 24 patches of the ColorChecker."},
    {Reflectance::Type::table, "table", "Measured points, straight lines between them, the ends held outside."}};

template <>
inline constexpr Choice<Texture::Type> choices<Texture::Type>[] = {
    {Texture::Type::file, "file", "A picture file."},
    {Texture::Type::checkerboard, "checkerboard", "Two colours, four quarters."}};

template <>
inline constexpr Choice<Texture::Wrap> choices<Texture::Wrap>[] = {
    {Texture::Wrap::repeat, "repeat", "The picture again."},
    {Texture::Wrap::mirror, "mirror", "The picture again, every second one mirrored."},
    {Texture::Wrap::clamp, "clamp", "The colour at the edge."}};

template <>
inline constexpr Choice<Pane::Type> choices<Pane::Type>[] = {
    {Pane::Type::glass, "glass", "By its glass, its thickness and the thin layers on its faces."},
    {Pane::Type::measured, "measured", "By what it reflects and lets pass straight on: numbers or tables."},
    {Pane::Type::file, "file", "By a file of what it reflects and lets pass straight on."}};

/// What the material's own file says, app/scatter/NAME.cpp.
std::string_view sentence_of(Material::Type type);

#define NEPHROID_MATERIAL_CHOICE(word, NAME, lobes) {Material::Type::word, #word, sentence_of(Material::Type::word)},
template <>
inline const Choice<Material::Type> choices<Material::Type>[] = {MATERIALS(NEPHROID_MATERIAL_CHOICE)};
#undef NEPHROID_MATERIAL_CHOICE

template <>
inline constexpr Choice<Shape::Type> choices<Shape::Type>[] = {
    {Shape::Type::quad, "quad", "A rectangle in the x-z plane that faces +y."},
    {Shape::Type::box, "box", "A box."},
    {Shape::Type::sphere, "sphere", "A ball."},
    {Shape::Type::cylinder, "cylinder", "A closed cylinder about the y axis."},
    {Shape::Type::prism, "prism", "A prism along y whose cross-section is an isosceles triangle."},
    {Shape::Type::plate, "plate", "A plane-parallel plate, y thick."},
    {Shape::Type::brilliant, "brilliant", "A brilliant-cut stone with its table up."},
    {Shape::Type::curtain_wall, "curtain_wall",
     "A front of panes without thickness that faces +z, straight or on an arc."},
    {Shape::Type::water, "water", "A box of water with waves on it, which wind has raised."},
    {Shape::Type::relief, "relief", "A box whose top has the heights of a picture."}};

template <>
inline constexpr Choice<Object::Normals> choices<Object::Normals>[] = {
    {Object::Normals::given, "given",
     "Those of the mesh file, and of pillowed panes; where there are none, and of a shape: faceted."},
    {Object::Normals::faceted, "faceted", "Every triangle is flat."},
    {Object::Normals::smooth, "smooth",
     "Normals are interpolated between the corners of a triangle; where a file has none, they are made."}};

template <>
inline constexpr Choice<Light::Type> choices<Light::Type>[] = {
#define NEPHROID_LIGHT_CHOICE(word, NAME, Row, has, sentence) {Light::Type::word, #word, sentence},
    LIGHTS(NEPHROID_LIGHT_CHOICE)};
#undef NEPHROID_LIGHT_CHOICE

template <>
inline constexpr Choice<Camera::Projection> choices<Camera::Projection>[] = {
    {Camera::Projection::perspective, "perspective", "All rays meet in the camera."},
    {Camera::Projection::orthographic, "orthographic",
     "All rays are parallel: what is far is as large as what is near."}};

template <>
inline constexpr Choice<Environment::Type> choices<Environment::Type>[] = {
    {Environment::Type::file, "file", "A latitude-longitude picture."},
    {Environment::Type::constant, "constant", "One colour."},
    {Environment::Type::sky, "sky", "The clear sky and the sun of a place and time (Preetham et al. 1999)."}};

template <>
inline constexpr Choice<Meter::Type> choices<Meter::Type>[] = {
    {Meter::Type::surface, "surface", "An object's surface, or a part of it."},
    {Meter::Type::plane, "plane", "A rectangle in the air."},
    {Meter::Type::point, "point", "A small window in the air, as of a light meter in the hand."},
    {Meter::Type::goniometer, "goniometer",
     "Far away all around: what lamps and all about them send in each direction."}};

template <>
inline constexpr Choice<Meter::Unit> choices<Meter::Unit>[] = {
    {Meter::Unit::watts, "W/m^2", "Irradiance."},
    {Meter::Unit::kilowatts, "kW/m^2", "Irradiance."},
    {Meter::Unit::lux, "lx", "Illuminance."},
    {Meter::Unit::kilolux, "klx", "Illuminance."},
    {Meter::Unit::suns, "suns", "Irradiance in 1,000 W/m^2."},
    {Meter::Unit::candela, "cd", "A goniometer's luminous intensity."},
    {Meter::Unit::watts_per_steradian, "W/sr", "A goniometer's radiant intensity."}};

template <>
inline constexpr Choice<Scene::DamagedMeshes> choices<Scene::DamagedMeshes>[] = {
    {Scene::DamagedMeshes::report, "report", "Say which, mend what can be mended, and go on."},
    {Scene::DamagedMeshes::refuse, "refuse", "An error."}};

template <>
inline constexpr Choice<Stop::Metric> choices<Stop::Metric>[] = {
    {Stop::Metric::lab_mean, "lab_mean", "Mean distance in CIELAB; about 2.3 is just noticeable."},
    {Stop::Metric::lab_rms, "lab_rms", "Root mean square of the distance in CIELAB."},
    {Stop::Metric::mse, "mse", "Mean square of the difference."},
    {Stop::Metric::rel_mse, "rel_mse", "Mean of the squared difference over the squared reference plus .01."},
    {Stop::Metric::rel_l2, "rel_l2", "Norm of the difference over the norm of the reference."}};

template <>
inline constexpr Choice<Reference::Type> choices<Reference::Type>[] = {
    {Reference::Type::file, "file", "A picture file."},
    {Reference::Type::recipe, "recipe", "Rendered once from this scene with two other seeds, then kept in the cache."}};

template <>
inline constexpr Choice<Preset::Unit> choices<Preset::Unit>[] = {{Preset::Unit::mm, "mm", "Millimetres."},
                                                                 {Preset::Unit::cm, "cm", "Centimetres."},
                                                                 {Preset::Unit::m, "m", "Metres."}};

template <>
inline constexpr Choice<Display::Gamut> choices<Display::Gamut>[] = {
    {Display::Gamut::oklch, "oklch", "Less colourful, with the same hue and lightness (OKLCh)."},
    {Display::Gamut::clip, "clip", "Each channel is clipped, which shifts the hue."}};

template <>
inline constexpr Choice<Display::Tone> choices<Display::Tone>[] = {
    {Display::Tone::reinhard, "reinhard",
     "Highlights up to the brightest ones are compressed; below .6 of white all stays (Reinhard 2002)."},
    {Display::Tone::filmic, "filmic", "A soft shoulder up to 5.6 times white, darker middle tones (Hable 2010)."},
    {Display::Tone::clip, "clip", "What is above white is clipped."}};

template <>
inline constexpr Choice<Display::WhiteBalance> choices<Display::WhiteBalance>[] = {
    {Display::WhiteBalance::d65, "D65", "Daylight, as sRGB has it: a lamp shows its own colour."},
    {Display::WhiteBalance::light, "light", "The first of scene.lights is white (Bradford adaptation)."}};

template <>
inline constexpr Choice<Track::Interpolation> choices<Track::Interpolation>[] = {
    {Track::Interpolation::linear, "linear", "Straight lines between keys."},
    {Track::Interpolation::smooth, "smooth",
     "A smooth curve through the keys that never goes beyond them (monotone cubic)."}};

} // namespace nephroid::preset
