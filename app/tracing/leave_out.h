// SPDX-License-Identifier: Apache-2.0
// What a run may do without where its scene does not need it; omissions.h finds out where. A preset leaves out all of that or nothing.
// Tests turn one thing back on and show that the picture stays the same.
#pragma once

namespace nephroid::tracing {

struct LeaveOut {
  bool direct = true;            ///< the layer "direct" where no surface is diffuse
  bool photons = true;           ///< photons where no object bends light or no surface is diffuse
  bool photon_maps = true;       ///< photon maps where the camera sees every diffuse surface directly
  bool stray_photons = true;     ///< photons that start towards anything but glass and mirrors
  bool unreached_targets = true; ///< for each light: glass and mirrors outside a spot's cone or behind an area light
  bool dark_lights = true;       ///< lights without power
  bool unlit_wavelengths = true; ///< wavelengths that no light has
  bool occlusion = true;         ///< the look from a caustic back to the camera where nothing can stand between them
  bool light_types = true;       ///< kernels without the code of types of light that the scene does not have
  bool mirrors = true;           ///< kernels without mirrors
  bool bending = true;           ///< kernels without Snell and Fresnel where all glass has n = 1
  bool attenuation = true;       ///< kernels without absorption where no glass absorbs and no mirror is coloured
  bool smooth_normals = true;    ///< kernels without interpolated normals
};

constexpr LeaveOut leave_out_all(bool leaves)
{
  return {leaves, leaves, leaves, leaves, leaves, leaves, leaves, leaves, leaves, leaves, leaves, leaves, leaves};
}

} // namespace nephroid::tracing
