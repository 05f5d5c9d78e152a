// SPDX-License-Identifier: Apache-2.0
// The workbench's commands about the dispersion of one dielectric.
#include "base/error.h"
#include "ui/dispersion/edits.h"
#include "ui/state/workbench.h"

#include <filesystem>

namespace nephroid::ui {

void Workbench::carry_out(const command::ChooseMaterial& c) { material_ = c.material; }

void Workbench::carry_out(const command::LoadDispersion& c)
{
  if (!history_) throw bad_input(c.file, "is dispersion data, and no preset is open", {}, "open a preset with glass, then load it");
  const preset::Preset& preset = history_->current();
  const std::string material = shown_dielectric(preset, material_);
  if (material.empty())
    throw bad_input(c.file, "is dispersion data, and this preset has no dielectric", "expected a material of type \"dielectric\"");
  preset::Dispersion loaded = load_file(c.file, preset.source);
  const std::string name = std::filesystem::path(c.file).stem().string();
  carry_out(command::Edit{"load " + name + " into " + material, with_dispersion(preset, material, std::move(loaded))});
  say(false, "loaded " + name + " into the material '" + material + "'");
}

} // namespace nephroid::ui
