// SPDX-License-Identifier: Apache-2.0
#include "cli/examples.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::cli {

std::string examples(const std::vector<Example>& list)
{
  std::size_t width = 0;
  for (const Example& example : list)
    if (!example.says.empty()) width = std::max(width, example.command.size());
  std::string text = list.size() == 1 ? "Example:" : "Examples:";
  for (const Example& example : list)
    text += example.says.empty() ? fmt::format("\n  {}", example.command)
                                 : fmt::format("\n  {:<{}}  # {}", example.command, width, example.says);
  return text;
}

} // namespace nephroid::cli
