// SPDX-License-Identifier: Apache-2.0
// What the verbs that read dispersion files share: words of presets as options, and the option for wavelengths outside
// a file's range.
#pragma once
#include "cli/verb.h"
#include "preset/choices.h"
#include "scatter/spectra.h"

#include <algorithm>

namespace nephroid::cli {

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

/// Adds --outside. Without the option, `chosen` is "automatic"; outside_policy reads it after parsing.
inline void add_outside_option(Verb& verb, std::string& chosen) {
  chosen = "automatic";
  verb.option("--outside", chosen,
              {.type = "POLICY",
               .says = "Outside the data's range: hold its end, extrapolate, or refuse; default: extrapolate a "
                       "formula, hold a table",
               .words = words_of<preset::Extrapolation>()});
}
inline optics::Extrapolation outside_policy(const std::string& chosen) {
  return scatter::outside_policy(chosen_of<preset::Extrapolation>(chosen));
}

} // namespace nephroid::cli
