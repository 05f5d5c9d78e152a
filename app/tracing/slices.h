// SPDX-License-Identifier: Apache-2.0
// The pixels, rows or photons of a pass in slices of about 30 ms.
#pragma once
#include "base/communicator.h"
#include "tracing/archive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nephroid::tracing {

template <class Work>
double seconds_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// How much work fits into a slice, learned from the slices before.
class SliceSize {
public:
  explicit SliceSize(double start, double least = 1) : amount_(start), least_(least) {}
  /// Calls work(first, count) for this rank's part (Partition) of the next slice of `size` items, of which `done` are
  /// done; a slice has at most `most`. Returns how many it had on all ranks.
  template <class Work>
  std::int64_t advance(const Communicator& communicator, std::int64_t size, std::int64_t done, std::int64_t most,
                       const Work& work) {
    const std::int64_t count = std::min(std::max<std::int64_t>(std::llround(amount(communicator)), 1), most);
    timed(static_cast<double>(count), [&] {
      Partition(communicator, size).for_own(done, count, [&](std::int64_t first, std::int64_t own) {
        work(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(own));
      });
    });
    return count;
  }
  /// Rank 0's amount, for all ranks.
  double amount(const Communicator& communicator) { return amount_ = communicator.broadcast(amount_); }
  /// Calls work(), which does `amount`, and learns from the time it took. It learns a little at a time, because the
  /// first slice of a kernel also compiles it, and the rows of a picture differ.
  template <class Work>
  void timed(double amount, const Work& work) {
    const double fits = amount * slice_seconds / std::max(seconds_of(work), 1e-6);
    amount_ = std::clamp(fits, std::max(0.25 * amount_, least_), std::max(2 * amount_, least_));
  }

private:
  static constexpr double slice_seconds = 0.03;
  double amount_, least_;
};

/// The pixels of a pass, or its rows.
class PixelSlices {
public:
  /// size: how many a pass has. first_slice: how many the first slice has. most: how many a slice has at most.
  PixelSlices(std::int64_t size, std::int64_t first_slice, std::int64_t most = std::numeric_limits<std::int64_t>::max())
      : size_(size), most_(most), amount_(static_cast<double>(first_slice)) {}

  double fraction_done() const { return size_ > 0 ? static_cast<double>(done_) / static_cast<double>(size_) : 0; }
  /// How many of the pass in hand are done.
  std::int64_t done() const { return done_; }

  /// Calls work(first, count) for this rank's part (Partition) of the next slice of the pass in hand. True when the
  /// pass is complete.
  template <class Work>
  bool advance(const Communicator& communicator, const Work& work) {
    done_ += amount_.advance(communicator, size_, done_, std::min(most_, size_ - done_), work);
    if (done_ < size_) return false;
    done_ = 0;
    return true;
  }

  void serialize(Archive& archive) {
    archive.value(done_);
    archive.value(size_);
  }

private:
  std::int64_t size_, most_, done_ = 0;
  SliceSize amount_;
};

/// The photons `offset`, offset + stride, ... of a batch and those that follow it, `count` of them.
struct PhotonSlice {
  std::uint32_t offset = 0, stride = 1, count = 0;
};

/// The photons of batches. A slice has several batches, or is a part of one: slice s of n has the photons s, s + n,
/// s + 2 n, ..., so that each is a fair sample of the batch.
class PhotonSlices {
public:
  /// Of the batch in hand.
  double fraction_done() const { return static_cast<double>(at_.slice) / at_.slices; }
  /// How many of the photons 0 .. photons - 1 of the batch in hand are done.
  std::uint32_t done_of(std::uint32_t photons) const {
    return photons / at_.slices * at_.slice + std::min(photons % at_.slices, at_.slice);
  }
  /// Whether the next slice begins a batch.
  bool at_start() const { return at_.slice == 0; }

  /// Calls work(slice) for this rank's part of the next slice. A batch has `photons` photons; `most` batches may begin.
  /// Returns how many it completes.
  template <class Work>
  std::int64_t advance(const Communicator& communicator, std::uint32_t photons, const Work& work,
                       std::int64_t most = 1) {
    const double amount = photons_a_slice_.amount(communicator);
    std::int64_t batches = 1;
    if (at_start()) {
      at_.slices = static_cast<std::uint32_t>(std::clamp<std::int64_t>(std::llround(photons / amount), 1, photons));
      batches = std::clamp<std::int64_t>(std::llround(amount / photons), 1, most);
    }
    const auto count = static_cast<std::uint32_t>((batches * photons - at_.slice + at_.slices - 1) / at_.slices),
               rank = static_cast<std::uint32_t>(communicator.rank()),
               ranks = static_cast<std::uint32_t>(communicator.size());
    photons_a_slice_.timed(count, [&] {
      if (rank < count)
        work(PhotonSlice{at_.slice + rank * at_.slices, ranks * at_.slices, (count - rank + ranks - 1) / ranks});
    });
    if (++at_.slice < at_.slices) return 0;
    at_ = {};
    return batches;
  }

  void serialize(Archive& archive) { archive.value(at_); }

private:
  struct Position {
    std::uint32_t slice = 0, slices = 1;
  };
  Position at_;
  SliceSize photons_a_slice_{4096};
};

} // namespace nephroid::tracing
