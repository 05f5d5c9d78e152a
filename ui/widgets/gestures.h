// SPDX-License-Identifier: Apache-2.0
// Numbers for the gestures of one panel. UndoStack makes one entry of the edits that have one number, so no two panels may have the same.
#pragma once
#include <cstdint>
#include <functional>
#include <string_view>

namespace nephroid::ui {

class Gestures {
public:
  /// panel: its name, which is no other panel's.
  explicit Gestures(std::string_view panel) : number_(std::uint64_t{std::hash<std::string_view>{}(panel)} << 32) {}
  /// A new gesture; returns its number, which is not 0.
  std::uint64_t begin() { return ++number_; }
  /// Of the newest one.
  std::uint64_t number() const { return number_; }

private:
  std::uint64_t number_; ///< the panel above, the count below
};

} // namespace nephroid::ui
