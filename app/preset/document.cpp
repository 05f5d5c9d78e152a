// SPDX-License-Identifier: Apache-2.0
#include "preset/document.h"

#include "base/error.h"
#include "base/numbers.h"
#include "preset/change_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace nephroid::preset {
namespace {

/// An object that changes its type starts anew: the fields of the old type would be errors.
bool changes_type(const Json& into, const Json& over) {
  return over.contains("type") && into.contains("type") && over["type"] != into["type"];
}

std::string dotted(const std::vector<std::string>& path, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ".") + path[i];
  return text;
}

/// The item of a list that a path's key names.
Json& item(Json& list, const std::string& key, const std::string& path, const Origin& origin) {
  if (const auto index = number_in<std::size_t>(key); index && *index < list.size()) return list[*index];
  const std::string range = list.empty() ? "it is empty" : fmt::format("its items are 0 to {}", list.size() - 1);
  throw bad_input(origin.place, fmt::format("{} is a list and has no item {}", in_quotes(path), in_quotes(key)), range);
}

struct Axis {
  std::string key; ///< as written
  std::vector<std::string> path;
  Json values;
  std::vector<std::string> labels;
  Origin origin;
  Location where; ///< for messages
};

bool starts_with(const std::vector<std::string>& path, const std::vector<std::string>& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

/// [0, 1.5] as "0_1.5"
std::string joined(const Json& numbers) {
  std::string text;
  for (const Json& number : numbers) text += (text.empty() ? "" : "_") + number.dump();
  return text;
}

bool is_list_of_numbers(const Json& value) {
  return value.is_array() && !value.empty() && std::ranges::all_of(value, &Json::is_number);
}

/// Numbers and words say what they are; they must do in the name of a folder.
std::string label(const Json& value) {
  std::string text = value.is_string()           ? value.get<std::string>()
                     : is_list_of_numbers(value) ? joined(value)
                                                 : value.dump();
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-' && c != '+') c = '-';
  return text.substr(0, 40);
}

std::vector<std::string> labels(const Json& values) {
  const auto all_differ = [](const std::vector<std::string>& words) {
    return std::set(words.begin(), words.end()).size() == words.size();
  };
  std::vector<std::string> all, of_files; // "materials/N-BK7.yml" and "N-BK7.yml"
  for (const Json& value : values) {
    all.push_back(label(value));
    of_files.push_back(value.is_string() ? label(std::filesystem::path(value.get<std::string>()).filename().string())
                                         : all.back());
  }
  if (all_differ(of_files)) all = of_files;
  const bool plain = std::none_of(values.begin(), values.end(),
                                  [](const Json& v) { return v.is_structured() && !is_list_of_numbers(v); });
  if (!plain || !all_differ(all))
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::to_string(i);
  return all;
}

Axis make_axis(const std::string& key, Json values, const Document& document) {
  const std::string pointer = child("/sweep", key);
  Axis axis{key, split_path(key), std::move(values), {}, document.origins().at(pointer), document.where(pointer)};
  if (axis.path.empty())
    throw bad_input(axis.where, in_quotes(key) + " is no path",
                    "expected keys joined by dots, for instance scene.lights.0.power_w");
  if (axis.path.front() == "sweep" || axis.path.front() == "parent")
    throw bad_input(axis.where, in_quotes(key) + " cannot be swept");
  if (!axis.values.is_array() || axis.values.empty())
    throw bad_input(axis.where, "is " + shown(axis.values), "expected a list of at least one value");
  axis.labels = labels(axis.values);
  return axis;
}

void refuse_overlaps(const std::vector<Axis>& axes) {
  for (const Axis& a : axes)
    for (const Axis& b : axes)
      if (&a != &b && starts_with(b.path, a.path))
        throw bad_input(b.where,
                        fmt::format("{} lies inside {}, which is swept too", in_quotes(b.key), in_quotes(a.key)),
                        "expected keys apart from each other");
}

/// An override of a swept key fixes it; one inside a swept value would be overwritten in every run.
bool is_fixed(const Axis& axis, const std::vector<std::string>& overrides) {
  bool fixed = false;
  for (const std::string& text : overrides) {
    const std::vector<std::string> path = split_path(std::string_view(text).substr(0, text.find('=')));
    if (path == axis.path)
      fixed = true;
    else if (starts_with(path, axis.path))
      throw bad_input("--set " + text,
                      fmt::format("the preset sweeps {}, which would overwrite it", in_quotes(axis.key)), {},
                      fmt::format("set {} as a whole", axis.key));
  }
  return fixed;
}

/// The last part of the path where that is enough to tell the axes apart.
void append_suffix(std::string& suffix, const Axis& axis, const std::vector<Axis>& axes, std::size_t index) {
  const auto same = [&](const Axis& other) { return other.path.back() == axis.path.back(); };
  const bool clear = std::count_if(axes.begin(), axes.end(), same) == 1;
  suffix += fmt::format(",{}={}", label(clear ? axis.path.back() : axis.key), axis.labels[index]);
}

std::vector<Axis> read_axes(Document& document, const std::vector<std::string>& overrides) {
  const Location where = document.where("/sweep");
  const Json sweep = document.take("sweep");
  if (sweep.is_null()) return {};
  if (!sweep.is_object())
    throw bad_input(where, "is " + shown(sweep), "expected an object of lists, for instance {\"seed\": [1, 2]}");
  std::vector<Axis> axes;
  for (const auto& [key, values] : sweep.items()) axes.push_back(make_axis(key, values, document));
  refuse_overlaps(axes);
  std::erase_if(axes, [&](const Axis& axis) { return is_fixed(axis, overrides); });
  double runs = 1;
  for (const Axis& axis : axes) runs *= static_cast<double>(axis.values.size());
  if (runs > static_cast<double>(max_runs))
    throw bad_input(where, fmt::format("gives {:.0f} runs", runs), fmt::format("expected at most {}", max_runs));
  return axes;
}

/// "FILE#/sweep/seed/0"; of a sweep that an override gave, the override.
Origin origin_of_value(const Axis& axis, std::size_t index) {
  Origin origin = axis.origin;
  if (origin.is_file) origin.place = axis.where / index;
  origin.is_file = false;
  return origin;
}

} // namespace

