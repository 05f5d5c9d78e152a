// SPDX-License-Identifier: Apache-2.0
// The one interface of all engines: a job advances in short steps and shows itself as immutable snapshots.
#pragma once
#include "base/bytes.h"
#include "job/history.h"
#include "preset/preset.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::job {

struct Layer {
  std::string name;       ///< "direct", "caustic", ... (contract.md)
  std::vector<float> rgb; ///< linear sRGB, 3 a pixel, row 0 at the top, divided by the preset's white
};

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb; ///< the sum of the layers
  std::vector<Layer> layers;
  /// An independent draw of the picture's own error, like rgb: the difference of two independent halves of the samples, a and b of them
  /// in number, times sqrt(a b) / (a + b), which has the expectation 0 and the covariance of rgb. Empty where no halves are kept
  /// or one of them has no sample yet.
  std::vector<float> error_draw;
};

/// Where a job is. All counts are of the whole run, resumed parts included.
struct Progress {
  double fraction = 0;       ///< 0..1 of the preset's own stop; 1 when finished
  std::int64_t step = 0;     ///< passes completed; the one in hand is in `fraction` and `photons` only
  std::int64_t steps = -1;   ///< passes in all; -1: it stops by time
  std::uint64_t photons = 0; ///< sent so far
  double work_seconds = 0;   ///< of stepping, without start-up and snapshots
};

/// Where the power that photons carried went, as the mean of the passes: emitted = deposited + missed + absorbed + escaped + lost
/// but for rounding. kernels/tracing/shared_types.h says what each is (OUTCOME_*).
struct EnergyBalance {
  double emitted_w = 0, deposited_w = 0, missed_w = 0, absorbed_w = 0, escaped_w = 0, lost_w = 0;
  std::uint64_t refused_contributions = 0; ///< film contributions too large for its fixed point: 0 in a sound run
};

/// The same of the photons of a layer of interreflection: emitted = absorbed (by any surface, or inside glass) + escaped + lost.
struct IndirectBalance {
  double emitted_w = 0, absorbed_w = 0, escaped_w = 0, lost_w = 0;
};

struct Snapshot {
  std::shared_ptr<const Picture> picture;
  Progress progress;
  EnergyBalance energy;
  std::optional<IndirectBalance> indirect_energy;     ///< where there is such a layer
  std::vector<std::pair<std::string, double>> phases; ///< seconds a phase, e.g. {"photons", 3.2}
  std::shared_ptr<const History> history;             ///< of its error so far; null where nothing is measured
  std::uint64_t adoption = 0;                         ///< the newest Worker::adopt() that it knows of; the worker's to set
};

class Job {
public:
  virtual ~Job() = default;
  /// One short piece of work, about 50 ms. Never called once finished() is true.
  virtual void step() = 0;
  virtual bool finished() const = 0;
  virtual Progress progress() const = 0;
  /// Reads the device's state and makes a picture of it: a few milliseconds; with smoothing a tenth of a second or more for large pictures.
  virtual Snapshot snapshot() = 0;
  /// Of its error so far, without a snapshot; null where nothing is measured.
  virtual std::shared_ptr<const History> history() const { return nullptr; }
  /// Writes everything needed to go on later with the same bits. Opaque; versioned by the engine.
  virtual void save(ByteSink& to) = 0;
  /// Reads what save() wrote, to its end. Throws bad_input where that is of another version or preset, or is cut.
  virtual void load(ByteSource& from) = 0;
  /// Takes on another preset without starting again, where it can: where only the light differs (preset::only_relit) and the job keeps
  /// what it needs to weigh it anew. What was computed so far stays. False, and nothing has changed, where it cannot. Throws bad_input at
  /// FILE#/scene/lights/... for a spectrum that cannot be used; nothing has changed then either.
  virtual bool adopt(const preset::Preset&) { return false; }
};

} // namespace nephroid::job
