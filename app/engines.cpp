// SPDX-License-Identifier: Apache-2.0
// The engines of the program: a line each.
#include "environment/engine.h"
#include "inverse/engine.h"
#include "spectral/engine.h"

namespace nephroid::engine {

const std::vector<const Engine*>& engines() {
  static const std::vector<const Engine*> all{
      &spectral::engine,
      &environment::engine,
      &inverse::engine,
  };
  return all;
}

} // namespace nephroid::engine
