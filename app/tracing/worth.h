// SPDX-License-Identifier: Apache-2.0
// What light is worth, where paths are dealt to lights, clusters or wavelengths and nothing has been measured.
#pragma once

namespace nephroid::tracing {

/// seen: what the eye makes of it, (X + Y + Z) / 3. power: a twentieth of it counts too, so that what the eye hardly sees is still seen.
constexpr double worth(double seen, double power) { return seen + 0.05 * power; }

} // namespace nephroid::tracing