void Document::merge(const Json& over, const Origin& origin) {
  const auto shared = std::make_shared<const Origin>(origin);
  origins_.set_main(shared);
  if (over.contains("engine")) change_engine(over["engine"], origin);
  merge(value_, over, "", shared);
}

void Document::change_engine(const Json& engine, const Origin& origin) {
  if (!engine.is_string() || value_.value("engine", Json()) == engine) return;
  const std::vector<std::string> taken = take_foreign(value_, engine.get<std::string>());
  if (taken.empty()) return;
  const Origins::Shared tracks = origins_.shared_at("/animation/tracks");
  origins_.set_whole("/animation/tracks", tracks); // their numbers may have changed
  Location place = origin.place;
  if (origin.is_file) place = place / "engine";
  notes_.push_back(place.text() + ": " + left_out_note(engine.get<std::string>(), taken));
}

void Document::merge(Json& into, const Json& over, const std::string& pointer, const Origins::Shared& origin) {
  if (!into.is_object() || !over.is_object() || changes_type(into, over)) {
    replace(into, over, pointer, origin);
    return;
  }
  // The object is now of both: what is already in it keeps its origin, what may be missing from it is for the later
  // file to say.
  const Origins::Shared before = origins_.shared_at(pointer);
  for (const auto& [key, value] : into.items()) origins_.set_if_none(child(pointer, key), before);
  origins_.set(pointer, origin);
  for (const auto& [key, value] : over.items()) {
    const bool is_new = !into.contains(key);
    Json& slot = into[key];
    if (is_new)
      replace(slot, value, child(pointer, key), origin);
    else
      merge(slot, value, child(pointer, key), origin);
  }
}

void Document::replace(Json& slot, const Json& value, const std::string& pointer, const Origins::Shared& origin) {
  slot = value;
  origins_.set_whole(pointer, origin);
}

