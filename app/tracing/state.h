// SPDX-License-Identifier: Apache-2.0
// What a checkpoint holds of a device: its buffers piece by piece, without the pieces that are all 0. So no second film is held on the
// host, and an empty film takes no room.
#pragma once
#include "base/bytes.h"
#include "compute/compute.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace nephroid::tracing {

/// nephroid::State with the buffers of a device.
class State : public nephroid::State {
public:
  using nephroid::State::State;

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

  std::vector<std::byte> piece_;
};

} // namespace nephroid::tracing
