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
  std::string plain(trimmed(text));
  for (const std::string_view square_metre : {"m2", "m²"})
    if (plain.ends_with(square_metre)) plain.replace(plain.size() - square_metre.size(), square_metre.size(), "m^2");
  text = plain;
  for (const auto& choice : choices<Meter::Unit>) {
    if (!text.ends_with(choice.name)) continue;
    const std::string number(trimmed(text.substr(0, text.size() - choice.name.size())));
    if (const auto value = number_in<double>(number); value && *value >= 0 && std::isfinite(*value))
      return Quantity{*value, choice.value};
  }
  return std::nullopt;
}

std::optional<double> threshold_in(const Meter& meter, Meter::Unit unit) {
  if (!meter.threshold) return std::nullopt;
  const Quantity threshold = quantity_in(*meter.threshold).value(); // preset::check has looked
  if (is_luminous(threshold.unit) != is_luminous(unit)) return std::nullopt;
  return threshold.value * size_of(threshold.unit) / size_of(unit);
}

std::string file_stem(const Meter& meter) {
  std::string stem = meter.name;
  std::ranges::replace_if(
      stem, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_' && c != '.'; }, '-');
  return stem;
}

} // namespace nephroid::preset
