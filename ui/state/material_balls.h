// SPDX-License-Identifier: Apache-2.0
// Materials as small pictures of a ball, each a short run of its own beside the run in hand. A picture is made again
// where its material changes. Nothing runs for materials that no panel shows.
#pragma once
#include "job/worker.h"
#include "ui/state/run_in_hand.h"

namespace nephroid::ui {

class MaterialBalls {
public:
  using Clock = std::chrono::steady_clock;
  /// The width and height of a picture in pixels.
  static constexpr int edge = 128;

  /// source outlives the object.
  explicit MaterialBalls(RunSource& source) : source_(source) {}
  ~MaterialBalls() { making_.request_stop(); }

  /// A panel calls it in every frame in which it shows the material. Null: there is no picture yet, or none can be
  /// made, of which the run in hand says why. While the material changes the picture may be a little older than that.
  std::shared_ptr<const job::Picture> of(const std::string& material);
  /// Called once a frame, before panels draw: takes the newest picture, starts the run of the next material. preset:
  /// null where none is open. While the run in hand works they only take a part of the device, and its first picture
  /// after an edit comes before theirs, unless that takes long.
  void update(const preset::Preset* preset, const RunInHand& run);
  /// Whether one of them is being made or waits.
  bool works() const { return works_; }

private:
  /// What a picture is made of.
  struct Subject {
    std::string source; ///< as preset::Preset::source: files are looked up from there
    preset::Preset::Unit unit = {};
    preset::Material material;
    std::uint64_t readings = 0; ///< as RunInHand::readings
    bool operator==(const Subject&) const = default;
  };
  struct Ball {
    Subject subject;
    std::shared_ptr<const job::Picture> picture; ///< perhaps of the subject before
    double work_seconds = -1;                    ///< what is in the picture; below 0: it is not of the subject
    Clock::time_point outdated{};                ///< since when there is none of the subject
    bool done = false;                           ///< there is no better picture of the subject to come
    bool wanted = false;                         ///< since the last update
  };
  static preset::Preset scene_of(const Subject& subject);
  void take_newest();
  void follow(const preset::Preset* preset, std::uint64_t readings);
  void start_next(bool run_shows_nothing);
  void start(const std::string& material, const Ball& ball);
  void end_run();

  RunSource& source_;
  std::map<std::string, Ball> balls_; ///< by the materials' names
  std::string in_hand_;               ///< the material whose run goes on; empty: none
  Subject subject_;                   ///< of that run
  bool works_ = false;
  bool shown_ = false; ///< that run has shown a picture
  std::shared_ptr<const job::Snapshot> before_start_;
  std::stop_source making_;
  std::atomic<bool> device_is_wanted_{false};
  job::Worker worker_; ///< last: its thread uses the other members
};

} // namespace nephroid::ui
