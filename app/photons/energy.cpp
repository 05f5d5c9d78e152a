// SPDX-License-Identifier: Apache-2.0
#include "photons/energy.h"

#include "base/counted.h"
#include "tracing/scales.h"

#include <fmt/format.h>

namespace nephroid::photons {
namespace {

struct Part {
  const char* name;
  std::size_t outcome;
  double EnergyBalance::*watts;
};
constexpr Part parts[] = {{"emitted_w", OUTCOME_EMITTED, &EnergyBalance::emitted_w},
                          {"deposited_w", OUTCOME_DEPOSITED, &EnergyBalance::deposited_w},
                          {"missed_w", OUTCOME_MISSED, &EnergyBalance::missed_w},
                          {"absorbed_w", OUTCOME_ABSORBED, &EnergyBalance::absorbed_w},
                          {"escaped_w", OUTCOME_ESCAPED, &EnergyBalance::escaped_w},
                          {"lost_w", OUTCOME_LOST, &EnergyBalance::lost_w}};

/// The part of the light that met glass or mirrors above which its loss is worth a warning.
constexpr double most_lost = 0.005;

void add_parts(const std::string& group, const EnergyBalance& energy, job::Snapshot& snapshot) {
  double accounted = 0;
  for (const Part& part : parts) {
    if (group == "indirect_energy" && part.outcome == OUTCOME_DEPOSITED) continue;
    snapshot.scalars.push_back({group, part.name, energy.*part.watts});
    if (part.outcome != OUTCOME_EMITTED) accounted += energy.*part.watts;
  }
  snapshot.scalars.push_back({group, "unaccounted_w", energy.emitted_w - accounted});
}

} // namespace

OutcomeWatts outcome_watts(std::span<const std::int64_t> quanta, double quanta_per_watt, double passes) {
  OutcomeWatts watts{};
  for (std::size_t i = 0; i < watts.size(); ++i)
    watts[i] = is_count(i) ? static_cast<double>(quanta[i]) : tracing::mean_watts(quanta[i], quanta_per_watt, passes);
  return watts;
}

EnergyBalance balance_of(const OutcomeWatts& watts) {
  EnergyBalance energy;
  for (const Part& part : parts) energy.*part.watts = watts[part.outcome];
  energy.refused_contributions = static_cast<std::uint64_t>(watts[OUTCOME_REFUSED]);
  energy.segments = static_cast<std::uint64_t>(watts[OUTCOME_SEGMENTS]);
  return energy;
}

void add_energy(const Energy& energy, std::uint64_t photons, job::Snapshot& snapshot) {
  const std::uint64_t refused = energy.caustics.refused_contributions;
  add_parts("energy", energy.caustics, snapshot);
  snapshot.scalars.push_back({"energy", "refused_contributions", static_cast<double>(refused)});
  if (energy.indirect) add_parts("indirect_energy", *energy.indirect, snapshot);
  if (photons > 0) {
    const auto segments =
        static_cast<double>(energy.caustics.segments + (energy.indirect ? energy.indirect->segments : 0));
    snapshot.scalars.push_back({"paths", "segments", segments});
    snapshot.scalars.push_back({"paths", "segments_per_photon", segments / static_cast<double>(photons)});
  }
  const double lost = energy.caustics.lost_w + (energy.indirect ? energy.indirect->lost_w : 0),
               missed = energy.caustics.missed_w + (energy.indirect ? energy.indirect->missed_w : 0),
               met = energy.caustics.emitted_w + (energy.indirect ? energy.indirect->emitted_w : 0) - missed;
  if (lost > most_lost * met)
    snapshot.warnings.push_back(
        fmt::format("{:.1f} % of the light that met glass or mirrors is missing from the picture; its paths have more "
                    "surfaces than spectral.max_surfaces, or lie in more than {} objects at once",
                    100 * lost / met, MEDIA_DEPTH));
  if (refused > 0)
    snapshot.warnings.push_back(fmt::format(
        "{} too bright for the film and missing from the picture; move the camera or the light away from the "
        "surface, or take fewer pixel_samples",
        counted(refused, "sample was", "samples were")));
}

EnergyBalance energy_of(const job::Snapshot& snapshot, const char* group) {
  EnergyBalance energy;
  for (const Part& part : parts) energy.*part.watts = job::scalar(snapshot, group, part.name);
  const double refused = job::scalar(snapshot, group, "refused_contributions");
  energy.refused_contributions = refused > 0 ? static_cast<std::uint64_t>(refused) : 0;
  return energy;
}

} // namespace nephroid::photons
