// SPDX-License-Identifier: Apache-2.0
// The settings of engine 1 described for visitors: describe.h says what a visitor is.
#pragma once
#include "preset/choices.h"
#include "preset/describe_limits.h"
#include "preset/field.h"
#include "preset/preset.h"

namespace nephroid::preset {

template <class V, Is<LeaveOut> S>
void describe(V& v, S& s)
{
  v.field({.name = "direct", .sentence = "Leave out the layer \"direct\" where no surface is diffuse."}, s.direct);
  v.field({.name = "photons", .sentence = "Leave out photons where no object bends light or no surface is diffuse."}, s.photons);
  v.field({.name = "photon_maps", .sentence = "Leave out photon maps where the camera sees every diffuse surface directly."},
          s.photon_maps);
  v.field({.name = "stray_photons", .sentence = "Leave out photons that start towards anything but glass and mirrors."}, s.stray_photons);
  v.field({.name = "unreached_targets",
           .sentence = "Leave out, for each light, glass and mirrors that are outside a spot's cone or behind an area light."},
          s.unreached_targets);
  v.field({.name = "dark_lights", .sentence = "Leave out lights without power."}, s.dark_lights);
  v.field({.name = "unlit_wavelengths", .sentence = "Leave out wavelengths that no light has."}, s.unlit_wavelengths);
  v.field({.name = "occlusion", .sentence = "Leave out the look from a caustic back to the camera where nothing can stand between them."},
          s.occlusion);
  v.field({.name = "light_types", .sentence = "Leave out the code of types of light that the scene does not have."}, s.light_types);
  v.field({.name = "mirrors", .sentence = "Leave out the code of mirrors where there is none."}, s.mirrors);
  v.field({.name = "bending", .sentence = "Leave out the code of Snell and Fresnel where all glass has n = 1."}, s.bending);
  v.field({.name = "attenuation", .sentence = "Leave out the code of absorption where no glass absorbs and no mirror is coloured."},
          s.attenuation);
  v.field({.name = "smooth_normals", .sentence = "Leave out the code of interpolated normals where every object is faceted."},
          s.smooth_normals);
}

template <class V, Is<Importance> S>
void describe(V& v, S& i)
{
  v.field({.name = "cluster", .sentence = "Which of its wavelengths speaks for a cluster."}, i.cluster);
  v.field({.name = "geometry", .sentence = "Weigh materials by how much of them the caustic objects see."}, i.geometry);
}

template <class V, Is<Sppm> S>
void describe(V& v, S& s)
{
  v.field({.name = "radius",
           .sentence = "Radius of the first pass; without, what the camera's pixels suggest.",
           .unit = length_unit,
           .bounds = length_bounds},
          s.radius);
  v.field({.name = "alpha",
           .sentence = "Part of each pass's photons that is kept: the radius shrinks the faster the smaller it is.",
           .bounds = between(0, 1)},
          s.alpha);
}

template <class V, Is<Spectral> S>
void describe(V& v, S& s)
{
  v.field({.name = "method", .sentence = "How wavelengths are put into clusters that share a path."}, s.method);
  v.field({.name = "threshold_deg",
           .sentence = "Largest change of the refraction angle inside a cluster.",
           .unit = "degrees",
           .bounds = between(0, 90)},
          s.threshold_deg);
  v.field({.name = "step_nm",
           .sentence = "Of the method brute_force: neighbouring wavelengths that share a path all the same.",
           .unit = "nm",
           .bounds = within(1, 401)},
          s.step_nm);
  v.field({.name = "estimator", .sentence = "How caustics are estimated."}, s.estimator);
  v.field({.name = "effort", .sentence = "How the work is dealt to the clusters."}, s.effort);
  v.field({.name = "importance", .sentence = "How much a wavelength matters, where `effort` asks for it."}, s.importance);
  v.field({.name = "jitter",
           .sentence = "Each path takes one wavelength of its cluster, so that clusters leave no bias; with photon maps those of a pass "
                       "share few."},
          s.jitter);
  v.field({.name = "low_discrepancy", .sentence = "Photons leave the lights by a scrambled Sobol sequence."}, s.low_discrepancy);
  v.field({.name = "differentials", .sentence = "A splat is stretched along the way that it moves with wavelength."}, s.differentials);
  v.field(
      {.name = "smoothing",
       .sentence =
           "Spread caustics over up to 6 pixels around, until their noise is a quarter of them. Needs measure.estimate; not with sppm."},
      s.smoothing);
  v.field({.name = "relight", .sentence = "Keep a layer for each cluster, so that the spectrum of a light can change without a new run."},
          s.relight);
  v.field({.name = "photons_per_pass",
           .sentence = "Photons sent towards the caustic objects in one pass; of the estimator sppm, for each cluster.",
           .bounds = within(1, 1 << 24)},
          s.photons_per_pass);
  v.field({.name = "indirect_photons_per_pass", .sentence = "Photons of the layer \"indirect\" in one pass.", .bounds = within(1, 1 << 24)},
          s.indirect_photons_per_pass);
  v.field({.name = "pixel_samples",
           .sentence = "Samples a pixel of the layer \"direct\", one a pass until there are so many.",
           .bounds = within(1, 1 << 20)},
          s.pixel_samples);
  v.field({.name = "max_surfaces", .sentence = "Interfaces a path may meet before it counts as lost.", .bounds = within(1, 1024)},
          s.max_surfaces);
  v.field({.name = "sppm", .sentence = "Progressive photon mapping."}, s.sppm);
  v.field({.name = "direct", .sentence = "Compute the layer \"direct\": light that reaches a diffuse surface unbent."}, s.direct);
  v.field({.name = "caustic", .sentence = "Compute the layer \"caustic\": light that met glass or a mirror, then one diffuse surface."},
          s.caustic);
  v.field({.name = "indirect", .sentence = "Compute the layer \"indirect\": light that met a diffuse surface before the last one."},
          s.indirect);
  v.field({.name = "background", .sentence = "Compute the layer \"background\": the environment, seen directly and through glass."},
          s.background);
  v.field({.name = "leave_out", .sentence = "What to leave out where the scene does not need it."}, s.leave_out);
}

} // namespace nephroid::preset
