// SPDX-License-Identifier: Apache-2.0
// Whether a run has caustics, and how their photons are sent: what its plan says of both. photon_stage.cpp splats them, map_stage.cpp and
// sppm_stage.cpp gather them.
#include "base/counted.h"
#include "spectral/effort/importance.h"
#include "spectral/plan_part.h"
#include "tracing/stretch.h"

#include <fmt/format.h>

namespace nephroid::spectral {
namespace {

plan::Pass stray_photons_pass(const PlanInput& input)
{
  const bool aims = input.leave_out.stray_photons;
  return tracing::not_needed(
      "stray photons", aims,
      aims ? fmt::format("photons start towards {} about glass and mirrors only", counted(std::ssize(input.tables.spheres), "sphere"))
           : "photons need not start where there is no glass and no mirror");
}

plan::Pass low_discrepancy_pass(const Settings& settings)
{
  return {"low discrepancy", settings.low_discrepancy,
          settings.low_discrepancy ? "photons leave the lights by a scrambled Sobol sequence"
                                   : "spectral.low_discrepancy is false: plain random numbers",
          "/spectral/low_discrepancy", true};
}

plan::Pass differentials_pass(const PlanInput& input)
{
  const char* const name = "differentials";
  if (input.settings.relight) return not_in_layers(name, "a layer is a whole cluster's");
  if (!input.settings.differentials) return not_asked_for(name, name);
  if (!input.caustics.runs || input.is_sppm()) return {name, false, "nothing is splatted"};
  const tracing::StretchParameter along = tracing::stretch_parameter(input.scene);
  if (along == tracing::StretchParameter::none) return {name, false, "no glass bends one wavelength otherwise than another"};
  return {name, true,
          fmt::format("splats are stretched along the way that they move with the {}",
                      along == tracing::StretchParameter::index ? "index of refraction" : "wavelength, for there are several curves"),
          "/spectral/differentials", true};
}

PlanPart plan_caustics(const PlanInput& input)
{
  const plan::Pass jitter = jitter_pass(input), low_discrepancy = low_discrepancy_pass(input.settings),
                   differentials = differentials_pass(input);
  PlanPart part;
  if (input.caustics.runs)
    part.passes = {effort_pass(input.settings, input.tables.importance), stray_photons_pass(input), jitter, low_discrepancy, differentials};
  part.defines = {{"NEPHROID_JITTER", std::to_string(int(jitter.runs))},
                  {"NEPHROID_LOW_DISCREPANCY", std::to_string(int(low_discrepancy.runs))},
                  {"NEPHROID_DIFFERENTIALS", std::to_string(int(differentials.runs))}};
  return part;
}

} // namespace

const RunPart caustics_part{plan_caustics};

plan::Pass caustics_pass(const PlanInput& input)
{
  const char* const name = "photons";
  if (!input.settings.caustic) return not_asked_for(name, "caustic");
  // No field brings these back: there is nothing to send.
  if (const std::string dark = no_light(input); !dark.empty()) return {name, false, dark};
  const std::string missing = input.objects.dielectrics + input.objects.mirrors == 0 ? "no object is of glass or a mirror"
                              : input.objects.diffuse == 0                           ? "no diffuse surface can receive a caustic"
                                                                                     : "";
  if (!missing.empty()) return tracing::not_needed(name, input.leave_out.photons, missing);
  if (input.tables.emitters.empty()) return {name, false, "no light shines on glass or a mirror"};
  return tracing::needed(name, fmt::format("{} photons a pass in {}", input.tables.photons_per_pass,
                                           counted(std::ssize(input.tables.wavelengths.clusters), "wavelength cluster")));
}

plan::Pass jitter_pass(const PlanInput& input)
{
  const char *const name = "jitter", *const field = "/spectral/jitter";
  if (!input.settings.jitter)
    return {name, false, "spectral.jitter is false: every path of a cluster has the cluster's mean n", field, true};
  if (input.settings.relight)
    return {name, false, "spectral.relight is true: a layer holds clusters as a whole", "/spectral/relight", false};
  if (!input.tables.wavelengths.clusters_spread) return {name, false, "n is the same at all wavelengths of every cluster"};
  return {name, true, "each path takes one wavelength of its cluster, so clusters leave no bias", field, true};
}

} // namespace nephroid::spectral
