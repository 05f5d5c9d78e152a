// SPDX-License-Identifier: Apache-2.0
// Locks among processes.
#pragma once
#include <memory>

namespace nephroid {

/// Kept as long as somebody has this, and lost with the process. Null: there is none.
using FileLock = std::shared_ptr<const int>;

/// Locks an open file or folder, which becomes the lock's, and waits for nobody. alone: else others may lock it so,
/// too. Null with the system's errno where it cannot be had: EWOULDBLOCK where another process has one, another where
/// the file system has no locks.
FileLock lock_open_file(int descriptor, bool alone = true);

} // namespace nephroid
