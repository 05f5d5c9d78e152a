// SPDX-License-Identifier: Apache-2.0
// Long work that somebody waits for: it says what it is at, and ends where nobody waits any more.
#pragma once
#include "base/error.h"

#include <functional>
#include <stop_token>

namespace nephroid {

struct Watch {
  std::stop_token stop;
  std::function<void(const std::string& doing)> tell; ///< "reading bunny.obj", on the working thread; may be null

  /// Call it before each part of the work. Throws interrupted if the work shall end.
  void begin(const std::string& doing) const {
    if (stop.stop_requested()) throw Error(ErrorKind::interrupted, "", "interrupted while " + doing);
    if (tell) tell(doing);
  }
};

} // namespace nephroid
