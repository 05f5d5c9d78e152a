// SPDX-License-Identifier: Apache-2.0
// What is behind everything, infinitely far away, as a latitude-longitude picture.
#pragma once
#include "base/files.h"
#include "preset/preset.h"

#include <string>
#include <vector>

namespace nephroid::scene {

/// The texel of row r (0: at +y) and column c is seen in the directions of elevation 90 - 180 (r + .5) / height degrees and
/// azimuth 360 (c + .5) / width - 180 degrees, counted from -z to the right (+x), after `rotate_deg` turned all of it about +y to the left.
/// One texel: the same everywhere.
struct Environment {
  int width = 0, height = 0;
  std::vector<float> rgb; ///< linear sRGB, finite, not negative, 3 a texel
  double radiance = 1;    ///< Y in W m^-2 sr^-1 of the colour (1, 1, 1)
  double rotate_deg = 0;
  bool lights = false; ///< whether it is a light too; never where it is black

  /// Whether nothing of it can be seen.
  bool is_black() const;
};

/// Floats of a file are taken as linear, integers as sRGB-encoded; a grey picture is as good as one with colours.
/// Throws bad_input at the file for what is no such picture, naming the texel of a value that is NaN, infinite or negative, and
/// at `where` (FILE#/scene/environment) for a file that is not there. Values below 0 that are at most a thousandth of all light in sum
/// become 0. Appends to warnings where there are such, and where the picture's shape is not 2 : 1.
Environment make_environment(const preset::Environment& environment, const FileFinder& finder, const Place& where,
                             std::vector<std::string>& warnings);

} // namespace nephroid::scene
