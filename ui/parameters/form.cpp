// SPDX-License-Identifier: Apache-2.0
#include "ui/parameters/form.h"

#include "base/lower_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {

using preset::Outline;
using Kind = Outline::Kind;

const Json& part(const Json& object, const Outline& o) {
  static const Json none;
  const auto found = object.find(o.field.name);
  return found == object.end() ? none : *found;
}

bool is_changed(const Outline& o, const Json& value) {
  if (o.kind != Kind::object || o.optional) return !o.field.required && value != o.standard;
  const auto fields = o.fields(value);
  return std::any_of(fields.begin(), fields.end(), [&](const Outline& f) { return is_changed(f, part(value, f)); });
}

void Form::push_edits(const Context& context) {
  for (PendingEdit& asked : std::exchange(asked_, {})) {
    if (auto edited = draft.edit(asked.pointer, std::move(asked.value)))
      context.push(command::Edit{.label = std::move(asked.label),
                                 .preset = *std::move(edited),
                                 .gesture = asked.live ? gestures.number() : 0,
                                 .live = asked.live,
                                 .was_read = true});
    else if (!asked.live)
      for (const auto& [edit, problem] : draft.problems())
        if (is_inside(asked.pointer, edit)) reveal = shown_at(problem);
  }
  if (std::exchange(gesture_ended_, false)) context.push(command::EndGesture{});
}

const std::string& shown_at(const Problem& problem) {
  return is_inside(problem.place, problem.pointer) ? problem.place : problem.pointer;
}

bool Form::wants(const Outline& o, const Json& value, const std::string& pointer) const {
  if (o.is_engine_settings && draft.value()["engine"] != o.field.name) return false;
  if (!searching()) return true;
  if (only_changed && !is_changed(o, value)) return false;
  if (has_words(fmt::format("{} {} {}", dotted(pointer), o.field.sentence, o.field.unit), search)) return true;
  if (!o.object && lower_case(search).starts_with(lower_case(dotted(pointer)) + ".")) return true; // a number of it
  if (value.is_null() || !o.object) return false;
  if (o.kind == Kind::object) return wants_any(o, value, pointer);
  const auto items = value.items();
  return std::any_of(items.begin(), items.end(),
                     [&](const auto& item) { return wants_any(o, item.value(), child_of(pointer, item.key())); });
}

bool Form::wants_any(const Outline& o, const Json& object, const std::string& pointer) const {
  const auto fields = o.fields(object);
  return std::any_of(fields.begin(), fields.end(),
                     [&](const Outline& f) { return wants(f, part(object, f), child_of(pointer, f.field.name)); });
}

} // namespace nephroid::ui
