// SPDX-License-Identifier: Apache-2.0
// The engines of the program: a line each.
#include "spectral/engine.h"

namespace nephroid::engine {

const std::vector<const Engine*>& engines()
{
  static const std::vector<const Engine*> all{
      &spectral::engine,
  };
  return all;
}

} // namespace nephroid::engine
