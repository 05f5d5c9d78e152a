// SPDX-License-Identifier: Apache-2.0
// Contents as one number: what caches and checkpoints are bound to.
#pragma once
#include <cstdint>
#include <string_view>

namespace nephroid {

/// FNV-1a: enough to tell contents apart and to notice damage; not against forgery. `hash` continues an earlier one.
inline std::uint64_t hash_of(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325u)
{
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

} // namespace nephroid
