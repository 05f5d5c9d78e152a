// SPDX-License-Identifier: Apache-2.0
#include "formats/import/pbrt_tokens.h"

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

constexpr int max_includes = 16;

void read_into(std::vector<PbrtToken>& tokens, const fs::path& file, int depth) {
  if (depth > max_includes)
    throw bad_input(file.string(), fmt::format("files include each other more than {} deep", max_includes));
  const std::string text = read_file(file);
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      ++i;
    } else if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (c == '[' || c == ']') {
      tokens.push_back({std::string(1, c), false, Place(file.string(), line)});
      ++i;
    } else if (c == '"') {
      const std::size_t end = text.find_first_of("\"\n", i + 1);
      if (end == std::string::npos || text[end] == '\n')
        throw bad_input(Place(file.string(), line), "a string has no end", "expected \"");
      tokens.push_back({text.substr(i + 1, end - i - 1), true, Place(file.string(), line)});
      i = end + 1;
      const std::size_t count = tokens.size();
      if (count >= 2 && !tokens[count - 2].quoted &&
          (tokens[count - 2].text == "Include" || tokens[count - 2].text == "Import")) {
        const fs::path next = file.parent_path() / tokens.back().text;
        if (!is_there(next)) throw bad_input(tokens.back().where, "the file " + next.string() + " is not there");
        tokens.resize(count - 2);
        read_into(tokens, next, depth + 1);
      }
    } else {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n[]\"#", i), text.size());
      tokens.push_back({text.substr(i, end - i), false, Place(file.string(), line)});
      i = end;
    }
  }
}

} // namespace

std::vector<PbrtToken> pbrt_tokens(const fs::path& file) {
  std::vector<PbrtToken> tokens;
  read_into(tokens, file, 0);
  return tokens;
}

std::vector<double> PbrtParameter::numbers() const {
  std::vector<double> result;
  for (const std::string& text : values) {
    const auto value = typed_number<double>(text);
    if (!value || !(std::abs(*value) <= 1e12))
      throw bad_input(where, fmt::format("\"{}\" of \"{}\" is no number", text, name), "expected numbers");
    result.push_back(*value);
  }
  return result;
}

const PbrtParameter* PbrtParameters::find(const std::string& name) const {
  for (const PbrtParameter& parameter : all)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

std::string PbrtParameters::text(const std::string& name, const std::string& standard) const {
  const PbrtParameter* found = find(name);
  return found && !found->values.empty() ? found->values[0] : standard;
}

double PbrtParameters::number(const std::string& name, double standard) const {
  const PbrtParameter* found = find(name);
  if (!found) return standard;
  const auto values = found->numbers();
  if (values.size() != 1)
    throw bad_input(found->where, fmt::format("\"{}\" has {} values", name, values.size()), "expected one number");
  return values[0];
}

std::array<double, 3> PbrtParameters::vector(const std::string& name, const std::array<double, 3>& standard) const {
  const PbrtParameter* found = find(name);
  if (!found) return standard;
  const auto v = found->numbers();
  if (v.size() != 3)
    throw bad_input(found->where, fmt::format("\"{}\" has {} values", name, v.size()), "expected three numbers");
  return {v[0], v[1], v[2]};
}

} // namespace nephroid::formats
