// SPDX-License-Identifier: Apache-2.0
// A device's buffers in a checkpoint, in pieces, without those that are all 0, so an empty film takes no room.
#pragma once
#include "base/bytes.h"
#include "base/communicator.h"
#include "compute/compute.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace nephroid::tracing {

/// nephroid::Archive with the buffers of a device. The ranks' buffers are one buffer there, whatever the number of
/// ranks.
class Archive : public nephroid::Archive {
public:
  Archive(ByteSink& to, const Communicator& communicator) : nephroid::Archive(to), communicator_(communicator) {}
  Archive(ByteSource& from, const Communicator& communicator) : nephroid::Archive(from), communicator_(communicator) {}

  /// Sums that every rank adds to (mpi::RankContext::all_reduced_sum). What is loaded goes to rank 0.
  void buffer(compute::Buffer<std::int64_t>& buffer) {
    in_pieces(buffer, [&](std::size_t) {
      if (is_read() && !communicator_.is_root()) std::ranges::fill(piece_, std::byte{0});
      if (to_)
        communicator_.all_reduce_sum(
            {reinterpret_cast<std::int64_t*>(piece_.data()), piece_.size() / sizeof(std::int64_t)});
    });
  }
  /// Items that one rank has written and others have 0 (mpi::RankContext::all_reduced_or). All get what is loaded.
  template <class T>
  void joined(compute::Buffer<T>& buffer) {
    in_pieces(buffer, [&](std::size_t) {
      if (to_) communicator_.all_reduce_or(piece_);
    });
  }
  /// Several values for each item of `partition`. Only a rank's own items count (Partition::clear_others).
  template <class T>
  void owned(compute::Buffer<T>& buffer, const Partition& partition, std::size_t values_an_item) {
    if (to_ && !communicator_.is_alone()) {
      std::vector<T> items = buffer.read();
      partition.clear_others(std::span(items), values_an_item);
      buffer.write(items);
    }
    joined(buffer);
  }

private:
  /// Calls work(at) between reading a piece from its source and writing it.
  template <class T, class Work>
  void in_pieces(compute::Buffer<T>& buffer, const Work& work) {
    constexpr std::size_t piece_bytes = 1 << 18;
    for (std::size_t at = 0; at < buffer.bytes(); at += piece_bytes) {
      piece_.assign(std::min(piece_bytes, buffer.bytes() - at), std::byte{0});
      if (to_) {
        buffer.RawBuffer::read(piece_.data(), piece_.size(), at);
        work(at);
      }
      bool is_zero = to_ && all_zero();
      value(is_zero);
      if (!is_zero) items(std::span(piece_));
      if (!from_) continue;
      work(at);
      buffer.RawBuffer::write(piece_.data(), piece_.size(), at);
    }
  }

  /// Tests that the first byte is 0 and each equals the one before.
  bool all_zero() const {
    return piece_[0] == std::byte{0} && std::memcmp(piece_.data(), piece_.data() + 1, piece_.size() - 1) == 0;
  }

  Communicator communicator_;
  std::vector<std::byte> piece_;
};

} // namespace nephroid::tracing
