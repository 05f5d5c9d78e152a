// SPDX-License-Identifier: Apache-2.0
// What a run may do without where its scene does not need it; omissions.h finds out where. A preset leaves out all of that or nothing.
// Tests turn one thing back on and show that the picture stays the same.
#pragma once

namespace nephroid::tracing {

struct LeaveOut {
  bool all = true;              ///< what the others are where nothing else is said
  bool direct = all;            ///< the layer "direct" where no surface is diffuse
  bool photons = all;           ///< photons where no object bends light or no surface is diffuse
  bool photon_maps = all;       ///< photon maps where the camera sees every diffuse surface directly
  bool stray_photons = all;     ///< photons that start towards anything but glass and mirrors
  bool unreached_targets = all; ///< for each light: glass and mirrors outside a spot's cone or behind an area light
  bool dark_lights = all;       ///< lights without power
  bool unlit_wavelengths = all; ///< wavelengths that no light has
  bool occlusion = all;         ///< the look from a caustic back to the camera where nothing can stand between them
  bool light_types = all;       ///< kernels without the code of types of light that the scene does not have
  bool mirrors = all;           ///< kernels without mirrors
  bool bending = all;           ///< kernels without Snell and Fresnel where all glass has n = 1
  bool attenuation = all;       ///< kernels without absorption where no glass absorbs and no mirror is coloured
  bool smooth_normals = all;    ///< kernels without interpolated normals
};

} // namespace nephroid::tracing
