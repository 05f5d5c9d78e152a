// SPDX-License-Identifier: Apache-2.0
// The one way from a preset to a job that works and measures itself, and to its last step: for the command line, the
// window, Python and each rank.
#pragma once
#include "job/observer.h"
#include "measure/measured_job.h"
#include "mpi/ranks.h"
#include "run/folder.h"
#include "run/metered_job.h"

#include <chrono>
#include <stop_token>

namespace nephroid::photons {
struct SeenPlaces;
}

namespace nephroid::run {

/// A run on its device. What is left of one makes the next one ready sooner.
struct ReadyRun {
  explicit ReadyRun(std::function<compute::Context()> open_device) : device(std::move(open_device)) {}

  DeviceOnDemand device;
  std::optional<Prepared> prepared;                    ///< its white is a number
  std::shared_ptr<mpi::Ranks> ranks;                   ///< that compute it together; null: this process alone
  std::shared_ptr<const measure::Reference> reference; ///< null where it is measured against none
  std::unique_ptr<ClaimedFolder> claimed;              ///< null where it writes no files
  std::shared_ptr<const photons::SeenPlaces> seen;     ///< of a frame that leaves something for the next; else null
  bool resumed = false;                                ///< it goes on from a checkpoint
  std::unique_ptr<job::Job> job;                       ///< measures itself; on other ranks it follows that of rank 0
  std::string name_in_job;                             ///< the name of the preset that the job was made of
};

/// What a front end adds to making a run ready. What is left out is not done.
struct ReadyOptions {
  Watch watch;
  std::shared_ptr<mpi::Ranks> ranks = {};  ///< as ReadyRun::ranks
  std::filesystem::path folder = {};       ///< that the run writes into; empty: into none
  bool is_frame = false;                   ///< of an animation
  std::filesystem::path frame_before = {}; ///< the folder of the frame that it begins with; empty: with none
  bool resume = false;                     ///< from the folder's checkpoint, with the white of the run in there
  std::vector<double> measure_at = {};     ///< as measure::measured takes it
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
  /// Hears the plan before anything is on the device.
  std::function<void(const Prepared&)> planned = {};
  /// Finds what the run is measured against. Null: find_reference, else make_reference.
  std::function<std::shared_ptr<const measure::Reference>(const Prepared&, const compute::Context&)> reference = {};
  /// Where there is a checkpoint that is bad input: throws, or lets the run begin anew. Null: throws that.
  std::function<void(const Error&)> bad_checkpoint = {};
  MeterShare meter_share = nullptr; ///< as metered() takes it
};

/// Makes `run` ready for the preset, in place of what it was. An earlier run lends its scene, as prepare takes it, and
/// its job where that takes the preset on (job::Job::adopt) with its progress at 0: as a new job, bit for bit, but that
/// it keeps what does not change, such as a bake. Fits white where that is "auto". To be called within
/// preset::at_origins. Throws as what it calls, bad_input on a rank that would compute other bits than rank 0, and
/// interrupted where the watch asks for it.
void make_ready(ReadyRun& run, preset::Preset preset, const ReadyOptions& options);

/// Steps the run's job until it is finished or `stop` asks for its end. On another rank than 0 the job does what that
/// of rank 0 does, and there is nothing to observe. Where the job finds out by its work that the preset asks for what
/// cannot be, the observer keeps what there is before bad_input is thrown.
void drive(const ReadyRun& run, job::Observer& observer, const std::stop_token& stop);

/// Prepares the preset as make_ready does, with what the run before lends, but makes no job: for the plan alone.
const Prepared& prepare_next(ReadyRun& run, const preset::Preset& preset, const Watch& watch);

/// Throws as require_memory. No rank goes on where one lacks it. ranks: may be null.
void require_memory(const Prepared& prepared, const compute::Context& context,
                    const std::shared_ptr<mpi::Ranks>& ranks);

/// Throws bad_input on a rank that does not see a file that rank 0 has written before.
void require_shared(mpi::Ranks& ranks, const std::filesystem::path& file);

/// Throws bad_input on the ranks that would compute other bits than rank 0.
void require_same(mpi::Ranks& ranks, const Prepared& prepared, const compute::Context& context);

} // namespace nephroid::run
