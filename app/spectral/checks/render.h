// SPDX-License-Identifier: Apache-2.0
// Small pictures by the real engine and its tables, for checks. Also functions with which checks and tests read values
// off a picture, and closed forms of geometrical optics in double precision.
#pragma once
#include "base/error.h"
#include "check/check.h"
#include "compute/compute.h"
#include "job/job.h"
#include "optics/colour.h"
#include "photons/energy.h"
#include "photons/tables/run_tables.h"
#include "preset/preset.h"

#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>

namespace nephroid::check {

inline constexpr double degree = std::numbers::pi / 180;

/// A run of engine 1 with the general kernels rather than those made for the scene: so all checks together build two
/// programs, which is most of their time on a device whose compiler has not seen them. Tests compare the two kinds.
/// leave_out decides on what is no kernel's code. change modifies the preset's scene, if there is one.
using ChangeScene = std::function<void(scene::Scene&)>;
std::unique_ptr<job::Job> general_job(const preset::Preset& preset, tracing::LeaveOut leave_out,
                                      const compute::Context& context, const ChangeScene& change = {});

/// Runs general_job to the preset's end.
job::Snapshot render(const preset::Preset& preset, const compute::Context& context, const ChangeScene& change = {});

/// The tables that the engine would render the preset with.
photons::RunTables device_tables(const preset::Preset& preset);

/// The layer of that name. Throws failed where it is missing.
inline const job::Layer& layer(const job::Snapshot& snapshot, std::string_view name) {
  for (const job::Layer& candidate : snapshot.picture->layers)
    if (candidate.name == name) return candidate;
  throw failed("check", "no layer " + std::string(name));
}

/// The luminance Y of a pixel of a layer; width is the picture's.
inline double luminance(const job::Layer& layer, int width, int row, int column) {
  const std::size_t i = 3 * static_cast<std::size_t>(row * width + column);
  return optics::linear_srgb_to_xyz({layer.rgb[i], layer.rgb[i + 1], layer.rgb[i + 2]})[1];
}

/// The transmittance of a plane-parallel plate in air, theta in radians, without absorption, with all reflections
/// inside added up. The first face reflects R of the light; of the 1 - R that go in, 1 - R leave at the second face and
/// R go back, and so on: T = (1 - R)^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R).
double plate_transmittance(double theta, double n);
/// The same of a pane without thickness, in which light keeps its polarisation: the mean of both polarisations' sums,
/// with Fresnel's r_s = sin(i - t) / sin(i + t) and r_p = tan(i - t) / tan(i + t).
double pane_transmittance(double theta, double n);

/// How far the fraction of the power of a pencil of one wavelength that reaches the floor below `p`'s objects is from
/// `truth` times `left`, the part that a photon keeps, in sigma of the count.
double z_of_transmitted(const compute::Context& context, preset::Preset p, double truth, double left = 1);

/// Light through a prism of apex angle 60 degrees, apex at +z, its cross section in (x, z) about the origin, n inside,
/// 1 outside. It comes from the left, `incidence` radians from the entry face's normal, towards that face's middle.
struct PrismPath {
  double from_x, from_z; ///< a point before the prism, 2 sides away from the face
  double direction_x, direction_z;
  double landing_x; ///< x where the light meets the plane z = screen_z
};
PrismPath prism_path(double side, double incidence, double n, double screen_z);

/// Light along -z at x = height falls on a ball of the radius about the origin. After two refractions it crosses the
/// plane z = screen_z at the returned x. screen_z <= -radius.
///
/// sin a = h / R, sin b = sin a / n. The light is turned by a - b at each of the two surfaces, d = 2 (a - b) in all,
/// towards the axis. In the triangle of the ball's centre, the exit and the crossing of the axis the angle at the
/// crossing is d, and the ray passes the centre at a distance of R sin a (the exit angle is a again): it crosses the
/// axis at f = R sin a / sin d behind the centre. For h -> 0 that is the paraxial focus n R / (2 (n - 1)).
double ball_lens_landing(double radius, double height, double n, double screen_z);

/// The checks of engine 1 by subject: its tables, its lights, and small pictures against closed forms.
Checks table_checks();      ///< tables.cpp: sums over wavelengths, absorption, what lights send
Checks radiometry_checks(); ///< radiometry.cpp: small pictures against closed forms of irradiance and power
Checks refraction_checks(); ///< refraction.cpp: plates, a prism and a ball lens
Checks material_checks();   ///< materials.cpp: metals, tinted glass, panes, coatings

} // namespace nephroid::check
