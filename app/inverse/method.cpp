// SPDX-License-Identifier: Apache-2.0
#include "inverse/method.h"

#include "inverse/assign/assignment.h"
#include "inverse/lens/lens.h"
#include "inverse/thesis/pipeline.h"

namespace nephroid::inverse {

std::unique_ptr<Method> make_method(const Settings& settings, const Layout& layout, const std::vector<Target>& targets, std::uint64_t seed)
{
  if (settings.method == Settings::Method::thesis) return std::make_unique<Pipeline>(layout, targets, settings.thesis, seed);
  if (settings.method == Settings::Method::lens) return std::make_unique<Lens>(layout, targets.front());
  return std::make_unique<Assignment>(layout, targets, seed);
}

} // namespace nephroid::inverse
