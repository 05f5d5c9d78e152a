// SPDX-License-Identifier: Apache-2.0
#include "scene/materials.h"

#include "base/error.h"
#include "base/nearest.h"
#include "optics/dispersion_file.h"
#include "optics/fresnel.h"
#include "optics/spectrum.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <system_error>

namespace nephroid::scene {
namespace {

/// What optics throws names a curve or a file; the person needs the preset's field as well.
template <class Make>
auto at(const Location& where, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.location() == where) throw;
    throw Error(error.kind(), where, error.line());
  }
}

/// presets/materials/NAME or NAME.yml, or the only NAME-*.yml, where there is one.
std::optional<std::filesystem::path> shipped_material(const std::string& name) {
  const std::filesystem::path presets = presets_folder_if_any();
  if (presets.empty() || name.empty() || std::filesystem::path(name).is_absolute()) return std::nullopt;
  std::error_code ignored;
  for (const std::string& file : {name, name + ".yml"})
    if (const auto material = presets / "materials" / file; std::filesystem::is_regular_file(material, ignored))
      return material;
  const std::set<std::string> names = shipped_materials();
  const auto first = names.lower_bound(name + "-");
  const auto begins_so = [&](auto entry) { return entry != names.end() && entry->starts_with(name + "-"); };
  if (begins_so(first) && !begins_so(std::next(first))) return presets / "materials" / (*first + ".yml");
  return std::nullopt;
}

} // namespace

std::set<std::string> shipped_materials() {
  std::set<std::string> names;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(presets_folder_if_any() / "materials", ignored), end;
       !ignored && entry != end; entry.increment(ignored))
    if (entry->path().extension() == ".yml") names.insert(entry->path().stem().string());
  return names;
}

std::vector<ShippedMaterial> read_shipped_materials() {
  std::vector<ShippedMaterial> materials;
  for (const std::string& stem : shipped_materials()) try {
      const auto file = shipped_material(stem);
      ShippedMaterial material{stem, false, {}, {}};
      // A file's name ends in who measured it: "gold-Johnson".
      if (const std::string short_name = stem.substr(0, stem.rfind('-')); shipped_material(short_name) == file)
        material.name = short_name;
      const optics::DispersionCurve curve = optics::load_dispersion(*file);
      const optics::IndexSample at_d = curve.sample(optics::line_d_nm);
      material.metal = at_d.k.value_or(0) > 1; // light comes less than 50 nm deep
      material.n_d = at_d.n;
      material.abbe = optics::abbe_number(curve);
      materials.push_back(std::move(material));
    } catch (const Error&) {
      // What uses it says what is wrong with it.
    }
  return materials;
}

std::filesystem::path find_dispersion(const std::string& name, const FileFinder& finder, const Location& where) {
  try {
    return finder.find(name, where);
  } catch (const Error& error) {
    if (const auto shipped = shipped_material(name)) return *shipped;
    const auto* missing = dynamic_cast<const FileNotFound*>(&error);
    const bool may_be_a_short_name =
        std::filesystem::path(name).extension().string().size() != 4 || name.ends_with(".yml");
    if (!missing || !may_be_a_short_name) throw;
    throw FileNotFound(
        where, name,
        fmt::format("{}; the program comes with {}", missing->looked_in(), fmt::join(shipped_materials(), ", ")));
  }
}

optics::DispersionCurve load_dispersion(const std::string& name) {
  if (is_there(name)) return optics::load_dispersion(name);
  try {
    return optics::load_dispersion(find_dispersion(name, FileFinder(), name));
  } catch (const FileNotFound& error) {
    const std::set<std::string> materials = shipped_materials();
    const std::string material = nearest(name, std::vector(materials.begin(), materials.end()));
    if (material.empty()) throw;
    throw error.noting(fmt::format("did you mean '{}'?", material));
  }
}

optics::DispersionCurve make_curve(const preset::Dispersion& dispersion, const FileFinder& finder,
                                   const Location& where) {
  using Type = preset::Dispersion::Type;
  return at(where, [&] {
    switch (dispersion.type) {
    case Type::file: return optics::load_dispersion(find_dispersion(dispersion.file, finder, where));
    case Type::sellmeier: return optics::sellmeier(dispersion.b, dispersion.c_um2);
    case Type::cauchy: return optics::cauchy(dispersion.coefficients);
    case Type::table: return optics::tabulated(dispersion.table);
    case Type::points: return optics::control_points(dispersion.table);
    case Type::constant: break;
    }
    return optics::constant_index(dispersion.n);
  });
}

optics::Spectrum make_light_spectrum(const preset::LightSpectrum& spectrum, const Location& where) {
  using Type = preset::LightSpectrum::Type;
  return at(where, [&] {
    switch (spectrum.type) {
    case Type::blackbody: return optics::blackbody(spectrum.temperature_k);
    case Type::lines: return optics::light_lines(spectrum.table);
    case Type::table: return optics::light_table(spectrum.table);
    case Type::illuminant: break;
    }
    return optics::illuminant(spectrum.illuminant);
  });
}

optics::Spectrum make_reflectance(const preset::Reflectance& reflectance, const Location& where) {
  using Type = preset::Reflectance::Type;
  return at(where, [&] {
    switch (reflectance.type) {
    case Type::patch: return optics::colorchecker_patch(reflectance.patch);
    case Type::table: return optics::reflectance_table(reflectance.table);
    case Type::constant: break;
    }
    return optics::constant_spectrum(reflectance.value);
  });
}

