// SPDX-License-Identifier: Apache-2.0
#include "preset/read.h"

#include "base/nearest.h"
#include "preset/animation.h"
#include "preset/describe.h"
#include "preset/document.h"
#include "preset/length.h"
#include "preset/walks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::preset {
namespace {

/// What other programs and everyday language call things, and our words for them.
constexpr std::pair<std::string_view, std::string_view> other_words[] = {
    {"glass", "dielectric"},    {"metal", "conductor"},    {"matt", "diffuse"},         {"matte", "diffuse"},
    {"lambertian", "diffuse"},  {"plane", "quad"},         {"rectangle", "quad"},       {"sun", "directional"},
    {"distant", "directional"}, {"hdri", "file"},          {"envmap", "file"},          {"background", "environment"},
    {"ior", "dispersion"},      {"int_ior", "dispersion"}, {"refraction", "dispersion"}};

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  std::string near;
  for (const auto& [other, ours] : other_words)
    if (word == other && std::ranges::count(known, ours) > 0) near = ours;
  if (near.empty()) near = nearest(word.substr(0, 64), known);
  if (near.empty() && word.size() >= 3) // the unit left out: "fov" for "fov_deg"
    if (const auto longer = std::ranges::find_if(known, [&](const std::string& k) { return k.starts_with(word); });
        longer != known.end())
      near = *longer;
  return near.empty() ? std::string() : fmt::format("did you mean '{}'?", near);
}

/// Settings of another engine than the preset's have no key.
std::vector<std::string> keys_of(const std::vector<Member>& members) {
  std::vector<std::string> keys;
  for (const Member& member : members)
    if (member.value.exists()) keys.emplace_back(member.field.name);
  return keys;
}

bool holds(const std::vector<std::string>& keys, const std::string& key) { return std::ranges::count(keys, key) > 0; }

/// Where a field of this name is in the value, as --set names it: "spectral.threshold_deg"; empty where there is none.
std::string path_to(const std::string& key, const Value& value) {
  const auto below = [&](std::string_view name, const Value& inner) {
    const std::string path = path_to(key, inner);
    return path.empty() ? path : fmt::format("{}.{}", name, path);
  };
  std::string path;
  if (value.kind() == Kind::object) {
    for (const Member& member : value.members())
      if (member.value.exists() && member.field.name == key) return key;
    for (const Member& member : value.members())
      if (path.empty() && member.value.exists()) path = below(member.field.name, member.value);
  } else if (value.kind() == Kind::optional) {
    if (value.count() > 0) path = path_to(key, value[0]);
  } else if (value.kind() == Kind::list || value.kind() == Kind::map)
    for (std::size_t i = 0; i < value.count() && path.empty(); ++i)
      path = below(value.kind() == Kind::map ? value.key(i) : std::to_string(i), value[i]);
  return path;
}

class Reader {
public:
  explicit Reader(const Document& document) : document_(document) {}

  void read_object(const Json& json, const std::string& pointer, const Value& object) const {
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
          throw bad_input(document_.where(pointer), fmt::format("has no '{}'", f.name),
                          "expected " + expected(f, member.value.type()));
        if (f.required && missing.empty()) missing = f.name;
        continue;
      }
      if (member.role == Role::recipe && f.name != engine()) refuse_of_other_engine(pointer, f.name);
      read_value(*given, child(pointer, f.name), f, member.value);
      if (member.chooses()) members = object.members();
    }
    refuse_unknown(json, pointer, object, members);
    if (!missing.empty())
      throw bad_input(document_.where(pointer), fmt::format("has no '{}'", missing), "this key is required");
  }

