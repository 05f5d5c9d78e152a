// SPDX-License-Identifier: Apache-2.0
// Numerical self-checks on any device: closed forms of optics through the real kernels, and kernels against the host in double
// precision. What a person runs first on a new device, and what tests run on every device there is.
#pragma once
#include "compute/compute.h"

#include <functional>
#include <string>
#include <vector>

namespace nephroid::check {

/// What one check gave: passed where |figure| <= tolerance.
struct Result {
  std::string name;  ///< "prism: 9 wavelengths against Snell"
  double figure = 0; ///< a distance from the truth
  double tolerance = 0;
  std::string unit;                                                           ///< of both: "pixels", "sigma", "quanta", ""
  std::string detail;                                                         ///< a sentence: what was compared with what
  bool passed() const { return figure <= tolerance && figure >= -tolerance; } // NaN: failed
};

/// One check by name; run() takes a second or two at most and throws where the device fails.
struct Check {
  std::string name;
  std::function<Result(const compute::Context&)> run;
};

/// All of them, under 30 s together on two processor cores.
const std::vector<Check>& checks();

} // namespace nephroid::check
