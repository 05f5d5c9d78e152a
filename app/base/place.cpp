// SPDX-License-Identifier: Apache-2.0
#include "base/place.h"

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

Place Place::operator/(std::string_view key) const { return {name, pointer.value_or("").append("/").append(pointer_key(key))}; }

std::string Place::text() const
{
  std::string text = name;
  if (pointer) text.append("#").append(*pointer);
  for (const std::size_t number : {line, column})
    if (number > 0) text.append(":").append(std::to_string(number));
  return text;
}

} // namespace nephroid
