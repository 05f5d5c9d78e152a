// SPDX-License-Identifier: Apache-2.0
#include "inverse/method.h"

#include "inverse/assign/assignment.h"
#include "inverse/lens/lens.h"
#include "inverse/settings.h"
#include "inverse/thesis/pipeline.h"

namespace nephroid::inverse {

std::unique_ptr<Method> make_method(const preset::Preset& preset, const Layout& layout,
                                    const std::vector<Target>& targets, const mpi::RankContext& context) {
  const Settings& s = settings(preset);
  if (s.method == Settings::Method::thesis) return std::make_unique<Pipeline>(layout, targets, s.thesis, preset.seed);
  if (s.method == Settings::Method::lens)
    return std::make_unique<Lens>(layout, targets.front(), s.mesh_error, Place(preset.source) / "inverse");
  return std::make_unique<Assignment>(context, layout, targets, preset.seed);
}

} // namespace nephroid::inverse
