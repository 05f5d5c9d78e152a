// SPDX-License-Identifier: Apache-2.0
// Passes, in each of which every stage has its turn, slice by slice, and their progress. Before the first come
// previews: coarse pictures, in blocks of pixels, each finer than the one before (coarse.h).
#pragma once
#include "photons/stage.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace nephroid::photons {

/// A stage and the seconds that it has worked.
struct TimedStage {
  std::unique_ptr<Stage> stage;
  const char* layer = "";
  double seconds = 0;
  bool caustics() const { return std::string_view(layer) == "caustic"; }
};

/// Runs all kernels once where OpenCL has not yet compiled them (Stage::warm_up).
void warm_up(StageContext& world, std::span<const TimedStage> stages);

class Passes {
public:
  /// batches is the number of batches of photons in a pass.
  explicit Passes(unsigned batches) : batches_(batches) {}
  void add(std::unique_ptr<Stage> stage, const char* layer) { stages_.push_back({std::move(stage), layer}); }
  const std::vector<TimedStage>& stages() const { return stages_; }

  /// Runs one slice of about 30 ms of the stage whose turn it is.
  void advance();
  /// Does other work of the run and counts it for a stage.
  template <class Work>
  void work(std::size_t stage, const Work& work) {
    const double seconds = tracing::seconds_of(work);
    stages_[stage].seconds += seconds;
    at_.work_seconds += seconds;
  }

  std::int64_t complete() const { return at_.pass; }
  double work_seconds() const { return at_.work_seconds; }
  bool is_between_passes() const { return at_.stage == 0 && !at_.has_begun; }
  /// Whether a stage has had its turn in the current pass.
  bool had_turn(std::size_t stage) const { return stage < at_.stage; }
  bool has_halves(std::size_t stage) const { return stages_[stage].stage->has_halves(at_.pass, had_turn(stage)); }
  /// The number of passes after which no stage takes part any more.
  std::int64_t most() const;
  /// Complete passes and the fraction of the current one, in which every stage counts alike.
  double with_fraction() const;
  std::uint64_t photons() const;
  /// The batches of the photons that StageContext::energy counts, with the fraction of the current pass.
  double photon_batches() const;
  /// The batches since begin_energy().
  double energy_batches() const { return photon_batches() - at_.energy_from; }
  void begin_energy() { at_.energy_from = photon_batches(); }

  void state_of_position(tracing::Archive& archive) { archive.value(at_); }
  void state_of_stages(tracing::Archive& archive);

private:
  struct Position {
    std::int64_t pass = 0;  ///< number of complete passes
    std::size_t stage = 0;  ///< stage whose turn it is
    bool has_begun = false; ///< whether that stage has begun
    double work_seconds = 0;
    double energy_from = 0; ///< batches of photons when the energy counters began
  };

  /// The fraction of the current pass that a stage has done.
  double fraction_of(std::size_t stage) const;

  unsigned batches_;
  std::vector<TimedStage> stages_;
  Position at_;
};

class Preview {
public:
  /// edges are those of each picture's blocks (preview_edges). Without edges there is no preview.
  Preview(StageContext& world, std::vector<int> edges) : world_(world), edges_(std::move(edges)) {}

  bool has_more() const { return pictures_ < edges_.size(); }
  bool has_picture() const { return pictures_ > 0; }
  /// Renders the whole next picture at once: a part of it would be of no use.
  void next(Passes& passes);

  void serialize(tracing::Archive& archive) {
    archive.value(pictures_);
    if (archive.is_read() && has_picture()) begin_picture();
  }

private:
  void begin_picture();

  StageContext& world_;
  std::vector<int> edges_;
  std::size_t pictures_ = 0; ///< number of pictures that have begun
};

} // namespace nephroid::photons
