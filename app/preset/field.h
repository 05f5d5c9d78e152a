// SPDX-License-Identifier: Apache-2.0
// What a description says about one field of a preset, about the words of an enumeration and about a whole struct: the
// vocabulary of describe.h. No JSON here: the editor needs the same facts.
#pragma once
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>

namespace nephroid::preset {

/// The numbers a field may hold, ends included unless said otherwise.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false, without_high = false;

  constexpr bool contain(double x) const {
    return (without_low ? x > low : x >= low) && (without_high ? x < high : x <= high);
  }
};
/// low <= x <= high.
constexpr Bounds within(double low, double high) { return {low, high, false, false}; }
/// low < x < high.
constexpr Bounds between(double low, double high) { return {low, high, true, true}; }

/// How many items a list or a table may have.
struct Count {
  std::size_t low = 0, high = std::numeric_limits<std::size_t>::max();
};

/// One column of a table of number pairs.
struct Column {
  std::string_view name, unit;
  Bounds bounds;
};

struct Columns {
  Column first, second;
  const Column& operator[](std::size_t i) const { return i == 0 ? first : second; }
};

/// text: anything. line: without line breaks and other control characters. file: the name of a file, looked up as
/// docs/presets.md says.
enum class Text { text, line, file };

/// What a text names. Whether such a thing exists is checked where the preset is used. metal, glass: a file with n and
/// k or with n, or a shipped material of the kind.
enum class Names { nothing, material, object, illuminant, patch, metal, glass };

/// One field. Its default is not here: it is what a default-constructed struct holds.
struct Field {
  std::string_view name = {};     ///< the key in JSON
  std::string_view sentence = {}; ///< for a person: the schema's description, the editor's tooltip
  std::string_view unit = {};     ///< as it reads after a number: "degrees", "nm"; empty for pure numbers
  Bounds bounds = {};             ///< each number's
  Count count = {};               ///< a list's items
  Columns columns = {};           ///< a table's pairs
  Text text = Text::text;
  Names names = Names::nothing;
  bool bare_number = false;        ///< a number stands for a list of one
  std::string_view none_word = {}; ///< what JSON has where there is no optional number, in place of null
  bool required = false;           ///< no default is sensible
};

/// One word of an enumeration. For a struct's type it introduces the fields that come with it.
template <class E>
struct Choice {
  E value;
  std::string_view name, sentence;
};

/// Every word of the enumeration E: an array of Choice<E>, specialised in choices.h.
template <class E>
inline constexpr int choices = 0;

template <class E>
concept Enumeration = std::is_enum_v<E>;

template <Enumeration E>
constexpr std::string_view word(E value) {
  for (const Choice<E>& choice : choices<E>)
    if (choice.value == value) return choice.name;
  return {};
}

// Shared by many fields; describe.h says why.
inline constexpr Bounds index_bounds = within(0.01, 100);
inline constexpr Bounds wavelength_bounds = within(1, 1e6);
inline constexpr Bounds coefficient_bounds = within(-1e6, 1e6);
inline constexpr Bounds position_bounds = within(-1e7, 1e7);
inline constexpr Bounds length_bounds = within(1e-6, 1e7);
inline constexpr Bounds power_bounds = within(0, 1e9);
inline constexpr Count term_count{1, 16};
inline constexpr std::size_t max_rows = 100000;
inline constexpr std::string_view length_unit = "length units";

} // namespace nephroid::preset
