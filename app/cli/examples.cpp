// SPDX-License-Identifier: Apache-2.0
#include "cli/examples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace nephroid::cli {

std::string examples(std::initializer_list<Example> list)
{
  std::size_t width = 0;
  for (const Example& example : list)
    if (*example.says) width = std::max(width, std::strlen(example.command));
  std::string text = list.size() == 1 ? "Example:" : "Examples:";
  for (const Example& example : list)
    text += *example.says ? fmt::format("\n  {:<{}}  # {}", example.command, width, example.says) : fmt::format("\n  {}", example.command);
  return text;
}

} // namespace nephroid::cli
