// SPDX-License-Identifier: Apache-2.0
#include "formats/import/mitsuba_scene.h"

#include "base/error.h"
#include "base/lower_case.h"
#include "base/numbers.h"
#include "formats/import/dielectrics.h"
#include "formats/import/textures.h"
#include "image/image.h"
#include "optics/spectrum.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nephroid::formats {
namespace {

/// Mitsuba's own figures of the indices of refraction that it names.
const std::map<std::string, double> iors{{"vacuum", 1},
                                         {"air", 1.000277},
                                         {"water", 1.3330},
                                         {"water ice", 1.31},
                                         {"fused quartz", 1.458},
                                         {"pyrex", 1.470},
                                         {"acrylic glass", 1.49},
                                         {"polypropylene", 1.49},
                                         {"bk7", 1.5046},
                                         {"sodium chloride", 1.544},
                                         {"amber", 1.55},
                                         {"pet", 1.5750},
                                         {"diamond", 2.419},
                                         {"acetone", 1.36},
                                         {"ethanol", 1.361},
                                         {"benzene", 1.501},
                                         {"silicone oil", 1.52045},
                                         {"glycerol", 1.4729},
                                         {"hydrogen", 1.000132},
                                         {"helium", 1.000036},
                                         {"carbon dioxide", 1.00045},
                                         {"bromine", 1.661},
                                         {"carbon tetrachloride", 1.461}};

using Rows = std::vector<std::array<double, 2>>;

/// "400:0.1, 500:0.2".
Rows rows_of(const MitsubaFile& file, xml_node node) {
  std::string text = file.attribute(node, "value");
  std::ranges::replace(text, ',', ' ');
  std::istringstream words(text);
  Rows rows;
  for (std::string word; words >> word;) {
    const std::size_t colon = word.find(':');
    const auto nm = scene_number(std::string_view(word).substr(0, colon)),
               value =
                   colon == std::string::npos ? std::nullopt : scene_number(std::string_view(word).substr(colon + 1));
    if (!nm || !value)
      throw bad_input(file.at(node), "\"" + word + "\" is no value of a spectrum", "expected WAVELENGTH:VALUE");
    rows.push_back({*nm, *value});
  }
  return rows;
}

bool is_listed(const MitsubaFile& file, xml_node node) {
  return std::string_view(node.name()) == "spectrum" && file.attribute(node, "value").find(':') != std::string::npos;
}

/// "regular" and "irregular".
Rows sampled_rows(const MitsubaFile& file, xml_node node) {
  const auto numbers = [&](const char* name) {
    const xml_node list = file.child(node, name);
    return list ? file.numbers(list) : std::vector<double>();
  };
  const std::vector<double> values = numbers("values");
  std::vector<double> nm = numbers("wavelengths");
  if (nm.empty() && values.size() > 1) {
    const double low = file.number(node, "wavelength_min", 360), high = file.number(node, "wavelength_max", 830);
    for (std::size_t i = 0; i < values.size(); ++i)
      nm.push_back(std::lerp(low, high, static_cast<double>(i) / static_cast<double>(values.size() - 1)));
  }
  if (nm.size() != values.size())
    throw bad_input(file.at(node), fmt::format("has {} wavelengths and {} values", nm.size(), values.size()));
  Rows rows;
  for (std::size_t i = 0; i < nm.size(); ++i) rows.push_back({nm[i], values[i]});
  return rows;
}

/// "5000" or "5000K".
double kelvin(const MitsubaFile& file, xml_node node, const std::string& text) {
  const auto value = scene_number(std::string_view(text).substr(0, text.find_last_of("0123456789.") + 1));
  if (!value) throw bad_input(file.at(node), "\"" + text + "\" is no temperature", "expected kelvins");
  return *value;
}

/// Encoded as sRGB: "#ff8000", or three numbers.
glm::dvec3 srgb_of(const MitsubaFile& file, xml_node node, const std::string& text) {
  glm::dvec3 rgb(0);
  if (!text.starts_with('#'))
    rgb = file.vector_of(node, 0);
  else if (text.size() != 7 || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    throw bad_input(file.at(node), "\"" + text + "\" is no colour", "expected # and six digits");
  else
    for (int i = 0; i < 3; ++i)
      rgb[i] = std::stoi(text.substr(1 + 2 * static_cast<std::size_t>(i), 2), nullptr, 16) / 255.0;
  for (int i = 0; i < 3; ++i) rgb[i] = image::decoded_srgb(rgb[i]);
  return rgb;
}

/// Nothing for what is no colour of its own, as a texture.
std::optional<DescribedColour> colour_of(MitsubaScene& scene, xml_node node) {
  const MitsubaFile& file = scene.file;
  const double unit = scene.d.unit;
  const Location where = file.at(node);
  const std::string kind = node.name(), text = file.attribute(node, "value");
  DescribedColour colour;
  if (kind == "srgb" || text.starts_with('#')) {
    colour.rgb = srgb_of(file, node, text);
  } else if (kind == "rgb" || kind == "color" ||
             kind == "float") { // a float shines as D65, a <spectrum> of one value as E
    colour.rgb = file.vector_of(node, 0);
  } else if (kind == "blackbody") {
    colour = blackbody_of(kelvin(file, node, file.attribute(node, "temperature")), unit, where) *
             file.number_of(node, 1, "scale");
  } else if (kind == "spectrum" && node.attribute("filename")) {
    colour = spectrum_of_rows(rows_of_file(file.find(node, file.attribute(node, "filename")), where), unit, where);
  } else if (is_listed(file, node)) {
    colour = spectrum_of_rows(rows_of(file, node), unit, where);
  } else if (kind == "spectrum" && !text.empty()) {
    const std::vector<double> values = file.numbers(node);
    if (values.size() == 1) return even_spectrum(values[0], unit);
    colour.rgb = file.vector_of(node, 0);
  } else if (kind == "spectrum" || kind == "texture") {
    const std::string type = file.attribute(node, "type");
    const double scale = file.number(node, "scale", 1);
    if (type == "uniform" || type == "rawconstant")
      colour = even_spectrum(file.number(node, "value", 1), unit);
    else if (type == "d65")
      colour = mitsuba_colour(scene, node, "color", 1) * scale;
    else if (type == "srgb")
      colour = mitsuba_colour(scene, node, "color", 1);
    else if (type == "blackbody")
      colour = blackbody_of(kelvin(file, node, file.text(node, "temperature", "5000")), unit, where) * scale;
    else if (type == "regular" || type == "irregular")
      colour = spectrum_of_rows(file.child(node, "filename")
                                    ? rows_of_file(file.find(node, file.text(node, "filename", "")), where)
                                    : sampled_rows(file, node),
                                unit, where);
    else
      return std::nullopt;
  } else
    return std::nullopt;
  return colour;
}

DescribedGlass dielectric(MitsubaScene& scene, xml_node node, const char* inside, const char* standard) {
  const MitsubaFile& file = scene.file;
  const auto ior = [&](const char* name, const char* otherwise) {
    const xml_node given = file.child(node, name);
    const std::string value = given ? lower_case(file.attribute(given, "value")) : otherwise;
    if (const auto named = iors.find(value); named != iors.end()) return named->second;
    const auto n = scene_number(value);
    if (!n) throw bad_input(file.at(given), "no index of refraction is called \"" + value + "\"");
    if (*n > 0) return *n;
    throw bad_input(file.at(given), "an index of refraction is above 0");
  };
  DescribedGlass glass;
  if (const xml_node given = file.child(node, inside); is_listed(file, given)) {
    glass.inside.type = preset::Dispersion::Type::table;
    glass.inside.table = rows_of(file, given);
  } else
    glass.inside.n = glass_of(ior(inside, standard), file.at(node)).inside.n;
  glass.outside = glass_of(ior("ext_ior", "air"), file.at(node)).inside.n;
  return glass;
}

/// A number, or with a note the standard in a texture's place.
double plain_number(MitsubaScene& scene, xml_node node, const char* name, double standard) {
  if (const xml_node given = scene.file.child(node, name); given && !given.attribute("value"))
    scene.d.note(scene.file.at(given),
                 fmt::format("the texture of {} is left out: {:.3g} takes its place", name, standard));
  return scene.file.number(node, name, standard);
}

/// What is in the wrappers around a bsdf.
struct Unwrapped {
  xml_node bsdf, normal_map; ///< the outermost normalmap
  xml_node back;             ///< the second of a twosided
  bool is_twosided = false;
};

bool refracts(const MitsubaFile& file, xml_node bsdf) {
  const std::string type = mitsuba_name(file.attribute(bsdf, "type"));
  return type.ends_with("dielectric") || (type == "principled" && file.number(bsdf, "spec_trans", 0) >= 0.5);
}

/// The bsdf is none where nothing is there; a blend only where it is of opaque ones. blends: that it is in.
Unwrapped unwrapped(MitsubaScene& scene, xml_node node, int blends = 0) {
  constexpr int most_blends = 8;
  const MitsubaFile& file = scene.file;
  Unwrapped found;
  if (blends > most_blends) throw bad_input(file.at(node), fmt::format("blends are more than {} deep", most_blends));
  for (int depth = 0; node; ++depth) {
    const std::string type = mitsuba_name(file.attribute(node, "type"));
    const std::vector<xml_node> inside = file.objects(node, "bsdf");
    const auto left_out = [&](const char* taken) {
      scene.d.note(file.at(node), "the " + type + " is left out: " + taken);
    };
    if (depth > 16) throw bad_input(file.at(node), "materials go round in a circle");
    xml_node next = inside.empty() ? xml_node() : inside[0];
    if (type == "twosided") {
      found.is_twosided = true;
      if (inside.size() > 1) found.back = inside[1];
    } else if (type == "mask") {
      const glm::dvec3 colour = linear_srgb_of(mitsuba_colour(scene, node, "opacity", 0.5));
      const double opacity = (colour.x + colour.y + colour.z) / 3;
      if (opacity > 0 && opacity < 1) left_out(opacity < 0.5 ? "nothing is there" : "the material in it is taken");
      if (opacity < 0.5) return found;
    } else if (type == "normalmap" && !found.normal_map)
      found.normal_map = node;
    else if (type == "normalmap" || type == "bumpmap")
      left_out("the material in it is taken");
    else if (type == "blendbsdf" && inside.size() == 2) {
      const Unwrapped parts[] = {unwrapped(scene, inside[0], blends + 1), unwrapped(scene, inside[1], blends + 1)};
      if (std::ranges::all_of(parts, [&](const Unwrapped& p) { return p.bsdf && !refracts(file, p.bsdf); })) break;
      left_out("the heavier material in it is taken");
      next = inside[file.number(node, "weight", 0.5) > 0.5 ? 1 : 0];
    } else
      break;
    node = next;
  }
  if (mitsuba_name(file.attribute(node, "type")) != "null") found.bsdf = node;
  return found;
}

/// Whether a factor of reflection or an index of refraction is given that is not 1, as it is by itself.
bool is_given_and_not_one(MitsubaScene& scene, xml_node node, const char* name) {
  const xml_node given = scene.file.child(node, name);
  const auto colour = given ? colour_of(scene, given) : std::nullopt;
  return given && (!colour || values_of(*colour) != optics::constant_spectrum(1));
}

/// By n and k, or by name; nothing for a perfect mirror, and with a note where it is not to be had.
std::optional<preset::Material> metal(MitsubaScene& scene, xml_node node, const std::string& key) {
  const MitsubaFile& file = scene.file;
  const Location where = file.at(node);
  const std::string name = file.text(node, "material", "");
  const xml_node eta = file.child(node, "eta"), k = file.child(node, "k");
  std::optional<preset::Material> made = metal_of_element(name);
  if (!made && eta && k)
    if (const auto n = colour_of(scene, eta), extinction = colour_of(scene, k); n && extinction)
      made = metal_of(scene.d, key, values_of(*n), values_of(*extinction));
  if (made && is_given_and_not_one(scene, node, "specular_reflectance")) {
    scene.d.note(where, "with its specular_reflectance the metal is a mirror that reflects alike at all angles");
    made = mirror_of(scene.d, *made, mitsuba_colour(scene, node, "specular_reflectance", 1));
  }
  if (is_given_and_not_one(scene, node, "ext_eta")) scene.d.note(where, "its ext_eta is left out: around it is air");
  if (!made && (eta || (!name.empty() && name != "none")))
    scene.d.note(where, "the metal is left out: a mirror of its specular_reflectance takes its place");
  return made;
}

/// As a preset has it, whose square is the alpha of GGX. texture: gets the picture that it is multiplied by; null: that
/// is left out.
double roughness_of(MitsubaScene& scene, xml_node node, const std::string& key,
                    std::optional<preset::Texture>* texture) {
  const MitsubaFile& file = scene.file;
  if (file.text(node, "distribution", "beckmann") != "ggx")
    scene.d.note(file.at(node), "its facets have the distribution GGX here, not Beckmann's");
  const auto alpha = texture ? mitsuba_texture(scene, node, "alpha", scatter::Texels::numbers) : std::nullopt;
  if (alpha) {
    const xml_node given = file.child(node, "alpha");
    *texture = roughness_picture(*alpha, 0.5, !file.flag(given, "raw"), key, file.at(given), scene.d);
    if (*texture) return 1;
  }
  const double both = plain_number(scene, node, "alpha", 0.1), u = plain_number(scene, node, "alpha_u", both),
               v = plain_number(scene, node, "alpha_v", both);
  if (u != v)
    scene.d.note(file.at(node), fmt::format("its alpha_u {:.3g} and alpha_v {:.3g} are one: their mean", u, v));
  return std::sqrt(std::clamp((u + v) / 2, 0.0, 1.0));
}

preset::Material opaque(MitsubaScene& scene, xml_node node, const std::string& type, const std::string& key) {
  const MitsubaFile& file = scene.file;
  const Location where = file.at(node);
  if (type == "blendbsdf") {
    const auto part = [&](std::size_t i) {
      const auto [bsdf, normal_map, back, is_twosided] = unwrapped(scene, file.objects(node, "bsdf")[i]);
      if (normal_map) scene.d.note(file.at(normal_map), "the normalmap in a blendbsdf is left out");
      if (back) scene.d.note(file.at(back), "the second side in a blendbsdf is left out");
      return opaque(scene, bsdf, mitsuba_name(file.attribute(bsdf, "type")), key);
    };
    return mixed(part(0), part(1), plain_number(scene, node, "weight", 0.5), where, scene.d);
  }
  preset::Material made;
  if (type == "conductor" || type == "roughconductor") {
    made.type = preset::Material::Type::mirror;
    if (const auto own = metal(scene, node, key))
      made = *own;
    else
      made.reflectance = reflectance_of(mitsuba_colour(scene, node, "specular_reflectance", 1));
    if (type == "roughconductor") made.roughness = roughness_of(scene, node, key, &made.roughness_texture);
    note_unasked(scene, node);
    return made;
  }
  const char* const name = type == "diffuse"      ? "reflectance"
                           : type == "principled" ? "base_color"
                                                  : "diffuse_reflectance";
  if ((made.texture = mitsuba_texture(scene, node, name, scatter::Texels::colours)))
    made.reflectance.value = 1;
  else
    made.reflectance = reflectance_of(mitsuba_colour(scene, node, name, 0.5));
  if (type == "plastic" || type == "roughplastic") {
    const DescribedGlass coat = dielectric(scene, node, "int_ior", "polypropylene");
    const bool below = file.text(node, "nonlinear", "false") == "true" && !made.texture;
    make_plastic(made, coat.inside.n / coat.outside,
                 type == "roughplastic" ? roughness_of(scene, node, key, nullptr) : 0, below);
    note_unasked(scene, node);
  } else if (type == "diffuse")
    note_unasked(scene, node);
  else
    scene.d.note(where, "the bsdf " + type + " is left out: a matt surface of its colour takes its place");
  return made;
}

/// What the medium takes away a unit of length.
std::optional<DescribedColour> absorption_of(MitsubaScene& scene, xml_node medium) {
  const MitsubaFile& file = scene.file;
  const Location where = file.at(medium);
  if (file.attribute(medium, "type") != "homogeneous" || file.child(medium, "material")) {
    scene.d.note(where, "the medium is left out: there is clear space in its place");
    return std::nullopt;
  }
  const double scale = file.number(medium, "scale", 1);
  const bool apart = file.child(medium, "sigma_a") || file.child(medium, "sigma_s");
  const optics::Spectrum scattered =
      values_of(mitsuba_colour(scene, medium, apart ? "sigma_s" : "albedo", apart ? 1 : 0.75));
  if (std::ranges::any_of(scattered, [](double value) { return value > 0; }))
    scene.d.note(where, "the medium scatters in the file, and only absorbs here");
  if (apart) return mitsuba_colour(scene, medium, "sigma_a", 1) * scale;
  DescribedColour absorption;
  absorption.spectrum = values_of(mitsuba_colour(scene, medium, "sigma_t", 1));
  for (std::size_t i = 0; i < scattered.size(); ++i)
    (*absorption.spectrum)[i] *= scale * std::max(1 - scattered[i], 0.0);
  return absorption;
}

} // namespace

void note_unasked(MitsubaScene& scene, xml_node node) {
  // How to render and to write files, textures' coordinates, and what has a note of its own where it counts.
  static const std::string_view harmless =
      " alpha alpha_u alpha_v distribution sample_visible eta k material near_clip far_clip focus_distance "
      "aperture_radius file_format pixel_format component_format banner sampling_weight flip_tex_coords "
      "crop_offset_x crop_offset_y crop_width crop_height sample_border compensate shutter_open shutter_close "
      "filename method high_quality_edges nonlinear ";
  for (const xml_node value : scene.file.unasked(node))
    if (const std::string name = mitsuba_name(value.attribute("name").value());
        harmless.find(" " + name + " ") == std::string_view::npos)
      scene.d.note(scene.file.at(value), fmt::format("its \"{}\" is left out", name));
}

DescribedColour mitsuba_colour(MitsubaScene& scene, xml_node parent, const std::string& name, double standard) {
  DescribedColour grey;
  grey.rgb = glm::dvec3(standard);
  const xml_node node = scene.file.child(parent, name);
  if (!node) return grey;
  if (const auto colour = colour_of(scene, node)) return *colour;
  if (const auto texture = mitsuba_texture(scene, parent, name, scatter::Texels::numbers))
    if (const auto mean = mean_of(*texture, !scene.file.flag(node, "raw"))) {
      scene.d.note(scene.file.at(node), fmt::format("this {} is taken by its mean", node.name()));
      grey.rgb = *mean;
      return grey;
    }
  scene.d.note(scene.file.at(node), fmt::format("this {} is left out: {:.3g} takes its place", node.name(), standard));
  return grey;
}

namespace {

/// The key of what an unwrapped bsdf is, which may be a new one. medium: inside of it.
std::string key_of(MitsubaScene& scene, const Unwrapped& from, xml_node medium) {
  const MitsubaFile& file = scene.file;
  const xml_node node = from.bsdf, normal_map = from.normal_map;
  const std::string type = node ? mitsuba_name(file.attribute(node, "type")) : "diffuse";
  const double through = type == "principled" ? file.number(node, "spec_trans", 0) : 0;
  const bool thin = type == "thindielectric", is_glass = node && refracts(file, node);
  const auto [known, is_new] =
      scene.keys.try_emplace({node.hash_value(), (is_glass ? medium : normal_map).hash_value()});
  if (!is_new) return known->second;
  const std::string id = node ? file.attribute(node, "id") : std::string();
  const std::string key = known->second =
      unique(node ? name_of(id, fmt::format("material {}", file.at(node).line)) : "plain", scene.taken);
  if (normal_map && (is_glass || type != "diffuse"))
    scene.d.note(file.at(normal_map), "the normalmap is left out: here only diffuse surfaces have one");
  if (!is_glass) {
    preset::Material& made = scene.d.materials[key] = opaque(scene, node, type, key);
    if (normal_map && type == "diffuse") {
      const auto map = mitsuba_texture(scene, normal_map, "normalmap", scatter::Texels::numbers);
      if (!map || map->type != preset::Texture::Type::file)
        scene.d.note(file.at(normal_map), "the normalmap is left out: it is no picture");
      else
        made.normal_map = normals_with_y_up(*map, !file.flag(file.child(normal_map, "normalmap"), "raw"), key,
                                            file.at(normal_map), scene.d);
    }
    return key;
  }
  const Location where = file.at(node);
  DescribedGlass glass =
      through > 0 ? dielectric(scene, node, "eta", "1.5") : dielectric(scene, node, "int_ior", "bk7");
  glass.is_thin = thin;
  if (type == "roughdielectric") glass.roughness = roughness_of(scene, node, key, &glass.roughness_texture);
  if (type == "principled") glass.roughness = std::clamp(plain_number(scene, node, "roughness", 0.5), 0.0, 1.0);
  const char* const tint = through > 0 ? "base_color" : "specular_transmittance";
  if (through == 0) glass.tint_texture = mitsuba_texture(scene, node, tint, scatter::Texels::colours);
  if (file.child(node, tint) && !glass.tint_texture) glass.tint = mitsuba_colour(scene, node, tint, 1);
  if (through > 0 && glass.tint) { // whose root each surface of a principled body takes
    glass.tint->spectrum = values_of(*glass.tint);
    for (double& part : *glass.tint->spectrum) part = std::sqrt(std::max(part, 0.0));
  }
  if (is_given_and_not_one(scene, node, "specular_reflectance"))
    scene.d.note(where, "its specular_reflectance is left out: it reflects as clear glass does");
  if (medium && !thin) glass.absorption = absorption_of(scene, medium);
  note_unasked(scene, node);
  scene.d.dielectrics[key] = glass;
  return key;
}

/// The key of what all light is lost on.
const std::string& black_key(MitsubaScene& scene) {
  if (scene.black.empty()) {
    scene.black = unique("black back", scene.taken);
    scene.d.materials[scene.black].reflectance.value = 0;
  }
  return scene.black;
}

} // namespace

std::string mitsuba_material(MitsubaScene& scene, xml_node shape, std::optional<std::string>* back) {
  const MitsubaFile& file = scene.file;
  const xml_node bsdf = file.object(shape, "bsdf"), medium = file.object(shape, "medium", "interior");
  if (file.object(shape, "medium", "exterior"))
    scene.d.note(file.at(shape), "the medium around it is left out: there is clear space in its place");
  const Unwrapped front = unwrapped(scene, bsdf);
  const std::string type = mitsuba_name(file.attribute(front.bsdf, "type"));
  const bool is_glass = front.bsdf && refracts(file, front.bsdf);
  if (medium && !is_glass)
    scene.d.note(file.at(shape), "the medium in it is left out: there is clear space in its place");
  if (bsdf && !front.bsdf) return {};
  const std::string key = key_of(scene, front, medium);
  const Unwrapped behind = unwrapped(scene, front.back);
  if (behind.bsdf && refracts(file, behind.bsdf))
    scene.d.note(file.at(behind.bsdf), "the second side is left out: what is behind a surface is no glass");
  else if (behind.bsdf)
    *back = key_of(scene, behind, {});
  else if (!front.is_twosided && !is_glass && type != "principled")
    *back = black_key(scene);
  return key;
}

} // namespace nephroid::formats
