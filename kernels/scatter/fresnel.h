// SPDX-License-Identifier: Apache-2.0
// Snell's law and Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 1.5).
// cos of the refraction angle from sin(theta_t) = eta sin(theta_i), eta = n_i / n_t; negative: total internal
// reflection. 1 - eta^2 (1 - cos_i^2) is a product of sums, which keeps its sign at the critical angle.
static inline float refracted_cosine(float cos_i, float eta) {
  const float sin_i = sqrt(fmax((1.0f - cos_i) * (1.0f + cos_i), 0.0f)); // a cosine is rounded, and may be above 1
  const float sin_t = eta * sin_i;
  const float cos2 = (1.0f - sin_t) * (1.0f + sin_t);
  return cos2 < 0.0f ? -1.0f : sqrt(cos2);
}

// The amplitudes that light polarised across the plane of incidence and in it keeps,
//   r_s = (n_i cos_i - n_t cos_t) / (n_i cos_i + n_t cos_t),  r_p = (n_t cos_i - n_i cos_t) / (n_t cos_i + n_i cos_t).
// cos_t from refracted_cosine, not negative.
static inline float2 fresnel_amplitudes(float cos_i, float cos_t, float n_i, float n_t) {
  return (float2)((n_i * cos_i - n_t * cos_t) / (n_i * cos_i + n_t * cos_t),
                  (n_t * cos_i - n_i * cos_t) / (n_t * cos_i + n_i * cos_t));
}

// Mean of the reflectances of both polarisations, squares of the amplitudes.
static inline float fresnel_reflectance(float cos_i, float cos_t, float n_i, float n_t) {
  const float2 r = fresnel_amplitudes(cos_i, cos_t, n_i, n_t);
  return 0.5f * (r.x * r.x + r.y * r.y);
}

// normal: unit, against the incoming direction; cos_i = -dot(direction, normal) >= 0.
static inline float3 reflect_about(float3 direction, float3 normal, float cos_i) {
  return direction + 2.0f * cos_i * normal;
}
static inline float3 refract_through(float3 direction, float3 normal, float cos_i, float cos_t, float eta) {
  return normalize(eta * direction + (eta * cos_i - cos_t) * normal);
}
