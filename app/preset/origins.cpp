// SPDX-License-Identifier: Apache-2.0
#include "preset/origins.h"

#include "base/files.h"

#include <utility>

namespace nephroid::preset {

Origins::Origins(Origin main) : main_(std::make_shared<const Origin>(std::move(main))) { of_[""] = main_; }

Origins::Shared Origins::shared_at(const std::string& pointer) const
{
  for (std::string at = pointer;; at.resize(at.rfind('/'))) {
    if (const auto found = of_.find(at); found != of_.end()) return found->second;
    if (at.empty()) return main_;
  }
}

std::string Origins::where(const std::string& pointer) const
{
  const Origin& from = at(pointer);
  return from.is_file ? from.name + "#" + pointer : from.name;
}

void Origins::set_whole(const std::string& pointer, Shared origin)
{
  const std::string inside = pointer + "/";
  const auto first = of_.lower_bound(inside);
  auto last = first;
  while (last != of_.end() && last->first.starts_with(inside)) ++last;
  of_.erase(first, last);
  of_[pointer] = std::move(origin);
}

void set_origin(Preset& preset, const std::string& pointer, const std::string& name)
{
  const Origins* before = preset.provenance.origins.get();
  auto origins = before ? std::make_shared<Origins>(*before) : std::make_shared<Origins>(Origin{.name = preset.source, .folder = {}});
  origins->set_whole(pointer, std::make_shared<const Origin>(Origin{.name = name, .is_file = false, .folder = {}, .is_typed = true}));
  preset.provenance.origins = std::move(origins);
}

namespace {

/// Of the value that the error is about; empty where it is about no value of the preset as it was read.
std::string pointer_of(const Preset& preset, const Error& error)
{
  const Origins* origins = preset.provenance.origins.get();
  const std::string file = preset.source + "#";
  const bool is_known = origins && origins->main().name == preset.source && error.where().starts_with(file + "/");
  return is_known ? error.where().substr(file.size()) : std::string();
}

Error at_origin(const Origins& origins, const std::string& pointer, const Error& error)
{
  const std::string where = origins.where(pointer);
  const auto* missing = dynamic_cast<const FileNotFound*>(&error);
  if (missing && origins.at(pointer).is_typed) return FileNotFound(where, missing->name(), "the current folder, " + missing->looked_in());
  return error.at(where);
}

/// At an item of the sweep's list, which says already what runs it is about.
bool is_at_swept_value(const Error& error) { return error.where().find("#/sweep/") != std::string::npos; }

} // namespace

void rethrow_at_origin(const Preset& preset, const Error& error)
{
  const std::string pointer = pointer_of(preset, error), &run = preset.provenance.run;
  if (pointer.empty() && run.empty()) throw;
  const Error told = pointer.empty() ? error : at_origin(*preset.provenance.origins, pointer, error);
  // A missing device is missing for every run, and what is interrupted names the run's folder.
  const bool may_be_of_one_run = error.kind() == ErrorKind::bad_input || error.kind() == ErrorKind::failed;
  if (run.empty() || is_at_swept_value(told) || !may_be_of_one_run) throw told;
  throw told.noting("in the run '" + run + "' of the sweep");
}

} // namespace nephroid::preset
