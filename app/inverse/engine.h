// SPDX-License-Identifier: Apache-2.0
// Engine 3, inverse caustics: one refractive object that casts several pictures at several distances (thesis chapter 5).
#pragma once
#include "engine/engine.h"
#include "inverse/layout.h"
#include "inverse/settings.h"
#include "job/job.h"
#include "plan/plan.h"
#include "preset/preset.h"

namespace nephroid::inverse {

extern const engine::Engine engine;

struct InversePlan : plan::Plan {
  Layout layout;
  std::vector<Target> targets; ///< of each receiver
};

/// Reads the index and the pictures. Throws bad_input as make_layout and make_targets do.
InversePlan make_plan(const preset::Preset& preset);

/// Looks for slopes until the method gains no more, or the preset's stop; then makes the solid and judges it.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const InversePlan& plan);

/// Whether a run of `before` may go on as one of `now` and keep its facets' slopes: only distances, weights and pictures of as many
/// receivers differ, or the stop; or the camera or a name. Methods other than assign begin again for all but the last two.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

/// Where a snapshot has a receiver's figures: its distance and size, what the search believes of its picture and what the judge says.
std::string receiver_group(std::size_t receiver);

/// Closed forms, for `nephroid check`.
std::vector<check::Check> closed_forms();

} // namespace nephroid::inverse
