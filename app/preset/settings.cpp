// SPDX-License-Identifier: Apache-2.0
#include "preset/settings.h"

#include "preset/settings_type.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nephroid::preset {

Settings::Settings() : Settings(*settings_types().front()) {}
Settings::Settings(const SettingsType& type) : type_(&type), value_(type.make()) {}

std::string_view Settings::engine() const { return type_->name; }

bool Settings::operator==(const Settings& other) const { return type_ == other.type_ && type_->equal(value_, other.value_); }

void FileNames::settings(Settings& settings) { settings.type().name_files(settings.value(), rename_); }

void Keys::engine(const Field& field, const Settings& settings)
{
  names.emplace_back(field.name);
  engine_name = settings.type().name;
}
void Keys::settings(const Settings& settings) { names.emplace_back(settings.type().name); }
void Keys::settings(const std::optional<Settings>&)
{
  for (const SettingsType* type : settings_types()) names.emplace_back(type->name);
}

namespace {

std::vector<std::string> engine_names()
{
  std::vector<std::string> names;
  for (const SettingsType* type : settings_types()) names.emplace_back(type->name);
  return names;
}

const SettingsType* type_named(std::string_view name)
{
  for (const SettingsType* type : settings_types())
    if (type->name == name) return type;
  return nullptr;
}

} // namespace

void Reader::engine(const Field& f, Settings& settings)
{
  const std::string expected = fmt::format("one of {}", fmt::join(engine_names(), ", "));
  const auto found = object_.find(f.name);
  if (found == object_.end()) throw bad_input(document_.where(pointer_), fmt::format("has no '{}'", f.name), "expected " + expected);
  const std::string word = found->is_string() ? found->get<std::string>() : std::string();
  const SettingsType* const type = type_named(word);
  if (!type) refuse(*found, child(pointer_, f.name), expected, did_you_mean(word, engine_names()));
  settings = Settings(*type);
}

void Reader::settings(Settings& settings)
{
  const SettingsType& type = settings.type();
  if (const auto found = object_.find(type.name); found != object_.end())
    type.read(document_, *found, child(pointer_, type.name), settings.value());
}

void Reader::settings(std::optional<Settings>& settings)
{
  const SettingsType& type = *type_named(document_.value().at("engine").get<std::string>()); // read before: it is a word that is known
  settings.reset();
  for (const SettingsType* other : settings_types())
    if (other != &type && object_.contains(other->name)) refuse_of_other_engine(other->name, type.name);
  if (const auto found = object_.find(type.name); found != object_.end() && !found->is_null())
    type.read(document_, *found, child(pointer_, type.name), settings.emplace(type).value());
}

bool Reader::is_engine(std::string_view key) { return type_named(key) != nullptr; }

void Reader::refuse_of_other_engine(std::string_view section, std::string_view engine) const
{
  throw bad_input(document_.where(child(pointer_, section)), fmt::format("'{}' has no meaning for the engine '{}'", section, engine),
                  fmt::format("it belongs to '{}'", section), "remove it or change the engine");
}

void Writer::engine(const Field& f, const Settings& settings) { object_[std::string(f.name)] = std::string(settings.type().name); }
void Writer::settings(const Settings& settings) { object_[std::string(settings.type().name)] = settings.type().write(settings.value()); }
void Writer::settings(const std::optional<Settings>& settings)
{
  if (settings) this->settings(*settings);
}

void Properties::engine(const Field& f, const Settings&)
{
  Json words = Json::array();
  for (const SettingsType* type : settings_types())
    words.push_back({{"const", std::string(type->name)}, {"description", std::string(type->sentence)}});
  add(f, {{"oneOf", words}});
  required_.emplace_back(f.name);
}

void Properties::settings(const Settings&)
{
  for (const SettingsType* type : settings_types()) {
    const std::string sentence = fmt::format("Settings of the engine \"{}\".", type->name);
    add({.name = type->name, .sentence = sentence}, type->schema(definitions_, presence_));
  }
}

void Properties::settings(const std::optional<Settings>&)
{
  for (const SettingsType* type : settings_types()) {
    const std::string sentence = "Settings of the engine; without them the run's own, made exact.";
    add({.name = type->name, .sentence = sentence}, {{"anyOf", {type->schema(definitions_, presence_), {{"type", "null"}}}}});
  }
}

} // namespace nephroid::preset
