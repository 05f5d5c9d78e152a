// SPDX-License-Identifier: Apache-2.0
#include "measure/report_text.h"

#include "base/json_output.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::measure {

/// Through JSON, whose writer replaces what is no UTF-8.
std::string utf8(std::string_view text) { return nlohmann::ordered_json::parse(json_text(std::string(text))).get<std::string>(); }

std::string shortened(const std::string& text, std::size_t bytes)
{
  if (text.size() <= bytes) return text;
  std::size_t end = bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end; // the later bytes of a character are 10xxxxxx
  return text.substr(0, end) + "…";
}

std::string escaped(std::string_view text)
{
  std::string result;
  for (const char c : utf8(text)) switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    case '\'':
      result += "&#39;";
      break;
    default:
      result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  return result;
}

std::string base64(std::string_view bytes)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u; };
    const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k) text += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string three_figures(double value)
{
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const std::string scientific = fmt::format("{:.2e}", value); // rounded, so that its exponent is that of what is shown
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  if (exponent < -4 || exponent > 8) return scientific;
  const double rounded = std::stod(scientific);
  return fmt::format("{:.{}f}", rounded, std::max(2 - exponent, 0));
}

std::string signed_text(double value, int decimals)
{
  std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string readable_seconds(double seconds)
{
  if (seconds < 0.1) return three_figures(seconds * 1000) + " ms";
  if (seconds < 99.95) return three_figures(seconds) + " s";
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string readable_count(double count)
{
  if (count >= 1e9) return three_figures(count * 1e-9) + " billion";
  if (count >= 1e6) return three_figures(count * 1e-6) + " million";
  if (count >= 1e4) return three_figures(count * 1e-3) + " thousand";
  return fmt::format("{}", count);
}

} // namespace nephroid::measure
