// SPDX-License-Identifier: Apache-2.0
// Whether a run's caustics are smoothed, and what that takes.
#include "photons/plan_part.h"
#include "photons/smoothing.h"
#include "tracing/world.h"

#include <fmt/format.h>

namespace nephroid::photons {
namespace {

bool is_of_use(const PlanInput& input) { return input.has_caustics() || indirect_decision(input).runs; }

plan::Decision smoothing_decision(const PlanInput& input) {
  const char* const name = "smoothing";
  using Choice = Settings::Smoothing;
  const Choice choice = input.settings.smoothing;
  if (choice == Choice::off) return {name, false, "spectral.smoothing is off"};
  if (!is_of_use(input)) return {name, false, "there are no caustics and no light of walls"};
  if (input.is_sppm()) return {name, false, "spectral.estimator is sppm, which has radii of its own"};
  if (input.scene.camera.lens_radius > 0)
    return {name, false, "scene.camera.aperture: a pixel shows several surfaces at once"};
  if (!input.estimate.runs)
    return {name, false, "measure.estimate is false: nothing tells how noisy a pixel is", "/measure/estimate", true};
  if (input.preset.stop.passes == 1)
    return {name, false, "the run has one pass, and it takes two to tell how noisy a pixel is"};
  if (input.settings.estimator == Settings::Estimator::tiles && !tracing::may_see_glass_or_mirror(input.scene) &&
      !input.tables.has_even_sky && !indirect_decision(input).runs)
    return {name, false, "tiles are as wide as their cells, and the camera sees no glass and no mirror"};
  return {
      name, true,
      fmt::format("a pixel's caustics are spread until their noise is {} of them, what paths from the eye see further, "
                  "{}; the estimated error takes in how far it goes",
                  Smoothing::usual_noise,
                  choice == Choice::on ? "everywhere" : "where the two halves of the film say that it helps")};
}

PlanPart plan_smoothing(const PlanInput& input) {
  const plan::Decision pass = smoothing_decision(input);
  PlanPart part;
  if (is_of_use(input)) part.decisions = {pass};
  if (pass.runs) part.buffers = {{"surfaces in pixels (host)", Smoothing::bytes(input.scene, input.bvh), true}};
  if (input.settings.smoothing != Settings::Smoothing::on) return part;
  if (!pass.runs)
    part.notes = {"spectral.smoothing: on does nothing here: " + pass.reason};
  else if (input.preset.stop.error && !input.preset.reference)
    part.notes = {
        "stop.error: the run's own estimate may not know how far spectral.smoothing moves light; a 'reference' does"};
  return part;
}

} // namespace

const RunPart smoothing_part{plan_smoothing};

} // namespace nephroid::photons
