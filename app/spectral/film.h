// SPDX-License-Identifier: Apache-2.0
// A film read back from the device: fixed-point XYZ sums turned into a layer of linear sRGB.
#pragma once
#include "job/job.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace nephroid::spectral {

/// sums: 3 a pixel, XYZ radiance in quanta, added up over samples. factor(row): what a sum of that row is multiplied with to give
/// XYZ radiance in W m^-2 sr^-1. white: the Y that becomes 1.
job::Layer develop(std::string name, std::span<const std::int64_t> sums, int width, const std::function<double(int row)>& factor,
                   double white);

} // namespace nephroid::spectral
