// SPDX-License-Identifier: Apache-2.0
// A scene to begin with, one an engine: small, complete, and in no file, so that saving asks for a name.
#pragma once
#include "preset/preset.h"

namespace nephroid::ui {

enum class NewScene { spectral, environment, inverse };

/// What is drawn at once by that engine.
preset::Preset new_scene(NewScene kind);

} // namespace nephroid::ui
