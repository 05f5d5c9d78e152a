// SPDX-License-Identifier: Apache-2.0
#include "photons/block_smoothing.h"

#include "photons/mixture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace nephroid::photons {
namespace {

/// The pixels that a kernel of Smoothing may need, in the mean of all light: with more, caustics are smoothed in larger blocks.
constexpr double most_needed = 24;

/// The pixels that a kernel of single ones would need, in the mean of all light. layer: with a value for each block.
double pixels_needed(const Blocks& blocks, const Noisy& layer)
{
  const std::vector<double> light = light_of(layer.rgb), portion = portions(light, layer.draw, blocks.across(), blocks.down());
  double needed = 0, all = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    needed += std::max(portion[i] / (Smoothing::noise * Smoothing::noise), light[i]);
    all += light[i];
  }
  return all > 0 ? needed / all * blocks.edge * blocks.edge : 1;
}

/// Adds to the draw of a layer in blocks what these hide of the picture: about as much as blocks twice as large hide of it, and no more
/// than there is.
void add_hidden(const Blocks& blocks, Noisy& layer)
{
  const Blocks pairs{blocks.across(), blocks.down(), 2};
  const std::vector<float> larger = between_blocks(pairs, mean_of_blocks(pairs, layer.rgb));
  for (std::size_t i = 0; i < layer.draw.size(); ++i) {
    const float hidden = std::min(std::abs(layer.rgb[i] - larger[i]), std::abs(layer.rgb[i]));
    layer.draw[i] = std::copysign(std::hypot(layer.draw[i], hidden), layer.draw[i]);
  }
}

} // namespace

Noisy means(const Blocks& blocks, const Noisy& layer)
{
  return {mean_of_blocks(blocks, layer.rgb), layer.draw.empty() ? layer.draw : mean_of_blocks(blocks, layer.draw)};
}

Noisy between(const Blocks& blocks, const Noisy& layer)
{
  return {between_blocks(blocks, layer.rgb), layer.draw.empty() ? layer.draw : between_blocks(blocks, layer.draw)};
}

BlockSmoothing::BlockSmoothing(const scene::Scene& scene, const scene::Bvh& bvh, Smoothing::Spread spread, int first_edge)
    : first_{scene.camera.width, scene.camera.height, first_edge}
{
  const std::shared_ptr<const Smoothing::View> view = Smoothing::view_of(scene, bvh);
  for (Blocks blocks{first_.width, first_.height, first_edge > 1 ? 2 * first_edge : 1}; blocks.edge > 0; blocks.edge /= 2)
    levels_.push_back({blocks, Smoothing(view, blocks.across(), blocks.down(), spread)});
}

Noisy BlockSmoothing::pixels_of(const Blocks& blocks, Noisy layer)
{
  const auto level = std::ranges::find(levels_, blocks.edge, [](const Level& of) { return of.blocks.edge; });
  level->smoothing.spread(layer.rgb, layer.draw);
  add_hidden(blocks, layer);
  return between(blocks, layer);
}

void BlockSmoothing::spread(Noisy& caustics, const Smoothing::Known& known)
{
  auto level = levels_.end() - 1;
  if (first_.edge > 1) {
    const double needed = pixels_needed(first_, means(first_, caustics));
    while (level != levels_.begin() && needed / level->blocks.edge / level->blocks.edge > most_needed) --level;
  }
  if (level->blocks.edge == 1) return level->smoothing.spread(caustics.rgb, caustics.draw, known);
  Noisy blocks = means(level->blocks, caustics);
  if (level->blocks.edge >= first_.edge) { // the pixels hold next to nothing
    caustics = pixels_of(level->blocks, std::move(blocks));
    return;
  }
  level->smoothing.spread(blocks.rgb, blocks.draw);
  Noisy spread = between(level->blocks, blocks);
  keep_fine(std::move(caustics), spread);
  caustics = std::move(spread);
}

void BlockSmoothing::keep_fine(Noisy plain, Noisy& spread) const
{
  const std::vector<double> light = light_of(plain.rgb), portion = portions(light, plain.draw, first_.width, first_.height),
                            light_spread = light_of(spread.rgb);
  // Where few portions fell, or none, their noise cannot be told: there nothing speaks for the plain layer.
  constexpr double least_portions = 16, around = 15 * 15; // pixels
  for (std::size_t i = 0; i < light.size(); ++i)
    if (portion[i] <= 0 || light_spread[i] * around < least_portions * portion[i])
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) plain.rgb[c] = spread.rgb[c], plain.draw[c] = spread.draw[c];
  mix(plain.rgb, plain.draw, {plain.rgb, plain.draw}, light, first_.width, first_.height, spread.rgb, spread.draw);
}

} // namespace nephroid::photons
