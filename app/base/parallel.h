// SPDX-License-Identifier: Apache-2.0
// Work on a picture in blocks, on every core. What a block gives depends on the block alone, so that sums over blocks,
// added in their order, have the same bits on any number of cores.
#pragma once
#include <cstddef>
#include <functional>

namespace nephroid {

/// Calls work(block) once for each block 0..count-1, on several threads, and returns when all are done. If a call
/// throws, blocks not yet begun are left out and the exception is rethrown.
void for_blocks(std::size_t count, const std::function<void(std::size_t)>& work);

/// A half-open range of items.
struct Range {
  std::size_t begin = 0, end = 0;
};

/// Calls work(block, range) over 0..items-1 in blocks of `size`.
template <class Work>
void for_ranges(std::size_t items, std::size_t size, const Work& work) {
  for_blocks((items + size - 1) / size, [&](std::size_t block) {
    const std::size_t begin = block * size;
    work(block, Range{begin, begin + size < items ? begin + size : items});
  });
}

/// Calls work(i) for each i of 0..items-1, where a call takes little.
template <class Work>
void for_items(std::size_t items, const Work& work) {
  constexpr std::size_t items_of_a_block = 1 << 13;
  for_ranges(items, items_of_a_block, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) work(i);
  });
}

} // namespace nephroid
