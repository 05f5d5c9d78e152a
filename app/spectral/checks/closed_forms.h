// SPDX-License-Identifier: Apache-2.0
// Closed forms of geometrical optics that checks and tests hold pictures against, in double precision.
#pragma once

namespace nephroid::check {

/// Of a plane-parallel plate in air, theta in radians, without absorption, all reflections inside added up. Of light that meets it R is
/// reflected at the first face; of the 1 - R that go in, 1 - R leave at the second face and R go back, and so on:
/// T = (1 - R)^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R).
double plate_transmittance(double theta, double n);

/// Light through a prism of apex angle 60 degrees, apex at +z, its cross section in (x, z) about the origin, n inside, 1 outside. It comes
/// from the left, `incidence` radians from the entry face's normal, towards that face's middle.
struct PrismPath {
  double from_x, from_z; ///< a point before the prism, 2 sides away from the face
  double direction_x, direction_z;
  double landing_x; ///< where the light meets the plane z = screen_z
};
PrismPath prism_path(double side, double incidence, double n, double screen_z);

/// Light along -z at x = height falls on a ball of the radius about the origin and, twice refracted, crosses the plane z = screen_z at the
/// x that is returned. screen_z <= -radius.
///
/// sin a = h / R, sin b = sin a / n. The light is turned by a - b at each of the two surfaces, d = 2 (a - b) in all, towards the axis. In
/// the triangle of the ball's centre, the exit and the crossing of the axis the angle at the crossing is d, and the ray passes the centre
/// at a distance of R sin a (the exit angle is a again): it crosses the axis at f = R sin a / sin d behind the centre. For h -> 0 that is
/// the paraxial focus n R / (2 (n - 1)).
double ball_lens_landing(double radius, double height, double n, double screen_z);

} // namespace nephroid::check
