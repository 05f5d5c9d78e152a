// SPDX-License-Identifier: Apache-2.0
// What a run that keeps layers has in its plan.
#pragma once
#include "plan/plan.h"
#include "spectral/tables/run_tables.h"

namespace nephroid::spectral {

/// Why there are no photon maps.
plan::Pass no_maps_of_layers();

/// Adds the pass "relighting", puts the layers' memory in place of the films' and takes out what only runs without layers leave out.
/// tables: of make_run_tables.
void plan_layers(const RunTables& tables, bool direct, bool photons, int halves, plan::Plan& plan);

} // namespace nephroid::spectral
