// SPDX-License-Identifier: Apache-2.0
// The visitor that turns a struct's description into data (outline.h). Private to preset/ and to what describes settings.
#pragma once
#include "preset/outline.h"
#include "preset/writer.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::preset {

template <Described S>
std::vector<Outline> fields_of(const Json& object);

template <Described S>
Json fresh()
{
  return Writer::json(S{});
}

/// The visitor: a field, an Outline.
class Outliner {
public:
  std::vector<Outline> fields;

  template <class E>
  void type(const Field& f, const E& value)
  {
    field(f, value);
    fields.back().chooses = true;
  }
  /// As both may be of any engine there is, all are here.
  void engine(const Field& f, const Settings& settings);
  void settings(const Settings&) { sections(false); }
  void settings(const std::optional<Settings>&) { sections(true); }
  template <class T>
  void field(const Field& f, const T& value)
  {
    Outline& o = fields.emplace_back();
    o.field = f;
    shape(o, value);
    if (o.kind != Outline::Kind::object) o.standard = Writer::json(value);
  }

private:
  using Kind = Outline::Kind;

  void sections(bool optional);
  static void shape(Outline& o, const bool&) { o.kind = Kind::boolean; }
  static void shape(Outline& o, const double&) { o.kind = Kind::number; }
  static void shape(Outline& o, const std::string&) { o.kind = Kind::text; }
  template <std::integral T>
  static void shape(Outline& o, const T&)
  {
    o.kind = Kind::integer;
    o.whole = true;
  }
  template <Enumeration E>
  static void shape(Outline& o, const E&)
  {
    o.kind = Kind::word;
    for (const Choice<E>& choice : Choices<E>::all) o.words.push_back({choice.name, choice.sentence});
  }
  template <class T, std::size_t N>
  static void shape(Outline& o, const std::array<T, N>&)
  {
    o.kind = Kind::numbers;
    o.whole = std::integral<T>;
    o.size = N;
  }
  static void shape(Outline& o, const std::vector<double>&) { o.kind = Kind::numbers; }
  static void shape(Outline& o, const std::vector<std::string>&) { o.kind = Kind::texts; }
  static void shape(Outline& o, const std::vector<std::array<double, 2>>&) { o.kind = Kind::table; }
  template <Described S>
  static void shape(Outline& o, const S&)
  {
    o.kind = Kind::object;
    o.fresh = fresh<S>;
    o.fields = fields_of<S>;
  }
  template <Described S>
  static void shape(Outline& o, const std::vector<S>&)
  {
    shape(o, S{});
    o.kind = Kind::list;
  }
  template <Described S>
  static void shape(Outline& o, const std::map<std::string, S>&)
  {
    shape(o, S{});
    o.kind = Kind::map;
  }
  template <class T>
  static void shape(Outline& o, const std::optional<T>&)
  {
    shape(o, T{});
    o.optional = true;
  }
};

template <Described S>
std::vector<Outline> fields_of(const Json& object)
{
  std::vector<Outline> first;
  if constexpr (Variant<S>) {
    bool found = false;
    for_each_type<S>([&](const auto&, const S& s) {
      if (found) return;
      Outliner outliner;
      describe(outliner, s);
      const auto chooser = std::find_if(outliner.fields.begin(), outliner.fields.end(), [](const Outline& o) { return o.chooses; });
      found = object.value(chooser->field.name, Json()) == chooser->standard;
      if (found || first.empty()) first = std::move(outliner.fields);
    });
  } else {
    Outliner outliner;
    const S s{};
    describe(outliner, s);
    first = std::move(outliner.fields);
  }
  return first;
}

} // namespace nephroid::preset
