// SPDX-License-Identifier: Apache-2.0
// Clusters of wavelengths as text and as nanometres.
#pragma once
#include <string>
#include <vector>

namespace nephroid::cli {

/// indices (both): 0..400, in any order.
std::vector<int> wavelengths_nm(const std::vector<int>& indices);
/// "380-384,390 nm": runs of neighbouring wavelengths, by rising wavelength.
std::string wavelength_runs(const std::vector<int>& indices);

} // namespace nephroid::cli
