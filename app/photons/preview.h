// SPDX-License-Identifier: Apache-2.0
// The previews of a run, before its first pass: coarse ones, in blocks of pixels, each finer than the one before (coarse.h).
#pragma once
#include "photons/passes.h"

#include <cstddef>
#include <vector>

namespace nephroid::photons {

class Preview {
public:
  /// edges: of the blocks of each picture (preview_edges); none: there is no preview.
  Preview(DeviceWorld& world, std::vector<int> edges) : world_(world), edges_(std::move(edges)) {}

  bool has_more() const { return pictures_ < edges_.size(); }
  bool has_picture() const { return pictures_ > 0; }
  /// Renders the next picture, whole: nobody wants to see a part of it.
  void next(Passes& passes);

  void state(tracing::State& state);

private:
  /// Sets DeviceWorld::preview.
  void begin_picture();

  DeviceWorld& world_;
  std::vector<int> edges_;
  std::size_t pictures_ = 0; ///< that have begun
};

} // namespace nephroid::photons
