// SPDX-License-Identifier: Apache-2.0
// Runs work that may crash, hang or ask for all memory, in a child process with limits: mesh readers meet corrupt files, and
// Assimp 5.2's PLY and glTF readers loop for ever or overrun the stack on some of them.
#pragma once
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace nephroid::scene {

/// The work did not come to its end; what() says why, as the rest of a sentence: "crashed (Segmentation fault)".
struct IsolatedFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct IsolationLimits {
  unsigned cpu_seconds = 5;
  std::size_t extra_memory_bytes = std::size_t{2} << 30; ///< address space beyond what this process has now
};

/// Calls work() in a forked child and gives back the bytes that it returned. The child has one thread and must not use
/// anything that other threads of this process may hold locked (the C library's allocator is safe), nor print. Throws
/// IsolatedFailure where the child dies or throws, and Error (failed) where the system has no process or pipe left.
std::string run_isolated(const std::function<std::string()>& work, const IsolationLimits& limits = {});

} // namespace nephroid::scene
