// SPDX-License-Identifier: Apache-2.0
// Who gave each value of a preset: its file, one of the file's parents, a sweep, an override. Messages name them.
#pragma once
#include "base/error.h"
#include "preset/preset.h"

#include <filesystem>

namespace nephroid::preset {

/// Who gave a value: a file, or something in it or on the command line that has a name of its own.
struct Origin {
  Location place;               ///< the file, or "--set a.b=c", or FILE#/sweep/seed/0
  bool is_file = true;          ///< then the value is at its own pointer in it
  std::filesystem::path folder; ///< where the file names in the value are looked up first
  bool is_typed = false;        ///< on a command line: file names are looked up in the current folder before that
};

/// Who gave the value at each JSON pointer of a preset. A value has the origin of what is around it unless it has one
/// of its own.
class Origins {
public:
  explicit Origins(Origin main);

  /// The file that was asked for, at the end of its chain of parents.
  const Origin& main() const { return *main_; }
  /// Who gave the value at pointer.
  const Origin& at(const std::string& pointer) const { return *shared_at(pointer); }
  /// For messages: FILE#/pointer or "--set a.b=c"; its Location::field is the pointer.
  Location where(const std::string& pointer) const;

  using Shared = std::shared_ptr<const Origin>;
  Shared shared_at(const std::string& pointer) const;
  void set_main(Shared origin) { main_ = std::move(origin); }
  /// Sets the origin of the value at pointer alone: what is inside it keeps the origin that it has of its own.
  void set(const std::string& pointer, Shared origin) { of_[pointer] = std::move(origin); }
  /// The same where the value has none of its own.
  void set_if_none(const std::string& pointer, Shared origin) { of_.try_emplace(pointer, std::move(origin)); }
  /// Sets the origin of the value and of all that is inside it.
  void set_whole(const std::string& pointer, Shared origin);

private:
  Shared main_;
  std::map<std::string, Shared> of_;
};

/// For a value that was changed after the preset was read: says who gave it, by a `name` such as an option of the
/// command line.
void set_origin(Preset& preset, const std::string& pointer, const std::string& name);

/// JSON pointer of the preset's field that an error at this place is about, whoever gave its value; empty where it is
/// about none.
std::string field_of(const Preset& preset, const Location& place);

/// Throws the error that is being caught, in a form that a person can use. An error at a value of preset.source names
/// who gave that value, unless the preset has been saved as another file since it was read. An error about a run of a
/// sweep says which run, unless it stands at one of the swept values.
[[noreturn]] void rethrow_at_origin(const Preset& preset, const Error& error);

/// Returns what work() returns. What it throws goes through rethrow_at_origin. To be put once around all that works on
/// one preset.
template <class Work>
auto at_origins(const Preset& preset, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    rethrow_at_origin(preset, error);
  }
}

} // namespace nephroid::preset
