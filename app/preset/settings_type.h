// SPDX-License-Identifier: Apache-2.0
// Settings of an engine made from its struct's description: settings_type<S>() is how an engine tells the preset what
// its section holds.
#pragma once
#include "base/location.h"
#include "preset/json_text.h"
#include "preset/settings.h"
#include "preset/value.h"

#include <algorithm>
#include <functional>
#include <span>

namespace nephroid::preset {

struct Preset;

/// Where a JSON pointer's value came from, for messages.
using Where = std::function<Location(const std::string& pointer)>;

struct SettingsType {
  std::string_view name;     ///< the engine's: the word in "engine" and the key of the section
  std::string_view sentence; ///< what the engine is for
  /// What one field cannot say alone, of a preset with these settings. Throws bad_input at where(pointer) of the first
  /// contradiction.
  void (*check)(const Preset& preset, const Where& where);
  /// What presets of this engine have not, though those of others have it, as --set names it: it goes where a preset's
  /// engine changes.
  std::span<const std::string_view> without;

  const ValueType& (*section)();   ///< the struct's type
  const ValueType& (*recipe)();    ///< the type of a std::optional<Settings>, as far as it holds these
  void* (*of)(Settings& settings); ///< the struct that settings hold; null: that of another engine
  std::any (*make)();
  bool (*equal)(const std::any& a, const std::any& b);
};

/// Whether `white` changes anything of the preset's pictures. Inverse ones are as bright as what is wanted.
bool has_white(const Preset& preset);

template <class S>
void* settings_struct(Settings& settings) {
  return std::any_cast<S>(&settings.value());
}

template <class S>
const ValueType& recipe_type() {
  using Optional = std::optional<Settings>;
  static const ValueType type{
      .kind = Kind::optional,
      .item = &type_of<S>(),
      .count = [](const void* recipe) -> std::size_t {
        const auto& settings = *static_cast<const Optional*>(recipe);
        return settings && settings->type().section == type_of<S> ? 1 : 0;
      },
      .resize =
          [](void* recipe, std::size_t count) {
            static_cast<Optional*>(recipe)->reset();
            if (count == 0) return;
            const auto& types = settings_types();
            static_cast<Optional*>(recipe)->emplace(**std::find_if(
                types.begin(), types.end(), [](const SettingsType* t) { return t->section == type_of<S>; }));
          },
      .at = [](void* recipe, std::size_t) { return settings_struct<S>(**static_cast<Optional*>(recipe)); }};
  return type;
}

/// S: described (describe.h).
template <class S>
constexpr SettingsType settings_type(std::string_view name, std::string_view sentence,
                                     void (*check)(const Preset&, const Where&),
                                     std::span<const std::string_view> without = {}) {
  return {.name = name,
          .sentence = sentence,
          .check = check,
          .without = without,
          .section = type_of<S>,
          .recipe = recipe_type<S>,
          .of = settings_struct<S>,
          .make = [] { return std::any(S{}); },
          .equal = [](const std::any& a,
                      const std::any& b) { return std::any_cast<const S&>(a) == std::any_cast<const S&>(b); }};
}

} // namespace nephroid::preset
