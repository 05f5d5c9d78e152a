// SPDX-License-Identifier: Apache-2.0
// Engine 3, inverse caustics: one refractive object that casts several pictures at several distances (thesis chapter 5).
#pragma once
#include "engine/engine.h"
#include "inverse/layout.h"
#include "inverse/settings.h"
#include "job/job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "communicator/rank_context.h"

#include <string>

namespace nephroid::inverse {

extern const engine::Engine engine;

struct InversePlan : plan::Plan {
  Layout layout;
  std::vector<Target> targets; ///< of each receiver
  std::vector<Target> best;    ///< how close to each an object comes at best: pictures/preview.h
  std::uint64_t triangles = 0; ///< of the solid, about
};

/// Reads the index and the pictures. Throws bad_input as make_layout and make_targets do.
InversePlan make_plan(const preset::Preset& preset);

/// Looks for slopes until the method gains no more, or the preset's stop; then makes the solid and judges it.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const InversePlan& plan, const mpi::RankContext& context);

/// Whether a run of `before` may go on as one of `now` and keep its facets' slopes: only what as many receivers say differs
/// (distances, offsets, weights, pictures), or the stop; or the camera or a name. Methods other than assign begin again for all but the
/// last two.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

/// Where a snapshot has a receiver's figures: its distance and size, what the search believes of its picture and what the judge says.
std::string receiver_group(std::size_t receiver);

/// Closed forms, for `nephroid check`.
std::vector<check::Check> closed_forms();

/// The finished object as lit glass over its receivers, among the files of a run.
inline constexpr const char* glass_view_file = "view.json";

/// Its JSON: a preset of engine 1 that stands beside object.obj. The design's light, which is parallel, falls on as many copies of the
/// object as there are receivers, side by side, each over one receiver at its distance. A lamp would light all copies. The camera looks at
/// them from the front and above, where no object hides its receiver, as far as the distances allow. Of coloured light, light and glass
/// have their spectrum and dispersion; else the glass has the index that the design was made with, at all wavelengths.
std::string glass_view(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset);

} // namespace nephroid::inverse
