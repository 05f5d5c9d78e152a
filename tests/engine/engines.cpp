// SPDX-License-Identifier: Apache-2.0
// app/engines.cpp with one line more.
#include "gradient.h"
#include "spectral/engine.h"

namespace nephroid::engine {

const std::vector<const Engine*>& engines() {
  static const std::vector<const Engine*> all{
      &spectral::engine,
      &gradient::engine,
  };
  return all;
}

} // namespace nephroid::engine
