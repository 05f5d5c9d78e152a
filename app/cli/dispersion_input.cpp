// SPDX-License-Identifier: Apache-2.0
#include "cli/dispersion_input.h"

#include "base/nearest.h"
#include "optics/dispersion_file.h"
#include "scene/materials.h"

#include <fmt/format.h>

namespace nephroid::cli {
namespace {

namespace fs = std::filesystem;

/// The names of the shipped materials.
std::vector<std::string> shipped_materials() {
  std::vector<std::string> names;
  const fs::path presets = presets_folder_if_any();
  if (presets.empty()) return names;
  std::error_code error; // a folder that cannot be read gives no names
  for (fs::directory_iterator entry(presets / "materials", error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".yml") names.push_back(entry->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path find_file(const std::string& name) {
  if (is_there(name)) return name;
  try {
    return scene::find_dispersion(name, FileFinder(), name);
  } catch (const FileNotFound& error) {
    const std::string material = nearest(name, shipped_materials());
    if (material.empty()) throw;
    throw error.noting(fmt::format("did you mean '{}'?", material));
  }
}

} // namespace

bool is_dispersion(const std::string& name) {
  const std::vector<std::string> materials = shipped_materials();
  return fs::path(name).extension() == ".yml" || std::find(materials.begin(), materials.end(), name) != materials.end();
}

optics::DispersionCurve find_dispersion(const std::string& name) { return optics::load_dispersion(find_file(name)); }

void add_outside_option(Verb& verb, std::string& chosen) {
  chosen = "automatic";
  verb.option("--outside", chosen,
              {.type = "POLICY",
               .says = "Outside the data's range: hold its end, extrapolate, or refuse; default: extrapolate a "
                       "formula, hold a table",
               .words = words_of<preset::Extrapolation>()});
}

optics::Extrapolation outside_policy(const std::string& chosen) {
  return scene::outside_policy(chosen_of<preset::Extrapolation>(chosen));
}

} // namespace nephroid::cli
