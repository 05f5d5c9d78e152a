// SPDX-License-Identifier: Apache-2.0
// The picture as the stages' films have it so far: layer by layer, smoothed, and the sum of them. While a layer has
// little light, what the preview shows stands in for it.
#pragma once
#include "photons/block_smoothing.h"
#include "photons/passes.h"
#include "photons/preview.h"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::photons {

class Development {
public:
  /// smoothing: of caustics, if any; smooths_paths: also of what paths from the eye see of lights. World, passes and
  /// preview outlive it.
  Development(const DeviceWorld& world, const Passes& passes, const Preview& preview,
              std::optional<BlockSmoothing> smoothing, bool smooths_paths)
      : world_(world), passes_(passes), preview_(preview), smoothing_(std::move(smoothing)),
        smooths_paths_(smooths_paths) {}

  job::Picture picture();
  /// Allocates the work of the next passes out by how much each stage lowers the picture's noise: the sum of the
  /// variances V_s of what takes the work w_s a pass, V_s w_s being as it is, is smallest where all V_s / w_s are
  /// alike. Work is counted, not timed, so that a seed has its bits. The square of a pixel's noise is over that of its
  /// light, as in the metric rel_mse.
  void share_work();

  bool smooths() const { return smoothing_.has_value(); }
  /// Looks through all pixels before a picture waits for it.
  void prepare();
  /// Of all pictures since the program began; no work of the run's.
  double smoothing_seconds() const { return smoothing_seconds_; }

  /// As photons::PhotonJob.
  void set_estimate(std::vector<float> caustics) { estimate_ = std::move(caustics); }
  void smooth(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> estimate);

private:
  /// Without layers, with room for a draw of its error where films have halves.
  job::Picture black(const Blocks& blocks) const;
  job::Picture black() const { return black({world_.tables.camera.width, world_.tables.camera.height, 1}); }
  /// The preview of a stage's layer, smoothed, of [pixel][3].
  LayerEstimate preview_of(Stage& stage);
  /// The layer of a stage of no caustics.
  LayerEstimate layer_of(std::size_t stage);
  /// The layer of all stages of caustics.
  LayerEstimate caustics();
  template <class Work>
  void timed(const Work& work) {
    smoothing_seconds_ += seconds_of(work);
  }

  const DeviceWorld& world_;
  const Passes& passes_;
  const Preview& preview_;
  std::optional<BlockSmoothing> smoothing_;
  bool smooths_paths_;
  std::vector<float> estimate_; ///< PhotonJob::set_estimate
  double smoothing_seconds_ = 0;
};

} // namespace nephroid::photons
