// SPDX-License-Identifier: Apache-2.0
// Intensities as the files that lighting programs read: IES (ANSI/IES LM-63-2002, type C) and EULUMDAT (Stockmar 1990).
// scene/photometry.h reads them.
#pragma once
#include <string>
#include <vector>

namespace nephroid::scene {

/// Candela by C and gamma.
struct LuminaireGrid {
  std::vector<double> gamma_deg; ///< from 0 to 90 or 180
  int planes = 0;                ///< in equal steps from C = 0, without 360
  std::vector<double> candela;   ///< [plane][gamma]
  double lumens = 0, watts = 0;
  double c_deg(int plane) const { return 360.0 * plane / planes; }
  double at(int plane, std::size_t gamma) const {
    return candela[static_cast<std::size_t>(plane % planes) * gamma_deg.size() + gamma];
  }
};

/// test, name: for people, one line each. C goes from 0 to 360.
std::string ies(const LuminaireGrid& grid, const std::string& test, const std::string& name);
/// The same as EULUMDAT, without symmetry: cd for 1,000 lm.
std::string eulumdat(const LuminaireGrid& grid, const std::string& test, const std::string& name);

} // namespace nephroid::scene
