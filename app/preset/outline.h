// SPDX-License-Identifier: Apache-2.0
// The description of the preset (describe.h) as data: which fields a JSON value of it has, of what kind, with which default. The panel
// Parameters draws a preset from it, field by field, and names no field itself.
#pragma once
#include "preset/field.h"
#include "preset/json_text.h"

#include <string>
#include <vector>

namespace nephroid::preset {

/// One field.
struct Outline {
  /// numbers: a list of numbers; texts: of texts; table: rows of two numbers; list and map: of objects.
  enum class Kind { boolean, integer, number, text, word, numbers, texts, table, object, list, map };
  struct Word {
    std::string_view name, sentence;
  };

  Field field;
  Kind kind = Kind::object;
  bool chooses = false;    ///< a word that says which other fields its object has
  bool of_engine = false;  ///< settings of the engine of that name: they mean something where it is the preset's
  bool optional = false;   ///< may be null, and is by default
  bool whole = false;      ///< of numbers
  std::size_t size = 0;    ///< how many numbers a vector has; 0: a list of any length within field.count
  std::vector<Word> words; ///< of a word, all of them
  Json standard;           ///< the default; null of an object, whose fields have theirs
  /// A default-constructed one: of an optional what it holds, of a list or map one item, else the object. Null where there is no struct.
  Json (*fresh)() = nullptr;
  /// The fields of that struct as `object`, a JSON value of it, has them by its type.
  std::vector<Outline> (*fields)(const Json& object) = nullptr;
};

/// The fields of a preset.
std::vector<Outline> outline(const Json& preset);

/// `object` as another type of its struct. What both types have stays, the rest is by default. fields: of the struct. chooser: its field
/// that chooses the type, as the old type has it.
Json as_type(const Json& object, std::vector<Outline> (*fields)(const Json&), const Outline& chooser, std::string_view type);

/// What the field may be: "a number from 0 to 1 W", "one of point, spot".
std::string expected(const Outline& field);

} // namespace nephroid::preset
