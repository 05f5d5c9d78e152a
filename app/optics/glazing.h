// SPDX-License-Identifier: Apache-2.0
// Glazings: what one to three panes with air between them reflect and let pass, by angle and wavelength. Panes are
// thick, so that light adds up without interference between their faces; thin films on a face interfere.
#pragma once
#include "optics/wavelength.h"

#include <span>
#include <variant>
#include <vector>

namespace nephroid::optics {

/// A thin layer, of the index n + i k.
struct Film {
  Spectrum n{}, k{};
  double thickness_nm = 0;
};

/// A pane by its glass. Its faces are by Fresnel's equations or, with films, by their characteristic matrices (Born and
/// Wolf, Principles of Optics, 1.6 and 14.4).
struct GlassPane {
  Spectrum n{};                  ///< 1 or more
  Spectrum passes{};             ///< the part that is left of light after the straight way through the glass, 0..1
  std::vector<Film> front, back; ///< on its faces, each from the front to the back
};

/// A pane by measurements straight on, each 0..1 with transmittance + reflectance <= 1.
///
/// Without a coating: by the index and absorption that would give the transmittance and the mean of both reflectances,
/// and then as GlassPane. With one: by the regressions of LBNL's WINDOW (Finlayson et al. 1993, LBL-33943; EnergyPlus,
/// Engineering Reference, "Angular properties for simple coated glass") on clear glass where the transmittance is above
/// 0.645 and on bronze glass elsewhere, scaled to be right straight on, alike in both polarisations.
struct MeasuredPane {
  Spectrum transmittance{}, front{}, back{};
  bool coated = true;
};

using Pane = std::variant<GlassPane, MeasuredPane>;

/// The parts of unpolarised light that pass, the same both ways, and that are reflected of light from each side.
struct GlazingParts {
  double passes = 1, front = 0, back = 0;
};

/// At the cosine 0..1 of the angle of incidence in air, in the cell `wavelength` of the range. Each polarisation goes
/// through all panes by itself, with all reflections between them.
GlazingParts glazing_parts(std::span<const Pane> panes, double cosine, std::size_t wavelength, SpectralRange range);

} // namespace nephroid::optics
