// SPDX-License-Identifier: Apache-2.0
// What the verbs that read dispersion files share: finding a file, and the option for wavelengths outside its range.
#pragma once
#include "cli/verb.h"
#include "optics/dispersion.h"
#include "preset/choices.h"

#include <algorithm>

namespace nephroid::cli {

/// Finds `name` as a file, else among the shipped materials, where ".yml" may be left out ("N-BK7"). Throws bad_input
/// naming the folders searched.
optics::DispersionCurve find_dispersion(const std::string& name);

/// Whether the name means a dispersion file: it ends in ".yml" or is a shipped material.
bool is_dispersion(const std::string& name);

/// The words of an enumeration of presets, as an option's values.
template <preset::Enumeration E>
std::vector<std::string> words_of() {
  std::vector<std::string> words;
  for (const auto& choice : preset::choices<E>) words.emplace_back(choice.name);
  return words;
}
template <preset::Enumeration E>
E chosen_of(const std::string& word) {
  return std::ranges::find(preset::choices<E>, word, &preset::Choice<E>::name)->value;
}

/// Adds --outside hold|extrapolate|refuse. Without the option, `chosen` is "automatic"; outside_policy reads it after
/// parsing.
void add_outside_option(Verb& verb, std::string& chosen);
optics::Extrapolation outside_policy(const std::string& chosen);

} // namespace nephroid::cli
