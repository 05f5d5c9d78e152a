// SPDX-License-Identifier: Apache-2.0
// The photons of a pass in steps of about 50 ms: slice s of n has the photons s, s + n, s + 2 n, ..., so that each is a fair sample of all.
#pragma once
#include "tracing/state_bytes.h"
#include "tracing/step_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nephroid::tracing {

class PhotonSlices {
public:
  double part() const { return static_cast<double>(at_.slice) / at_.slices; }
  /// How many of the photons 0 .. photons - 1 of the pass in hand are done.
  std::uint32_t done_of(std::uint32_t photons) const
  {
    return photons / at_.slices * at_.slice + std::min(photons % at_.slices, at_.slice);
  }
  /// Whether the next step is the first of a pass.
  bool at_start() const { return at_.slice == 0; }

  /// Calls work(offset, stride, count) for the next slice of `photons` photons. True when the pass is complete.
  template <class Work>
  bool step(std::uint32_t photons, const Work& work)
  {
    if (at_start())
      at_.slices = static_cast<std::uint32_t>(std::clamp<std::int64_t>(std::llround(photons / photons_a_step_.amount()), 1, photons));
    const std::uint32_t count = (photons - at_.slice + at_.slices - 1) / at_.slices;
    photons_a_step_.timed(count, [&] { work(at_.slice, at_.slices, count); });
    if (++at_.slice < at_.slices) return false;
    at_ = {};
    return true;
  }

  void save(StateWriter& to) const { to.value(at_); }
  void load(StateReader& from) { from.value(at_); }

private:
  struct Position {
    std::uint32_t slice = 0, slices = 1;
  };
  Position at_;
  StepSize photons_a_step_{8192};
};

} // namespace nephroid::tracing
