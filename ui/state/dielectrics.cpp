// SPDX-License-Identifier: Apache-2.0
#include "ui/state/dielectrics.h"

#include "base/files.h"
#include "optics/dispersion.h"
#include "scene/materials.h"

#include <algorithm>
#include <filesystem>

namespace nephroid::ui {

std::vector<std::string> dielectrics(const preset::Preset& preset)
{
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    const auto found = preset.scene.materials.find(name);
    if (found == preset.scene.materials.end() || found->second.type != preset::Material::Type::dielectric) return;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const preset::Object& object : preset.scene.objects) add(object.material);
  for (const auto& [name, material] : preset.scene.materials) add(name);
  return names;
}

std::string shown_dielectric(const preset::Preset& preset, const std::string& chosen)
{
  const std::vector<std::string> names = dielectrics(preset);
  if (std::find(names.begin(), names.end(), chosen) != names.end()) return chosen;
  return names.empty() ? std::string() : names.front();
}

preset::Dispersion load_dispersion(const std::string& file, const std::string& preset_source)
{
  preset::Dispersion dispersion;
  dispersion.type = preset::Dispersion::Type::file;
  // A path means what it means to the shell that the program was started from; a name is looked for where a preset's is.
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::absolute(file, ignored);
  dispersion.file = !file.empty() && is_there(path) ? path.string() : file;
  const FileFinder finder(std::filesystem::path(preset_source).parent_path());
  optics::sample_n(scene::make_curve(dispersion, finder, file.empty() ? "load dispersion" : file), optics::Outside::automatic);
  return dispersion;
}

} // namespace nephroid::ui
