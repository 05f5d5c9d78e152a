// SPDX-License-Identifier: Apache-2.0
// JSON files of a run, read with the place of whatever is missing or of another type than a run writes. Private to measure/.
#pragma once
#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::measure {

using Json = nlohmann::ordered_json;

/// Throws bad_input naming the file: missing, empty, cut, no JSON, nested deeper than anything a run writes.
inline Json read_json(const std::filesystem::path& file)
{
  if (!is_there(file)) throw bad_input(file.string(), "is missing", "expected the files of a finished run");
  const std::string text = read_file(file);
  if (text.empty()) throw bad_input(file.string(), "is empty", {}, "run it again");
  const auto refuse_depth = [&](int depth, Json::parse_event_t, const Json&) {
    constexpr int max_depth = 64; // what walks through a value calls itself at every level
    if (depth > max_depth) throw bad_input(file.string(), fmt::format("is nested deeper than {} levels", max_depth));
    return true;
  };
  Json json = Json::parse(text, refuse_depth, false);
  if (json.is_discarded()) throw bad_input(file.string(), "is cut or no JSON", {}, "run it again");
  return json;
}

/// An object of a file, which must outlive it. Every getter throws bad_input at FILE#/pointer where the member is missing or is none of its
/// kind.
class JsonObject {
public:
  JsonObject(const Json& json, Place place) : json_(json), place_(std::move(place))
  {
    if (!json_.is_object()) throw bad_input(place_, "is no object");
  }

  bool has(const char* key) const { return json_.contains(key); }
  JsonObject object(const char* key) const { return {at(key), place_of(key)}; }

  std::string text(const char* key) const
  {
    const Json& value = at(key);
    if (!value.is_string()) throw bad_input(place_of(key), "is no text");
    return value.get<std::string>();
  }

  /// Finite.
  double number(const char* key) const { return number_in(at(key), place_of(key)); }

  template <class Integer>
  Integer count(const char* key) const
  {
    const Json& value = at(key);
    if (!value.is_number_unsigned()) throw bad_input(place_of(key), "is no whole number from 0");
    return value.get<Integer>();
  }

  bool flag(const char* key) const
  {
    const Json& value = at(key);
    if (!value.is_boolean()) throw bad_input(place_of(key), "is neither true nor false");
    return value.get<bool>();
  }

  /// Every member as a number; null is left out: an error that is undefined.
  std::vector<std::pair<std::string, double>> numbers() const
  {
    std::vector<std::pair<std::string, double>> all;
    for (const auto& [key, value] : json_.items())
      if (!value.is_null()) all.emplace_back(key, number_in(value, place_of(key)));
    return all;
  }

  /// Every member as text: a string as it is, else its JSON.
  std::vector<std::pair<std::string, std::string>> texts() const
  {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [key, value] : json_.items()) all.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    return all;
  }

  std::vector<JsonObject> objects(const char* key) const
  {
    std::vector<JsonObject> all;
    for (const Json& item : array(key)) all.emplace_back(item, place_of(key) / all.size());
    return all;
  }

  std::vector<std::string> texts(const char* key) const
  {
    std::vector<std::string> all;
    for (const Json& item : array(key)) {
      if (!item.is_string()) throw bad_input(place_of(key) / all.size(), "is no text");
      all.push_back(item.get<std::string>());
    }
    return all;
  }

private:
  Place place_of(const std::string& key) const { return place_ / key; }

  const Json& at(const char* key) const
  {
    if (!json_.contains(key)) throw bad_input(place_of(key), "is missing");
    return json_.at(key);
  }

  const Json& array(const char* key) const
  {
    const Json& value = at(key);
    if (!value.is_array()) throw bad_input(place_of(key), "is no list");
    return value;
  }

  static double number_in(const Json& value, const Place& place)
  {
    if (!value.is_number() || !std::isfinite(value.get<double>())) throw bad_input(place, "is no number");
    return value.get<double>();
  }

  const Json& json_;
  Place place_;
};

} // namespace nephroid::measure