private:
  /// A bare value in place of an object: that object with its type and one field, at the bare value's own place.
  bool read_shorthand(const Json& json, const std::string& pointer, const Value& object) const {
    for (const Shorthand& shorthand : object.type().shorthands) {
      if (shorthand.bare == BareValue::number ? !json.is_number() : !json.is_string()) continue;
      choose(object.members().front().value, shorthand.type);
      for (const Member& member : object.members())
        if (member.field.name == shorthand.field) read_value(json, pointer, member.field, member.value);
      return true;
    }
    return false;
  }

  /// The preset's engine, once "engine" has been read.
  std::string engine() const { return document_.value().at("engine").get<std::string>(); }

  [[noreturn]] void refuse_of_other_engine(const std::string& pointer, std::string_view section) const {
    throw bad_input(document_.where(child(pointer, section)),
                    fmt::format("'{}' has no meaning for the engine '{}'", section, engine()),
                    fmt::format("it belongs to '{}'", section), "remove it or change the engine");
  }

  void refuse_unknown(const Json& json, const std::string& pointer, const Value& object,
                      const std::vector<Member>& members) const {
    const std::vector<std::string> keys = keys_of(members);
    for (const auto& item : json.items()) {
      const std::string& key = item.key();
      if (holds(keys, key)) continue;
      if (members.front().role == Role::type) refuse_of_other_type(child(pointer, key), key, object, members.front());
      if (std::ranges::any_of(members, [&](const Member& member) { return member.field.name == key; })) {
        if (item.value().is_null()) continue; // not given, which is as it should be
        refuse_of_other_engine(pointer, key);
      }
      const std::string remedy = did_you_mean(key, keys);
      throw bad_input(document_.where(child(pointer, key)), "unknown key " + in_quotes(key),
                      fmt::format("the keys here are {}", fmt::join(keys, ", ")),
                      remedy.empty() ? further_in(key, object) : remedy);
    }
  }

  static std::string further_in(const std::string& key, const Value& object) {
    const std::string path = path_to(key, object);
    return path.empty() ? path : fmt::format("did you mean '{}'?", path);
  }

  void refuse_of_other_type(const std::string& pointer, const std::string& key, const Value& object,
                            const Member& own) const {
    const auto other = object.type().make();
    const Value probe(other.get(), object.type());
    std::string others;
    for (std::size_t i = 0; i < own.value.type().words.size(); ++i) {
      probe.members().front().value.choose(i);
      if (holds(keys_of(probe.members()), key))
        others += (others.empty() ? "'" : "', '") + std::string(own.value.type().words[i].name);
    }
    if (!others.empty())
      throw bad_input(document_.where(pointer),
                      fmt::format("'{}' has no meaning for the type '{}'", key, own.value.word().name),
                      fmt::format("it belongs to {}'", others), "remove it or change the type");
  }

  [[noreturn]] void refuse(const Json& json, const std::string& pointer, const std::string& wanted,
                           const std::string& remedy = {}) const {
    throw bad_input(document_.where(pointer), "is " + shown(json), "expected " + wanted, remedy);
  }

  void read_value(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    const Kind kind = value.kind();
    if (kind == Kind::integer) return read_integer(json, pointer, f, value);
    if (kind == Kind::number) return read_number(json, pointer, f, value);
    if (kind == Kind::text) return read_text(json, pointer, f, value);
    if (kind == Kind::word) return read_word(json, pointer, f, value);
    if (kind == Kind::object) return read_object(json, pointer, value);
    if (kind == Kind::map) return read_map(json, pointer, f, value);
    if (kind == Kind::optional) { // null is "not given": a child can take back what its parent gave
      const bool is_none = f.none_word.empty() ? json.is_null() : json == f.none_word;
      value.resize(is_none ? 0 : 1);
      if (!is_none) read_value(json, pointer, f, value[0]);
    } else if (kind == Kind::boolean) {
      if (!json.is_boolean()) refuse(json, pointer, expected(f, value.type()));
      value.as<bool>() = json.get<bool>();
    } else
      read_list(json, pointer, f, value);
  }

  void read_number(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    const bool is_length = f.unit == millimetre_unit && json.is_string();
    const std::optional<double> number = is_length          ? millimetres_of(json.get_ref<const std::string&>())
                                         : json.is_number() ? std::optional(json.get<double>())
                                                            : std::nullopt;
    // A value of as_json may be none that a text can have.
    if (!number || !std::isfinite(*number) || !f.bounds.contain(*number))
      refuse(json, pointer, expected_number(f),
             is_length ? fmt::format("write a number, or a length with its unit: {}", length_units) : std::string());
    value.as<double>() = *number;
  }

  void read_integer(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    const bool whole = json.is_number() && std::trunc(json.get<double>()) == json.get<double>();
    // 2^64 - 1 is not a double: the nearest one is 2^64, which a number in the file may be and the value may not.
    const bool fits = whole && f.bounds.contain(json.get<double>()) &&
                      (json.is_number_integer() || json.get<double>() < 18446744073709551616.0);
    if (!fits) refuse(json, pointer, expected(f, value.type()));
    if (value.is<int>())
      value.as<int>() = json.get<int>();
    else
      value.as<std::uint64_t>() = json.get<std::uint64_t>();
  }

  void read_text(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    if (!json.is_string()) refuse(json, pointer, expected(f, value.type()));
    const std::string& text = json.get_ref<const std::string&>();
    if (text.size() > 4096) refuse(json, pointer, "at most 4096 bytes");
    if (f.text != Text::text && std::ranges::any_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      refuse(json, pointer, "one line without control characters");
    if (f.text == Text::file && text.empty()) refuse(json, pointer, expected(f, value.type()));
    value.as<std::string>() =
        f.text == Text::file ? name_given(document_.origins().main(), text, document_.origins().at(pointer)) : text;
  }

  static bool choose(const Value& value, std::string_view word) {
    const std::vector<Word>& words = value.type().words;
    const auto chosen = std::ranges::find(words, word, &Word::name);
    if (chosen != words.end()) value.choose(static_cast<std::size_t>(chosen - words.begin()));
    return chosen != words.end();
  }

  void read_word(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    const std::string text = json.is_string() ? json.get<std::string>() : std::string();
    if (json.is_string() && choose(value, text)) return;
    std::vector<std::string> known;
    for (const Word& word : value.type().words) known.emplace_back(word.name);
    refuse(json, pointer, expected(f, value.type()), did_you_mean(text, known));
  }

  void read_list(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    const ValueType& type = value.type();
    if (f.bare_number && json.is_number()) {
      value.resize(1);
      read_number(json, pointer, f, value[0]);
      return;
    }
    const Count count = type.size > 0 ? Count{type.size, type.size} : f.count;
    if (!json.is_array() || json.size() < count.low || json.size() > count.high)
      refuse(json, pointer, expected(f, type));
    value.resize(json.size());
    for (std::size_t i = 0; i < json.size(); ++i)
      if (type.kind == Kind::table)
        read_row(json[i], child(pointer, i), f, value[i]);
      else
        read_value(json[i], child(pointer, i), f, value[i]);
  }

  void read_row(const Json& json, const std::string& pointer, const Field& f, const Value& row) const {
    if (!json.is_array() || json.size() != 2)
      refuse(json, pointer, fmt::format("a row [{}, {}]", f.columns.first.name, f.columns.second.name));
    for (std::size_t i = 0; i < 2; ++i)
      read_number(json[i], child(pointer, i), {.unit = f.columns[i].unit, .bounds = f.columns[i].bounds}, row[i]);
  }

  /// null takes an inherited entry away.
  void read_map(const Json& json, const std::string& pointer, const Field& f, const Value& value) const {
    if (!json.is_object() || json.size() > f.count.high) refuse(json, pointer, expected(f, value.type()));
    value.resize(0);
    for (const auto& [name, item] : json.items())
      if (!item.is_null()) read_object(item, child(pointer, name), value.add(name));
  }

  const Document& document_;
};

