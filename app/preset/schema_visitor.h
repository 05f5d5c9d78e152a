// SPDX-License-Identifier: Apache-2.0
// The visitor that turns the descriptions into a JSON Schema (2020-12), for editors that check and complete while one types.
// It knows fields one by one; what takes several of them (check.cpp) and file names are left to the program.
#pragma once
#include "preset/writer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::preset {

/// Presets with a parent may leave out whatever they inherit, but lists replace the parent's lists, so that inside a list
/// everything that is required must be there.
enum class Presence { whole, part };

/// Collects the properties of one struct of one type, and into `definitions` the structs that it holds.
class Properties {
public:
  Properties(Json& definitions, Presence presence) : definitions_(definitions), presence_(presence) {}

  template <Enumeration E>
  void type(const Field& f, const E& value)
  {
    add(f, {{"const", word(value)}});
    required_.emplace_back(f.name);
  }

  void engine(const Field& f, const Settings& settings);
  void settings(const Settings& settings);
  void settings(const std::optional<Settings>& settings);

  template <class T>
  void field(const Field& f, const T& value)
  {
    Json schema = schema_of(f, value);
    // A struct's defaults stand at its own fields, and an optional one has none.
    if (const Json standard = Writer::json(value); !f.required && !standard.is_object() && !standard.is_null())
      schema["default"] = standard;
    add(f, std::move(schema));
    if (f.required) required_.emplace_back(f.name);
  }

  /// The object's schema. Only `part` may lack what is required.
  Json object(const std::string& title, std::string_view sentence) const
  {
    Json schema{
        {"title", title}, {"description", sentence}, {"type", "object"}, {"properties", properties_}, {"additionalProperties", false}};
    if (presence_ == Presence::whole && !required_.empty()) schema["required"] = required_;
    return schema;
  }
  const Json& properties() const { return properties_; }
  const Json& required() const { return required_; }

  /// A reference to the definition of S, which is made at its first use.
  template <Described S>
  static Json reference(Json& definitions, Presence presence);

private:
  void add(const Field& f, Json schema)
  {
    Json& slot = properties_[std::string(f.name)];
    slot["description"] = std::string(f.sentence);
    if (!f.unit.empty()) slot["unit"] = std::string(f.unit);
    slot.update(schema);
  }

  static Json number(const char* type, const Bounds& bounds)
  {
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

  static Json list(const Json& items, const Count& count)
  {
    Json schema{{"type", "array"}, {"items", items}};
    if (count.low > 0) schema["minItems"] = count.low;
    if (count.high < std::numeric_limits<std::size_t>::max()) schema["maxItems"] = count.high;
    return schema;
  }

  Json schema_of(const Field&, const bool&) { return {{"type", "boolean"}}; }
  Json schema_of(const Field& f, const double&) { return number("number", f.bounds); }
  template <std::integral T>
  Json schema_of(const Field& f, const T&)
  {
    return number("integer", f.bounds);
  }
  Json schema_of(const Field& f, const std::string&)
  {
    Json schema{{"type", "string"}, {"maxLength", 4096}};
    if (f.text == Text::file) schema["minLength"] = 1;
    if (f.text != Text::text) schema["pattern"] = "^[^\\u0000-\\u001f\\u007f]*$";
    return schema;
  }
  template <Enumeration E>
  Json schema_of(const Field&, const E&)
  {
    Json words = Json::array();
    for (const Choice<E>& choice : Choices<E>::all) words.push_back({{"const", choice.name}, {"description", choice.sentence}});
    return {{"oneOf", words}};
  }
  template <class T, std::size_t N>
  Json schema_of(const Field& f, const std::array<T, N>&)
  {
    return list(schema_of(f, T{}), {N, N});
  }
  Json schema_of(const Field& f, const std::vector<double>&)
  {
    Json one = number("number", f.bounds), several = list(one, f.count);
    return f.bare_number ? Json{{"anyOf", {several, one}}} : several;
  }
  Json schema_of(const Field& f, const std::vector<std::string>&) { return list(schema_of(f, std::string()), f.count); }
  Json schema_of(const Field& f, const std::vector<std::array<double, 2>>&)
  {
    Json columns = Json::array();
    for (const Column& c : {f.columns.first, f.columns.second}) {
      columns.push_back({{"title", c.name}});
      if (!c.unit.empty()) columns.back()["unit"] = c.unit;
      columns.back().update(number("number", c.bounds));
    }
    return list({{"type", "array"}, {"prefixItems", columns}, {"items", false}, {"minItems", 2}}, f.count);
  }
  template <Described S>
  Json schema_of(const Field&, const S&)
  {
    return reference<S>(definitions_, presence_);
  }
  template <Described S>
  Json schema_of(const Field& f, const std::vector<S>&)
  {
    return list(reference<S>(definitions_, Presence::whole), f.count);
  }
  template <Described S>
  Json schema_of(const Field& f, const std::map<std::string, S>&)
  {
    const Json item = reference<S>(definitions_, presence_);
    return {{"type", "object"}, {"additionalProperties", {{"anyOf", {item, {{"type", "null"}}}}}}, {"maxProperties", f.count.high}};
  }
  template <class T>
  Json schema_of(const Field& f, const std::optional<T>&)
  {
    return {{"anyOf", {schema_of(f, T{}), {{"type", "null"}}}}};
  }

  Json& definitions_;
  Presence presence_;
  Json properties_ = Json::object();
  Json required_ = Json::array();
};

/// The struct's types one by one, then its shorthands; as a part also any of their fields without a type.
template <Variant S>
Json alternatives(Json& definitions, Presence presence)
{
  Json all = Json::array(), bare = Json::array(), any_field = Json::object();
  for_each_type<S>([&](const auto& choice, S& s) {
    Properties properties(definitions, presence);
    describe(properties, s);
    Json schema = properties.object(std::string(choice.name), choice.sentence);
    const std::string key = properties.required()[0];
    schema["required"] = presence == Presence::whole ? properties.required() : Json::array({key});
    all.push_back(std::move(schema));
    for (const auto& [name, property] : properties.properties().items())
      if (name != key) { // fields of one name and several meanings: anything goes, the program knows
        const bool clear = !any_field.contains(name) || any_field[name] == property;
        any_field[name] = clear ? property : Json::object();
      }
    if constexpr (WithShorthands<S>)
      for (const auto& shorthand : About<S>::shorthands)
        if (shorthand.type == choice.value) bare.push_back(properties.properties()[std::string(shorthand.field)]);
  });
  for (Json& schema : bare) all.push_back(std::move(schema));
  if (presence == Presence::part)
    all.push_back({{"title", "inherited"},
                   {"description", "Some fields; the type is the parent's."},
                   {"type", "object"},
                   {"properties", any_field},
                   {"additionalProperties", false}});
  return {{"title", About<S>::name}, {"description", About<S>::sentence}, {"oneOf", all}};
}

template <Described S>
Json Properties::reference(Json& definitions, Presence presence)
{
  const std::string name = std::string(About<S>::name) + (presence == Presence::part ? "" : "Item");
  if (!definitions.contains(name)) {
    Json schema;
    if constexpr (Variant<S>)
      schema = alternatives<S>(definitions, presence);
    else {
      Properties properties(definitions, presence);
      const S defaults{};
      describe(properties, defaults);
      schema = properties.object(std::string(About<S>::name), About<S>::sentence);
    }
    definitions[name] = std::move(schema);
  }
  return {{"$ref", "#/$defs/" + name}};
}

} // namespace nephroid::preset
