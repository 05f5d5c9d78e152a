// SPDX-License-Identifier: Apache-2.0
// The pixels of a pass, or its rows, in steps of about 50 ms.
#pragma once
#include "tracing/state_bytes.h"
#include "tracing/step_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nephroid::tracing {

class PixelSteps {
public:
  /// size: how many a pass has to begin with. first_step: how many the first step has.
  PixelSteps(std::int64_t size, std::int64_t first_step) : size_(size), amount_(static_cast<double>(first_step)) {}

  double part() const { return size_ > 0 ? static_cast<double>(done_) / static_cast<double>(size_) : 0; }
  /// Of the pass in hand.
  std::int64_t done() const { return done_; }

  /// Calls work(first, count) for the next pixels (or rows) of the pass in hand, which has `size`; at most `most` at a time. True when the
  /// pass is complete.
  template <class Work>
  bool step(std::int64_t size, std::int64_t most, const Work& work)
  {
    size_ = size;
    const auto count = std::clamp<std::int64_t>(std::llround(amount_.amount()), 1, std::min(most, size - done_));
    amount_.timed(static_cast<double>(count), [&] { work(static_cast<std::uint32_t>(done_), static_cast<std::uint32_t>(count)); });
    done_ += count;
    if (done_ < size) return false;
    done_ = 0;
    return true;
  }

  void save(StateWriter& to) const
  {
    to.value(done_);
    to.value(size_);
  }
  void load(StateReader& from)
  {
    from.value(done_);
    from.value(size_);
  }

private:
  std::int64_t size_, done_ = 0;
  StepSize amount_;
};

} // namespace nephroid::tracing
