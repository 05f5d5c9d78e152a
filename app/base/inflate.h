// SPDX-License-Identifier: Apache-2.0
// What zlib or gzip packed (RFC 1950, 1952), unpacked piece by piece.
#pragma once
#include "base/error.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace nephroid {

class Inflater {
public:
  /// packed outlives this. where: what an error calls it.
  Inflater(std::string_view packed, Location where);
  ~Inflater();
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Fills `into`, or as much of it as there is; the number of bytes. Throws bad_input where the bytes are damaged or
  /// cut.
  std::size_t read_some(std::span<std::byte> into);
  /// Throws bad_input also where fewer are left.
  void read(std::span<std::byte> into);
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    read(std::as_writable_bytes(std::span(&value, 1)));
  }

private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  Location where_;
};

/// A small file may hold terabytes.
inline constexpr std::size_t most_inflated = std::size_t{1} << 30;
/// All of it. Throws bad_input where that is more than `most` bytes.
std::string inflated(std::string_view packed, const Location& where, std::size_t most = most_inflated);

} // namespace nephroid
