// SPDX-License-Identifier: Apache-2.0
#include "base/file_lock.h"

#include <cerrno>
#include <sys/file.h>
#include <unistd.h>

namespace nephroid {

FileLock lock_open_file(int descriptor, bool alone) {
  if (descriptor < 0) return nullptr;
  FileLock lock(new int(descriptor), [](const int* open) {
    ::flock(*open, LOCK_UN); // a forked process may also hold it open
    ::close(*open);
    delete open;
  });
  if (::flock(descriptor, (alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return lock;
  const int why = errno;
  lock.reset();
  errno = why;
  return nullptr;
}

} // namespace nephroid
