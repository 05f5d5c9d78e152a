// SPDX-License-Identifier: Apache-2.0
// The words of a PBRT file, with their lines.
#pragma once
#include "base/place.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::formats {

struct PbrtToken {
  std::string text;    ///< without the quotes
  bool quoted = false; ///< a string
  Place where;
};

/// The tokens of the file and of those it includes, in order. Throws bad_input at FILE:LINE: a string without an end, a
/// file that is not there or includes itself.
std::vector<PbrtToken> pbrt_tokens(const std::filesystem::path& file);

struct PbrtParameter {
  std::string type, name;
  std::vector<std::string> values;
  Place where;
  std::vector<double> numbers() const; ///< throws bad_input where one is no number
};

/// The parameters of a directive.
struct PbrtParameters {
  std::vector<PbrtParameter> all;
  Place where; ///< of the directive
  const PbrtParameter* find(const std::string& name) const;
  std::string text(const std::string& name, const std::string& standard) const;
  double number(const std::string& name, double standard) const;
  std::array<double, 3> vector(const std::string& name, const std::array<double, 3>& standard) const;
};

} // namespace nephroid::formats
