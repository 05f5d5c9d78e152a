// SPDX-License-Identifier: Apache-2.0
// A stage is one kind of work that every pass of a photon job has: the direct layer, photons that are splatted, photon
// maps, ... It owns its kernels and films; the job gives each its turn. Sums are exact, so slices change no bit.
#pragma once
#include "job/job.h"
#include "photons/energy.h"
#include "photons/plan_part.h"
#include "photons/stage_context.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "tracing/archive.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid::photons {

/// A path from the eye takes about as long as a photon, and twice as long through glass. There, a sample has about so
/// many paths or branches (PATHS_THROUGH_GLASS in kernels/transport/eye_path.h).
inline constexpr double work_of_a_path = 1, work_through_glass = 2, paths_through_glass = 4;

/// The noise of a stage, and how much it matters in the picture.
struct Noise {
  const std::vector<float>& draw;  ///< draw of the error that it brings, [pixel][3]; of photons, of the caustic layer's
  const std::vector<float>& light; ///< light of the whole picture, [pixel][3]
  std::int64_t passes = 0;         ///< passes of the layer until now
  double photon_gain = 0;          ///< by how much the work of a photon lowers the sum of noise_beside() of all pixels

  /// The relative error of the metric rel_mse.
  static double noise_beside(double light_squared, double noise_squared) {
    return noise_squared / (0.01 + light_squared);
  }
  double of(std::size_t channel) const {
    return noise_beside(std::pow(double{light[channel]}, 2), std::pow(double{draw[channel]}, 2));
  }
};

class Stage {
public:
  virtual ~Stage() = default;
  /// The name of its phase in run.json.
  virtual const char* name() const = 0;
  /// Runs its kernels once without effect on what it computes: OpenCL compiles them when they first run, and that is
  /// not part of the run's work. The caller resets the shared energy counters.
  virtual void warm_up(const Communicator& communicator) {
    ByteStore kept; // little: films are still all 0, and pieces of zeros are left out
    tracing::Archive before(kept, communicator);
    serialize(before);
    advance(0);
    StoredBytes bytes(kept.bytes(), name());
    tracing::Archive back(bytes, communicator);
    serialize(back);
  }
  /// The number of passes that it takes part in; it stops once it has enough samples.
  virtual std::int64_t passes() const { return preset::max_passes; }
  /// Does one slice of about 30 ms of a pass that it takes part in. True when its part of that pass is complete.
  virtual bool advance(std::int64_t pass) = 0;
  /// Does one slice of its part of a preview (StageContext::preview), before the first pass. True when that is
  /// complete.
  virtual bool advance_preview() { return true; }
  /// Adds its layers to the preview, as develop() does.
  virtual void develop_preview(job::Picture& /*picture*/) {}
  /// The fraction of the current pass that is done, 0..1; 0 before its first slice and after its last.
  virtual double fraction_done() const = 0;
  /// Adds its layers to the picture, and its error to Picture::error_draw (add_layer in film.h). They are the means of
  /// `passes` complete passes and the part of the current one, which has the number `passes`. done says whether the
  /// stage has had its turn in that pass.
  virtual void develop(std::int64_t passes, bool done, job::Picture& picture) = 0;
  /// Whether both halves of its film are complete by then: only then there is a draw of its error.
  virtual bool has_halves(std::int64_t passes, bool done) const { return passes + (done ? 1 : 0) >= 2; }
  /// Adds the radiance of its layer in a pixel, as develop() does. False where its film knows colours only.
  virtual bool add_spectrum(std::int64_t /*passes*/, bool /*done*/, job::PixelSpectrum& /*to*/) { return false; }
  /// Adds where the power of its photons went in the same passes, if it has counters of its own.
  virtual void report(std::int64_t /*passes*/, bool /*done*/, Energy& /*energy*/) {}
  /// Whether its noise is its own; photons share that of the caustic layer.
  virtual bool samples_pixels() const { return false; }
  /// The work of its samples until now, in that of a photon.
  virtual double work() const { return 0; }
  /// Decides the work of as many passes as there were: its paths are to gain as much as photons for their work.
  virtual void share_work(const Noise& /*noise*/) {}
  /// Of a meter, between cycles: how much the noise of each cell matters from now on, 0..1.
  virtual void weigh_cells(const std::vector<float>& /*worth*/) {}
  /// Photons sent in one pass; 0 where it sends none.
  virtual std::uint64_t photons_per_pass() const { return 0; }
  /// Whether StageContext::energy holds the power of its photons.
  virtual bool counts_energy() const { return false; }
  virtual void serialize(tracing::Archive& archive) = 0;
};

/// The function RunPart::make of a stage.
template <class Kind>
std::unique_ptr<Stage> make_stage(StageContext& world, const scene::Scene& scene, const Settings& settings) {
  return std::make_unique<Kind>(world, scene, settings);
}

} // namespace nephroid::photons
