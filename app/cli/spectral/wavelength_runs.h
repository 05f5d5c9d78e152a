// SPDX-License-Identifier: Apache-2.0
// Clusters of wavelengths as text and as nanometres.
#pragma once
#include "optics/wavelength.h"

#include <fmt/format.h>

#include <set>
#include <string>

namespace nephroid::cli {

/// indices of both functions: 0..400, in any order.
inline std::vector<int> wavelengths_nm(const std::vector<int>& indices) {
  std::vector<int> result;
  for (const int index : indices) result.push_back(optics::wavelength_nm(index));
  return result;
}

/// "380-384,390 nm": runs of neighbouring wavelengths, by rising wavelength.
inline std::string wavelength_runs(const std::vector<int>& indices) {
  const std::vector<int> members = wavelengths_nm(indices);
  const std::set<int> sorted(members.begin(), members.end());
  std::string text;
  for (auto i = sorted.begin(); i != sorted.end();) {
    const int first = *i;
    int last = first;
    while (++i != sorted.end() && *i == last + 1) last = *i;
    if (!text.empty()) text += ',';
    text += first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
  }
  return text + " nm";
}

} // namespace nephroid::cli
