// SPDX-License-Identifier: Apache-2.0
#include "preset/value.h"

#include "preset/settings_type.h"

#include <algorithm>
#include <utility>

namespace nephroid::preset {

Settings::Settings() : Settings(*settings_types().front()) {}
Settings::Settings(const SettingsType& type) : type_(&type), value_(type.make()) {}

std::string_view Settings::engine() const { return type_->name; }

bool Settings::operator==(const Settings& other) const {
  return type_ == other.type_ && type_->equal(value_, other.value_);
}

std::vector<Member> Value::members() const {
  Fields fields;
  type_->describe(fields, at_);
  return std::move(fields.members_);
}

void Fields::add(std::string_view name, std::string_view sentence, const Value& value, Role role, Field more) {
  more.name = name;
  more.sentence = sentence;
  members_.push_back({more, value, role});
}

void Fields::settings(Settings& settings) {
  for (const SettingsType* type : settings_types())
    add(type->name, type->section().sentence, {type->of(settings), type->section()}, Role::section, {});
}

void Fields::settings(std::optional<Settings>& settings) {
  for (const SettingsType* type : settings_types())
    add(type->name, "Settings of the engine; without them the run's own, made exact.", {&settings, type->recipe()},
        Role::recipe, {});
}

ValueType described(ValueType type) {
  Fields fields;
  type.describe(fields, type.make().get());
  type.name = fields.name_;
  type.sentence = fields.sentence_;
  type.shorthands = std::move(fields.shorthands_);
  return type;
}

ValueType make_type(std::string*) { return {.kind = Kind::text}; }

ValueType make_type(Settings*) {
  ValueType type{.kind = Kind::word};
  for (const SettingsType* settings : settings_types()) type.words.push_back({settings->name, settings->sentence});
  type.word = [](const void* settings) {
    const auto& types = settings_types();
    const auto own = std::find(types.begin(), types.end(), &static_cast<const Settings*>(settings)->type());
    return static_cast<std::size_t>(own - types.begin());
  };
  type.choose = [](void* settings, std::size_t i) {
    *static_cast<Settings*>(settings) = Settings(*settings_types()[i]);
  };
  return type;
}

} // namespace nephroid::preset
