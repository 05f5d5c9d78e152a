// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/nearest.h"
#include "preset/describe.h"
#include "preset/document.h"
#include "preset/files.h"
#include "preset/walks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace nephroid::preset {
namespace {

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known)
{
  std::string near = nearest(word.substr(0, 64), known);
  if (near.empty() && word.size() >= 3) // the unit left out: "fov" for "fov_deg"
    if (const auto longer = std::find_if(known.begin(), known.end(), [&](const std::string& k) { return k.starts_with(word); });
        longer != known.end())
      near = *longer;
  return near.empty() ? std::string() : fmt::format("did you mean '{}'?", near);
}

/// Settings of another engine than the preset's have no key.
std::vector<std::string> keys_of(const std::vector<Member>& members)
{
  std::vector<std::string> keys;
  for (const Member& member : members)
    if (member.value.exists()) keys.emplace_back(member.field.name);
  return keys;
}

bool holds(const std::vector<std::string>& keys, const std::string& key) { return std::ranges::count(keys, key) > 0; }

class Reader {
public:
  explicit Reader(const Document& document) : document_(document) {}

  void read_object(const Json& json, const std::string& pointer, const Value& object) const
  {
    if (read_shorthand(json, pointer, object)) return;
    if (!json.is_object()) refuse(json, pointer, expected({}, object.type()));
    std::vector<Member> members = object.members();
    std::string_view missing;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Member member = members[i];
      if (!member.value.exists()) continue;
      const Field& f = member.field;
      const auto given = json.find(f.name);
      if (given == json.end()) {
        if (member.chooses())
          throw bad_input(document_.where(pointer), fmt::format("has no '{}'", f.name), "expected " + expected(f, member.value.type()));
        if (f.required && missing.empty()) missing = f.name;
        continue;
      }
      if (member.role == Role::recipe && f.name != engine()) refuse_of_other_engine(pointer, f.name);
      read_value(*given, child(pointer, f.name), f, member.value);
      if (member.chooses()) members = object.members();
    }
    refuse_unknown(json, pointer, object, members);
    if (!missing.empty()) throw bad_input(document_.where(pointer), fmt::format("has no '{}'", missing), "this key is required");
  }

