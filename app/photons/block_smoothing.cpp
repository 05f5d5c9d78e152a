// SPDX-License-Identifier: Apache-2.0
#include "photons/block_smoothing.h"

#include "base/parallel.h"
#include "photons/mixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

namespace nephroid::photons {
namespace {

/// The most pixels of a kernel, as the mean over all light: with more, caustics are smoothed in larger blocks.
constexpr double most_needed = 24;

/// The pixels that a kernel of single pixels would need, as the mean over all light. layer: [block].
double pixels_needed(const Blocks& blocks, const LayerEstimate& layer) {
  const std::vector<double> light = light_of(layer.rgb),
                            portion = portions(light, layer.draw, blocks.across(), blocks.down());
  const double light_sum = std::reduce(light.begin(), light.end());
  const double needed = std::reduce(portion.begin(), portion.end()) / (Smoothing::usual_noise * Smoothing::usual_noise);
  return light_sum > 0 ? needed / light_sum * blocks.edge * blocks.edge : 1;
}

/// Adds to a layer's draw what its blocks hide: as much as blocks twice as large do, and no more than there is.
void add_hidden(const Blocks& blocks, LayerEstimate& layer) {
  const Blocks pairs{blocks.across(), blocks.down(), 2};
  const std::vector<float> larger = between_blocks(pairs, mean_of_blocks(pairs, layer.rgb));
  for_items(layer.draw.size(), [&](std::size_t i) {
    const float hidden = std::min(std::abs(layer.rgb[i] - larger[i]), std::abs(layer.rgb[i]));
    layer.draw[i] = std::copysign(std::hypot(layer.draw[i], hidden), layer.draw[i]);
  });
}

/// `of` with the colours of `colour`, whose light is not needed: both halves of it. A place without light in `colour`
/// stays as it is.
LayerEstimate recoloured(const LayerEstimate& of, const LayerEstimate& colour) {
  LayerEstimate result = of;
  for_items(of.rgb.size() / 3, [&](std::size_t pixel) {
    const std::size_t i = 3 * pixel;
    std::array<float, 3> half[2];
    for (int h = 0; h < 2; ++h) {
      const float sign = h == 0 ? 1.0f : -1.0f;
      float light = 0, coloured = 0;
      for (std::size_t c = i; c < i + 3; ++c) {
        light += of.rgb[c] + sign * of.draw[c];
        coloured += std::max(colour.rgb[c] + sign * colour.draw[c], 0.0f);
      }
      for (std::size_t c = 0; c < 3; ++c)
        half[h][c] = coloured > 0 ? std::max(colour.rgb[i + c] + sign * colour.draw[i + c], 0.0f) * light / coloured
                                  : of.rgb[i + c] + sign * of.draw[i + c];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      result.rgb[i + c] = (half[0][c] + half[1][c]) / 2;
      result.draw[i + c] = (half[0][c] - half[1][c]) / 2;
    }
  });
  return result;
}

} // namespace

LayerEstimate means(const Blocks& blocks, const LayerEstimate& layer) {
  return {mean_of_blocks(blocks, layer.rgb), layer.draw.empty() ? layer.draw : mean_of_blocks(blocks, layer.draw)};
}

LayerEstimate between(const Blocks& blocks, const LayerEstimate& layer) {
  return {between_blocks(blocks, layer.rgb), layer.draw.empty() ? layer.draw : between_blocks(blocks, layer.draw)};
}

BlockSmoothing::BlockSmoothing(const scene::Scene& scene, const scene::Bvh& bvh, Smoothing::Spread spread,
                               int first_preview_edge, Smoothing::FindTexture find_texture)
    : first_{scene.camera.width, scene.camera.height, first_preview_edge} {
  const std::shared_ptr<const Smoothing::View> view = Smoothing::view_of(scene, bvh);
  for (Blocks blocks{first_.width, first_.height, first_preview_edge > 1 ? 2 * first_preview_edge : 1}; blocks.edge > 0;
       blocks.edge /= 2)
    levels_.push_back({blocks, blocks.edge > 1
                                   ? Smoothing(view, blocks.across(), blocks.down(), spread)
                                   : Smoothing(view, blocks.across(), blocks.down(), spread, find_texture)});
}

LayerEstimate BlockSmoothing::pixels_of(const Blocks& blocks, LayerEstimate layer, double noise) {
  const auto level = std::ranges::find(levels_, blocks.edge, [](const Level& of) { return of.blocks.edge; });
  level->smoothing.spread_light(layer.rgb, layer.draw, {}, noise);
  add_hidden(blocks, layer);
  return between(blocks, layer);
}

void BlockSmoothing::spread(LayerEstimate& caustics) {
  for (std::vector<float>* values : {&caustics.rgb, &caustics.draw}) pixels().take_textures_out(*values);
  spread_light(caustics);
  for (std::vector<float>* values : {&caustics.rgb, &caustics.draw}) pixels().put_textures_in(*values);
}

void BlockSmoothing::spread_light(LayerEstimate& caustics) {
  std::size_t chosen = levels_.size() - 1;
  if (first_.edge > 1) {
    const double needed = pixels_needed(first_, means(first_, caustics));
    while (chosen > 0 && needed / levels_[chosen].blocks.edge / levels_[chosen].blocks.edge > most_needed) --chosen;
  }
  if (levels_[chosen].blocks.edge >= first_.edge && first_.edge > 1) { // single pixels hold next to nothing
    caustics = pixels_of(levels_[chosen].blocks, means(levels_[chosen].blocks, caustics), Smoothing::usual_noise);
    return;
  }
  const LayerEstimate& plain = caustics;
  const std::vector<double> light = light_of(plain.rgb),
                            portion = portions(light, plain.draw, first_.width, first_.height);
  std::vector<LayerEstimate> spread(levels_.size()); // by block
  const auto spread_in_level = [&](std::size_t level) {
    if (spread[level].rgb.empty()) spread[level] = spread_in(levels_[level], plain);
    return between(levels_[level].blocks, spread[level]);
  };
  LayerEstimate mixed = spread_in_level(chosen);
  const auto mix_in = [&](const LayerEstimate& estimate, int radius = error_radius) {
    mix(plain.rgb, plain.draw, {estimate.rgb, estimate.draw}, light, first_.width, first_.height, mixed.rgb, mixed.draw,
        radius);
  };
  for (std::size_t finer = chosen + 1; finer < levels_.size(); ++finer) {
    LayerEstimate fine = spread_in_level(finer);
    // Where few portions fell, or none, their noise is unknown: there nothing supports the finer estimate.
    constexpr double least_portions = 16, around = 15 * 15; // pixels
    const std::vector<double> coarse_light = light_of(mixed.rgb);
    for_items(light.size(), [&](std::size_t i) {
      if (portion[i] <= 0 || coarse_light[i] * around < least_portions * portion[i])
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) fine.rgb[c] = mixed.rgb[c], fine.draw[c] = mixed.draw[c];
    });
    mix_in(fine);
  }
  const auto is_small = [&](std::size_t level) { return levels_[level].blocks.edge < first_.edge; };
  for (std::size_t level = chosen; level-- > 0 && is_small(level);) mix_in(spread_in_level(level));
  // Colours have more noise than light, so they come from larger blocks, and are judged over some of these.
  const LayerEstimate before = mixed;
  for (std::size_t level = levels_.size() - 1; level-- > 0;)
    mix_in(recoloured(mixed, spread_in_level(level)), error_radius + 2 * levels_[level].blocks.edge);
  add_bias(before.rgb, before.draw, mixed.rgb, mixed.draw, first_.width, first_.height);
  caustics = std::move(mixed);
}

LayerEstimate BlockSmoothing::spread_in(Level& level, const LayerEstimate& plain) {
  LayerEstimate blocks = means(level.blocks, plain);
  level.smoothing.spread_light(blocks.rgb, blocks.draw);
  return blocks;
}

} // namespace nephroid::photons
