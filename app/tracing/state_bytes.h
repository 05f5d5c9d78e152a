// SPDX-License-Identifier: Apache-2.0
// What a checkpoint holds, byte after byte: plain values, and device buffers piece by piece, without the pieces that are all 0. So no
// second film is held on the host, and an empty film takes no room.
#pragma once
#include "base/bytes.h"
#include "compute/compute.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace nephroid::tracing {

/// Bytes of a buffer that are read or written at once.
constexpr std::size_t state_piece = 1 << 18;

class StateWriter {
public:
  /// to: outlives it.
  explicit StateWriter(ByteSink& to) : to_(to) {}
  template <class T>
  void value(const T& value)
  {
    to_.value(value);
  }
  void bytes(std::span<const std::byte> bytes) { to_.write(bytes); }
  template <class T>
  void buffer(const compute::Buffer<T>& buffer)
  {
    for (std::size_t at = 0; at < buffer.bytes(); at += state_piece) {
      piece_.resize(std::min(state_piece, buffer.bytes() - at));
      buffer.RawBuffer::read(piece_.data(), piece_.size(), at);
      const std::uint8_t is_zero = all_zero();
      value(is_zero);
      if (is_zero == 0) to_.write(piece_);
    }
  }

private:
  /// The first byte is 0 and each is as the one before.
  bool all_zero() const { return piece_[0] == std::byte{0} && std::memcmp(piece_.data(), piece_.data() + 1, piece_.size() - 1) == 0; }

  ByteSink& to_;
  std::vector<std::byte> piece_;
};

/// Throws bad_input where the checkpoint ends early.
class StateReader {
public:
  /// from: outlives it.
  explicit StateReader(ByteSource& from) : from_(from) {}
  template <class T>
  void value(T& value)
  {
    from_.value(value);
  }
  void bytes(std::span<std::byte> into) { from_.read(into); }
  template <class T>
  void buffer(compute::Buffer<T>& buffer)
  {
    for (std::size_t at = 0; at < buffer.bytes(); at += state_piece) {
      std::uint8_t is_zero = 0; // no bool: a byte of a file may be any number
      value(is_zero);
      piece_.assign(std::min(state_piece, buffer.bytes() - at), std::byte{0});
      if (is_zero == 0) from_.read(piece_);
      buffer.RawBuffer::write(piece_.data(), piece_.size(), at);
    }
  }

private:
  ByteSource& from_;
  std::vector<std::byte> piece_;
};

} // namespace nephroid::tracing
