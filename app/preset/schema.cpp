// SPDX-License-Identifier: Apache-2.0
// The descriptions as a JSON Schema (2020-12), for editors that check and complete while one types. It knows fields one
// by one; what takes several of them (check.cpp) and file names are left to the program.
#include "preset/read.h"

#include "preset/describe.h"
#include "preset/length.h"
#include "preset/walks.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace nephroid::preset {
namespace {

/// Presets with a parent may leave out whatever they inherit, but lists replace the parent's lists, so that inside a
/// list everything that is required must be there.
enum class Requirement { whole, part };

Json or_null(const Json& schema) { return {{"anyOf", {schema, {{"type", "null"}}}}}; }

Json number_schema(const char* type, const Bounds& bounds) {
  Json schema{{"type", type}};
  const auto limit = [&](const char* closed, const char* open, double value, bool without) {
    if (!std::isfinite(value)) return;
    Json& slot = schema[without ? open : closed];
    // Whole limits without ".0"; 2^64 stands for the largest 64-bit number, which no double is.
    if (value >= 18446744073709551615.0)
      slot = std::numeric_limits<std::uint64_t>::max();
    else if (value == std::trunc(value))
      slot = static_cast<std::int64_t>(value);
    else
      slot = value;
  };
  limit("minimum", "exclusiveMinimum", bounds.low, bounds.without_low);
  limit("maximum", "exclusiveMaximum", bounds.high, bounds.without_high);
  return schema;
}

Json list_schema(const Json& items, const Count& count) {
  Json schema{{"type", "array"}, {"items", items}};
  if (count.low > 0) schema["minItems"] = count.low;
  if (count.high < std::numeric_limits<std::size_t>::max()) schema["maxItems"] = count.high;
  return schema;
}

Json text_schema(Text text) {
  Json schema{{"type", "string"}, {"maxLength", 4096}};
  if (text == Text::file) schema["minLength"] = 1;
  if (text != Text::text) schema["pattern"] = "^[^\\u0000-\\u001f\\u007f]*$";
  return schema;
}

Json words_schema(const std::vector<Word>& words) {
  Json schemas = Json::array();
  for (const Word& word : words) schemas.push_back({{"const", word.name}, {"description", word.sentence}});
  return {{"oneOf", schemas}};
}

Json row_schema(const Columns& columns) {
  Json items = Json::array();
  for (const Column& c : {columns.first, columns.second}) {
    items.push_back({{"title", c.name}});
    if (!c.unit.empty()) items.back()["unit"] = c.unit;
    items.back().update(number_schema("number", c.bounds));
  }
  return {{"type", "array"}, {"prefixItems", items}, {"items", false}, {"minItems", 2}};
}

/// The properties of an object of one type, and which of them are required.
struct Properties {
  Json properties = Json::object(), required = Json::array();

  Json schema(const std::string& title, std::string_view sentence) const {
    return {{"title", title},
            {"description", sentence},
            {"type", "object"},
            {"properties", properties},
            {"additionalProperties", false}};
  }
};

/// Collects the schemas of all structs, each made at its first use.
class Definitions {
public:
  Properties properties(const Value& object, Requirement presence) {
    Properties properties;
    for (const Member& member : object.members()) {
      const Field& f = member.field;
      Json& slot = properties.properties[std::string(f.name)];
      slot["description"] = std::string(f.sentence);
      if (!f.unit.empty()) slot["unit"] = std::string(f.unit);
      slot.update(schema_of(member, presence));
      if (f.required || member.chooses()) properties.required.emplace_back(f.name);
    }
    return properties;
  }

  Json all = Json::object();

private:
  Json schema_of(const Member& member, Requirement presence) {
    if (member.role == Role::type) return {{"const", member.value.word().name}};
    Json schema = schema_of(member.field, member.value.type(), presence);
    // A struct's defaults stand at its own fields, and an optional one has none.
    const bool has_default =
        !member.field.required && member.role == Role::plain && member.value.kind() != Kind::object;
    if (const Json standard = has_default ? as_json(member) : Json(); !standard.is_object() && !standard.is_null())
      schema["default"] = standard;
    return schema;
  }

