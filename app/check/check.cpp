// SPDX-License-Identifier: Apache-2.0
#include "check/check.h"

#include <limits>

namespace nephroid::check {

std::vector<Check> checks() {
  std::vector<Check> list;
  for (const auto subject : {arithmetic_checks, exactness_checks, geometry_checks, interface_checks, roughness_checks})
    for (Check& check : subject()) list.push_back(std::move(check));
  return list;
}

Result run_check(const Check& check, const compute::Context& context, std::uint64_t seed) {
  Result result;
  try {
    result = check.run(context, seed);
  } catch (const Error& error) {
    result.figure = std::numeric_limits<double>::quiet_NaN();
    result.detail = error.line();
  }
  result.name = check.name;
  return result;
}

} // namespace nephroid::check
