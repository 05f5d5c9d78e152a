// SPDX-License-Identifier: Apache-2.0
// How a preset's pictures are shown.
#pragma once
#include "image/display.h"

namespace nephroid::run {

/// What the preset's `display` asks for, with the white of its first lamp. Plain for an engine that is without it: what
/// its pictures show is compared as it is. Throws bad_input at that lamp's spectrum.
image::Display display_of(const preset::Preset& preset);

} // namespace nephroid::run
