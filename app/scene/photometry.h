// SPDX-License-Identifier: Apache-2.0
// How a luminaire spreads its light over directions, as IES files (ANSI/IES LM-63-1986 to -2019) and EULUMDAT files
// (Stockmar 1990) have it. What they say of watts and ballasts is not read.
#pragma once
#include <filesystem>
#include <vector>

namespace nephroid::scene {

/// Luminous intensity in C planes: gamma is 0 straight down and 180 degrees straight up, C goes counterclockwise as
/// seen from above.
struct Photometry {
  std::filesystem::path file;
  std::vector<double> gamma_deg; ///< rising, within 0..180; outside of them there is no light
  std::vector<double> c_deg; ///< rising, from 0 or less to 360 or more: the file's planes and what its symmetry says
  std::vector<double> intensity; ///< [c][gamma], of any unit; not negative, not all 0
  double lumens = 0; ///< what the file's candela add up to; 0: EULUMDAT with several sets of lamps, or none of lumens
};

/// Types A and B of IES become C planes in steps of half a degree of gamma and a degree of C. Type A is about the same
/// vertical as C; what it is aimed at is at gamma = 90, C = 0. Of type B vertical and horizontal 0 is straight down.
/// Throws bad_input at the file (with its line where there is one): not readable, larger than 16 MiB, neither kind of
/// file, cut short, angles that do not rise or are out of range, an intensity that is negative or not finite, no light
/// at all.
Photometry load_photometry(const std::filesystem::path& file);

/// Linear in gamma and C between the file's directions. gamma_deg: 0..180; c_deg: 0..360.
double intensity(const Photometry& photometry, double gamma_deg, double c_deg);

} // namespace nephroid::scene
