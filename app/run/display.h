// SPDX-License-Identifier: Apache-2.0
// How a preset's pictures are shown.
#pragma once
#include "image/display.h"

namespace nephroid::run {

/// Whether presets of its engine have a `display`. What the pictures of others show is compared as it is.
bool has_display(const preset::Preset& preset);

/// What the preset's `display` asks for, with the white of its first lamp; plain where it has none. Throws bad_input at
/// that lamp's spectrum, and at `white_balance` where no display has the lamp's colour.
image::Display display_of(const preset::Preset& preset);

} // namespace nephroid::run
