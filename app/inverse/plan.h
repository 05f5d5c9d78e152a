// SPDX-License-Identifier: Apache-2.0
// What a preset asks an object for, and what a run for it does: method, constraints and blurs, and its memory.
#pragma once
#include "inverse/lens/forecast.h"
#include "plan/plan.h"

#include <mutex>

namespace nephroid::inverse {

/// Where things stand and which light is wanted. It is read once; the plan and its job share it.
class Design {
public:
  /// Reads the index and the pictures. Throws bad_input as make_layout and make_targets.
  explicit Design(const preset::Preset& preset);

  const Layout layout;
  std::vector<std::string> file_notes; ///< what picture files say and is not obeyed
  const std::vector<Target> targets;   ///< the wanted light of each receiver

  /// How close to each target an object can come (pictures/preview.h). The first call computes it, in up to a second.
  const std::vector<Target>& best() const;
  /// What a lens becomes. The first call computes it, in up to a second.
  const LensForecast& lens() const;

private:
  Settings settings_;
  mutable std::once_flag has_best_, has_lens_;
  mutable std::vector<Target> best_;
  mutable LensForecast lens_;
};

struct InversePlan : plan::Plan {
  std::shared_ptr<const Design> design;
  std::uint64_t triangles = 0; ///< how many the solid has, about
};

/// The plan without its notes. Throws bad_input as Design does, and for a mesh that would be too large.
InversePlan make_plan(const preset::Preset& preset);

/// What a run should say once about the design. It computes how close the pictures come at best.
std::vector<std::string> notes_of(const preset::Preset& preset, const Design& design);

} // namespace nephroid::inverse