/// The preset's own name, or else its file's.
std::string base_name(const Document& document) {
  const auto own = document.value().find("name");
  const bool is_named = own != document.value().end() && own->is_string();
  return is_named ? own->get<std::string>() : stem_of(document.origins().main().place.name);
}

Preset finish(const SweptDocument& run) {
  const Document& document = run.document;
  const std::string name = base_name(document) + run.suffix;
  const Provenance provenance{
      std::make_shared<const Origins>(document.origins()), run.suffix.empty() ? std::string() : name,
      run.suffix.substr(std::min<std::size_t>(1, run.suffix.size())), std::nullopt, document.notes()};
  Preset unread;
  unread.provenance = provenance;
  return at_origins(unread, [&] {
    Preset preset;
    read(document, preset);
    preset.name = name;
    preset.source = document.origins().main().place.name;
    preset.provenance = provenance;
    if (preset.animation) preset = at_start(preset);
    check(preset, [&](const std::string& pointer) { return preset.provenance.origins->where(pointer); });
    return preset;
  });
}

std::vector<SweptDocument> runs_of(Document document, const Overrides& overrides) {
  for (const std::string& text : overrides) apply_override(document, text);
  return expand_sweep(std::move(document), overrides);
}

const SweptDocument& only(const std::vector<SweptDocument>& runs) {
  if (runs.size() != 1)
    throw bad_input(runs.front().document.origins().main().place / "sweep", fmt::format("gives {} runs", runs.size()),
                    "one preset is wanted here", "fix the swept keys by --set, or --set sweep=null");
  return runs.front();
}

