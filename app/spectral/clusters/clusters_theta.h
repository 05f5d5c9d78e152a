// SPDX-License-Identifier: Apache-2.0
// Theta, the change of the refraction angle from one wavelength to the next, integrated over the angle of incidence (thesis 4.4):
// once exactly, once by the thesis' bicubic patches.
#pragma once
#include <span>
#include <vector>

namespace nephroid::spectral {

/// The angles of incidence end at 89 degrees, where every index of refraction from 1 on still has a finite derivative.
inline constexpr int last_angle_deg = 89;

/// G(n), the integral over theta1 = 0..89 degrees of theta2 = asin(sin theta1 / n), in square degrees; n > 0.
double refraction_integral_deg2(double n);

/// n: falling, at least two. One value >= 0 in square degrees for each of the n.size() - 1 steps.
std::vector<double> theta_exact(std::span<const double> n);
/// The same by bicubic patches of 1 nm by 1 degree; exact where a patch would need a derivative at n < 1.
std::vector<double> theta_patches(std::span<const double> n);

} // namespace nephroid::spectral