Material make_material(const std::string& name, const preset::Material& material, const FileFinder& finder,
                       const Location& where, std::vector<std::string>& warnings) {
  Material result;
  result.name = name;
  result.type = material.type;
  if (is_specular(material.type)) result.alpha = material.roughness * material.roughness;
  const auto sampled = [&](const preset::Dispersion& dispersion, const Location& field, const auto& sample) {
    const optics::DispersionCurve curve = make_curve(dispersion, finder, field);
    const optics::Extrapolation outside = outside_policy(dispersion.outside);
    at(field, [&] { return sample(curve, outside), 0; });
    if (const std::string note = optics::outside_note(curve, outside); !note.empty())
      warnings.push_back(fmt::format("material '{}': {}", name, note));
  };
  const std::string owner = fmt::format("material '{}'", name);
  const auto pictured = [&](const std::optional<preset::Texture>& texture, Texels texels, const char* field) {
    return !texture ? nullptr
                    : std::make_shared<const Texture>(
                          make_texture(*texture, texels, finder, where / field, owner, warnings));
  };
  if (is_specular(material.type) && !is_plastic(result) && material.roughness_texture) {
    if (!is_rough(result))
      throw bad_input(where / "roughness_texture", "multiplies a roughness of 0", "expected a roughness above 0",
                      "set the roughness to 1 for that of the picture");
    result.roughness_texture = pictured(material.roughness_texture, Texels::numbers, "roughness_texture");
  }
  if (material.type == Material::Type::diffuse && material.normal_map)
    result.normal_map = std::make_shared<const Texture>(
        make_normal_map(*material.normal_map, material.normal_scale, finder, where / "normal_map", owner, warnings));
  preset::Dispersion metal;
  metal.type = preset::Dispersion::Type::file;
  metal.file = material.metal;
  const Location dispersion = where / "dispersion";
  switch (material.type) {
  case Material::Type::plastic:
    sampled(material.dispersion, dispersion, [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
      result.coat_n = curve.sample(588, outside).n.value_or(0);
    });
    if (!(result.coat_n >= 1 && result.coat_n <= 4))
      throw bad_input(dispersion, fmt::format("is {:.3g} at 588 nm", result.coat_n), "expected 1 to 4 for a coat",
                      "varnish and plastic have about 1.5");
    result.coat = optics::make_coat(result.coat_n, result.alpha);
    [[fallthrough]];
  case Material::Type::diffuse:
    result.texture = pictured(material.texture, Texels::colours, "texture");
    [[fallthrough]];
  case Material::Type::mirror:
    result.reflectance = make_reflectance(material.reflectance, where / "reflectance");
    break;
  case Material::Type::conductor:
    sampled(metal, where / "metal", [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
      if (!curve.k)
        throw bad_input(where / "metal", fmt::format("{} has no k", curve.name), "expected a metal's n and k",
                        "take gold, silver, copper, aluminium, brass, or a file of refractiveindex.info");
      result.n = optics::sample_n(curve, outside);
      result.k = optics::sample_k(curve, outside);
    });
    if (const double most = std::ranges::max(result.k); most < 0.01)
      warnings.push_back(fmt::format("material '{}': its k is at most {:.2g}, which is no metal's: a conductor absorbs "
                                     "what a dielectric lets through",
                                     name, most));
    result.conductor = optics::conductor_terms(result.n, result.k);
    if (const double error = result.conductor.error; error > most_conductor_error)
      throw bad_input(where / "metal", fmt::format("has a reflectance that is off by up to {:.2g} here", error),
                      "expected n and k of a metal", "what light passes is a dielectric, with k as its absorption");
    else if (error > 0.001)
      warnings.push_back(fmt::format("material '{}': its reflectance is off by up to {:.2g}", name, error));
    for (std::size_t w = 0; w < result.n.size(); ++w)
      result.reflectance[w] = optics::conductor_reflectance(1, 1, {result.n[w], result.k[w]});
    break;
  case Material::Type::dielectric:
    sampled(material.dispersion, dispersion, [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
      result.n = optics::sample_n(curve, outside);
      if (material.absorption && curve.k && !material.thin) result.k = optics::sample_k(curve, outside);
    });
    result.absorbs = std::any_of(result.k.begin(), result.k.end(), [](double k) { return k > 0; });
    result.tint = make_reflectance(material.tint, where / "tint");
    result.texture = pictured(material.tint_texture, Texels::colours, "tint_texture");
    result.thin = material.thin;
    if (material.thin && is_rough(result))
      throw bad_input(where / "roughness", "is of a thin pane", "expected 0, or a body: a pane is polished",
                      "for a frosted pane take a plate");
    if (!material.coating) break;
    if (material.thin)
      throw bad_input(where / "coating", "is on a thin pane", "expected a body: a pane has no coating",
                      "for a film such as soap's, give a body the index 1 and the film as its coating");
    result.coating_nm = material.coating->thickness_nm;
    sampled(material.coating->dispersion, where / "coating" / "dispersion",
            [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
              result.coating_n = optics::sample_n(curve, outside);
            });
  }
  return result;
}

} // namespace nephroid::scene
