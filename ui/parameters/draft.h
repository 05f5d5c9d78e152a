// SPDX-License-Identifier: Apache-2.0
// The preset while it is edited field by field: JSON that also holds what is impossible, until it is mended. What is
// possible becomes a preset; the rest waits with the line that says why. No Dear ImGui here.
#pragma once
#include "preset/json_text.h"
#include "preset/preset.h"

#include <nlohmann/json.hpp>

#include <variant>

namespace nephroid::ui {

using preset::Json;

/// Why an edit waits.
struct Problem {
  std::string pointer; ///< the edit's
  std::string place;   ///< what is wrong, mostly the same
  std::string text;    ///< the error's text, without its place
};

class Draft {
public:
  /// Called once a frame. Edits that wait are put over another preset of the same file where their places are there.
  void follow(const preset::Preset& preset);
  /// The preset as JSON, with the edits that wait.
  const Json& value() const { return value_; }
  const std::string& source() const { return preset_.source; }
  /// Keyed by the pointers of their edits.
  const std::map<std::string, Problem>& problems() const { return problems_; }

  /// Puts a value at a JSON pointer of the draft. Returns the preset that the reader made of it: with this edit and
  /// those that were waiting for it. Nothing where it has to wait itself.
  std::optional<preset::Preset> edit(const std::string& pointer, Json value);
  /// Why that edit would wait; changes nothing.
  std::optional<Problem> trial(const std::string& pointer, const Json& value) const;
  /// Takes back an edit that waits.
  void drop(const std::string& pointer);

private:
  using Edits = std::map<std::string, Json>; ///< values by their pointers, none inside of another
  enum class Reach { alone, siblings, all }; ///< which of the edits that wait may say one thing together
  void take(preset::Preset preset);
  Json with(const Edits& edits) const;
  Edits together(const std::string& pointer, Reach reach) const;
  std::optional<preset::Preset> settle(const std::string& pointer);
  std::variant<preset::Preset, Problem> read(const Edits& edits, const std::string& pointer) const;

  preset::Preset preset_; ///< as it is outside
  int frame_ = 0;         ///< of its animation, in which edits are keys
  Json base_, value_;     ///< that as JSON; with the edits that wait
  Edits waiting_;
  std::map<std::string, Problem> problems_;
};

/// The JSON pointer of a key or an index in the value at `pointer`.
std::string child_of(const std::string& pointer, std::string_view key);
/// A pointer as --set has it: "scene.lights.0.power_w".
std::string dotted(const std::string& pointer);
/// Whether `pointer` is `root` or inside of it.
bool is_inside(const std::string& pointer, const std::string& root);

} // namespace nephroid::ui
