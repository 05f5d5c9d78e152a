// SPDX-License-Identifier: Apache-2.0
// Numerical self-checks on any device: closed forms of optics through the real kernels, and kernels against the host in
// double precision. What a person runs first on a new device, and what tests run on every device there is.
#pragma once
#include "compute/compute.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::check {

/// What one check gave: passed where |figure| <= tolerance.
struct Result {
  std::string name;  ///< Check::name
  double figure = 0; ///< a distance from the truth
  double tolerance = 0;
  std::string unit;   ///< of both: "pixels", "sigma", "quanta", ""
  std::string detail; ///< a sentence: what was compared with what
  bool passed() const { return figure <= tolerance && figure >= -tolerance; } // NaN: failed
};

/// Of a check that does not know its name.
inline Result judged(double figure, double tolerance, std::string unit, std::string detail) {
  return {{}, figure, tolerance, std::move(unit), std::move(detail)};
}

/// One check by name; run() takes a second or two at most and throws where the device fails.
struct Check {
  std::string name; ///< "SUBJECT: what holds"
  /// seed: of every random number in it. Results in sigma pass with every seed but one in ten million.
  std::function<Result(const compute::Context&, std::uint64_t seed)> run;
};

/// Those of what all engines share. engine/engine.h has every engine's own too.
std::vector<Check> checks();

/// The check's result under its name. Where the device or the kernels' compiler fails, the figure is NaN and the detail
/// says why, so that one broken kernel does not hide what the others do.
Result run_check(const Check& check, const compute::Context& context, std::uint64_t seed = 1);

using Checks = std::vector<Check>;

/// By subject, in the order in which they make sense: a device whose exp is wrong needs no look at its rays.
Checks arithmetic_checks(); ///< arithmetic.cpp: the device's own functions, in units in the last place
Checks exactness_checks();  ///< exactness.cpp: random numbers and sums, bit for bit
Checks geometry_checks();   ///< geometry.cpp: rays and triangles
Checks interface_checks();  ///< interfaces.cpp: Snell, Fresnel, nested media

} // namespace nephroid::check
