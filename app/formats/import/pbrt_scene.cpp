// SPDX-License-Identifier: Apache-2.0
#include "formats/import/pbrt_scene.h"

#include "base/error.h"
#include "formats/import/dielectrics.h"
#include "formats/import/textures.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace nephroid::formats {
namespace {

using Rows = std::vector<std::array<double, 2>>;

/// Schott's glasses that PBRT names: Sellmeier's coefficients of Schott's data sheets.
struct NamedGlass {
  const char* name;
  std::vector<double> b, c_um2;
};
const std::vector<NamedGlass>& named_glasses() {
  static const std::vector<NamedGlass> glasses{
      {"glass-BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
      {"glass-BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
      {"glass-FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
      {"glass-LASF9", {2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},
      {"glass-F5", {1.3104463, 0.19603426, 0.96612977}, {0.00958633048, 0.0457627627, 115.011883}},
      {"glass-SF5", {1.52481889, 0.187085527, 1.42729015}, {0.011254756, 0.0588995392, 129.141675}},
      {"glass-SF10", {1.62153902, 0.256287842, 1.64447552}, {0.0122241457, 0.0595736775, 147.468793}},
      {"glass-SF11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}}};
  return glasses;
}

bool is_name(const PbrtParameter& p) { return p.values.size() == 1 && !scene_number(p.values[0]); }

Rows pairs_of(const PbrtParameter& p) {
  const std::vector<double> numbers = p.numbers();
  if (numbers.size() % 2 != 0)
    throw bad_input(p.where, fmt::format("\"{}\" has {} values", p.name, numbers.size()), "expected pairs");
  Rows rows;
  for (std::size_t i = 0; i < numbers.size(); i += 2) rows.push_back({numbers[i], numbers[i + 1]});
  return rows;
}

/// A constant texture's value in the texture's place.
const PbrtParameter* resolved(const PbrtScene& scene, const PbrtParameters& p, const std::string& name) {
  const PbrtParameter* given = p.find(name);
  if (given && given->type == "texture" && !given->values.empty())
    if (const auto found = scene.textures.find(given->values[0]); found != scene.textures.end()) return &found->second;
  return given;
}

/// Nothing for what is no colour.
std::optional<DescribedColour> colour_of(const PbrtScene& scene, const PbrtParameter& p) {
  static const double unit = optics::to_xyz(optics::constant_spectrum(1))[1]; // PBRT's own: the integral of y
  DescribedColour colour;
  if (p.type == "rgb" || p.type == "color" || p.type == "float" || p.type == "xyz") {
    const auto v = p.numbers();
    if (v.size() != 1 && v.size() != 3)
      throw bad_input(p.where, fmt::format("\"{}\" has {} values", p.name, v.size()), "expected one or three");
    colour.rgb = v.size() == 1 ? glm::dvec3(v[0]) : glm::dvec3(v[0], v[1], v[2]);
    if (p.type != "xyz") return colour;
    const auto rgb = optics::xyz_to_linear_srgb({colour.rgb.x, colour.rgb.y, colour.rgb.z});
    colour.rgb = {rgb[0], rgb[1], rgb[2]};
    return colour;
  }
  if (p.type == "blackbody") {
    const auto v = p.numbers();
    if (v.size() != 1 && v.size() != 2)
      throw bad_input(p.where, fmt::format("\"{}\" has {} values", p.name, v.size()), "expected a temperature");
    colour = blackbody_of(v[0], unit, p.where);
    // The highest value is 1; version 3 has a factor behind it.
    return colour * ((v.size() == 2 ? v[1] : 1) / *std::ranges::max_element(*colour.spectrum));
  }
  if (p.type != "spectrum" || p.values.empty()) return std::nullopt;
  if (!is_name(p)) return spectrum_of_rows(pairs_of(p), unit, p.where);
  const std::string& name = p.values[0];
  if (const std::string cie = name.starts_with("stdillum-") ? name.substr(9) : std::string();
      std::ranges::count(optics::illuminant_names(), cie) > 0)
    return illuminant_of(cie, unit);
  const std::filesystem::path file = scene.file.find(name, p.where);
  if (!file.has_extension()) return std::nullopt;
  return spectrum_of_rows(rows_of_file(file, p.where), unit, p.where);
}

preset::Dispersion index_of(PbrtScene& scene, const PbrtParameters& p) {
  preset::Dispersion index;
  const PbrtParameter* eta = resolved(scene, p, p.find("eta") ? "eta" : "index");
  if (!eta || eta->values.empty()) return index;
  if (eta->type == "float") {
    const auto n = eta->numbers();
    if (n.size() != 1) throw bad_input(eta->where, "eta has several values", "expected one number");
    return glass_of(n[0], eta->where).inside;
  }
  if (const std::vector<std::string>& v = eta->values;
      eta->type == "rgb" && v.size() == 3 && v[0] == v[1] && v[0] == v[2])
    return glass_of(eta->numbers()[0], eta->where).inside;
  if (eta->type != "spectrum") {
    scene.d.note(eta->where, fmt::format("the {} of eta is left out: n = 1.5 takes its place", eta->type));
    return index;
  }
  const auto named = std::ranges::find(named_glasses(), eta->values[0], &NamedGlass::name);
  if (named != named_glasses().end()) {
    index.type = preset::Dispersion::Type::sellmeier;
    index.b = named->b;
    index.c_um2 = named->c_um2;
    return index;
  }
  const std::filesystem::path file =
      is_name(*eta) ? scene.file.find(eta->values[0], eta->where) : std::filesystem::path();
  if (is_name(*eta) && !file.has_extension()) {
    scene.d.note(eta->where, "the spectrum " + eta->values[0] + " of eta is left out: n = 1.5 takes its place");
    return index;
  }
  index.type = preset::Dispersion::Type::table;
  index.table = is_name(*eta) ? rows_of_file(file, eta->where) : pairs_of(*eta);
  for (const auto& row : index.table) glass_of(row[1], eta->where);
  return index;
}

/// What the medium takes away a unit of length.
std::optional<DescribedColour> absorption_of(PbrtScene& scene, const PbrtThing& medium) {
  const PbrtParameters& p = medium.parameters;
  if (medium.type != "homogeneous" || p.find("preset")) {
    scene.d.note(p.where, "the medium is left out: there is clear space in its place");
    return std::nullopt;
  }
  const auto given = [&](const char* name, const glm::dvec3& standard) {
    DescribedColour colour;
    colour.rgb = standard;
    return p.find(name) ? pbrt_colour(scene, p, name, 1) : colour;
  };
  if (!given("sigma_s", {2.55, 3.21, 3.77}).is_black())
    scene.d.note(p.where, "the medium scatters in the file, and only absorbs here");
  const DescribedColour absorption = given("sigma_a", {0.0011, 0.0024, 0.014}) * p.number("scale", 1);
  note_unasked(scene, p);
  return absorption;
}

/// A picture or a checkerboard, and what it is multiplied by.
struct ScaledTexture {
  preset::Texture texture;
  DescribedColour factor;
  bool is_srgb = true; ///< its integers
};

/// Of the texture that a parameter names; nothing where it is none that is taken over.
std::optional<ScaledTexture> texture_of(PbrtScene& scene, const PbrtParameters& from, const std::string& name,
                                        scatter::Texels texels) {
  const PbrtParameter* given = from.find(name);
  if (!given || given->type != "texture" || given->values.empty()) return std::nullopt;
  const auto& pictures = texels == scatter::Texels::colours ? scene.pictures : scene.numbers;
  const auto picture_named = pictures.find(given->values[0]);
  if (picture_named == pictures.end()) return std::nullopt;
  const std::string& kind = picture_named->second.type;
  const PbrtParameters& p = picture_named->second.parameters;
  const Nesting nesting(scene.nested, "textures", p.where);
  if (kind == "scale") { // "tex" by "scale" in version 4, "tex1" by "tex2" in 3; one of them a colour
    for (const auto& [texture, colour] : {std::pair("tex", "scale"), {"tex1", "tex2"}, {"tex2", "tex1"}})
      if (auto scaled = texture_of(scene, p, texture, texels)) {
        const DescribedColour factor = pbrt_colour(scene, p, colour, 1);
        const bool is_first = !scaled->factor.spectrum && scaled->factor.rgb == glm::dvec3(1);
        const glm::dvec3 both = linear_srgb_of(scaled->factor) * linear_srgb_of(factor);
        scaled->factor = factor;
        if (!is_first) {
          scaled->factor = {};
          scaled->factor.rgb = both;
        }
        return scaled;
      }
    return std::nullopt;
  }
  if ((kind != "imagemap" && kind != "checkerboard") || p.number("dimension", 2) != 2) return std::nullopt;
  if (p.text("mapping", "uv") != "uv") {
    scene.d.note(p.where, "the texture's mapping is left out: the surface's u, v count");
    return std::nullopt;
  }
  TextureMap map{glm::dmat2(p.number("uscale", 1), 0, 0, p.number("vscale", 1)),
                 {p.number("udelta", 0), p.number("vdelta", 0)}};
  ScaledTexture made;
  if (kind == "checkerboard") {
    made.texture.type = preset::Texture::Type::checkerboard;
    const auto colour_of_part = [&](const char* part, double standard) {
      return scene::to_vec3(glm::clamp(linear_srgb_of(pbrt_colour(scene, p, part, standard)), 0.0, 1.0));
    };
    made.texture.colour0 = colour_of_part("tex1", 1);
    made.texture.colour1 = colour_of_part("tex2", 0);
    made.texture = placed(made.texture, {0.5 * map.linear, 0.5 * map.offset}, p.where, scene.d); // a field is one unit
    return made;
  }
  const std::string wrap = p.text("wrap", "repeat");
  if (wrap != "repeat" && wrap != "clamp")
    scene.d.note(p.where, "the texture is not " + wrap + " beyond its edges here");
  const std::string encoding = p.text("encoding", "sRGB");
  made.is_srgb = encoding == "sRGB";
  const bool is_inverted = p.text("invert", "false") == "true";
  if (!made.is_srgb && encoding != "linear")
    scene.d.note(p.where, "the texture's encoding " + encoding + " is left out: its integers are linear here");
  made.factor = made.factor * p.number("scale", 1);
  auto file =
      picture(scene.file.find(p.text("filename", ""), p.where),
              wrap == "repeat" ? preset::Texture::Wrap::repeat : preset::Texture::Wrap::clamp, map, p.where, scene.d);
  if (file && (is_inverted || (!made.is_srgb && texels == scatter::Texels::colours))) {
    const double scale = p.number("scale", 1);
    file = linear_picture(*file, made.is_srgb, is_inverted ? std::optional(scale) : std::nullopt, p.where, scene.d);
    made.is_srgb = false;
    if (is_inverted) made.factor = {};
  }
  if (!file) return std::nullopt;
  made.texture = *file;
  return made;
}

} // namespace

void note_unasked(PbrtScene& scene, const PbrtParameters& p) {
  // How to render, textures' coordinates, what has a note of its own, and what only counts where a sensor, a lens or
  // scattering does.
  static const std::string_view harmless =
      " type filename diagonal savefp16 maxcomponentvalue maxsampleluminance shutteropen shutterclose focaldistance "
      "samples nsamples from to portal uv st S faceIndices emissionfilename remaproughness uroughness vroughness eta k "
      "g ";
  for (const PbrtParameter& parameter : p.unasked())
    if (harmless.find(" " + parameter.name + " ") == std::string_view::npos)
      scene.d.note(parameter.where, fmt::format("its \"{}\" is left out", parameter.name));
}

DescribedColour pbrt_colour(PbrtScene& scene, const PbrtParameters& p, const std::string& name, double standard) {
  DescribedColour grey;
  grey.rgb = glm::dvec3(standard);
  const PbrtParameter* given = resolved(scene, p, name);
  if (!given) return grey;
  if (const auto colour = colour_of(scene, *given)) return *colour;
  if (const auto scaled = texture_of(scene, p, name, scatter::Texels::colours))
    if (const auto mean = mean_of(scaled->texture, scaled->is_srgb)) {
      scene.d.note(given->where, fmt::format("the {} \"{}\" is taken by its mean", given->type, name));
      grey.rgb = *mean * linear_srgb_of(scaled->factor);
      return grey;
    }
  scene.d.note(given->where,
               fmt::format("the {} \"{}\" is left out: {:.3g} takes its place", given->type, name, standard));
  return grey;
}

DescribedColour pbrt_light_colour(PbrtScene& scene, const PbrtParameters& p, const std::string& name) {
  DescribedColour colour = pbrt_colour(scene, p, name, 1);
  if (colour.spectrum && !scene.is_version_3 && !colour.is_black()) colour = colour * (1 / colour.luminance);
  return colour * p.number("scale", 1);
}

namespace {

/// Copper where nothing is said.
preset::Material metal(PbrtScene& scene, const std::string& key, const PbrtParameters& p) {
  const PbrtParameter *const eta = resolved(scene, p, "eta"), *const k = resolved(scene, p, "k");
  const auto is_named = [](const PbrtParameter* given) {
    return given && given->type == "spectrum" && is_name(*given);
  };
  const std::string name = !eta && !k ? "metal-Cu-eta" : is_named(eta) ? eta->values[0] : std::string();
  if (name.starts_with("metal-") && name.ends_with("-eta")) // as version 4 names them
    if (const auto metal = metal_of_element(name.substr(6, name.size() - 10))) return *metal;
  if (eta && k)
    if (const auto n = colour_of(scene, *eta), extinction = colour_of(scene, *k); n && extinction)
      if (auto own = metal_of(scene.d, key, values_of(*n), values_of(*extinction))) return *own;
  scene.d.note(p.where, "the metal is left out: a mirror of 0.9 takes its place");
  preset::Material mirror;
  mirror.type = preset::Material::Type::mirror;
  mirror.reflectance.value = 0.9;
  return mirror;
}

} // namespace

namespace {

/// As a preset has it, whose square is the alpha of GGX. PBRT's alpha is the root of its roughness, in version 3 a
/// polynomial of its logarithm. standard: where the file has none. texture: gets the picture that it is multiplied by;
/// null: that is left out.
double roughness_of(PbrtScene& scene, const PbrtParameters& p, double standard, const std::string& key,
                    std::optional<preset::Texture>* texture) {
  const bool is_remapped = p.text("remaproughness", "true") != "false";
  if (texture && !(scene.is_version_3 && is_remapped))
    if (const auto values = texture_of(scene, p, "roughness", scatter::Texels::numbers)) {
      const double exponent = is_remapped ? 0.25 : 0.5;
      *texture = roughness_picture(values->texture, exponent, values->is_srgb, key, p.where, scene.d);
      if (*texture) return std::pow(std::clamp(linear_srgb_of(values->factor)[1], 0.0, 1.0), exponent);
    }
  const auto number_of = [&](const char* name, double otherwise) {
    const PbrtParameter* given = resolved(scene, p, name);
    if (!given) return otherwise;
    if (given->type == "float" && given->values.size() == 1) return given->numbers()[0];
    scene.d.note(given->where,
                 fmt::format("the {} \"{}\" is left out: {:.3g} takes its place", given->type, name, otherwise));
    return otherwise;
  };
  const double both = number_of("roughness", standard), u = number_of("uroughness", both),
               v = number_of("vroughness", both);
  if (u != v) scene.d.note(p.where, fmt::format("its two roughnesses {:.3g} and {:.3g} are one: their mean", u, v));
  const double mean = std::max((u + v) / 2, 0.0);
  if (mean == 0) return 0;
  double alpha = mean;
  if (is_remapped) {
    const double x = std::log(std::max(mean, 1e-3));
    alpha = scene.is_version_3
                ? 1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x + 0.000640711 * x * x * x * x
                : std::sqrt(mean);
  }
  return std::sqrt(std::clamp(alpha, 0.0, 1.0));
}

} // namespace

namespace {

/// Version 4 names "materials" and how much there is of the second, 3 two materials and how much there is of the first.
bool add_mix(PbrtScene& scene, const std::string& key, const PbrtParameters& p, const PbrtThing* medium) {
  const PbrtParameter* const list = p.find("materials");
  const std::string names[] = {list && !list->values.empty() ? list->values[0] : p.text("namedmaterial1", ""),
                               list && list->values.size() > 1 ? list->values[1] : p.text("namedmaterial2", "")};
  const double amount = glm::dot(linear_srgb_of(pbrt_colour(scene, p, "amount", 0.5)), glm::dvec3(1.0 / 3)),
               weight = list ? amount : 1 - amount;
  const Nesting nesting(scene.nested, "mixes", p.where);
  preset::Material parts[2];
  for (int i = 0; i < 2; ++i) {
    const auto part = scene.materials.find(names[i]);
    if (part == scene.materials.end()) throw bad_input(p.where, "there is no material \"" + names[i] + "\" to mix");
    const std::string name = key + "\n" + names[i]; // of no material that is kept
    add_pbrt_material(scene, name, part->second, nullptr);
    const auto opaque = scene.d.materials.extract(name);
    if (opaque.empty()) {
      scene.d.dielectrics.erase(name);
      scene.d.note(p.where, "the mix is left out: the heavier material in it is taken");
      return add_pbrt_material(scene, key, scene.materials.at(names[weight > 0.5 ? 1 : 0]), medium);
    }
    parts[i] = opaque.mapped();
  }
  if (medium) scene.d.note(p.where, "the medium in it is left out: there is clear space in its place");
  scene.d.materials[key] = mixed(parts[0], parts[1], weight, p.where, scene.d);
  note_unasked(scene, p);
  return true;
}

} // namespace

bool add_pbrt_material(PbrtScene& scene, const std::string& key, const PbrtThing& material, const PbrtThing* medium) {
  const std::string& type = material.type;
  const PbrtParameters& p = material.parameters;
  const bool thin = type == "thindielectric", refracts = thin || type == "dielectric" || type == "glass";
  const bool is_mix = type == "mix" && (p.find("materials") || p.find("namedmaterial1"));
  if (medium && !refracts && !is_mix)
    scene.d.note(p.where, "the medium in it is left out: there is clear space in its place");
  if (type == "interface" || type.empty() || type == "none") return false;
  if (refracts) {
    DescribedGlass& glass = scene.d.dielectrics[key];
    glass.inside = index_of(scene, p);
    glass.is_ratio = true;
    glass.is_thin = thin;
    glass.roughness = thin ? 0 : roughness_of(scene, p, 0, key, &glass.roughness_texture);
    if (const auto scaled = texture_of(scene, p, "Kt", scatter::Texels::colours)) {
      glass.tint_texture = scaled->texture;
      glass.tint = scaled->factor;
    } else if (p.find("Kt"))
      glass.tint = pbrt_colour(scene, p, "Kt", 1);
    if (const PbrtParameter* given = resolved(scene, p, "Kr"))
      if (const auto colour = colour_of(scene, *given); !colour || values_of(*colour) != optics::constant_spectrum(1))
        scene.d.note(given->where, "its Kr is left out: it reflects as clear glass does");
    if (medium && !thin) glass.absorption = absorption_of(scene, *medium);
    note_unasked(scene, p);
    return true;
  }
  if (is_mix) return add_mix(scene, key, p, medium);
  preset::Material& made = scene.d.materials[key];
  const auto reflect = [&](const char* name, double standard) {
    if (made.type == preset::Material::Type::diffuse)
      if (const auto scaled = texture_of(scene, p, name, scatter::Texels::colours)) {
        made.texture = scaled->texture;
        made.reflectance = reflectance_of(scaled->factor);
        return;
      }
    made.reflectance = reflectance_of(pbrt_colour(scene, p, name, standard));
  };
  const bool is_metal = type == "conductor" || type == "metal"; // as versions 4 and 3 call it
  if (is_metal || type == "mirror") {
    made.type = preset::Material::Type::mirror;
    if (is_metal && !p.find("reflectance"))
      made = metal(scene, key, p);
    else
      reflect(is_metal ? "reflectance" : "Kr", 0.9);
    made.roughness = roughness_of(scene, p, type == "metal" ? 0.01 : 0, key, &made.roughness_texture);
    note_unasked(scene, p);
    return true;
  }
  const bool is_older = type == "plastic" || type == "uber"; // whose Kd is .25 by default
  const char* const colour = p.find("Kd") || is_older ? "Kd" : "reflectance";
  reflect(colour, is_older ? 0.25 : 0.5);
  if (type == "coateddiffuse") {
    make_plastic(made, p.number("eta", 1.5), roughness_of(scene, p, 0, key, nullptr), !made.texture);
    if (made.texture) scene.d.note(p.where, "its texture is brighter here: its coat does not darken it");
    note_unasked(scene, p);
  } else if (type == "plastic") {
    make_plastic(made, 1.5, roughness_of(scene, p, 0.1, key, nullptr), false);
    scene.d.note(p.where, "its coat reflects as one of n = 1.5 does, and its Kd lies below that");
  } else if (type == "diffuse" || type == "matte") {
    if (const std::string map = p.text("normalmap", ""); !map.empty())
      made.normal_map = picture(scene.file.find(map, p.where), preset::Texture::Wrap::repeat, {}, p.where, scene.d);
    note_unasked(scene, p);
  } else
    scene.d.note(p.where, fmt::format("the material {} is left out: a matt surface of {} takes its place", type,
                                      p.find(colour) ? std::string("its ") + colour
                                      : is_older     ? "0.25"
                                                     : "0.5"));
  return true;
}

} // namespace nephroid::formats
