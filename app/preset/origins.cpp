// SPDX-License-Identifier: Apache-2.0
#include "preset/origins.h"

#include "base/files.h"

#include <fmt/format.h>

namespace nephroid::preset {

Origins::Origins(Origin main) : main_(std::make_shared<const Origin>(std::move(main))) { of_[""] = main_; }

Origins::Shared Origins::shared_at(const std::string& pointer) const {
  for (std::string at = pointer;; at.resize(at.rfind('/'))) {
    if (const auto found = of_.find(at); found != of_.end()) return found->second;
    if (at.empty()) return main_;
  }
}

Location Origins::where(const std::string& pointer) const {
  const Origin& from = at(pointer);
  Location place = from.place;
  if (from.is_file) place.pointer = pointer;
  place.field = pointer;
  return place;
}

void Origins::set_whole(const std::string& pointer, Shared origin) {
  const std::string inside = pointer + "/";
  const auto first = of_.lower_bound(inside);
  auto last = first;
  while (last != of_.end() && last->first.starts_with(inside)) ++last;
  of_.erase(first, last);
  of_[pointer] = std::move(origin);
}

void set_origin(Preset& preset, const std::string& pointer, const std::string& name) {
  const Origins* before = preset.provenance.origins.get();
  auto origins = before ? std::make_shared<Origins>(*before)
                        : std::make_shared<Origins>(Origin{.place = preset.source, .folder = {}});
  origins->set_whole(
      pointer, std::make_shared<const Origin>(Origin{.place = name, .is_file = false, .folder = {}, .is_typed = true}));
  preset.provenance.origins = std::move(origins);
}

namespace {

/// Whether the preset is still the one that its origins tell of.
bool is_as_read(const Preset& preset) {
  return preset.provenance.origins && preset.provenance.origins->main().place.name == preset.source;
}

Error at_origin(const Origins& origins, const std::string& pointer, const Error& error) {
  const Location where = origins.where(pointer);
  const auto* missing = dynamic_cast<const FileNotFound*>(&error);
  if (missing && origins.at(pointer).is_typed)
    return FileNotFound(where, missing->name(), "the current folder, " + missing->looked_in());
  return error.at(where);
}

/// "in frame 3 of the run 'lens,seed=2' of the sweep"; empty of a preset that stands alone.
std::string part_of(const Provenance& provenance) {
  const std::string frame = provenance.frame ? fmt::format("in frame {}", *provenance.frame) : std::string();
  if (provenance.run.empty()) return frame;
  return fmt::format("{} the run '{}' of the sweep", frame.empty() ? "in" : frame + " of", provenance.run);
}

} // namespace

std::string field_of(const Preset& preset, const Location& place) {
  return place.field.empty() && place.name == preset.source ? place.pointer.value_or("") : place.field;
}

void rethrow_at_origin(const Preset& preset, const Error& error) {
  const std::string pointer = is_as_read(preset) ? field_of(preset, error.location()) : std::string(),
                    part = part_of(preset.provenance);
  if (pointer.empty() && part.empty()) throw;
  const Error error_at_origin = pointer.empty() ? error : at_origin(*preset.provenance.origins, pointer, error);
  // A missing device is missing for every run, and what is interrupted names the run's folder.
  const bool may_be_of_one_run = error.kind() == ErrorKind::bad_input || error.kind() == ErrorKind::failed;
  // An item of the sweep's list says already what runs it is about.
  const bool is_at_swept_value = error_at_origin.location().pointer.value_or("").starts_with("/sweep/");
  if (part.empty() || is_at_swept_value || !may_be_of_one_run) throw error_at_origin;
  throw error_at_origin.noting(part);
}

} // namespace nephroid::preset
