// SPDX-License-Identifier: Apache-2.0
// Waiting for what another thread or process does: until it is seen, not for a time that a slow machine would need.
#pragma once
#include <chrono>
#include <thread>

namespace nephroid::test {

/// Calls step() and rests for a moment in turn until done(); says whether it was done before a minute was over, which no machine needs.
template <class Step, class Done>
bool eventually(Step step, Done done)
{
  using namespace std::chrono;
  const auto end = steady_clock::now() + minutes(1);
  while (!done()) {
    if (steady_clock::now() > end) return false;
    step();
    std::this_thread::sleep_for(microseconds(200));
  }
  return true;
}

/// The same where there is nothing to do but wait.
template <class Done>
bool eventually(Done done)
{
  return eventually([] {}, done);
}

} // namespace nephroid::test
