// SPDX-License-Identifier: Apache-2.0
// What a snapshot has of a run: pictures of what is wanted and what is cast on each receiver, of the slopes and of
// screens between receivers; and the files of a finished one.
#pragma once
#include "inverse/judgement.h"
#include "inverse/method.h"
#include "inverse/sheet.h"

#include <memory>
#include <vector>

namespace nephroid::inverse {

/// What a run has so far; for as long as a snapshot takes.
struct RunState {
  const preset::Preset& preset;
  const Layout& layout;
  const std::vector<Target>& targets;
  const std::vector<Target>& best; ///< Design::best
  const Method& method;
  const Judgement* judgement; ///< null: slopes are searched

  bool is_judged() const { return judgement && judgement->is_judged(); }
  /// Costs as judged where that is done, else as believed.
  std::vector<Cost> costs() const { return is_judged() ? judgement->judge().costs(targets) : method.costs(); }
  /// Wanted on a receiver, as a part of all light, in a cell.
  double brightest(std::size_t receiver) const;
  /// On a receiver as judged where that is done, else as believed; or, once it is judged, on a frame behind them. In
  /// colours where the judge has them.
  std::shared_ptr<const job::Picture> picture_of(std::size_t screen, double most) const;
};

/// Of each receiver. Returns what it shows.
std::vector<std::shared_ptr<const job::Picture>> add_pictures(job::Snapshot& snapshot, const RunState& run);

/// The receivers' pictures and those between them in the order of their distance, as a screen that moves away would
/// show them: as bright as is wanted at the receivers, and between them from the one to the other. Of a run that is
/// judged.
void add_frames(job::Snapshot& snapshot, const RunState& run);

/// Meshes, tables, pages for the workshop, and the object as a scene of its own. Of a run that is judged.
void add_files(job::Snapshot& snapshot, const RunState& run);

/// The object in the window's camera: the same picture until a quarter of a step, the judge or the camera changes it.
class ObjectPicture {
public:
  std::shared_ptr<const job::Picture> of(const RunState& run,
                                         const std::vector<std::shared_ptr<const job::Picture>>& receivers);
  void clear() { picture_.reset(); }

private:
  struct Shown {
    std::int64_t steps = 0;
    int quarter = 0; ///< of the slice in hand
    bool judged = false;
    preset::Camera camera;
    bool operator==(const Shown&) const = default;
  };
  Shown shown_;
  std::shared_ptr<const job::Picture> picture_; ///< of shown_
};

} // namespace nephroid::inverse
