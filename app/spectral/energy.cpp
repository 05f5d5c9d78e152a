// SPDX-License-Identifier: Apache-2.0
#include "spectral/energy.h"

#include "base/counted.h"
#include "tracing/scales.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::spectral {

OutcomeWatts outcome_watts(std::span<const std::int64_t> quanta, double quanta_per_watt, double passes)
{
  OutcomeWatts watts{};
  for (std::size_t i = 0; i < watts.size(); ++i)
    watts[i] = i == OUTCOME_REFUSED ? static_cast<double>(quanta[i]) : tracing::mean_watts(quanta[i], quanta_per_watt, passes);
  return watts;
}

EnergyBalance balance_of(const OutcomeWatts& watts)
{
  return {watts[OUTCOME_EMITTED],
          watts[OUTCOME_DEPOSITED],
          watts[OUTCOME_MISSED],
          watts[OUTCOME_ABSORBED],
          watts[OUTCOME_ESCAPED],
          watts[OUTCOME_LOST],
          static_cast<std::uint64_t>(watts[OUTCOME_REFUSED])};
}

void add_energy(const Energy& energy, job::Snapshot& snapshot)
{
  const EnergyBalance& e = energy.caustics;
  const double accounted = e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w;
  const std::string group = "energy", indirect = "indirect_energy";
  snapshot.scalars.insert(snapshot.scalars.end(), {{group, "emitted_w", e.emitted_w},
                                                   {group, "deposited_w", e.deposited_w},
                                                   {group, "missed_w", e.missed_w},
                                                   {group, "absorbed_w", e.absorbed_w},
                                                   {group, "escaped_w", e.escaped_w},
                                                   {group, "lost_w", e.lost_w},
                                                   {group, "unaccounted_w", e.emitted_w - accounted},
                                                   {group, "refused_contributions", static_cast<double>(e.refused_contributions)}});
  if (const auto& i = energy.indirect)
    snapshot.scalars.insert(snapshot.scalars.end(), {{indirect, "emitted_w", i->emitted_w},
                                                     {indirect, "absorbed_w", i->absorbed_w},
                                                     {indirect, "escaped_w", i->escaped_w},
                                                     {indirect, "lost_w", i->lost_w},
                                                     {indirect, "unaccounted_w", i->emitted_w - i->absorbed_w - i->escaped_w - i->lost_w}});
  if (e.refused_contributions > 0)
    snapshot.warnings.push_back(
        fmt::format("{} too bright for the film and missing from the picture; move the camera or the light away from the "
                    "surface, or take fewer pixel_samples",
                    counted(e.refused_contributions, "sample was", "samples were")));
}

EnergyBalance energy_of(const job::Snapshot& snapshot)
{
  const auto of = [&](const char* name) { return job::scalar(snapshot, "energy", name); };
  const double refused = of("refused_contributions");
  return {of("emitted_w"),
          of("deposited_w"),
          of("missed_w"),
          of("absorbed_w"),
          of("escaped_w"),
          of("lost_w"),
          refused > 0 ? static_cast<std::uint64_t>(refused) : 0};
}

std::optional<IndirectBalance> indirect_energy_of(const job::Snapshot& snapshot)
{
  const auto of = [&](const char* name) { return job::scalar(snapshot, "indirect_energy", name); };
  if (std::isnan(of("emitted_w"))) return std::nullopt;
  return IndirectBalance{of("emitted_w"), of("absorbed_w"), of("escaped_w"), of("lost_w")};
}

} // namespace nephroid::spectral
