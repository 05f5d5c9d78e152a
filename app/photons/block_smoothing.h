// SPDX-License-Identifier: Apache-2.0
// Smoothing in blocks of pixels: what few photons have shown is spread farther and sooner than pixel by pixel.
#pragma once
#include "photons/coarse.h"
#include "photons/smoothing.h"

#include <span>
#include <vector>

namespace nephroid::photons {

/// A layer with a draw of its error (job::Picture::error_draw), which is empty where it is not known; both of
/// [pixel][3].
struct LayerEstimate {
  std::vector<float> rgb, draw;
};

LayerEstimate means(const Blocks& blocks, const LayerEstimate& layer);
/// layer: with a value for each block. With one for each pixel, as between_blocks().
LayerEstimate between(const Blocks& blocks, const LayerEstimate& layer);

class BlockSmoothing {
public:
  /// first_preview_edge: of the blocks of a run's preview; 1 where it has none, and light is spread from pixel to pixel
  /// only.
  BlockSmoothing(const scene::Scene& scene, const scene::Bvh& bvh, Smoothing::Spread spread, int first_preview_edge);

  /// From pixel to pixel.
  Smoothing& pixels() { return levels_.back().smoothing; }
  /// blocks: those of a preview, whose `layer` has a value for each. The layer of pixels, smoothed.
  LayerEstimate pixels_of(const Blocks& blocks, LayerEstimate layer);
  /// Spreads caustics in blocks so large that their noise needs no wide kernels. Then mixes in what smaller and larger
  /// blocks make of them, where the halves say that it is better (mixture.h). known: for single pixels.
  void spread(LayerEstimate& caustics, const Smoothing::BiasedEstimate& known);

private:
  struct Level {
    Blocks blocks;
    Smoothing smoothing;
  };
  static LayerEstimate spread_in(Level& level, LayerEstimate plain, const Smoothing::BiasedEstimate& known);

  std::vector<Level>
      levels_; ///< from twice first_preview_edge to single pixels, each with half the edge of that before
  Blocks first_;
};

} // namespace nephroid::photons
