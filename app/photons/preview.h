// SPDX-License-Identifier: Apache-2.0
// The previews of a run, before its first pass: coarse pictures, in blocks of pixels, each finer than the one before
// (coarse.h).
#pragma once
#include "photons/passes.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace nephroid::photons {

class Preview {
public:
  /// edges are those of each picture's blocks (preview_edges). Without edges there is no preview.
  Preview(DeviceWorld& world, std::vector<int> edges) : world_(world), edges_(std::move(edges)) {}

  bool has_more() const { return pictures_ < edges_.size(); }
  bool has_picture() const { return pictures_ > 0; }
  /// Renders the whole next picture at once: a part of it would be of no use.
  void next(Passes& passes) {
    ++pictures_;
    begin_picture();
    for (std::size_t s = 0; s < passes.stages().size(); ++s)
      passes.work(s, [&] {
        while (!passes.stages()[s].stage->advance_preview()) {
        }
      });
  }

  void state(tracing::State& state) {
    state.value(pictures_);
    if (state.is_read() && has_picture()) begin_picture();
  }

private:
  /// Sets DeviceWorld::preview.
  void begin_picture() {
    constexpr unsigned batches_a_picture = 2;
    const Blocks blocks{world_.tables.camera.width, world_.tables.camera.height, edges_[pictures_ - 1]};
    std::vector<bool> may_show_glass(static_cast<std::size_t>(blocks.across()) *
                                     static_cast<std::size_t>(blocks.down()));
    for (const std::uint32_t pixel : world_.pixels.glass) may_show_glass[blocks.block_of(pixel)] = true;
    std::vector<std::uint32_t> glass;
    for (std::size_t block = 0; block < may_show_glass.size(); ++block)
      if (may_show_glass[block]) glass.push_back(static_cast<std::uint32_t>(block));
    world_.preview = {blocks, std::min(batches_a_picture * static_cast<unsigned>(pictures_), world_.tables.batches - 1),
                      compute::Buffer(world_.context, "blocks of glass", glass)};
  }

  DeviceWorld& world_;
  std::vector<int> edges_;
  std::size_t pictures_ = 0; ///< number of pictures that have begun
};

} // namespace nephroid::photons