void Document::set(const std::vector<std::string>& path, Json value, const Origin& origin) {
  const auto shared = std::make_shared<const Origin>(origin);
  if (path.size() == 1 && path.front() == "engine") change_engine(value, origin);
  Json* slot = &value_;
  std::string pointer;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string& key = path[i];
    if (slot->is_array()) {
      slot = &item(*slot, key, dotted(path, i), origin);
    } else if (slot->is_object()) {
      if (!slot->contains(key))
        replace((*slot)[key], i + 1 < path.size() ? Json::object() : Json(), child(pointer, key), shared);
      slot = &(*slot)[key];
    } else
      throw bad_input(origin.place, fmt::format("{} is {} and has no fields", in_quotes(dotted(path, i)), shown(*slot)),
                      {}, "set the whole value instead");
    pointer = child(pointer, key);
  }
  replace(*slot, value, pointer, shared);
}

Json Document::take(const std::string& key) {
  if (!value_.is_object() || !value_.contains(key)) return nullptr;
  Json value = std::move(value_[key]);
  value_.erase(key);
  return value;
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> keys;
  for (std::size_t from = 0;;) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    if (dot == from) return {};
    keys.emplace_back(path.substr(from, dot - from));
    if (dot == path.size()) return keys;
    from = dot + 1;
  }
}

void apply_override(Document& document, const std::string& text) {
  if (!is_utf8(text)) throw bad_input("--set", in_quotes(text) + " is not UTF-8", "expected KEY=VALUE in UTF-8");
  Origin origin{"--set " + text, false, document.origins().main().folder, true};
  if (text.size() > 200) origin.place = "--set " + text.substr(0, 200) + "...";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw bad_input(origin.place, "has no '='", "expected KEY=VALUE, for instance scene.lights.0.power_w=2");
  const std::vector<std::string> path = split_path(std::string_view(text).substr(0, equals));
  if (path.empty())
    throw bad_input(origin.place, "has an empty key",
                    "expected keys joined by dots, for instance scene.lights.0.power_w=2");
  for (const std::string& key : path)
    if (key.size() > 2 && key.find('[') != std::string::npos && key.back() == ']')
      throw bad_input(origin.place, fmt::format("{} is no key", in_quotes(key)),
                      "items of a list go by number after a dot", "for instance scene.lights.0.power_w=2");
  if (path.size() > max_depth) throw bad_input(origin.place, fmt::format("is nested deeper than {} levels", max_depth));

  const std::string value = text.substr(equals + 1), as_json = with_json_numbers(value);
  Json parsed = value; // a bare string, unless it is or sets out to be JSON
  if (Json::accept(as_json))
    parsed = parse_json(as_json, origin.place.name);
  else if (value.starts_with('{') || value.starts_with('[') || value.starts_with('"'))
    parsed = parse_json(value, origin.place.name); // throws, at the column as typed
  document.set(path, std::move(parsed), origin);
}

Sweep take_sweep(Document& document, const std::vector<std::string>& overrides) {
  Sweep sweep;
  for (const Axis& axis : read_axes(document, overrides)) {
    SweptField& field = sweep.emplace_back(SweptField{axis.key, {}});
    for (const Json& value : axis.values) field.values.push_back(value.dump());
  }
  return sweep;
}

Document first_run(Document document, const std::vector<std::string>& overrides) {
  for (const Axis& axis : read_axes(document, overrides))
    document.set(axis.path, axis.values[0], origin_of_value(axis, 0));
  return document;
}

Json to_json(const Sweep& sweep) {
  Json json;
  for (const SweptField& field : sweep) {
    Json& values = json[field.key] = Json::array();
    for (const std::string& value : field.values) values.push_back(Json::parse(value));
  }
  return json;
}

double count_runs(const Sweep& sweep) {
  double runs = 1;
  for (const SweptField& field : sweep) runs *= static_cast<double>(field.values.size());
  return runs;
}

std::vector<SweptDocument> expand_sweep(Document document, const std::vector<std::string>& overrides) {
  const std::vector<Axis> axes = read_axes(document, overrides);
  std::vector<SweptDocument> runs{{std::move(document), ""}};
  for (const Axis& axis : axes) {
    std::vector<SweptDocument> longer;
    for (const SweptDocument& run : runs)
      for (std::size_t i = 0; i < axis.values.size(); ++i) {
        SweptDocument& next = longer.emplace_back(run);
        next.document.set(axis.path, axis.values[i], origin_of_value(axis, i));
        append_suffix(next.suffix, axis, axes, i);
      }
    runs = std::move(longer);
  }
  return runs;
}

} // namespace nephroid::preset
