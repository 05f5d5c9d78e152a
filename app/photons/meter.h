// SPDX-License-Identifier: Apache-2.0
// A meter of the preset (scene/meter.h) as a run: photons and paths from its cells, in eight independent replicates.
#pragma once
#include "mpi/rank_context.h"
#include "photons/plan.h"
#include "scene/meter.h"
#include "tracing/archive.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nephroid::photons {

/// Light that reaches a meter in one way.
struct MeterLayer {
  std::string name; ///< "direct": of lamps; "sky": both straight; "caustic", "indirect"
  /// [replicate][cell][2]: irradiance in W/m^2, and as an eye sees it (Y, no factor 683).
  std::vector<double> replicates;
};

class MeterRun {
public:
  virtual ~MeterRun() = default;
  /// Does one slice of about 30 ms.
  virtual void advance() = 0;
  /// Cycles so far, all of about the same work. In the first each stage has one pass in each replicate. In those after
  /// it, a stage has as many for each as lower the noise of the mean and the peak most (layers).
  virtual std::int64_t cycles() const = 0;
  /// Photons sent so far.
  virtual std::uint64_t photons() const = 0;
  /// Seconds of work.
  virtual double work_seconds() const = 0;
  /// Right after a cycle. steers: the work of the next ones is shared out by the noise until then.
  virtual std::vector<MeterLayer> layers(bool steers) = 0;
  /// The part of the photons' power that met too many surfaces.
  virtual double lost_share() = 0;
  /// Contributions that were too large for a film: 0 in a sound run.
  virtual std::uint64_t refused() = 0;
  /// Everything needed to go on later with the same bits.
  virtual void serialize(tracing::Archive& archive) = 0;
};

/// view: of scene::meter_view, whose camera is the meter. wanted: the run's settings for photons. What a meter has no
/// use for is left out. No layers: it is dark.
RunPlan plan_meter(const preset::Preset& preset, const Settings& wanted, const scene::Scene& view,
                   const scene::Bvh& bvh);

/// Throws as make_job does.
std::unique_ptr<MeterRun> make_meter_run(const preset::Preset& preset, const scene::Scene& view, const scene::Bvh& bvh,
                                         const RunPlan& plan, const mpi::RankContext& context);

} // namespace nephroid::photons
