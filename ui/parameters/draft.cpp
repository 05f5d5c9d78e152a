// SPDX-License-Identifier: Apache-2.0
#include "ui/parameters/draft.h"

#include "base/error.h"
#include "base/files.h"
#include "base/location.h"
#include "preset/animation.h"
#include "preset/read.h"
#include "scatter/material.h"
#include "scatter/spectra.h"

#include <algorithm>

namespace nephroid::ui {
namespace {

using Pointer = Json::json_pointer;

std::string parent_of(const std::string& pointer) {
  return pointer.substr(0, std::min(pointer.rfind('/'), pointer.size()));
}

/// Refuses what a run would refuse of what changed, as far as that is known without it: missing files, spectra and
/// curves.
void check_loads(const preset::Preset& before, const preset::Preset& after) {
  const Location where{after.source, std::string()};
  const FileFinder finder(std::filesystem::path(after.source).parent_path());
  std::vector<std::string> warnings;
  for (const auto& [name, material] : after.scene.materials) {
    const auto was = before.scene.materials.find(name);
    if (was == before.scene.materials.end() || was->second != material)
      scatter::make_material(name, material, finder, where / "scene" / "materials" / name, warnings);
  }
  for (std::size_t i = 0; i < after.scene.lights.size(); ++i) {
    const preset::LightSpectrum& spectrum = after.scene.lights[i].spectrum;
    if (i >= before.scene.lights.size() || before.scene.lights[i].spectrum != spectrum)
      scatter::make_light_spectrum(spectrum, where / "scene" / "lights" / i / "spectrum");
  }
  const auto known = preset::file_names(before);
  for (const auto& file : preset::file_names(after))
    if (std::find(known.begin(), known.end(), file) == known.end()) // a file, or a material by its short name
      scatter::find_dispersion(file.second, finder, {after.source, file.first});
}

} // namespace

std::string child_of(const std::string& pointer, std::string_view key) { return pointer + "/" + pointer_key(key); }

std::string dotted(const std::string& pointer) {
  std::string text;
  for (Pointer at(pointer); !at.empty(); at.pop_back()) text.insert(0, text.empty() ? at.back() : at.back() + '.');
  return text;
}

bool is_inside(const std::string& pointer, const std::string& root) {
  return pointer.starts_with(root) && (pointer.size() == root.size() || pointer[root.size()] == '/');
}

void Draft::follow(const preset::Preset& preset) {
  frame_ = preset.provenance.frame.value_or(0);
  if (!base_.is_null() && preset == preset_) return;
  preset::Preset here = preset; // as it was opened or saved, under whatever name
  here.source = preset_.source;
  if (preset.source != preset_.source && !(here == preset_)) waiting_.clear();
  take(preset);
  std::erase_if(waiting_, [&](const auto& edit) { return !base_.contains(Pointer(parent_of(edit.first))); });
  value_ = with(waiting_);
  problems_.clear();
  for (const auto& [pointer, value] : waiting_)
    if (auto result = read({{pointer, value}}, pointer); auto* problem = std::get_if<Problem>(&result))
      problems_[pointer] = std::move(*problem);
}

void Draft::take(preset::Preset preset) {
  preset_ = std::move(preset);
  preset_.provenance = {};
  base_ = preset::as_json(preset_);
}

Json Draft::with(const Edits& edits) const {
  Json edited = base_;
  for (const auto& [pointer, value] : edits) edited[Pointer(pointer)] = value;
  return edited;
}

/// The preset with these edits, or why the one at `pointer` waits.
std::variant<preset::Preset, Problem> Draft::read(const Edits& edits, const std::string& pointer) const {
  try {
    preset::Preset edited =
        preset::read_json(preset::with_keys(base_, with(edits), frame_, preset_.source), preset_.source);
    check_loads(preset_, edited);
    return edited.animation && frame_ > 0 ? preset::shown_at(edited, frame_) : edited;
  } catch (const Error& error) {
    const Location& location = error.location();
    const bool in_preset = location.name == preset_.source && location.pointer;
    return Problem{pointer, in_preset ? *location.pointer : pointer, in_preset ? error.text() : error.line()};
  }
}

/// A mesh in place of a shape is an edit with a sibling.
Draft::Edits Draft::together(const std::string& pointer, Reach reach) const {
  Edits edits;
  for (const auto& [p, value] : waiting_)
    if (p == pointer || reach == Reach::all || (reach == Reach::siblings && parent_of(p) == parent_of(pointer)))
      edits[p] = value;
  return edits;
}

std::optional<preset::Preset> Draft::settle(const std::string& pointer) {
  problems_.erase(pointer);
  std::size_t tried = 0;
  for (const Reach reach : {Reach::alone, Reach::siblings, Reach::all}) {
    const Edits edits = together(pointer, reach);
    if (edits.size() == std::exchange(tried, edits.size())) continue; // the same edits
    auto result = read(edits, pointer);
    if (auto* problem = std::get_if<Problem>(&result)) {
      problems_.insert_or_assign(pointer, std::move(*problem)); // that of the most edits together stays
      continue;
    }
    take(std::get<preset::Preset>(std::move(result)));
    for (const auto& [settled, value] : edits) {
      waiting_.erase(settled);
      problems_.erase(settled);
    }
    return preset_;
  }
  return std::nullopt;
}

std::optional<preset::Preset> Draft::edit(const std::string& pointer, Json value) {
  std::string root = pointer; // an edit inside of one that waits is part of that
  for (const auto& [waiting, _] : waiting_)
    if (is_inside(pointer, waiting)) root = waiting;
  Json whole;
  if (root == pointer)
    whole = std::move(value);
  else {
    whole = value_.at(Pointer(root));
    whole[Pointer(pointer.substr(root.size()))] = std::move(value);
  }
  std::erase_if(waiting_, [&](const auto& edit) { return is_inside(edit.first, root); });
  std::erase_if(problems_, [&](const auto& problem) { return is_inside(problem.first, root); });
  waiting_[root] = std::move(whole);
  std::optional<preset::Preset> edited = settle(root);
  // What became possible lets others be possible.
  for (bool again = edited.has_value(); again;) {
    again = false;
    for (const auto& [waiting, _] : Edits(waiting_))
      if (auto more = settle(waiting)) {
        edited = std::move(more);
        again = true;
        break;
      }
  }
  value_ = with(waiting_);
  return edited;
}

std::optional<Problem> Draft::trial(const std::string& pointer, const Json& value) const {
  Draft tried = *this;
  tried.edit(pointer, value);
  for (const auto& [edit, problem] : tried.problems_)
    if (is_inside(pointer, edit)) return Problem{pointer, problem.place, problem.text};
  return std::nullopt;
}

void Draft::drop(const std::string& pointer) {
  waiting_.erase(pointer);
  problems_.erase(pointer);
  value_ = with(waiting_);
}

} // namespace nephroid::ui
