// SPDX-License-Identifier: Apache-2.0
// The pixels of a pass in steps of about 50 ms, some rows at a time from the top.
#pragma once
#include "preset/preset.h"
#include "tracing/film.h"
#include "tracing/state_bytes.h"
#include "tracing/step_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace nephroid::tracing {

class PixelRows {
public:
  explicit PixelRows(std::int64_t height) : height_(height) {}
  double part() const { return static_cast<double>(row_) / static_cast<double>(height_); }
  /// Rows of the pass in hand that are done.
  std::int64_t done() const { return row_; }
  /// Whether a row of the pass in hand is done.
  bool is_done(std::int64_t row) const { return row < row_; }

  /// What the halves of a film have of a row (Film::samples) after `passes` complete passes and this one in hand, or all of it where it is
  /// `done`. Passes from `most` on add nothing.
  std::array<double, 2> samples(int row, std::int64_t passes, bool done, std::int64_t most = preset::max_passes) const
  {
    if (passes >= most) return halves_of(most, 0);
    return halves_of(passes, done || is_done(row) ? 1 : 0);
  }

  /// Calls work(first_row, rows) for the next rows. True when the pass is complete.
  template <class Work>
  bool step(const Work& work)
  {
    return step(height_, work);
  }
  /// The same for at most so many rows.
  template <class Work>
  bool step(std::int64_t most, const Work& work)
  {
    const auto rows = std::clamp<std::int64_t>(std::llround(rows_a_step_.amount()), 1, std::min(most, height_ - row_));
    rows_a_step_.timed(static_cast<double>(rows), [&] { work(static_cast<int>(row_), static_cast<int>(rows)); });
    row_ += rows;
    if (row_ < height_) return false;
    row_ = 0;
    return true;
  }

  void save(StateWriter& to) const { to.value(row_); }
  void load(StateReader& from) { from.value(row_); }

private:
  std::int64_t height_;
  std::int64_t row_ = 0;
  StepSize rows_a_step_{16};
};

} // namespace nephroid::tracing
