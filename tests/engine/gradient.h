// SPDX-License-Identifier: Apache-2.0
// The smallest engine: a picture that gets brighter from left to right, with noise of a known size. It proves that an
// engine is one folder and one line; tests/engine/engines.cpp has the line.
#pragma once
#include "engine/engine.h"

namespace nephroid::gradient {

struct Settings {
  double level = 1;          ///< of the rightmost pixels, white being 1
  double noise = 0.1;        ///< standard deviation of one sample of a pixel
  int samples_per_pass = 16; ///< of every pixel
  bool operator==(const Settings&) const = default;
};

extern const engine::Engine engine;

} // namespace nephroid::gradient
