// SPDX-License-Identifier: Apache-2.0
#include "preset/meters.h"

#include "base/numbers.h"
#include "preset/choices.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace nephroid::preset {

std::vector<std::string_view> meter_units() {
  std::vector<std::string_view> units;
  for (const auto& choice : choices<Meter::Unit>) units.push_back(choice.name);
  return units;
}

std::optional<Quantity> quantity_in(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
  const auto trimmed = [&](std::string_view part) {
    while (!part.empty() && is_space(part.front())) part.remove_prefix(1);
    while (!part.empty() && is_space(part.back())) part.remove_suffix(1);
    return part;
  };
  text = trimmed(text);
  for (const auto& choice : choices<Meter::Unit>) {
    if (!text.ends_with(choice.name)) continue;
    const std::string number(trimmed(text.substr(0, text.size() - choice.name.size())));
    if (const auto value = number_in<double>(number); value && *value >= 0 && std::isfinite(*value))
      return Quantity{*value, choice.value};
  }
  return std::nullopt;
}

std::string file_stem(const Meter& meter) {
  std::string stem = meter.name;
  std::ranges::replace_if(
      stem, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_' && c != '.'; }, '-');
  return stem;
}

} // namespace nephroid::preset
