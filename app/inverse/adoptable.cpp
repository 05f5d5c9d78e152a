// SPDX-License-Identifier: Apache-2.0
#include "inverse/engine.h"

namespace nephroid::inverse {

bool adoptable(const preset::Preset& before, const preset::Preset& now)
{
  if (settings(before).receivers.size() != settings(now).receivers.size()) return false;
  preset::Preset same = now;
  same.name = before.name;
  same.description = before.description;
  same.scene.camera = before.scene.camera;
  if (settings(before).method == Settings::Method::assign) {
    same.stop = before.stop;
    settings(same).receivers = settings(before).receivers;
  }
  return same == before;
}

} // namespace nephroid::inverse
