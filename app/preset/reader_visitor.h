// SPDX-License-Identifier: Apache-2.0
// The visitor that reads a struct from JSON, strictly: every key must be known, of the right type and in range. Private to preset/.
#pragma once
#include "base/error.h"
#include "base/nearest.h"
#include "preset/describe.h"
#include "preset/document.h"
#include "preset/expected.h"
#include "preset/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace nephroid::preset {

/// The keys of a struct of one type: a visitor that reads nothing.
struct Keys {
  std::vector<std::string> names;
  std::string engine_name; ///< of a preset
  template <class E>
  void type(const Field& field, E&)
  {
    names.emplace_back(field.name);
  }
  template <class T>
  void field(const Field& f, T&)
  {
    names.emplace_back(f.name);
  }
  void engine(const Field& field, const Settings& settings);
  void settings(const Settings& settings);
  void settings(const std::optional<Settings>& settings);
  bool hold(std::string_view name) const { return std::find(names.begin(), names.end(), name) != names.end(); }
};

template <Described S>
Keys keys_of(S& s)
{
  Keys keys;
  describe(keys, s);
  return keys;
}

inline std::string did_you_mean(std::string_view word, const std::vector<std::string>& known)
{
  std::string found = nearest(word.substr(0, 64), known);
  if (found.empty() && word.size() >= 3) // the unit left out: "fov" for "fov_deg"
    if (const auto longer = std::find_if(known.begin(), known.end(), [&](const std::string& k) { return k.starts_with(word); });
        longer != known.end())
      found = *longer;
  return found.empty() ? std::string() : fmt::format("did you mean '{}'?", found);
}

/// Reads one JSON object into one struct.
class Reader {
public:
  Reader(const Document& document, const Json& object, const std::string& pointer) : document_(document), object_(object), pointer_(pointer)
  {
  }

  template <Described S>
  static void read(const Document& document, const Json& json, const std::string& pointer, S& s)
  {
    if constexpr (WithShorthands<S>)
      if (read_shorthand(document, json, pointer, s)) return;
    if (!json.is_object()) throw bad_input(document.where(pointer), "is " + shown(json), "expected " + expected_struct<S>());
    Reader reader(document, json, pointer);
    describe(reader, s);
    reader.refuse_unknown(s);
    reader.refuse_missing();
  }

  template <Enumeration E>
  void type(const Field& f, E& value)
  {
    const auto found = object_.find(f.name);
    if (found == object_.end())
      throw bad_input(document_.where(pointer_), fmt::format("has no '{}'", f.name), "expected " + expected_word<E>());
    read_value(*found, child(pointer_, f.name), f, value);
  }

  void engine(const Field& f, Settings& settings);
  void settings(Settings& settings);
  /// Of the preset's own engine.
  void settings(std::optional<Settings>& settings);

  template <class T>
  void field(const Field& f, T& value)
  {
    const auto found = object_.find(f.name);
    if (found != object_.end())
      read_value(*found, bare_ ? pointer_ : child(pointer_, f.name), f, value);
    else if (f.required && !bare_)
      missing_.emplace_back(f.name);
  }

private:
  /// A bare value in place of an object: read as that object with its type and one field, at the bare value's own place.
  template <WithShorthands S>
  static bool read_shorthand(const Document& document, const Json& json, const std::string& pointer, S& s)
  {
    for (const auto& shorthand : About<S>::shorthands) {
      if (shorthand.bare == Bare::number ? !json.is_number() : !json.is_string()) continue;
      S probe;
      const Json object{{keys_of(probe).names.front(), word(shorthand.type)}, {shorthand.field, json}};
      Reader reader(document, object, pointer);
      reader.bare_ = true;
      describe(reader, s);
      return true;
    }
    return false;
  }

  template <class S>
  void refuse_unknown(S& s) const
  {
    const Keys keys = keys_of(s);
    for (const auto& [key, value] : object_.items()) {
      if (keys.hold(key)) continue;
      const Place where = document_.where(child(pointer_, key));
      if constexpr (Variant<S>) refuse_of_other_type(where, key, s);
      if constexpr (Is<S, Preset>)
        if (is_engine(key)) refuse_of_other_engine(key, keys.engine_name);
      throw bad_input(where, "unknown key " + in_quotes(key), fmt::format("the keys here are {}", fmt::join(keys.names, ", ")),
                      did_you_mean(key, keys.names));
    }
  }

  template <Variant S>
  static void refuse_of_other_type(const Place& where, const std::string& key, S& s)
  {
    std::string others;
    for_each_type<S>([&](const auto& choice, S& other) {
      if (keys_of(other).hold(key)) others += (others.empty() ? "'" : "', '") + std::string(choice.name);
    });
    if (!others.empty())
      throw bad_input(where, fmt::format("'{}' has no meaning for the type '{}'", key, word(type_of(s))),
                      fmt::format("it belongs to {}'", others), "remove it or change the type");
  }

  static bool is_engine(std::string_view key);
  [[noreturn]] void refuse_of_other_engine(std::string_view section, std::string_view engine) const;

  void refuse_missing() const
  {
    if (!missing_.empty()) throw bad_input(document_.where(pointer_), fmt::format("has no '{}'", missing_.front()), "this key is required");
  }

  [[noreturn]] void refuse(const Json& json, const std::string& pointer, const std::string& expected, const std::string& remedy = {}) const
  {
    throw bad_input(document_.where(pointer), "is " + shown(json), "expected " + expected, remedy);
  }

