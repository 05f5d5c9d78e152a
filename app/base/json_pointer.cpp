// SPDX-License-Identifier: Apache-2.0
#include "base/json_pointer.h"

namespace nephroid {

std::string pointer_key(std::string_view key)
{
  std::string escaped;
  for (const char c : key) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  return escaped;
}

} // namespace nephroid
