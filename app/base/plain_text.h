// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace nephroid {

/// A text of any system with lines that end in '\n', where it may have "\r\n" or, from old Macs, '\r'. Of UTF-16 what
/// is ASCII is right.
inline std::string plain_text(std::string text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    text.erase(0, 2);
    std::erase(text, '\0');
  }
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r')
      plain += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      plain += '\n';
  return plain;
}

} // namespace nephroid
