// SPDX-License-Identifier: Apache-2.0
// Locks among processes.
#pragma once
#include <memory>

namespace nephroid {

/// The lock lasts as long as this pointer has owners, and ends with the process. Null: no lock.
using FileLock = std::shared_ptr<const int>;

/// Locks an open file or folder and does not wait. The lock takes over the descriptor. Unless `alone`, others may take
/// the same shared lock. Returns null with the system's errno if it fails: EWOULDBLOCK if another process has the lock,
/// another errno if the file system has no locks.
FileLock lock_open_file(int descriptor, bool alone = true);

} // namespace nephroid
