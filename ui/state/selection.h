// SPDX-License-Identifier: Apache-2.0
// What a person has picked in the preset: the selected thing and the handles that move it, and the shown dielectric.
// Bookmarks of cameras belong to the window and not to the preset.
#pragma once
#include "preset/preset.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <cstddef>

namespace nephroid::ui {

struct Selection {
  enum class Kind { nothing, object, light, camera, environment };
  Kind kind = Kind::nothing;
  std::size_t index = 0; ///< an index into scene.objects or scene.lights; else 0
  bool operator==(const Selection&) const = default;
};

struct Handles {
  enum class Tool { move, turn, scale };
  Tool tool = Tool::move;
  bool own_axes = false; ///< moves along the axes of the selected thing; false: along those of the scene
  bool snap = false;     ///< moves in steps
  bool shown = true;     ///< over the picture, with the lights' icons
  bool operator==(const Handles&) const = default;
};

/// Whether the preset has a scene to select in; else it has a camera only.
bool has_scene(const preset::Preset& preset);
/// The selection, as far as the preset has it; else, and without a preset (null), nothing.
Selection in_preset(const Selection& selection, const preset::Preset* preset);
/// All that is selected by "Select the next": objects, lights, the camera; empty without a scene.
std::vector<Selection> selectable(const preset::Preset& preset);
/// "bunny", "object 2" where it has no name, "light 1 (spot)", "camera's target", "environment". The preset must have
/// it. Empty for nothing.
std::string name_of(const preset::Preset& preset, const Selection& selection);
/// The preset's unit of length as its file has it: "mm".
std::string unit_word(const preset::Preset& preset);
/// Where the fields of the selection are: "/scene/objects/0". Empty for nothing.
std::string pointer_of(const Selection& selection);

/// The wanted name, or the first of "NAME 2", "NAME 3", ... that is not taken(). pattern: of the numbered names.
template <class Taken>
std::string untaken_name(const std::string& wanted, Taken taken, const char* pattern = "{} {}") {
  std::string name = wanted;
  for (int number = 2; taken(name); ++number) name = fmt::format(fmt::runtime(pattern), wanted, number);
  return name;
}
/// Rounds to so many decimals; negative: to whole tens, hundreds. Gives the double nearest to that decimal number.
double rounded(double value, int decimals);
double with_digits(double value, int digits);
/// Rounds to a thousandth of a size, which is above 0.
preset::Vec3 rounded_place(const glm::dvec3& place, double size);

struct Bookmark {
  std::string name;
  preset::Camera camera;
  bool operator==(const Bookmark&) const = default;
};
/// "Prism 2": the preset's name and the first number that no bookmark has with it.
std::string new_bookmark_name(const preset::Preset& preset, const std::vector<Bookmark>& bookmarks);

/// The names of the dielectrics: first those of objects, in the order of the objects, then the others by name.
std::vector<std::string> dielectrics(const preset::Preset& preset);
/// The dielectric to show: `chosen` where the preset has it, else the first; empty where there is none.
std::string shown_dielectric(const preset::Preset& preset, const std::string& chosen);
/// Reads a dispersion from a refractiveindex.info file: a path, or the name of a shipped material ("N-SF66"), for a
/// preset from `preset_source`. Throws bad_input where it cannot be read or has no n at one of the 401 wavelengths.
preset::Dispersion load_dispersion(const std::string& file, const std::string& preset_source);

} // namespace nephroid::ui
