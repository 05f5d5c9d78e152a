// SPDX-License-Identifier: Apache-2.0
// One kind of work that every pass of engine 1 has: the direct layer, photons that are splatted, photon maps, ... A
// stage owns its kernels and films; the job gives each its turn. Sums are exact, so how a stage cuts its pass into
// steps changes no bit. Each file NAME_stage.cpp has one.
#pragma once
#include "job/job.h"
#include "photons/energy.h"
#include "photons/plan_part.h"
#include "photons/tables/device_world.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "tracing/state.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid::photons {

/// A path from the eye takes about as long as a photon, and twice as long through glass. A sample of the
/// layers "direct" and "background" is of so many paths there (PATHS_THROUGH_GLASS in kernels/tracing/eye_path.h).
inline constexpr double work_of_a_path = 1, work_through_glass = 2, paths_through_glass = 4;

/// The noise of a stage's layer, and what it is to the picture.
struct Noise {
  const std::vector<float>& draw;  ///< of the layer's error, [pixel][3]
  const std::vector<float>& light; ///< of the whole picture, [pixel][3]
  std::int64_t passes = 0;         ///< that the layer had until now
  double photon_gain = 0; ///< by how much a photon that is splatted lowers the sum of noise_beside() of all pixels

  /// As in the metric rel_mse.
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
  /// Of its phase in run.json.
  virtual const char* name() const = 0;
  /// Runs its kernels once without effect on what it computes: OpenCL compiles them when they first run, and that is no
  /// work of the run's. The shared energy counters are the caller's to reset.
  virtual void warm_up(const Communicator& communicator) {
    ByteStore kept; // little: films are still all 0, and such pieces are left out
    tracing::State before(kept, communicator);
    state(before);
    advance(0);
    StoredBytes bytes(kept.bytes(), name());
    tracing::State back(bytes, communicator);
    state(back);
  }
  /// How many passes it takes part in: what has had enough samples takes no more.
  virtual std::int64_t passes() const { return preset::max_passes; }
  /// One slice of about 30 ms of a pass that it takes part in. True when its part of that pass is complete: it is asked
  /// again in the next.
  virtual bool advance(std::int64_t pass) = 0;
  /// One slice of its part of a preview (DeviceWorld::preview), before the first pass. True when that is complete.
  virtual bool advance_preview() { return true; }
  /// Adds its layers to the preview, as develop.
  virtual void develop_preview(job::Picture& /*picture*/) {}
  /// How much of the pass in hand is done, 0..1, 0 before its first step and after its last.
  virtual double fraction_done() const = 0;
  /// Adds its layers to the picture, and its error to Picture::error_draw (add_layer in film.h), as the means of
  /// `passes` complete passes and what is done of the one in hand, which has the number `passes`; done: whether it has
  /// had its turn in that pass already.
  virtual void develop(std::int64_t passes, bool done, job::Picture& picture) = 0;
  /// Whether both halves of its film are whole by then: only then there is a draw of its error.
  virtual bool has_halves(std::int64_t passes, bool done) const { return passes + (done ? 1 : 0) >= 2; }
  /// Adds the radiance of its layer in a pixel, as develop; false where its film knows colours only.
  virtual bool add_spectrum(std::int64_t /*passes*/, bool /*done*/, job::PixelSpectrum& /*to*/) { return false; }
  /// Adds where the power of its photons went in the same passes, if it keeps counters of its own.
  virtual void report(std::int64_t /*passes*/, bool /*done*/, Energy& /*energy*/) {}
  /// Sees to it that in the next passes, as many as there were, its paths from the eye lower the noise by as much as
  /// photons that take as much work.
  virtual void share_work(const Noise& /*noise*/) {}
  /// Photons sent in one pass; 0 where it sends none.
  virtual std::uint64_t photons_per_pass() const { return 0; }
  /// Whether theirs is the power in DeviceWorld::energy.
  virtual bool counts_energy() const { return false; }
  /// Everything that it needs to go on with the same bits.
  virtual void state(tracing::State& state) = 0;
};

/// RunPart::make.
template <class Kind>
std::unique_ptr<Stage> make_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings) {
  return std::make_unique<Kind>(world, scene, settings);
}

} // namespace nephroid::photons
