// SPDX-License-Identifier: Apache-2.0
// Numerical self-checks on any device: closed forms of optics through the real kernels, and kernels against the host in
// double precision. What a person runs first on a new device, and what tests run on every device there is.
#pragma once
#include "compute/compute.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::check {

/// The result of one check: passed if |figure| <= tolerance.
struct Result {
  std::string name;  ///< Check::name
  double figure = 0; ///< a distance from the truth
  double tolerance = 0;
  std::string unit;   ///< unit of figure and tolerance: "pixels", "sigma", "quanta", ""
  std::string detail; ///< a sentence: what was compared with what
  bool passed() const { return figure <= tolerance && figure >= -tolerance; } // NaN fails
};

inline Result judged(double figure, double tolerance, std::string unit, std::string detail) {
  return {{}, figure, tolerance, std::move(unit), std::move(detail)};
}

/// The error of larger size; NaN where either is.
inline double worse(double worst, double error) {
  return std::isnan(worst) || std::abs(error) <= std::abs(worst) ? worst : error;
}

/// One check by name; run() takes a second or two at most and throws where the device fails.
struct Check {
  std::string name; ///< "SUBJECT: what holds"
  /// seed: seeds every random number of the check. With results in sigma, one seed in ten million fails.
  std::function<Result(const compute::Context&, std::uint64_t seed)> run;
};

/// The checks of what all engines share. engine/engine.h adds every engine's own.
std::vector<Check> checks();

/// The check's result under its name. If the device or the kernels' compiler fails, the figure is NaN and the detail
/// gives the reason, so that one broken kernel does not hide the other results.
Result run_check(const Check& check, const compute::Context& context, std::uint64_t seed = 1);

using Checks = std::vector<Check>;

/// By subject, basic ones first: if exp is wrong on a device, its rays need no check.
Checks arithmetic_checks(); ///< arithmetic.cpp: the device's own functions, in units in the last place
Checks exactness_checks();  ///< exactness.cpp: random numbers and sums, bit for bit
Checks geometry_checks();   ///< geometry.cpp: rays and triangles
Checks interface_checks();  ///< interfaces.cpp: Snell, Fresnel, metals, coatings, nested media
Checks roughness_checks();  ///< roughness.cpp: microfacets

} // namespace nephroid::check
