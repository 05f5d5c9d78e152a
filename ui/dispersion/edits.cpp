// SPDX-License-Identifier: Apache-2.0
#include "ui/dispersion/edits.h"

#include "base/error.h"
#include "base/files.h"
#include "optics/dispersion.h"
#include "scene/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

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

preset::Preset with_dispersion(const preset::Preset& preset, const std::string& material, preset::Dispersion dispersion)
{
  preset::Preset edited = preset;
  edited.scene.materials.at(material).dispersion = std::move(dispersion);
  return edited;
}

std::vector<ControlPoint> sorted_points(const preset::Dispersion& dispersion)
{
  if (dispersion.type != preset::Dispersion::Type::points) return {};
  return sorted_rows(dispersion.table);
}

preset::Dispersion with_points(const preset::Dispersion& before, std::vector<ControlPoint> points)
{
  preset::Dispersion dispersion;
  dispersion.type = preset::Dispersion::Type::points;
  dispersion.table = std::move(points);
  dispersion.outside = before.outside;
  return dispersion;
}

ControlPoint snapped(ControlPoint point, ControlPoint step)
{
  for (std::size_t i = 0; i < 2; ++i)
    if (step[i] > 0) point[i] = std::round(point[i] / step[i]) * step[i];
  return point;
}

FittedPoints fit_points(const optics::Spectrum& n, double tolerance, std::size_t most)
{
  const auto point = [&](int index) {
    // Seven decimals are as much as any table has.
    const double value = std::round(n[static_cast<std::size_t>(index)] * 1e7) / 1e7;
    return ControlPoint{static_cast<double>(optics::wavelength_nm(index)),
                        std::clamp(value, preset::index_bounds.low, preset::index_bounds.high)};
  };
  FittedPoints fitted;
  fitted.points = {point(0), point(optics::wavelength_count - 1)};
  while (true) {
    const optics::Spectrum made = optics::sample_n(optics::control_points(fitted.points), optics::Outside::hold);
    int worst = 0;
    fitted.greatest_deviation = 0;
    for (int i = 0; i < optics::wavelength_count; ++i) {
      const double deviation = std::fabs(made[static_cast<std::size_t>(i)] - n[static_cast<std::size_t>(i)]);
      if (deviation > fitted.greatest_deviation) fitted.greatest_deviation = deviation, worst = i;
    }
    if (fitted.greatest_deviation <= tolerance || fitted.points.size() >= std::max<std::size_t>(most, 2)) return fitted;
    if (!add_row(fitted.points, point(worst), point_rules)) return fitted; // it is a point already: nothing gets better
  }
}

preset::Dispersion load_file(const std::string& file, const std::string& preset_source)
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

bool is_dispersion_file(const std::string& file)
{
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".yml" || ending == ".yaml";
}

} // namespace nephroid::ui
