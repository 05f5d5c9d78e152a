// SPDX-License-Identifier: Apache-2.0
// Pictures of fewer pixels than the run's, for what few photons and few paths can show: a pixel of theirs is a block of
// the run's.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace nephroid::photons {

/// A picture of width x height pixels in blocks of so many across and down; those at its right and lower border may be
/// cut.
struct Blocks {
  int width, height, edge;
  int across() const { return (width + edge - 1) / edge; }
  int down() const { return (height + edge - 1) / edge; }
  std::size_t block_of(std::size_t pixel) const {
    const auto columns = static_cast<std::size_t>(width), side = static_cast<std::size_t>(edge);
    return pixel / columns / side * static_cast<std::size_t>(across()) + pixel % columns / side;
  }
};

/// The edges of the blocks that a run's previews have, powers of two above 1, each half of the one before: the preview
/// has about 32 x 32 blocks and is there at once, the others soon. None where a picture has so few pixels anyway.
std::vector<int> preview_edges(int width, int height);

/// rgb: [pixel][3]. The means of blocks, [block][3].
std::vector<float> mean_of_blocks(const Blocks& blocks, std::span<const float> rgb);

/// rgb: [block][3]. The picture of [pixel][3] that changes evenly from the middle of each block to the next.
std::vector<float> between_blocks(const Blocks& blocks, std::span<const float> rgb);

} // namespace nephroid::photons
