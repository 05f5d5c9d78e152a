// SPDX-License-Identifier: Apache-2.0
// Describes the settings of engine 1 for preset/describe.h.
#pragma once
#include "photons/settings.h"
#include "preset/value.h"

namespace nephroid::preset {

template <>
inline constexpr Choice<photons::Settings::Method> choices<photons::Settings::Method>[] = {
    {photons::Settings::Method::optimal, "optimal", "The fewest clusters that keep the threshold."},
    {photons::Settings::Method::thesis, "thesis", "Algorithm 4.1 of the thesis, as printed."},
    {photons::Settings::Method::brute_force, "brute_force", "Every wavelength on its own."}};

template <>
inline constexpr Choice<photons::Settings::Estimator> choices<photons::Settings::Estimator>[] = {
    {photons::Settings::Estimator::automatic, "automatic",
     "As tiles where small lamps shine on smooth or flat glass, as points elsewhere; the plan says why."},
    {photons::Settings::Estimator::points, "points",
     "Photons are splatted as points; receivers keep their light for what glass and mirrors show."},
    {photons::Settings::Estimator::splat, "splat",
     "As points, but what is seen through glass or in a mirror has no caustics."},
    {photons::Settings::Estimator::tiles, "tiles",
     "As points, with photons on lattices, each the piece of light that it stands for."},
    {photons::Settings::Estimator::sppm, "sppm",
     "Progressive photon mapping, a run of its own for each cluster, as the thesis has it."}};

template <>
inline constexpr Choice<photons::Settings::Effort> choices<photons::Settings::Effort>[] = {
    {photons::Settings::Effort::automatic, "automatic",
     "As variance, or power where that gains too little; power with sppm, tiles and relight."},
    {photons::Settings::Effort::power, "power", "By what the eye makes of a cluster's light."},
    {photons::Settings::Effort::equal, "equal", "The same for each cluster."},
    {photons::Settings::Effort::importance, "importance",
     "By the importance of (4.15): light, luminosity, surroundings."},
    {photons::Settings::Effort::radziszewski, "radziszewski",
     "By 1 / cosh^2(0.0072 (lambda - 538)), whatever the scene."},
    {photons::Settings::Effort::variance, "variance",
     "By the variance measured in the run, as photons' directions are; not with sppm, tiles."},
    {photons::Settings::Effort::random, "random", "One cluster a pass, drawn at random; with sppm only."}};

template <>
inline constexpr Choice<photons::Settings::Smoothing> choices<photons::Settings::Smoothing>[] = {
    {photons::Settings::Smoothing::automatic, "automatic",
     "Where the two halves of the film say that it helps, region by region."},
    {photons::Settings::Smoothing::on, "on", "Everywhere."},
    {photons::Settings::Smoothing::off, "off", "Nowhere."}};

template <>
inline constexpr Choice<photons::Importance::Cluster> choices<photons::Importance::Cluster>[] = {
    {photons::Importance::Cluster::maximum, "maximum", "The one that matters most."},
    {photons::Importance::Cluster::mean, "mean", "The mean of all."}};

} // namespace nephroid::preset

namespace nephroid::photons {

inline void describe(preset::Fields& v, Importance& i) {
  v.about("Importance", "How much a wavelength matters.");
  v.field("cluster", "Which of its wavelengths speaks for a cluster.", i.cluster);
  v.field("geometry", "Weigh materials by how much of them the caustic objects see.", i.geometry);
}

inline void describe(preset::Fields& v, Sppm& s) {
  v.about("Sppm", "Progressive photon mapping.");
  v.field("radius", "Radius of the first pass; without, what the camera's pixels suggest.", s.radius,
          {.unit = preset::length_unit, .bounds = preset::length_bounds});
  v.field("alpha", "Part of each pass's photons that is kept: the radius shrinks the faster the smaller it is.",
          s.alpha, {.bounds = preset::between(0, 1)});
}

inline void describe(preset::Fields& v, Settings& s) {
  v.about("Spectral", "Settings of the engine \"spectral\".");
  v.field("method", "How wavelengths are put into clusters that share a path.", s.method);
  v.field("threshold_deg", "Largest change of the refraction angle inside a cluster.", s.threshold_deg,
          {.unit = "degrees", .bounds = preset::between(0, 90)});
  v.field("step_nm", "Of the method brute_force: neighbouring wavelengths that share a path all the same.", s.step_nm,
          {.unit = "nm", .bounds = preset::within(1, 401)});
  v.field("estimator", "How caustics are estimated.", s.estimator);
  v.field("effort", "How the work is divided among the clusters.", s.effort);
  v.field("importance", "How much a wavelength matters, where `effort` asks for it.", s.importance);
  v.field("jitter",
          "Each path takes one wavelength of its cluster, so that clusters leave no bias, and splats are stretched "
          "along the wavelength.",
          s.jitter);
  v.field("low_discrepancy", "Photons leave the lights by a scrambled Sobol sequence.", s.low_discrepancy);
  v.field("smoothing",
          "Spread light over up to 6 pixels around, or blocks of pixels: caustics until their noise is a quarter of "
          "them, what "
          "paths from the eye see until it is 2 %. Needs measure.estimate; not with sppm.",
          s.smoothing);
  v.field("relight", "Keep a layer for each cluster, so that the spectrum of a light can change without a new run.",
          s.relight);
  v.field("photons_per_pass",
          "Photons sent towards the caustic objects in one pass; of the estimator sppm, for each cluster.",
          s.photons_per_pass, {.bounds = preset::within(1, 1 << 24)});
  v.field("indirect_photons_per_pass",
          "Photons of the layer \"indirect\" in one pass, of what caustics and narrow spots light.",
          s.indirect_photons_per_pass, {.bounds = preset::within(1, 1 << 24)});
  v.field("pixel_samples",
          "Most samples of a pixel that shows neither glass nor a mirror, of each layer that paths from the eye bring; "
          "\"indirect\" has at least 65536. Without: 64, and 4096 where lamps have a size or the environment lights.",
          s.pixel_samples, {.bounds = preset::within(1, 1 << 20)});
  v.field("max_surfaces", "Interfaces a path may meet before it counts as lost.", s.max_surfaces,
          {.bounds = preset::within(1, 1024)});
  v.field("sppm", "Progressive photon mapping.", s.sppm);
  v.field("direct", "Compute the layer \"direct\": light that reaches a diffuse surface unbent.", s.direct);
  v.field("caustic", "Compute the layer \"caustic\": light that met glass or a mirror, then one diffuse surface.",
          s.caustic);
  v.field("indirect",
          "Compute the layer \"indirect\": light that met a diffuse surface before the last one. Without: where "
          "surfaces may light each other, which those of one plane do not but by a mirror; not with relight.",
          s.indirect);
  v.field("background", "Compute the layer \"background\": the environment, seen directly and through glass.",
          s.background);
}

} // namespace nephroid::photons
