// SPDX-License-Identifier: Apache-2.0
// A device as one of several ranks has it, and buffers of which every rank holds a part.
#pragma once
#include "base/communicator.h"
#include "compute/compute.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::mpi {

/// A rank's own device, and the ranks that share the work of its jobs. A context alone is a rank alone.
class RankContext : public compute::Context {
public:
  RankContext() = default;
  RankContext(const compute::Context& context, Communicator communicator = {})
      : compute::Context(context), communicator_(std::move(communicator)) {}
  const Communicator& communicator() const { return communicator_; }

  /// The sums of a buffer that every rank adds to in its own memory: all ranks' together.
  std::vector<std::int64_t> all_reduced_sum(const compute::Buffer<std::int64_t>& buffer) const {
    std::vector<std::int64_t> items = buffer.read();
    communicator_.all_reduce_sum(items);
    return items;
  }
  /// A buffer each item of which one rank has written, where the others have 0 or the same.
  template <class T>
  std::vector<T> all_reduced_or(const compute::Buffer<T>& buffer) const {
    std::vector<T> items = buffer.read();
    communicator_.all_reduce_or(std::as_writable_bytes(std::span(items)));
    return items;
  }

private:
  Communicator communicator_;
};

} // namespace nephroid::mpi
