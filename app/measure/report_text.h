// SPDX-License-Identifier: Apache-2.0
// Text as a page needs it: escaped, and numbers as people read them.
#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace nephroid::measure {

template <class... Arguments>
void append(std::string& text, fmt::format_string<Arguments...> form, Arguments&&... arguments)
{
  fmt::format_to(std::back_inserter(text), form, std::forward<Arguments>(arguments)...);
}

/// What is no UTF-8 becomes U+FFFD.
std::string utf8(std::string_view text);
/// At most so many bytes of UTF-8, cut between characters, with "…" where something is missing.
std::string shortened(const std::string& text, std::size_t bytes);
/// For HTML's text and quoted attributes. Any bytes: what is no UTF-8 becomes U+FFFD, control characters become spaces.
std::string escaped(std::string_view text);
std::string base64(std::string_view bytes);

/// Three significant figures: "0.00123", "12.3", "1230".
std::string three_figures(double value);
/// "-0.5" with a minus sign instead of the hyphen.
std::string signed_text(double value, int decimals);
/// "1.23 s", "12 ms", "3 min 20 s", "2 h 05 min".
std::string readable_seconds(double seconds);
/// "262 thousand", "8.39 million".
std::string readable_count(double count);

} // namespace nephroid::measure
