// SPDX-License-Identifier: Apache-2.0
// Angles and frames.
#define PI_F 3.14159265358979f

// Two vectors that make an orthonormal frame with the unit vector n (Duff et al. 2017).
static inline void make_frame(float3 n, float3* x, float3* y) {
  const float sign = copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
  *x = (float3)(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  *y = (float3)(b, sign + n.y * n.y * a, -n.y);
}
