// SPDX-License-Identifier: Apache-2.0
#include "preset/preset.h"

namespace nephroid::preset {

double metres(Preset::Unit unit)
{
  switch (unit) {
  case Preset::Unit::mm:
    return 1e-3;
  case Preset::Unit::cm:
    return 1e-2;
  case Preset::Unit::m:
    break;
  }
  return 1;
}

} // namespace nephroid::preset
