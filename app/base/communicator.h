// SPDX-License-Identifier: Apache-2.0
// Processes that compute one run together: this one alone, or the ranks of an MPI job (app/team).
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
  /// What went to and fro, and how long this rank has waited for the others and the network.
  struct Traffic {
    std::uint64_t calls = 0, bytes = 0;
    double seconds = 0;
  };

  /// How ranks talk. A call returns once every rank has made it, and throws failed, naming the rank, where one does not
  /// answer any more.
  class Transport {
  public:
    virtual ~Transport() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// Each becomes the sum of all ranks', modulo 2^64.
    virtual void all_reduce_sum(std::span<std::int64_t> numbers) = 0;
    /// Each becomes the bitwise or of all ranks'.
    virtual void all_reduce_or(std::span<std::byte> bytes) = 0;
    /// Each becomes that of rank 0.
    virtual void broadcast(std::span<std::byte> bytes) = 0;
    /// Of all calls so far.
    virtual Traffic traffic() const { return {}; }
  };

  Communicator() = default; ///< alone
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
  /// Rank 0's: what hangs on time is decided by one of them.
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

  /// Every size()-th of the items is this rank's.
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

/// Which of `size` items a rank works on, and it alone: every size()-th of eight strips a rank, so that each has some
/// of what is easy and some of what is hard.
class Partition {
public:
  Partition(const Communicator& communicator, std::int64_t size)
      : rank_(communicator.rank()), ranks_(communicator.size()), size_(size) {}

  /// Calls work(first, count) for what is this rank's of items from .. from + count - 1, which may be nothing.
  template <class Work>
  void for_own(std::int64_t from, std::int64_t count, const Work& work) const {
    if (ranks_ == 1) return work(from, count);
    for (std::int64_t strip = rank_; strip < strips(); strip += ranks_) {
      const std::int64_t first = std::max(begin_of(strip), from), end = std::min(begin_of(strip + 1), from + count);
      if (first < end) work(first, end - first);
    }
  }

  /// Clears all but this rank's; values: of each item so many, one item after the other, from item 0 on and over again.
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
