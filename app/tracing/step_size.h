// SPDX-License-Identifier: Apache-2.0
// How long a step of a job is.
#pragma once
#include <algorithm>
#include <chrono>

namespace nephroid::tracing {

/// How much work fits into a step, learned from the steps before.
class StepSize {
public:
  explicit StepSize(double start) : amount_(start) {}
  double amount() const { return amount_; }
  /// Calls work(), which does `amount` of it, and learns from the time it took. It learns slowly, because the first step of a kernel also
  /// compiles it, and the rows of a picture differ.
  template <class Work>
  void timed(double amount, const Work& work)
  {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    work();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    amount_ = std::clamp(amount * step_seconds / std::max(seconds, 1e-6), 0.25 * amount_, 1.5 * amount_);
  }

private:
  static constexpr double step_seconds = 0.05;
  double amount_;
};

} // namespace nephroid::tracing
