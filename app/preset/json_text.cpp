// SPDX-License-Identifier: Apache-2.0
#include "preset/json_text.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/json_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <set>
#include <vector>

namespace nephroid::preset {
namespace {

/// Builds the value from the parser's events: nlohmann's own builder lets the last of two equal keys win silently.
class Builder : public nlohmann::json_sax<Json> {
public:
  Builder(std::string_view text, const std::string& source) : text_(text), source_(source) {}
  Json take() { return std::move(root_); }

  bool null() override { return place(nullptr); }
  bool boolean(bool value) override { return place(value); }
  bool number_integer(number_integer_t value) override { return place(value); }
  bool number_unsigned(number_unsigned_t value) override { return place(value); }
  bool number_float(number_float_t value, const string_t&) override { return place(value); }
  bool string(string_t& value) override { return place(std::move(value)); }
  bool binary(binary_t&) override { return false; } // JSON text has none
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    const Location where(source_, child(level.pointer, name));
    if (!level.keys.insert(name).second)
      throw bad_input(where, fmt::format("key {} is given twice", in_quotes(name)), "expected each key once");
    if (level.keys.size() > max_keys)
      throw bad_input(where, "too many keys", fmt::format("expected at most {} in one object", max_keys));
    level.key = name;
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    const std::string_view before = text_.substr(0, std::min(position == 0 ? 0 : position - 1, text_.size()));
    const std::size_t line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1; // npos + 1 is 0: the first line
    throw bad_input({source_, line, column}, "is not JSON", reason(error.what()));
  }

private:
  struct Level {
    Json* value;
    std::string pointer;
    std::set<std::string> keys = {};
    std::string key = {};
  };

  /// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ...": the part that is not
  /// ours to say.
  static std::string reason(std::string what) {
    for (const char* start : {"] parse error at ", "] "})
      if (const std::size_t at = what.find(start); at != std::string::npos) {
        const std::size_t from = start[2] == 'p' ? what.find(": ", at) + 2 : at + 2;
        what = what.substr(from);
        break;
      }
    std::erase_if(what, [](unsigned char c) { return c < 0x20 || c >= 0x7f; });
    return what;
  }

  std::string next_pointer() const {
    if (levels_.empty()) return "";
    const Level& level = levels_.back();
    return level.value->is_object() ? child(level.pointer, level.key) : child(level.pointer, level.value->size());
  }

  Json* insert(Json&& value) {
    if (levels_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Level& level = levels_.back();
    if (level.value->is_array()) {
      level.value->push_back(std::move(value));
      return &level.value->back();
    }
    Json& slot = (*level.value)[level.key];
    slot = std::move(value);
    return &slot;
  }

  template <class T>
  bool place(T&& value) {
    insert(Json(std::forward<T>(value)));
    return true;
  }

  bool open(Json&& empty) {
    std::string pointer = next_pointer();
    if (levels_.size() >= max_depth)
      throw bad_input({source_, pointer}, fmt::format("is nested deeper than {} levels", max_depth));
    levels_.push_back({insert(std::move(empty)), std::move(pointer)});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& source_;
  Json root_;
  std::vector<Level> levels_; // pointers stay valid: a container is only added to while it is the innermost open one
};

bool is_plain(const Json& value) { return !value.is_structured(); }

void print(const Json& value, int indent, std::string& out) {
  if (is_plain(value) || value.empty()) {
    out += json_text(value);
    return;
  }
  if (value.is_array() && std::ranges::all_of(value, is_plain)) { // reads best on one line
    for (std::size_t i = 0; i < value.size(); ++i) out += (i == 0 ? "[" : ", ") + json_text(value[i]);
    out += "]";
    return;
  }
  const bool object = value.is_object();
  const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
  out += object ? "{" : "[";
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    out += first ? "\n" : ",\n";
    out += margin;
    if (object) out += json_text(Json(key)) + ": ";
    print(item, indent + 2, out);
    first = false;
  }
  out += fmt::format("\n{}{}", margin.substr(2), object ? "}" : "]");
}

std::string shortened(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most; // not inside a UTF-8 character
  return text.substr(0, most) + "...";
}

/// Escaped as in JSON, without its quotation marks: nothing unprintable is left, not even where the bytes are no UTF-8.
std::string printable(std::string_view text) {
  const std::string escaped = json_text(Json(std::string(text)));
  return escaped.substr(1, escaped.size() - 2);
}

/// [+-] digits [. digits] [e [+-] digits], with a digit before or after the point.
std::string json_number(const std::string& word) {
  constexpr std::size_t longest = 64; // that somebody types
  static const std::regex number(R"(([+-]?)([0-9]*)\.?([0-9]*)((?:[eE][+-]?[0-9]+)?))");
  std::smatch parts;
  if (word.size() > longest || !std::regex_match(word, parts, number)) return word;
  const std::string sign = parts[1], whole = parts[2], fraction = parts[3], power = parts[4];
  if (whole.empty() && fraction.empty()) return word;
  return fmt::format("{}{}{}{}{}", sign == "-" ? "-" : "", whole.empty() ? "0" : whole, fraction.empty() ? "" : ".",
                     fraction, power);
}

} // namespace

Json parse_json(std::string_view text, const std::string& source) {
  Builder builder(text, source);
  Json::sax_parse(text, &builder);
  return builder.take();
}

std::string with_json_numbers(std::string_view text) {
  constexpr std::string_view between = " \t\r\n,:[]{}";
  std::string all;
  while (!text.empty()) {
    std::size_t size = 1;
    if (text.front() == '"') {
      while (size < text.size() && text[size] != '"') size += text[size] == '\\' ? 2 : 1;
      size = std::min(size + 1, text.size());
      all += text.substr(0, size);
    } else if (between.find(text.front()) != std::string_view::npos) {
      all += text.front();
    } else {
      size = std::min(text.find_first_of(between), text.size());
      all += json_number(std::string(text.substr(0, size)));
    }
    text.remove_prefix(size);
  }
  return all;
}

bool is_utf8(std::string_view text) {
  try {
    static_cast<void>(Json(std::string(text)).dump()); // strict
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

std::string pretty(const Json& value) {
  std::string out;
  print(value, 0, out);
  return out;
}

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty list" : "a list of " + counted(value.size(), "item");
  if (value.is_string()) return "the string " + in_quotes(value.get_ref<const std::string&>());
  return json_text(value);
}

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", shortened(printable(text), 60)); }

std::string child(const std::string& pointer, std::string_view key) {
  return pointer + "/" + pointer_key(shortened(printable(key), 100));
}

std::string child(const std::string& pointer, std::size_t index) { return fmt::format("{}/{}", pointer, index); }

} // namespace nephroid::preset
