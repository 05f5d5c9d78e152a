// SPDX-License-Identifier: Apache-2.0
// The figures that a run reports: docs/inverse.md says what each of them is.
#pragma once
#include "inverse/assign/conflicts.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "inverse/judge.h"
#include "job/job.h"

#include <string>
#include <vector>

namespace nephroid::inverse {

/// The snapshot's group for a receiver's figures: its distance and size, and the search's and the judge's costs.
std::string receiver_group(std::size_t receiver);

/// Adds the costs of all pictures and of each receiver. `judged` is empty until the judge has finished.
void add_costs(job::Snapshot& snapshot, const Layout& layout, const std::vector<Cost>& believed,
               const std::vector<Cost>& judged);

/// Adds how much of the judge's figures is noise.
void add_noise(job::Snapshot& snapshot, const Cost& noise);

void add_conflicts(job::Snapshot& snapshot, const Conflicts& conflicts);

void add_fates(job::Snapshot& snapshot, const RayOutcomes& outcomes);

void add_object(job::Snapshot& snapshot, const Layout& layout, const Solid& solid,
                const std::vector<glm::dvec2>& slopes);

} // namespace nephroid::inverse
