// SPDX-License-Identifier: Apache-2.0
// A thread that waits for signals rather than a handler: a handler may not take the lock inside a stop source.
#include "base/interrupts.h"

#include <ctime>
#include <pthread.h>

namespace nephroid {
namespace {

sigset_t waited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// Ends the process as the signal does by default, so that shells see the cause.
void die_of(int signal) {
  ::signal(signal, SIG_DFL);
  const sigset_t signals = waited_signals();
  ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  ::raise(signal);
}

void wait_for_signals(const std::stop_token& ended, std::stop_source stop) {
  const sigset_t signals = waited_signals();
  const timespec look_up{0, 50'000'000}; // notice the owner's end within 50 ms
  while (!ended.stop_requested()) {
    const int signal = ::sigtimedwait(&signals, nullptr, &look_up);
    if (signal < 0) continue;
    if (!stop.request_stop()) die_of(signal);
  }
}

} // namespace

Interrupts::Interrupts() {
  const sigset_t signals = waited_signals();
  ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
  waiter_ = std::jthread([stop = stop_](const std::stop_token& ended) { wait_for_signals(ended, stop); });
}

Interrupts::~Interrupts() {
  waiter_ = {}; // asks the thread to end and joins it
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

} // namespace nephroid