  void read_value(const Json& json, const std::string& pointer, const Field&, bool& value) const
  {
    if (!json.is_boolean()) refuse(json, pointer, "true or false");
    value = json.get<bool>();
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, double& value) const
  {
    read_number(json, pointer, f.bounds, f.unit, value);
  }

  void read_number(const Json& json, const std::string& pointer, const Bounds& bounds, std::string_view unit, double& value) const
  {
    if (!json.is_number() || !bounds.contain(json.get<double>())) refuse(json, pointer, expected_number(bounds, unit));
    value = json.get<double>();
  }

  template <std::integral T>
  void read_value(const Json& json, const std::string& pointer, const Field& f, T& value) const
  {
    const bool whole = json.is_number() && std::trunc(json.get<double>()) == json.get<double>();
    // 2^64 - 1 is not a double: the nearest one is 2^64, which a number in the file may be and T may not.
    const bool fits =
        whole && f.bounds.contain(json.get<double>()) && (json.is_number_integer() || json.get<double>() < 18446744073709551616.0);
    if (!fits) refuse(json, pointer, expected_integer(f.bounds, f.unit));
    value = json.get<T>();
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, std::string& value) const
  {
    if (!json.is_string()) refuse(json, pointer, f.text == Text::file ? "the name of a file" : "a string");
    const std::string& text = json.get_ref<const std::string&>();
    if (text.size() > 4096) refuse(json, pointer, "at most 4096 bytes");
    if (f.text != Text::text && std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      refuse(json, pointer, "one line without control characters");
    if (f.text == Text::file && text.empty()) refuse(json, pointer, "the name of a file");
    value = f.text == Text::file ? name_given(document_.origins().main(), text, document_.origins().at(pointer)) : text;
  }

  template <Enumeration E>
  void read_value(const Json& json, const std::string& pointer, const Field&, E& value) const
  {
    const std::string text = json.is_string() ? json.get<std::string>() : std::string();
    std::vector<std::string> known;
    for (const Choice<E>& choice : Choices<E>::all) {
      if (json.is_string() && choice.name == text) {
        value = choice.value;
        return;
      }
      known.emplace_back(choice.name);
    }
    refuse(json, pointer, expected_word<E>(), did_you_mean(text, known));
  }

  template <class T, std::size_t N>
  void read_value(const Json& json, const std::string& pointer, const Field& f, std::array<T, N>& value) const
  {
    if (!json.is_array() || json.size() != N)
      refuse(json, pointer, expected_list(N, std::integral<T> ? expected_integer(f.bounds, f.unit) : expected_number(f.bounds, f.unit)));
    for (std::size_t i = 0; i < N; ++i) read_value(json[i], child(pointer, i), f, value[i]);
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, std::vector<double>& value) const
  {
    read_items(json, pointer, f, expected_number(f.bounds, f.unit), value,
               [&](const Json& item, const std::string& at, double& x) { read_number(item, at, f.bounds, f.unit, x); });
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, std::vector<std::string>& value) const
  {
    read_items(json, pointer, f, "a string", value,
               [&](const Json& item, const std::string& at, std::string& text) { read_value(item, at, f, text); });
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, std::vector<std::array<double, 2>>& value) const
  {
    const std::string row = fmt::format("[{}, {}]", f.columns[0].name, f.columns[1].name);
    read_items(json, pointer, f, row, value, [&](const Json& item, const std::string& at, std::array<double, 2>& x) {
      if (!item.is_array() || item.size() != 2) refuse(item, at, "a row " + row);
      for (std::size_t i = 0; i < 2; ++i) read_number(item[i], child(at, i), f.columns[i].bounds, f.columns[i].unit, x[i]);
    });
  }

  template <Described S>
  void read_value(const Json& json, const std::string& pointer, const Field&, S& value) const
  {
    read(document_, json, pointer, value);
  }

  template <Described S>
  void read_value(const Json& json, const std::string& pointer, const Field& f, std::vector<S>& value) const
  {
    read_items(json, pointer, f, expected_struct<S>(), value,
               [&](const Json& item, const std::string& at, S& s) { read(document_, item, at, s); });
  }

  template <class T, class F>
  void read_items(const Json& json, const std::string& pointer, const Field& f, const std::string& each, std::vector<T>& value,
                  F&& read_item) const
  {
    if (!json.is_array() || json.size() < f.count.low || json.size() > f.count.high) refuse(json, pointer, expected_list(f.count, each));
    value.assign(json.size(), T{});
    for (std::size_t i = 0; i < json.size(); ++i) read_item(json[i], child(pointer, i), value[i]);
  }

  /// null takes an inherited entry away.
  template <Described S>
  void read_value(const Json& json, const std::string& pointer, const Field& f, std::map<std::string, S>& value) const
  {
    if (!json.is_object() || json.size() > f.count.high)
      refuse(json, pointer, fmt::format("an object of names with {}, each {}", expected_count(f.count), expected_struct<S>()));
    value.clear();
    for (const auto& [name, item] : json.items())
      if (!item.is_null()) read(document_, item, child(pointer, name), value[name]);
  }

  /// null is "not given": a child can take back what its parent gave.
  template <class T>
  void read_value(const Json& json, const std::string& pointer, const Field& f, std::optional<T>& value) const
  {
    value.reset();
    if (!json.is_null()) read_value(json, pointer, f, value.emplace());
  }

  const Document& document_;
  const Json& object_;
  const std::string& pointer_;
  bool bare_ = false;
  std::vector<std::string> missing_;
};

} // namespace nephroid::preset
