// SPDX-License-Identifier: Apache-2.0
#include "photons/preview.h"

#include <algorithm>

namespace nephroid::photons {

void Preview::next(Passes& passes)
{
  ++pictures_;
  begin_picture();
  for (std::size_t s = 0; s < passes.stages().size(); ++s)
    passes.work(s, [&] {
      while (!passes.stages()[s].stage->advance_preview()) {
      }
    });
}

void Preview::begin_picture()
{
  constexpr unsigned rounds_a_picture = 2;
  const Blocks blocks{world_.tables.camera.width, world_.tables.camera.height, edges_[pictures_ - 1]};
  std::vector<bool> may_show_glass(static_cast<std::size_t>(blocks.across()) * static_cast<std::size_t>(blocks.down()));
  for (const std::uint32_t pixel : world_.pixels.glass) may_show_glass[blocks.block_of(pixel)] = true;
  std::vector<std::uint32_t> glass;
  for (std::size_t block = 0; block < may_show_glass.size(); ++block)
    if (may_show_glass[block]) glass.push_back(static_cast<std::uint32_t>(block));
  world_.preview = {blocks, std::min(rounds_a_picture * static_cast<unsigned>(pictures_), world_.tables.batches - 1),
                  compute::Buffer(world_.context, "blocks of glass", glass)};
}

void Preview::state(tracing::State& state)
{
  state.value(pictures_);
  if (state.is_read() && has_picture()) begin_picture();
}

} // namespace nephroid::photons
