// SPDX-License-Identifier: Apache-2.0
#include "preset/document.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace nephroid::preset {
namespace {

/// An object that changes its type starts anew: the fields of the old type would be errors.
bool changes_type(const Json& into, const Json& over)
{
  return over.contains("type") && into.contains("type") && over["type"] != into["type"];
}

std::string dotted(const std::vector<std::string>& path, std::size_t count)
{
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ".") + path[i];
  return text;
}

/// The item of a list that a path's key names.
Json& item(Json& list, const std::string& key, const std::string& path, const Origin& origin)
{
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (error == std::errc() && end == key.data() + key.size() && index < list.size()) return list[index];
  const std::string range = list.empty() ? "it is empty" : fmt::format("its items are 0 to {}", list.size() - 1);
  throw bad_input(origin.place, fmt::format("{} is a list and has no item {}", in_quotes(path), in_quotes(key)), range);
}

} // namespace

void Document::merge(const Json& over, const Origin& origin)
{
  const auto shared = std::make_shared<const Origin>(origin);
  origins_.set_main(shared);
  merge(value_, over, "", shared);
}

void Document::merge(Json& into, const Json& over, const std::string& pointer, const Origins::Shared& origin)
{
  if (!into.is_object() || !over.is_object() || changes_type(into, over)) {
    replace(into, over, pointer, origin);
    return;
  }
  // The object is now of both: what is already in it keeps its origin, what may be missing from it is for the later file to say.
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

void Document::replace(Json& slot, const Json& value, const std::string& pointer, const Origins::Shared& origin)
{
  slot = value;
  origins_.set_whole(pointer, origin);
}

void Document::set(const std::vector<std::string>& path, Json value, const Origin& origin)
{
  const auto shared = std::make_shared<const Origin>(origin);
  Json* slot = &value_;
  std::string pointer;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string& key = path[i];
    if (slot->is_array()) {
      slot = &item(*slot, key, dotted(path, i), origin);
    } else if (slot->is_object()) {
      if (!slot->contains(key)) replace((*slot)[key], i + 1 < path.size() ? Json::object() : Json(), child(pointer, key), shared);
      slot = &(*slot)[key];
    } else
      throw bad_input(origin.place, fmt::format("{} is {} and has no fields", in_quotes(dotted(path, i)), shown(*slot)), {},
                      "set the whole value instead");
    pointer = child(pointer, key);
  }
  replace(*slot, value, pointer, shared);
}

Json Document::take(const std::string& key)
{
  if (!value_.is_object() || !value_.contains(key)) return nullptr;
  Json value = std::move(value_[key]);
  value_.erase(key);
  return value;
}

std::vector<std::string> split_path(std::string_view path)
{
  std::vector<std::string> keys;
  for (std::size_t from = 0;;) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    if (dot == from) return {};
    keys.emplace_back(path.substr(from, dot - from));
    if (dot == path.size()) return keys;
    from = dot + 1;
  }
}

void apply_override(Document& document, const std::string& text)
{
  if (!is_utf8(text)) throw bad_input("--set", in_quotes(text) + " is not UTF-8", "expected KEY=VALUE in UTF-8");
  Origin origin{"--set " + text, false, document.origins().main().folder, true};
  if (text.size() > 200) origin.place = "--set " + text.substr(0, 200) + "...";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw bad_input(origin.place, "has no '='", "expected KEY=VALUE, for instance scene.lights.0.power_w=2");
  const std::vector<std::string> path = split_path(std::string_view(text).substr(0, equals));
  if (path.empty())
    throw bad_input(origin.place, "has an empty key", "expected keys joined by dots, for instance scene.lights.0.power_w=2");
  for (const std::string& key : path)
    if (key.size() > 2 && key.find('[') != std::string::npos && key.back() == ']')
      throw bad_input(origin.place, fmt::format("{} is no key", in_quotes(key)), "items of a list go by number after a dot",
                      "for instance scene.lights.0.power_w=2");
  if (path.size() > max_depth) throw bad_input(origin.place, fmt::format("is nested deeper than {} levels", max_depth));

  const std::string value = text.substr(equals + 1), as_json = with_json_numbers(value);
  Json parsed = value; // a bare string, unless it is or sets out to be JSON
  if (Json::accept(as_json))
    parsed = parse_json(as_json, origin.place.name);
  else if (value.starts_with('{') || value.starts_with('[') || value.starts_with('"'))
    parsed = parse_json(value, origin.place.name); // throws, at the column as typed
  document.set(path, std::move(parsed), origin);
}

} // namespace nephroid::preset
