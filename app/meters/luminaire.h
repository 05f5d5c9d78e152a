// SPDX-License-Identifier: Apache-2.0
// A goniometer's reading as the files that lighting programs read: IES (ANSI/IES LM-63-2002, type C) and EULUMDAT
// (Stockmar 1990). scene/photometry.h reads them.
#pragma once
#include "meters/reading.h"

#include <string>

namespace nephroid::meters {

/// name: for people, one line. In steps of the meter's step_deg or less, which divide 90 degrees; C from 0 to 360.
/// Lumens are the reading's, and so are the watts: of light, not of electricity.
std::string ies(const preset::Meter& meter, const scene::MeterSurface& goniometer, const Reading& reading,
                const std::string& name);
/// The same as EULUMDAT, without symmetry: cd for 1,000 lm.
std::string eulumdat(const preset::Meter& meter, const scene::MeterSurface& goniometer, const Reading& reading,
                     const std::string& name);

} // namespace nephroid::meters
