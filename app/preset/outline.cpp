// SPDX-License-Identifier: Apache-2.0
#include "preset/outline.h"

#include "preset/expected.h"
#include "preset/writer.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::preset {
namespace {

using Kind = Outline::Kind;

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
  template <class T>
  void field(const Field& f, const T& value)
  {
    Outline& o = fields.emplace_back();
    o.field = f;
    shape(o, value);
    if (o.kind != Kind::object) o.standard = Writer::json(value);
  }

private:
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

} // namespace

std::vector<Outline> outline(const Json& preset) { return fields_of<Preset>(preset); }

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
    made[name] = stays ? object[name] : o.kind == Kind::object && !o.optional ? o.fresh() : o.standard;
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
