// SPDX-License-Identifier: Apache-2.0
// Files packed into one, as other programs' formats have it.
#pragma once
#include "base/bytes.h"

#include <functional>
#include <string>

namespace nephroid {

struct ZipEntry {
  std::string name; ///< its path in the archive, with slashes
  std::function<void(ByteSink&)> write;
};

/// An archive of deflated files, as PKWARE's APPNOTE 6.3.3 says. Packed bytes are in memory one file at a time. The
/// same entries give the same bytes. Throws failed for what takes 4 GiB, packed or not: that is not the plain format.
void write_zip(std::span<const ZipEntry> entries, ByteSink& to);

} // namespace nephroid
