// SPDX-License-Identifier: Apache-2.0
// A bake kept on disk, so that a second start costs a read. The file has the name of its key in the folder of caches. It is written whole,
// and used only where it was made by this version of the program and its kernels for exactly this key, and is as long as it was.
#pragma once
#include "environment/bake/bake.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace nephroid::environment {

struct BakeIdentity {
  std::uint64_t key = 0;     ///< bake_key
  std::uint64_t kernels = 0; ///< hash of the kernels' sources; 0 where they are not known yet
};

/// Empty where the user has no folder of caches.
std::filesystem::path bake_path(std::uint64_t key);

/// Why the file cannot be used, as far as its first bytes and its length tell; "" where there is none, nothing where all is right.
std::optional<std::string> bake_file_fault(const std::filesystem::path& file, const BakeIdentity& identity);

/// Throws bad_input, saying why, where the file cannot be used.
Bake read_bake(const std::filesystem::path& file, const BakeIdentity& identity);

/// Makes the folder. Throws failed where it cannot be written. Then removes the oldest bakes of the folder, until all together take no more
/// than `most` bytes; the one just written stays.
void write_bake(const std::filesystem::path& file, const BakeIdentity& identity, const Bake& bake,
                std::uint64_t most = std::uint64_t{4} << 30);

} // namespace nephroid::environment
