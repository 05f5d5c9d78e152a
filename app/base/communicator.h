// SPDX-License-Identifier: Apache-2.0
// Processes that compute one run together: this one alone, or the ranks of an MPI job (app/mpi).
//
// They keep in step: each makes the same calls in the same order, and does a part of the work in between. What is
// summed up in whole numbers, and what only one of them writes, is the same to the bit on any number of them.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

class Communicator {
public:
  /// What this rank has exchanged, and how long it has waited for the others and the network.
  struct Traffic {
    std::uint64_t calls = 0, bytes = 0;
    double seconds = 0;
  };

  /// How ranks exchange data. A call returns when every rank has made it. Throws failed, naming the rank, if one does
  /// not answer any more.
  class Transport {
  public:
    virtual ~Transport() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// Each number becomes the sum of all ranks' numbers, modulo 2^64.
    virtual void all_reduce_sum(std::span<std::int64_t> numbers) = 0;
    /// Each byte becomes the bitwise or of all ranks' bytes.
    virtual void all_reduce_or(std::span<std::byte> bytes) = 0;
    /// Each byte becomes the root's.
    virtual void broadcast(std::span<std::byte> bytes) = 0;
    /// The traffic of all calls so far.
    virtual Traffic traffic() const { return {}; }
  };

  Communicator() = default; ///< one rank alone
  explicit Communicator(std::shared_ptr<Transport> transport) : transport_(std::move(transport)) {}

  Traffic traffic() const { return transport_ ? transport_->traffic() : Traffic(); }
  int rank() const { return transport_ ? transport_->rank() : 0; }
  int size() const { return transport_ ? transport_->size() : 1; }
  bool is_alone() const { return size() == 1; }
  bool is_root() const { return rank() == 0; }

  void all_reduce_sum(std::span<std::int64_t> numbers) const {
    if (!is_alone()) transport_->all_reduce_sum(numbers);
  }
  void all_reduce_or(std::span<std::byte> bytes) const {
    if (!is_alone()) transport_->all_reduce_or(bytes);
  }
  /// All ranks get the root's value, so that one clock decides what depends on time.
  template <class T>
  T broadcast(T value) const {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!is_alone()) transport_->broadcast(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
  template <class T>
  std::vector<T> broadcast(std::vector<T> items) const {
    items.resize(broadcast(items.size()));
    if (!is_alone()) transport_->broadcast(std::as_writable_bytes(std::span(items)));
    return items;
  }

  /// This rank has every size()-th item.
  template <class T>
  void keep_own_share(std::vector<T>& items) const {
    if (is_alone()) return;
    std::size_t kept = 0;
    for (auto i = static_cast<std::size_t>(rank()); i < items.size(); i += static_cast<std::size_t>(size()))
      items[kept++] = items[i];
    items.resize(kept);
  }

private:
  std::shared_ptr<Transport> transport_;
};

/// Says which of `size` items a rank works on. The items are cut into eight strips per rank, and a rank has every
/// size()-th strip, so that it gets easy and hard items.
class Partition {
public:
  Partition(const Communicator& communicator, std::int64_t size)
      : rank_(communicator.rank()), ranks_(communicator.size()), size_(size) {}

  /// Calls work(first, count) for this rank's part of the items from .. from + count - 1. The part may be empty.
  template <class Work>
  void for_own(std::int64_t from, std::int64_t count, const Work& work) const {
    if (ranks_ == 1) return work(from, count);
    for (std::int64_t strip = rank_; strip < strips(); strip += ranks_) {
      const std::int64_t first = std::max(begin_of(strip), from), end = std::min(begin_of(strip + 1), from + count);
      if (first < end) work(first, end - first);
    }
  }

  /// Clears the values of all items but this rank's. Each item has a fixed number of values; items lie one after the
  /// other, from item 0 on and over again.
  template <class T>
  void clear_others(std::span<T> values, std::size_t values_an_item) const {
    if (ranks_ == 1) return;
    const std::size_t round = static_cast<std::size_t>(size_) * values_an_item;
    for (std::size_t begin = 0; begin < values.size(); begin += round)
      for (std::int64_t strip = 0; strip < strips(); ++strip)
        if (strip % ranks_ != rank_)
          std::fill(values.begin() +
                        static_cast<std::ptrdiff_t>(begin + static_cast<std::size_t>(begin_of(strip)) * values_an_item),
                    values.begin() + static_cast<std::ptrdiff_t>(begin + static_cast<std::size_t>(begin_of(strip + 1)) *
                                                                             values_an_item),
                    T{});
  }

private:
  std::int64_t strips() const { return std::int64_t{8} * ranks_; }
  std::int64_t begin_of(std::int64_t strip) const { return (strip * size_ + strips() - 1) / strips(); }
  int rank_, ranks_;
  std::int64_t size_;
};

} // namespace nephroid
