// SPDX-License-Identifier: Apache-2.0
// The description of the preset (describe.h) as data: which fields a JSON value of it has, of what kind, with which
// default. The panel Parameters draws a preset from it, field by field, and names no field itself.
#pragma once
#include "preset/json_text.h"
#include "preset/value.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace nephroid::preset {

/// One field.
struct Outline {
  using Kind = preset::Kind; ///< never optional
  using Word = preset::Word;

  Field field;
  Kind kind = Kind::object;
  bool chooses = false;              ///< a word that says which other fields its object has
  bool is_engine_settings = false;   ///< settings of the engine of that name
  bool optional = false;             ///< may be null, and is by default
  bool whole = false;                ///< its numbers are
  std::size_t size = 0;              ///< how many numbers a vector has; 0: a list of any length within field.count
  std::vector<Word> words;           ///< all that a word may be
  Json standard;                     ///< the default; null of settings of another engine
  const ValueType* object = nullptr; ///< its own, or that of a list's or a map's items; null where there is no struct
  std::string expected;              ///< what the field may be: "a number from 0 to 1 W", "one of point, spot"

  /// A default-constructed `object`.
  Json fresh() const;
  /// The fields of `object` as a JSON value of it has them by its type.
  std::vector<Outline> fields(const Json& value) const;
};

/// The fields of a preset.
std::vector<Outline> outline(const Json& preset);

using OutlineOf = std::function<std::vector<Outline>(const Json& object)>;

/// `object` as another type of its struct. What both types have stays, the rest is by default. fields: of the struct.
/// chooser: its field that chooses the type, as the old type has it.
Json as_type(const Json& object, const OutlineOf& fields, const Outline& chooser, std::string_view type);

} // namespace nephroid::preset
