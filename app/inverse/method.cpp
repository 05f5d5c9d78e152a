// SPDX-License-Identifier: Apache-2.0
#include "inverse/method.h"

#include "inverse/assign/assignment.h"

namespace nephroid::inverse {

std::unique_ptr<Method> make_method(const Settings& settings, const Layout& layout, const std::vector<Target>& targets, std::uint64_t seed)
{
  switch (settings.method) {
  case Settings::Method::assign:
    break;
  }
  return std::make_unique<Assignment>(layout, targets, seed);
}

} // namespace nephroid::inverse
