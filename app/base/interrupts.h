// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM as a stop token: the first asks for an orderly end, the second kills as usual.
#pragma once
#include <csignal>
#include <stop_token>
#include <thread>

namespace nephroid {

/// While one exists, the first SIGINT or SIGTERM sets token(), and a second one kills the process. Make it before any
/// other thread starts (by OpenCL, say), because threads inherit the signal mask. Its destructor restores the signals.
class Interrupts {
public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  std::stop_token token() const { return stop_.get_token(); }

private:
  std::stop_source stop_;
  sigset_t before_{};
  std::jthread waiter_;
};

} // namespace nephroid
