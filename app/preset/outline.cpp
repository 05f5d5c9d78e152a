// SPDX-License-Identifier: Apache-2.0
#include "preset/outline.h"

#include "preset/describe.h"
#include "preset/expected.h"
#include "preset/settings_type.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::preset {

using Kind = Outline::Kind;

void Outliner::engine(const Field& f, const Settings& settings)
{
  Outline& o = fields.emplace_back();
  o.field = f;
  o.kind = Kind::word;
  o.chooses = true;
  for (const SettingsType* type : settings_types()) o.words.push_back({type->name, type->sentence});
  o.standard = settings.type().name;
}

void Outliner::sections(bool optional)
{
  for (const SettingsType* type : settings_types()) {
    Outline& o = fields.emplace_back();
    o.field = {.name = type->name, .sentence = "Settings of the engine."};
    o.of_engine = true;
    o.optional = optional;
    o.fresh = type->fresh;
    o.fields = type->fields;
  }
}

std::vector<Outline> outline(const Json& preset)
{
  std::vector<Outline> fields = fields_of<Preset>(preset);
  std::erase_if(fields, [&](const Outline& o) { return o.of_engine && preset.at("engine") != o.field.name; });
  return fields;
}

Json as_type(const Json& object, std::vector<Outline> (*fields)(const Json&), const Outline& chooser, std::string_view type)
{
  const std::string key(chooser.field.name);
  const std::vector<Outline> before = fields(object);
  Json made = Json::object();
  made[key] = type;
  for (const Outline& o : fields(Json(made))) {
    const std::string name(o.field.name);
    const auto same = [&](const Outline& b) { return b.field.name == o.field.name && b.kind == o.kind; };
    if (name == key) continue;
    const bool stays = object.contains(name) && std::any_of(before.begin(), before.end(), same);
    if (stays)
      made[name] = object[name];
    else if (!o.of_engine || !o.optional) // the settings of another engine would be refused
      made[name] = o.kind == Kind::object && !o.optional ? o.fresh() : o.standard;
  }
  return made;
}

std::string expected(const Outline& o)
{
  const Field& f = o.field;
  const std::string number = o.whole ? expected_integer(f.bounds, f.unit) : expected_number(f.bounds, f.unit);
  switch (o.kind) {
  case Kind::boolean:
    return "true or false";
  case Kind::integer:
  case Kind::number:
    return number;
  case Kind::text:
    return f.text == Text::file ? "the name of a file" : "a text";
  case Kind::word: {
    std::string words;
    for (const Outline::Word& word : o.words) words += (words.empty() ? "one of " : ", ") + std::string(word.name);
    return words;
  }
  case Kind::numbers:
    return o.size > 0 ? expected_list(o.size, number) : expected_list(f.count, number);
  case Kind::texts:
    return expected_list(f.count, "a text");
  case Kind::table:
    return expected_list(f.count, fmt::format("[{}, {}]", f.columns[0].name, f.columns[1].name));
  case Kind::list:
  case Kind::map:
    return expected_count(f.count);
  case Kind::object:
    break;
  }
  return "an object";
}

} // namespace nephroid::preset
