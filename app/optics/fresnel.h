// SPDX-License-Identifier: Apache-2.0
// Snell's law and Fresnel's equations at a smooth interface, in double precision: the truth that the kernels are tested against.
#pragma once
#include <optional>

namespace nephroid::optics {

/// sin(theta_t) = n_i / n_t sin(theta_i). cos_i in 0..1. Empty: total internal reflection.
std::optional<double> refracted_cosine(double cos_i, double n_i, double n_t);
/// Unpolarised reflectance 0..1; 1 at total internal reflection.
double fresnel_reflectance(double cos_i, double n_i, double n_t);

} // namespace nephroid::optics
