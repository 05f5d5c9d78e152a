// SPDX-License-Identifier: Apache-2.0
// A goniometer's reading as a luminaire's file has it (scene/luminaire_files.h).
#pragma once
#include "meters/reading.h"
#include "scene/luminaire_files.h"

namespace nephroid::meters {

/// In steps of the meter's step_deg or less, which divide 90 degrees. Lumens are the reading's, and so are the watts:
/// of light, not of electricity.
scene::LuminaireGrid luminaire(const preset::Meter& meter, const scene::MeterSurface& goniometer,
                               const Reading& reading);

} // namespace nephroid::meters
