// SPDX-License-Identifier: Apache-2.0
// Presets and their parts, built without files: those of the checks, by their names alone.
#pragma once
#include "spectral/checks/scene_parts.h"

namespace nephroid::test {

using check::at;
using check::box;
using check::empty_preset;
using check::glass;
using check::line;
using check::object;
using check::pencil;
using check::quad;
using check::white;

} // namespace nephroid::test
