// SPDX-License-Identifier: Apache-2.0
// Pictures in blocks of the run's pixels, for what few photons and few paths can show.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace nephroid::photons {

/// A picture of width x height pixels in blocks of edge x edge; those at its right and lower border may be cut.
struct Blocks {
  int width, height, edge;
  int across() const { return (width + edge - 1) / edge; }
  int down() const { return (height + edge - 1) / edge; }
  std::size_t count() const { return static_cast<std::size_t>(across()) * static_cast<std::size_t>(down()); }
  std::size_t block_of(std::size_t pixel) const {
    const auto columns = static_cast<std::size_t>(width), side = static_cast<std::size_t>(edge);
    return pixel / columns / side * static_cast<std::size_t>(across()) + pixel % columns / side;
  }
};

/// The edges of the blocks of a run's previews: powers of two above 1, each half of the one before. The first preview
/// has about 32 x 32 blocks and is there at once, the others follow soon. A picture of few pixels has none.
std::vector<int> preview_edges(int width, int height);

/// Returns the means of blocks, [block][3]. rgb is [pixel][3].
std::vector<float> mean_of_blocks(const Blocks& blocks, std::span<const float> rgb);

/// Returns a draw of the error of mean_of_blocks() while a film has only one half: every other pixel's light, as of a
/// checkerboard, against that of the others. Light that changes within a block, or fills one of an odd number of
/// pixels, counts as noise. Noise that neighbours share does not.
std::vector<float> draw_by_places(const Blocks& blocks, std::span<const float> rgb);

/// Returns a picture, [pixel][3], that changes evenly from the middle of each block to the next. rgb is [block][3].
std::vector<float> between_blocks(const Blocks& blocks, std::span<const float> rgb);

} // namespace nephroid::photons