private:
  /// A bare value in place of an object: that object with its type and one field, at the bare value's own place.
  bool read_shorthand(const Json& json, const std::string& pointer, const Value& object) const
  {
    for (const Shorthand& shorthand : object.type().shorthands) {
      if (shorthand.bare == Bare::number ? !json.is_number() : !json.is_string()) continue;
      choose(object.members().front().value, shorthand.type);
      for (const Member& member : object.members())
        if (member.field.name == shorthand.field) read_value(json, pointer, member.field, member.value);
      return true;
    }
    return false;
  }

  /// Of the preset: its "engine" has been read.
  std::string engine() const { return document_.value().at("engine").get<std::string>(); }

  [[noreturn]] void refuse_of_other_engine(const std::string& pointer, std::string_view section) const
  {
    throw bad_input(document_.where(child(pointer, section)), fmt::format("'{}' has no meaning for the engine '{}'", section, engine()),
                    fmt::format("it belongs to '{}'", section), "remove it or change the engine");
  }

  void refuse_unknown(const Json& json, const std::string& pointer, const Value& object, const std::vector<Member>& members) const
  {
    const std::vector<std::string> keys = keys_of(members);
    for (const auto& item : json.items()) {
      const std::string& key = item.key();
      if (holds(keys, key)) continue;
      if (members.front().role == Role::type) refuse_of_other_type(child(pointer, key), key, object, members.front());
      if (std::ranges::any_of(members, [&](const Member& member) { return member.field.name == key; }))
        refuse_of_other_engine(pointer, key);
      throw bad_input(document_.where(child(pointer, key)), "unknown key " + in_quotes(key),
                      fmt::format("the keys here are {}", fmt::join(keys, ", ")), did_you_mean(key, keys));
    }
  }

  void refuse_of_other_type(const std::string& pointer, const std::string& key, const Value& object, const Member& own) const
  {
    const auto other = object.type().make();
    const Value probe(other.get(), object.type());
    std::string others;
    for (std::size_t i = 0; i < own.value.type().words.size(); ++i) {
      probe.members().front().value.choose(i);
      if (holds(keys_of(probe.members()), key)) others += (others.empty() ? "'" : "', '") + std::string(own.value.type().words[i].name);
    }
    if (!others.empty())
      throw bad_input(document_.where(pointer), fmt::format("'{}' has no meaning for the type '{}'", key, own.value.word().name),
                      fmt::format("it belongs to {}'", others), "remove it or change the type");
  }

  [[noreturn]] void refuse(const Json& json, const std::string& pointer, const std::string& wanted, const std::string& remedy = {}) const
  {
    throw bad_input(document_.where(pointer), "is " + shown(json), "expected " + wanted, remedy);
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, const Value& value) const
  {
    const ValueType& type = value.type();
    switch (type.kind) {
    case Kind::boolean:
      if (!json.is_boolean()) refuse(json, pointer, expected(f, type));
      value.as<bool>() = json.get<bool>();
      break;
    case Kind::integer:
      read_integer(json, pointer, f, value);
      break;
    case Kind::number:
      read_number(json, pointer, f.bounds, f.unit, value);
      break;
    case Kind::text:
      read_text(json, pointer, f, value);
      break;
    case Kind::word:
      read_word(json, pointer, f, value);
      break;
    case Kind::object:
      read_object(json, pointer, value);
      break;
    case Kind::map:
      read_map(json, pointer, f, value);
      break;
    case Kind::optional: // null is "not given": a child can take back what its parent gave
      value.resize(json.is_null() ? 0 : 1);
      if (!json.is_null()) read_value(json, pointer, f, value[0]);
      break;
    default:
      read_list(json, pointer, f, value);
    }
  }

  void read_number(const Json& json, const std::string& pointer, const Bounds& bounds, std::string_view unit, const Value& value) const
  {
    if (!json.is_number() || !bounds.contain(json.get<double>())) refuse(json, pointer, expected_number(bounds, unit));
    value.as<double>() = json.get<double>();
  }

  void read_integer(const Json& json, const std::string& pointer, const Field& f, const Value& value) const
  {
    const bool whole = json.is_number() && std::trunc(json.get<double>()) == json.get<double>();
    // 2^64 - 1 is not a double: the nearest one is 2^64, which a number in the file may be and the value may not.
    const bool fits =
        whole && f.bounds.contain(json.get<double>()) && (json.is_number_integer() || json.get<double>() < 18446744073709551616.0);
    if (!fits) refuse(json, pointer, expected(f, value.type()));
    if (value.is<int>())
      value.as<int>() = json.get<int>();
    else
      value.as<std::uint64_t>() = json.get<std::uint64_t>();
  }

  void read_text(const Json& json, const std::string& pointer, const Field& f, const Value& value) const
  {
    if (!json.is_string()) refuse(json, pointer, expected(f, value.type()));
    const std::string& text = json.get_ref<const std::string&>();
    if (text.size() > 4096) refuse(json, pointer, "at most 4096 bytes");
    if (f.text != Text::text && std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      refuse(json, pointer, "one line without control characters");
    if (f.text == Text::file && text.empty()) refuse(json, pointer, expected(f, value.type()));
    value.as<std::string>() = f.text == Text::file ? name_given(document_.origins().main(), text, document_.origins().at(pointer)) : text;
  }

  static bool choose(const Value& value, std::string_view word)
  {
    const std::vector<Word>& words = value.type().words;
    const auto chosen = std::ranges::find(words, word, &Word::name);
    if (chosen != words.end()) value.choose(static_cast<std::size_t>(chosen - words.begin()));
    return chosen != words.end();
  }

  void read_word(const Json& json, const std::string& pointer, const Field& f, const Value& value) const
  {
    const std::string text = json.is_string() ? json.get<std::string>() : std::string();
    if (json.is_string() && choose(value, text)) return;
    std::vector<std::string> known;
    for (const Word& word : value.type().words) known.emplace_back(word.name);
    refuse(json, pointer, expected(f, value.type()), did_you_mean(text, known));
  }

  void read_list(const Json& json, const std::string& pointer, const Field& f, const Value& value) const
  {
    const ValueType& type = value.type();
    if (f.bare_number && json.is_number()) {
      value.resize(1);
      read_number(json, pointer, f.bounds, f.unit, value[0]);
      return;
    }
    const Count count = type.size > 0 ? Count{type.size, type.size} : f.count;
    if (!json.is_array() || json.size() < count.low || json.size() > count.high) refuse(json, pointer, expected(f, type));
    value.resize(json.size());
    for (std::size_t i = 0; i < json.size(); ++i)
      if (type.kind == Kind::table)
        read_row(json[i], child(pointer, i), f, value[i]);
      else
        read_value(json[i], child(pointer, i), f, value[i]);
  }

  void read_row(const Json& json, const std::string& pointer, const Field& f, const Value& row) const
  {
    if (!json.is_array() || json.size() != 2)
      refuse(json, pointer, fmt::format("a row [{}, {}]", f.columns.first.name, f.columns.second.name));
    for (std::size_t i = 0; i < 2; ++i) read_number(json[i], child(pointer, i), f.columns[i].bounds, f.columns[i].unit, row[i]);
  }

  /// null takes an inherited entry away.
  void read_map(const Json& json, const std::string& pointer, const Field& f, const Value& value) const
  {
    if (!json.is_object() || json.size() > f.count.high) refuse(json, pointer, expected(f, value.type()));
    value.resize(0);
    for (const auto& [name, item] : json.items())
      if (!item.is_null()) read_object(item, child(pointer, name), value.add(name));
  }

  const Document& document_;
};

} // namespace

void read(const Document& document, Preset& preset) { Reader(document).read_object(document.value(), "", Value(preset)); }

} // namespace nephroid::preset
