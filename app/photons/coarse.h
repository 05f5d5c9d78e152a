// SPDX-License-Identifier: Apache-2.0
// Pictures of fewer pixels than the run's, for what few photons and few paths can show: a pixel of theirs is a block of the run's.
#pragma once
#include "tracing/film.h"

#include <span>
#include <vector>

namespace nephroid::photons {

/// A picture of width x height pixels in blocks of so many across and down; those at its right and lower border may be cut.
struct Blocks {
  int width, height, edge;
  int across() const { return (width + edge - 1) / edge; }
  int down() const { return (height + edge - 1) / edge; }
};

/// The shortest edge, a power of two, with which a picture is small enough to be worked out at once.
int edge_of_first_picture(int width, int height);

/// The same film with the sums and the samples of blocks.
tracing::Film film_of_blocks(const Blocks& blocks, const tracing::Film& film);

/// rgb: [block][3]. The picture of [pixel][3] that changes evenly from the middle of each block to the next.
std::vector<float> between_blocks(const Blocks& blocks, std::span<const float> rgb);

} // namespace nephroid::photons
