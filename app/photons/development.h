// SPDX-License-Identifier: Apache-2.0
// Develops the stages' films into smoothed layers and their sum. While a layer has little light, its preview stands in.
#pragma once
#include "photons/block_smoothing.h"
#include "photons/passes.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::photons {

class Development {
public:
  /// smoothing is for caustics that glass and mirrors show, with smooths_splats for all, with smooths_paths also for
  /// what paths from the eye see. The references outlive this.
  Development(const StageContext& world, const Passes& passes, const Preview& preview,
              std::optional<BlockSmoothing> smoothing, bool smooths_splats, bool smooths_paths)
      : world_(world), passes_(passes), preview_(preview), smoothing_(std::move(smoothing)),
        smooths_splats_(smooths_splats), smooths_paths_(smooths_paths) {}

  job::Picture picture();
  /// Divides the work of the next passes among the stages by how much each lowers the picture's noise. A stage that
  /// does the work w_s a pass has the variance V_s, and V_s w_s is constant. The sum of the variances is smallest where
  /// all V_s / w_s are alike. Work is counted, not timed, so that a seed always gives the same bits. The square of a
  /// pixel's noise is divided by that of its light, as in the metric rel_mse.
  void share_work();

  bool smooths() const { return smoothing_.has_value(); }
  /// Finds the surfaces of all pixels, so that no picture has to wait for it.
  void prepare();
  /// The seconds of all pictures since the program began. They are not part of the run's work.
  double smoothing_seconds() const { return smoothing_seconds_; }

  /// See job::Job::begin_with.
  void begin_with(std::shared_ptr<const std::vector<job::Layer>> before) {
    is_frame_ = true;
    before_ = std::move(before);
  }
  /// Takes what the last picture leaves for the next frame (job::Snapshot::left).
  std::vector<job::Layer> left() { return std::exchange(left_, {}); }

  /// See PhotonJob::set_estimate.
  void set_estimate(std::vector<float> direct) { estimate_ = std::move(direct); }

private:
  /// A picture without layers, with room for a draw of its error where films have halves.
  job::Picture black(const Blocks& blocks) const;
  job::Picture black() const { return black({world_.tables.camera.width, world_.tables.camera.height, 1}); }
  /// The preview of a stage's layer, smoothed, [pixel][3]. noise: Smoothing::usual_noise's, for its light.
  LayerEstimate preview_of(Stage& stage, double noise);
  /// Smoothed values by pixel, from one of each block of the preview. noise: as for preview_of.
  LayerEstimate pixels_of(LayerEstimate coarse, double noise);
  LayerEstimate layer_of(std::size_t stage);
  LayerEstimate caustics();
  void smooth(LayerEstimate& caustics);
  /// Mixes what a stage has developed with what the frame before left of it, before it is smoothed: then it has less
  /// noise, and smoothing blurs less.
  void mix_with_before(const std::string& name, LayerEstimate& layer);
  template <class Work>
  void timed(const Work& work) {
    smoothing_seconds_ += tracing::seconds_of(work);
  }

  const StageContext& world_;
  const Passes& passes_;
  const Preview& preview_;
  std::optional<BlockSmoothing> smoothing_;
  bool smooths_splats_, smooths_paths_;
  std::vector<float> estimate_;                           ///< PhotonJob::set_estimate
  bool is_frame_ = false;                                 ///< of an animation
  std::shared_ptr<const std::vector<job::Layer>> before_; ///< may be null
  std::vector<job::Layer> left_;
  double smoothing_seconds_ = 0;
};

} // namespace nephroid::photons