Origin origin_of(const std::string& source) {
  return {Location(source), true, std::filesystem::path(source).parent_path()};
}

Document load(const std::string& name) { return load_document(find_preset(name, {}, "preset")); }

WithSweep with_sweep(Document document, const Overrides& overrides) {
  for (const std::string& text : overrides) apply_override(document, text);
  const Document whole = document;
  Sweep sweep = take_sweep(document, overrides);
  try {
    return {finish({std::move(document), ""}), sweep};
  } catch (const Error&) {
    if (sweep.empty()) throw;
  }
  return {finish({first_run(whole, overrides), ""}), std::move(sweep)};
}

} // namespace

void read(const Document& document, Preset& preset) {
  Reader(document).read_object(document.value(), "", Value(preset));
}

std::vector<Preset> read_presets(const std::string& name, const Overrides& overrides) {
  std::vector<Preset> presets;
  for (const SweptDocument& run : runs_of(load(name), overrides)) presets.push_back(finish(run));
  return presets;
}

Preset read_preset(const std::string& name, const Overrides& overrides) {
  return finish(only(runs_of(load(name), overrides)));
}

Preset parse_preset(const std::string& json, const std::string& source, const Overrides& overrides) {
  return finish(only(runs_of(parse_document(json, source), overrides)));
}

Preset read_json(Json value, const std::string& source) {
  return finish({Document(std::move(value), origin_of(source)), ""});
}

Preset with_overrides(const Preset& preset, const Overrides& overrides) {
  return finish(only(runs_of(Document(as_json(preset), origin_of(preset.source)), overrides)));
}

WithSweep read_with_sweep(const std::string& name, const Overrides& overrides) {
  return with_sweep(load(name), overrides);
}

WithSweep parse_with_sweep(const std::string& json, const std::string& source) {
  return with_sweep(parse_document(json, source), {});
}

Preset parse_first_run(const std::string& json, const std::string& source) {
  return finish({first_run(parse_document(json, source), {}), ""});
}

std::vector<SweptRun> swept_runs(const Preset& preset, const Sweep& sweep) {
  const Origin origin = origin_of(preset.source);
  Document document(as_json(preset), origin);
  for (const SweptField& field : sweep)
    if (std::ranges::count(sweep, field.key, &SweptField::key) > 1)
      throw bad_input(Location(preset.source) / "sweep", in_quotes(field.key) + " is swept twice");
  document.set({"sweep"}, to_json(sweep), origin);
  std::vector<SweptRun> runs;
  for (const SweptDocument& run : expand_sweep(std::move(document), {})) {
    SweptRun& swept = runs.emplace_back(SweptRun{base_name(run.document) + run.suffix, std::nullopt, {}});
    try {
      swept.preset = finish(run);
    } catch (const Error& error) {
      swept.why_not = error.line();
    }
  }
  return runs;
}

} // namespace nephroid::preset
