// SPDX-License-Identifier: Apache-2.0
// Smoothing in blocks of pixels: few photons' light is spread farther and sooner than pixel by pixel.
#pragma once
#include "photons/coarse.h"
#include "photons/smoothing.h"

#include <vector>

namespace nephroid::photons {

/// A layer and a draw of its error (job::Picture::error_draw), both [pixel][3]. The draw is empty where it is unknown.
struct LayerEstimate {
  std::vector<float> rgb, draw;
};

LayerEstimate means(const Blocks& blocks, const LayerEstimate& layer);
/// layer has a value for each block, the result one for each pixel, as in between_blocks().
LayerEstimate between(const Blocks& blocks, const LayerEstimate& layer);

class BlockSmoothing {
public:
  /// first_preview_edge: of the first preview's blocks; 1: there is none, and light goes from pixel to pixel.
  /// find_texture: Smoothing's, for pixels.
  BlockSmoothing(const scene::Scene& scene, const scene::Bvh& bvh, Smoothing::Spread spread, int first_preview_edge,
                 Smoothing::FindTexture find_texture);

  Smoothing& pixels() { return levels_.back().smoothing; }
  /// Returns a preview's layer, smoothed, by pixel. blocks are the preview's; `layer` has a value for each. It blurs
  /// textures: to find them would hold up a preview. noise: as Smoothing::usual_noise.
  LayerEstimate pixels_of(const Blocks& blocks, LayerEstimate layer, double noise);
  /// Spreads caustics in blocks so large that their noise needs no wide kernels. Then mixes in the results of smaller
  /// and larger blocks where the halves show a gain (mixture.h), and at last their colours. All that without textures.
  void spread(LayerEstimate& caustics);

private:
  struct Level {
    Blocks blocks;
    Smoothing smoothing;
  };
  /// The result is by block.
  static LayerEstimate spread_in(Level& level, const LayerEstimate& plain);
  void spread_light(LayerEstimate& caustics);

  std::vector<Level> levels_; ///< edges from twice first_preview_edge down to 1, each half of the one before
  Blocks first_;
};

} // namespace nephroid::photons
