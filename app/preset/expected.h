// SPDX-License-Identifier: Apache-2.0
// What a field wants, in words: "a number from 0 to 1". Private to preset/.
#pragma once
#include "preset/field.h"

#include <string>

namespace nephroid::preset {

std::string expected_number(const Bounds& bounds, std::string_view unit);
std::string expected_integer(const Bounds& bounds, std::string_view unit);
/// "a list of 3 numbers, each from ..."
std::string expected_list(std::size_t count, const std::string& each);
std::string expected_list(const Count& count, const std::string& each);
/// "1 to 16 items", "at least 2 items"
std::string expected_count(const Count& count);

template <Enumeration E>
std::string expected_word()
{
  std::string text;
  for (const Choice<E>& choice : Choices<E>::all) text += (text.empty() ? "one of " : ", ") + std::string(choice.name);
  return text;
}

/// A struct: an object, and whatever else stands for it.
template <Described S>
std::string expected_struct()
{
  std::string text;
  if constexpr (WithShorthands<S>)
    for (const auto& shorthand : About<S>::shorthands) text += shorthand.bare == Bare::number ? "a number, " : "a string, ";
  return text.empty() ? "an object" : text.replace(text.size() - 2, 2, " or an object");
}

} // namespace nephroid::preset
