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
#include <type_traits>
#include <vector>

namespace nephroid::tracing {

/// Writes or reads: what goes into a checkpoint and what comes out of it is said once, by a function state(State&) of whoever has some.
/// What is read into may be any bytes. Throws bad_input where a checkpoint that is read ends early.
class State {
public:
  /// to, from: outlives it.
  explicit State(ByteSink& to) : to_(&to) {}
  explicit State(ByteSource& from) : from_(&from) {}
  bool is_read() const { return from_ != nullptr; }

  template <class T>
  void value(T& value)
  {
    if constexpr (std::is_same_v<T, bool>) { // not every byte is one
      std::uint8_t byte = value ? 1 : 0;
      this->value(byte);
      value = byte != 0;
    } else
      items(std::span(&value, 1));
  }
  template <class T>
  void items(std::span<T> items)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    if (from_)
      from_->read(std::as_writable_bytes(items));
    else
      to_->write(std::as_bytes(items));
  }
  template <class T>
  void buffer(compute::Buffer<T>& buffer)
  {
    constexpr std::size_t piece_bytes = 1 << 18;
    for (std::size_t at = 0; at < buffer.bytes(); at += piece_bytes) {
      piece_.assign(std::min(piece_bytes, buffer.bytes() - at), std::byte{0});
      if (to_) buffer.RawBuffer::read(piece_.data(), piece_.size(), at);
      bool is_zero = to_ && all_zero();
      value(is_zero);
      if (!is_zero) items(std::span(piece_));
      if (from_) buffer.RawBuffer::write(piece_.data(), piece_.size(), at);
    }
  }

private:
  /// The first byte is 0 and each is as the one before.
  bool all_zero() const { return piece_[0] == std::byte{0} && std::memcmp(piece_.data(), piece_.data() + 1, piece_.size() - 1) == 0; }

  ByteSink* to_ = nullptr;
  ByteSource* from_ = nullptr;
  std::vector<std::byte> piece_;
};

} // namespace nephroid::tracing
