// SPDX-License-Identifier: Apache-2.0
// What a snapshot has of a run: its figures, of which docs/inverse.md says what each is; pictures of what is wanted and
// what is cast on each receiver, of the slopes and of screens between receivers; and the files of a finished one.
#pragma once
#include "inverse/assign/conflicts.h"
#include "inverse/method.h"
#include "inverse/sheet.h"
#include "inverse/tolerances.h"

namespace nephroid::inverse {

/// What a run has so far; it exists while a snapshot is made.
struct RunState {
  const preset::Preset& preset;
  const Layout& layout;
  const std::vector<Target>& targets;
  const std::vector<Target>& best; ///< Design::best
  const Method& method;
  const Judgement* judgement; ///< null while slopes are searched

  bool is_judged() const { return judgement && judgement->is_judged(); }
  /// The judge's costs once it has finished, else the search's.
  std::vector<Cost> costs() const { return is_judged() ? judgement->judge().costs(targets) : method.costs(); }
  /// The largest part of all light that is wanted in a cell of a receiver.
  double brightest(std::size_t receiver) const;
  /// The picture on a receiver: the judge's once it has finished, else the search's. Once the run is judged, screens
  /// after the receivers are the frames. The picture has colours where the judge has them.
  std::shared_ptr<const job::Picture> picture_of(std::size_t screen, double most) const;
};

/// The snapshot's group for a receiver's figures: its distance and size, and the search's and the judge's costs.
std::string receiver_group(std::size_t receiver);

/// Adds the costs, of all pictures and of each, and what the judge says once it has finished.
void add_figures(job::Snapshot& snapshot, const RunState& run, const std::optional<Conflicts>& conflicts);

/// Adds the pictures of each receiver. Returns what each receiver shows.
std::vector<std::shared_ptr<const job::Picture>> add_pictures(job::Snapshot& snapshot, const RunState& run);

/// Adds the pictures of receivers and frames in the order of their distance, as a screen that moves away would show
/// them, each as bright as is wanted there; between receivers that is interpolated. The run must be judged.
void add_frames(job::Snapshot& snapshot, const RunState& run);

/// Adds meshes, tables, pages for the workshop, and the object as a scene of its own. The run must be judged.
void add_files(job::Snapshot& snapshot, const RunState& run);

/// The object as the window's camera sees it; it stays until a quarter of a step, the judge or the camera changes it.
class ObjectPicture {
public:
  std::shared_ptr<const job::Picture> of(const RunState& run,
                                         const std::vector<std::shared_ptr<const job::Picture>>& receivers);
  void clear() { picture_.reset(); }

private:
  struct Shown {
    std::int64_t steps = 0;
    int quarter = 0; ///< completed quarters of the step in hand
    bool judged = false;
    preset::Camera camera;
    bool operator==(const Shown&) const = default;
  };
  Shown shown_;
  std::shared_ptr<const job::Picture> picture_; ///< the picture of shown_
};

} // namespace nephroid::inverse
