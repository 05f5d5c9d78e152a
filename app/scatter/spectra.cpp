// SPDX-License-Identifier: Apache-2.0
#include "scatter/spectra.h"

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

namespace nephroid::scatter {
namespace {

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
    const std::set<std::string> materials = shipped_materials();
    const std::string near = nearest(name, std::vector(materials.begin(), materials.end()));
    throw FileNotFound(where, name,
                       fmt::format("{}; the program comes with {}{}", missing->looked_in(), fmt::join(materials, ", "),
                                   near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  }
}

optics::DispersionCurve load_dispersion(const std::string& name) {
  return optics::load_dispersion(is_there(name) ? std::filesystem::path(name)
                                                : find_dispersion(name, FileFinder(), name));
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

optics::Spectrum make_light_spectrum(const preset::LightSpectrum& spectrum, const Location& where,
                                     optics::SpectralRange range) {
  using Type = preset::LightSpectrum::Type;
  return at(where, [&] {
    switch (spectrum.type) {
    case Type::blackbody: return optics::blackbody(spectrum.temperature_k, range);
    case Type::lines: return optics::light_lines(spectrum.table, range);
    case Type::table: return optics::light_table(spectrum.table, range);
    case Type::illuminant: break;
    }
    return optics::illuminant(spectrum.illuminant, range);
  });
}

optics::Spectrum make_reflectance(const preset::Reflectance& reflectance, const Location& where,
                                  optics::SpectralRange range) {
  using Type = preset::Reflectance::Type;
  return at(where, [&] {
    switch (reflectance.type) {
    case Type::patch: return optics::colorchecker_patch(reflectance.patch, range);
    case Type::table: return optics::reflectance_table(reflectance.table, range);
    case Type::constant: break;
    }
    return optics::constant_spectrum(reflectance.value);
  });
}

bool reaches_beyond(const preset::LightSpectrum& spectrum) {
  using Type = preset::LightSpectrum::Type;
  if (spectrum.type == Type::blackbody) return true;
  if (spectrum.type == Type::illuminant) return false;
  return std::ranges::any_of(spectrum.table, [](const std::array<double, 2>& row) {
    return row[1] > 0 && (row[0] < optics::first_nm || row[0] > optics::last_nm);
  });
}

} // namespace nephroid::scatter
