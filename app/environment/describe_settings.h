// SPDX-License-Identifier: Apache-2.0
// The settings of engine 2 as preset/describe.h says.
#pragma once
#include "environment/settings.h"
#include "preset/value.h"

namespace nephroid::preset {

template <>
inline constexpr Choice<environment::Settings::Radii> choices<environment::Settings::Radii>[] = {
    {environment::Settings::Radii::quadratic, "quadratic",
     "Close together near the object, where caustics change most: (3.1) of the thesis."},
    {environment::Settings::Radii::uniform, "uniform", "All as far apart."}};

template <>
inline constexpr Choice<environment::SegmentMethod> choices<environment::SegmentMethod>[] = {
    {environment::SegmentMethod::variance, "variance",
     "The region with most variance is cut where least is left (Viriyothai and Debevec 2009)."},
    {environment::SegmentMethod::thesis, "thesis",
     "The brightest region is cut into halves of equal light (Algorithm 3.3)."}};

template <>
inline constexpr Choice<environment::SegmentWeights> choices<environment::SegmentWeights>[] = {
    {environment::SegmentWeights::solid_angle, "solid_angle", "A texel of the cube counts as much as its solid angle."},
    {environment::SegmentWeights::texel, "texel", "All texels count alike, as printed in the thesis."}};

template <>
inline constexpr Choice<environment::Settings::Occlusion> choices<environment::Settings::Occlusion>[] = {
    {environment::Settings::Occlusion::surface, "surface",
     "From points all over the object; the light then comes from the middle of what is seen."},
    {environment::Settings::Occlusion::thesis, "thesis",
     "From the object's middle; the light keeps its direction (Algorithm 3.4)."}};

template <>
inline constexpr Choice<environment::Settings::Phase> choices<environment::Settings::Phase>[] = {
    {environment::Settings::Phase::henyey_greenstein, "henyey_greenstein", "By 'anisotropy', as mist and smoke do."},
    {environment::Settings::Phase::rayleigh, "rayleigh",
     "As clear air does: as much back as on, half of that to the sides."}};

} // namespace nephroid::preset

namespace nephroid::environment {

inline void describe(preset::Fields& v, Settings& s) {
  v.about("EnvironmentEngine", "Settings of the engine \"environment\".");
  using preset::within;
  v.field("objects",
          "Names of the objects whose caustics are baked, all together; without, all of glass and all mirrors.",
          s.objects, {.count = {0, 100}, .text = preset::Text::line});
  v.field("directions", "How many directions light is baked from: 26, 98 or 386 points of a cube's faces.",
          s.directions, {.bounds = within(26, 386)});
  v.field("spheres", "Caustic spheres about the object, for each direction.", s.spheres, {.bounds = within(2, 64)});
  v.field("radii", "How the radii of the spheres grow.", s.radii);
  v.field("reach", "Radius of the largest sphere; beyond it light goes on by the inverse square of the distance.",
          s.reach, {.unit = "largest sides of the box about the object", .bounds = within(0.5, 1000)});
  v.field("resolution",
          "Texels across and down the square map of a sphere, which all have the same solid angle: 360 are as many as "
          "512 x 256.",
          s.resolution, {.bounds = within(8, 1024)});
  v.field("photons", "Photons from each direction.", s.photons, {.bounds = within(1, 1 << 30)});
  v.field(
      "weight_steps",
      "Steps of a state's weight from 0 to 1 at which a mesh that deforms is baked; between them spheres are mixed. "
      "0: it is baked at each weight.",
      s.weight_steps, {.bounds = within(0, 64)});
  v.field("lights", "Directional lights that the environment is cut into.", s.lights, {.bounds = within(6, 4096)});
  v.field("segmentation", "How the environment is cut into lights.", s.segmentation);
  v.field("weights", "How much a texel of the environment counts where it is cut.", s.weights);
  v.field("occlusion", "How it is found what other objects hide of a light.", s.occlusion);
  v.field("threshold", "A region with no more than this part of the environment's light is no light of its own.",
          s.threshold, {.bounds = within(0, 1)});
  v.field("refine",
          "Photons follow the spheres, and the picture goes on to the truth; false: spheres alone, as in the thesis.",
          s.refine);
  v.field("cast", "Whether caustics fall on surfaces.", s.cast);
  v.field("extinction",
          "How much light a medium around the object takes, as fog or smoke: it shows caustics in the air. 0: none.",
          s.extinction, {.unit = "1 / unit", .bounds = within(0, 1000)});
  v.field("albedo", "Which part of that light the medium scatters.", s.albedo, {.bounds = within(0, 1)});
  v.field("phase", "Where the medium scatters light.", s.phase);
  v.field("anisotropy",
          "Mean cosine between light's ways before and after scattering: 0 all around, towards 1 straight on.",
          s.anisotropy, {.bounds = within(-0.95, 0.95)});
}

} // namespace nephroid::environment
