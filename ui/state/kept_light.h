// SPDX-License-Identifier: Apache-2.0
// Light that has landed stays in the window's picture while the camera moves. A matt surface has one radiance in all
// directions, so what the picture before showed of a place is right for the next one, which begins with few photons.
#pragma once
#include "run/prepare.h"

#include <memory>

namespace nephroid::ui {

class KeptLight {
public:
  /// The job as it is, but that its snapshots also have a picture with the light of the run before (Snapshot::in_view),
  /// where that differs by the camera alone. What the job shows when it is finished, what it measures and its bits
  /// stay its own. prepared: what it was made of. To be called for each job, on the thread that the jobs work on.
  std::unique_ptr<job::Job> wrap(std::unique_ptr<job::Job> job, const run::Prepared& prepared);

private:
  struct Shown;
  class Keeper;
  std::shared_ptr<Shown> last_; ///< what the newest job shows; null before the first
};

} // namespace nephroid::ui
