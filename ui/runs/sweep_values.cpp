// SPDX-License-Identifier: Apache-2.0
#include "ui/runs/sweep_values.h"

#include "base/error.h"
#include "preset/outline.h"
#include "preset/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <set>

namespace nephroid::ui {
namespace {

using preset::Json;
using preset::Outline;
using Kind = Outline::Kind;

constexpr std::size_t most_values = 10000; ///< that a sweep of a preset may have

/// A name that --set takes between two dots.
bool is_sayable(const std::string& key)
{
  return !key.empty() && key.find_first_of(".=[") == std::string::npos &&
         std::ranges::none_of(key, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

void collect(const std::vector<Outline>& outline, const Json& object, const std::string& before, std::vector<NumberField>& all)
{
  for (const Outline& o : outline) {
    const std::string name(o.field.name);
    const std::string key = before + name;
    const Json value = object.contains(name) ? object[name] : Json();
    if (o.kind == Kind::number || o.kind == Kind::integer) {
      const double low = std::isfinite(o.field.bounds.low) ? o.field.bounds.low : 0;
      all.push_back({key, o.kind == Kind::integer, o.field.bounds, std::string(o.field.sentence), o.expected,
                     value.is_number() ? value.get<double>() : low});
    } else if (o.kind == Kind::object && value.is_object())
      collect(o.fields(value), value, key + '.', all);
    else if (o.kind == Kind::list || o.kind == Kind::map)
      for (const auto& item : value.items())
        if (is_sayable(item.key())) collect(o.fields(item.value()), item.value(), key + '.' + item.key() + '.', all);
  }
}

std::string text_of(const NumberField& field, double value)
{
  return field.whole ? fmt::format("{:.0f}", value) : Json(std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr)).dump();
}

/// Throws where the field may not have it.
void check_value(const NumberField& field, double value, const std::string& shown)
{
  if (std::isfinite(value) && field.bounds.contain(value) && (!field.whole || value == std::trunc(value))) return;
  throw bad_input(field.key, fmt::format("{} is out of its range", shown), "expected " + field.expected);
}

/// A number as people type it: ".5", "+3", "1e5".
std::string typed_value(const NumberField& field, const std::string& word)
{
  const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* const end = word.data() + word.size();
  const auto all = [&](auto& value) {
    const auto [stop, error] = std::from_chars(begin, end, value);
    return error == std::errc() && stop == end;
  };
  double value = 0;
  if (!all(value)) throw bad_input(field.key, "a value is no number", "expected numbers with commas between");
  check_value(field, value, fmt::format("{:g}", value));
  // Whole numbers beyond those of a double stay as they were typed.
  if (std::uint64_t natural = 0; field.whole && all(natural)) return std::to_string(natural);
  return text_of(field, value);
}

const std::vector<std::string>& all_different(const NumberField& field, const std::vector<std::string>& values)
{
  std::set<std::string> seen;
  for (const std::string& value : values)
    if (!seen.insert(value).second)
      throw bad_input(field.key, fmt::format("the value {} is there twice", value), "expected different values");
  return values;
}

} // namespace

std::vector<NumberField> number_fields(const preset::Preset& preset)
{
  std::vector<NumberField> all;
  const Json json = Json::parse(preset::to_json(preset));
  collect(preset::outline(json), json, "", all);
  return all;
}

std::vector<std::string> range_values(const NumberField& field, const SweepRange& range)
{
  if (range.count < 1 || static_cast<std::size_t>(range.count) > most_values)
    throw bad_input(field.key, fmt::format("{} values", range.count), fmt::format("expected 1 to {}", most_values));
  for (const double end : {range.from, range.to}) check_value(field, end, fmt::format("{:g}", end));
  if (range.logarithmic && !(range.from > 0 && range.to > 0))
    throw bad_input(field.key, "a logarithmic range has both ends above 0", "", "make it linear, or give other ends");
  std::vector<std::string> values;
  for (int i = 0; i < range.count; ++i) {
    const double part = range.count == 1 ? 0 : static_cast<double>(i) / (range.count - 1);
    double value = range.logarithmic ? range.from * std::pow(range.to / range.from, part) : range.from + part * (range.to - range.from);
    if (i == range.count - 1 && i > 0) value = range.to; // exactly
    values.push_back(text_of(field, field.whole ? std::round(value) : value));
  }
  return all_different(field, values);
}

std::vector<std::string> typed_values(const NumberField& field, const std::string& text)
{
  constexpr const char* between = ", ;\t\r\n";
  std::vector<std::string> values;
  for (std::size_t at = text.find_first_not_of(between); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    const std::string word = text.substr(at, end - at);
    values.push_back(typed_value(field, word));
    if (values.size() > most_values)
      throw bad_input(field.key, "there are too many values", fmt::format("expected at most {}", most_values));
    at = text.find_first_not_of(between, end);
  }
  if (values.empty()) throw bad_input(field.key, "there is no value", "expected numbers with commas between");
  return all_different(field, values);
}

} // namespace nephroid::ui
