// SPDX-License-Identifier: Apache-2.0
#include "preset/walks.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace nephroid::preset {
namespace {

std::string in_range(const Bounds& b) {
  const bool low = std::isfinite(b.low), high = std::isfinite(b.high);
  if (b.without_low && b.without_high)
    return low && high ? fmt::format(" above {} and below {}", b.low, b.high)
           : low       ? fmt::format(" above {}", b.low)
                       : "";
  return low && high ? fmt::format(" from {} to {}", b.low, b.high) : low ? fmt::format(" of at least {}", b.low) : "";
}

std::string in_unit(std::string_view unit) { return unit.empty() ? "" : fmt::format(" {}", unit); }

std::string expected_integer(const Bounds& bounds, std::string_view unit) {
  // Whole numbers read better without an exponent: 16777216, not 1.6777216e+07.
  // 2^64 as a bound stands for the largest 64-bit number, which no double is.
  const std::string high =
      bounds.high < 18446744073709551615.0 ? fmt::format("{:.0f}", bounds.high) : "18446744073709551615";
  return fmt::format("a whole number from {:.0f} to {}", bounds.low, high) + in_unit(unit);
}

/// A struct: an object, and whatever else stands for it.
std::string expected_object(const ValueType& type) {
  std::string text;
  for (const Shorthand& shorthand : type.shorthands)
    text += shorthand.bare == BareValue::number ? "a number, " : "a string, ";
  return text.empty() ? "an object" : text.replace(text.size() - 2, 2, " or an object");
}

/// A map's items by their names, or a list of them.
Json items_of(const Value& value) {
  const bool named = value.kind() == Kind::map;
  Json items = named ? Json::object() : Json::array();
  for (std::size_t i = 0; i < value.count(); ++i)
    (named ? items[value.key(i)] : items.emplace_back()) = as_json(value[i]);
  return items;
}

Json object_of(const Value& value) {
  Json object = Json::object();
  for (const Member& member : value.members()) {
    const bool absent = !member.value.exists() || (member.role == Role::recipe && member.value.count() == 0);
    if (absent) continue;
    object[std::string(member.field.name)] = as_json(member);
  }
  return object;
}

} // namespace

Json as_json(const Member& member) {
  const bool is_word = !member.field.none_word.empty() && member.value.count() == 0;
  return is_word ? Json(member.field.none_word) : as_json(member.value);
}

Json as_json(const Value& value) {
  const Kind kind = value.kind();
  if (kind == Kind::boolean) return value.as<bool>();
  if (kind == Kind::integer) return value.is<int>() ? Json(value.as<int>()) : Json(value.as<std::uint64_t>());
  if (kind == Kind::number) return value.as<double>();
  if (kind == Kind::text) return value.as<std::string>();
  if (kind == Kind::word) return std::string(value.word().name);
  if (kind == Kind::object) return object_of(value);
  if (kind == Kind::optional) return value.count() > 0 ? as_json(value[0]) : Json();
  return items_of(value);
}

std::string expected_number(const Field& f) {
  return "a number" + in_range(f.bounds) + in_unit(f.unit) +
         (f.none_word.empty() ? "" : fmt::format(" or \"{}\"", f.none_word));
}

std::string expected_count(const Count& count) {
  if (count.low == 0) return fmt::format("at most {} items", count.high);
  return fmt::format("{} to {} items", count.low, count.high);
}

std::string expected(const Field& f, const ValueType& type) {
  const auto list = [&](const std::string& item) {
    return fmt::format("a list of {}, each {}",
                       type.size > 0 ? fmt::format("{} items", type.size) : expected_count(f.count), item);
  };
  if (type.kind == Kind::boolean) return "true or false";
  if (type.kind == Kind::integer) return expected_integer(f.bounds, f.unit);
  if (type.kind == Kind::number) return expected_number(f);
  if (type.kind == Kind::text) return f.text == Text::file ? "the name of a file" : "a string";
  if (type.kind == Kind::word) {
    std::string words;
    for (const Word& word : type.words) words += (words.empty() ? "one of " : ", ") + std::string(word.name);
    return words;
  }
  if (type.kind == Kind::table) return list(fmt::format("[{}, {}]", f.columns.first.name, f.columns.second.name));
  if (type.kind == Kind::map)
    return fmt::format("an object of names with {}, each {}", expected_count(f.count), expected(f, *type.item));
  if (type.kind == Kind::optional) return expected(f, *type.item);
  return type.kind == Kind::object ? expected_object(type) : list(expected(f, *type.item));
}

} // namespace nephroid::preset