  Json schema_of(const Field& f, const ValueType& type, Requirement presence) {
    const Kind kind = type.kind;
    if (kind == Kind::boolean) return {{"type", "boolean"}};
    if (!f.none_word.empty()) return {{"anyOf", {number_schema("number", f.bounds), {{"const", f.none_word}}}}};
    if (kind == Kind::number && f.unit == millimetre_unit)
      return {{"anyOf", {number_schema("number", f.bounds), {{"type", "string"}, {"pattern", length_pattern}}}}};
    if (kind == Kind::integer || kind == Kind::number)
      return number_schema(kind == Kind::integer ? "integer" : "number", f.bounds);
    if (kind == Kind::text) return text_schema(f.text);
    if (kind == Kind::word) return words_schema(type.words);
    if (kind == Kind::numbers || kind == Kind::texts) {
      const Json item = schema_of(f, *type.item, presence);
      const Json list = list_schema(item, type.size > 0 ? Count{type.size, type.size} : f.count);
      return f.bare_number ? Json{{"anyOf", {list, item}}} : list;
    }
    if (kind == Kind::table) return list_schema(row_schema(f.columns), f.count);
    if (kind == Kind::list) return list_schema(reference(*type.item, Requirement::whole), f.count);
    if (kind == Kind::map)
      return {{"type", "object"},
              {"additionalProperties", or_null(reference(*type.item, presence))},
              {"maxProperties", f.count.high}};
    return kind == Kind::optional ? or_null(schema_of(f, *type.item, presence)) : reference(type, presence);
  }

  Json reference(const ValueType& type, Requirement presence) {
    const std::string name = std::string(type.name) + (presence == Requirement::part ? "" : "Item");
    if (!all.contains(name)) {
      Json schema = definition(type, presence);
      all[name] = std::move(schema);
    }
    return {{"$ref", "#/$defs/" + name}};
  }

  Json definition(const ValueType& type, Requirement presence) {
    const auto by_default = type.make();
    const Value object(by_default.get(), type);
    if (object.members().front().role == Role::type) return alternatives(object, presence);
    const Properties own = properties(object, presence);
    Json schema = own.schema(std::string(type.name), type.sentence);
    if (presence == Requirement::whole && !own.required.empty()) schema["required"] = own.required;
    return schema;
  }

  /// The struct's types one by one, then its shorthands; as a part also any of their fields without a type.
  Json alternatives(const Value& object, Requirement presence) {
    Json schemas = Json::array(), bare = Json::array(), any_field = Json::object();
    const std::vector<Word> words = object.members().front().value.type().words;
    const std::string key(object.members().front().field.name);
    for (std::size_t i = 0; i < words.size(); ++i) {
      object.members().front().value.choose(i);
      const Properties own = properties(object, presence);
      Json schema = own.schema(std::string(words[i].name), words[i].sentence);
      schema["required"] = presence == Requirement::whole ? own.required : Json::array({key});
      schemas.push_back(std::move(schema));
      for (const auto& [name, property] : own.properties.items())
        if (name != key) { // fields of one name and several meanings: anything goes, the program knows
          const bool clear = !any_field.contains(name) || any_field[name] == property;
          any_field[name] = clear ? property : Json::object();
        }
      for (const Shorthand& shorthand : object.type().shorthands)
        if (shorthand.type == words[i].name) bare.push_back(own.properties[std::string(shorthand.field)]);
    }
    for (Json& schema : bare) schemas.push_back(std::move(schema));
    if (presence == Requirement::part) {
      Properties inherited;
      inherited.properties = any_field;
      schemas.push_back(inherited.schema("inherited", "Some fields; the type is the parent's."));
    }
    return {{"title", object.type().name}, {"description", object.type().sentence}, {"oneOf", schemas}};
  }
};

/// Keys of a preset file that are not the preset's: they are gone before its fields are read.
Json file_keys() {
  return {{"$schema", {{"description", "Where this schema is, for editors."}, {"type", "string"}}},
          {"parent",
           {{"description",
             "A preset whose values this one takes over: a path beside this file, or a shipped preset's name."},
            {"type", "string"},
            {"minLength", 1}}},
          {"sweep",
           {{"description", "Values for several runs, by path: every combination is one run."},
            {"type", {"object", "null"}},
            {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}}}};
}

} // namespace

std::string schema() {
  Definitions definitions;
  Preset defaults;
  const Value preset(defaults);
  const Properties own = definitions.properties(preset, Requirement::part);
  Json properties = file_keys();
  properties.update(own.properties);
  Json document{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", preset.type().name},
                {"description", preset.type().sentence},
                {"type", "object"},
                {"properties", properties},
                {"additionalProperties", false},
                {"if", {{"not", {{"required", {"parent"}}}}}},
                {"then", {{"required", own.required}}}};
  document["$defs"] = definitions.all;
  return pretty(document);
}

} // namespace nephroid::preset
