// SPDX-License-Identifier: Apache-2.0
// What was worked out last, kept for the next time.
#pragma once
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace nephroid {

/// The values that were used last, as many as take no more than so many bytes together. Safe from several threads.
template <class Value>
class Recent {
public:
  explicit Recent(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  /// The value for which is(value); null where there is none.
  template <class Is>
  std::shared_ptr<const Value> find(const Is& is) {
    const std::lock_guard lock(mutex_);
    for (auto entry = kept_.begin(); entry != kept_.end(); ++entry)
      if (is(*entry->value)) {
        kept_.splice(kept_.begin(), kept_, entry);
        return entry->value;
      }
    return nullptr;
  }

  std::shared_ptr<const Value> add(Value value, std::uint64_t bytes) {
    auto added = std::make_shared<const Value>(std::move(value));
    const std::lock_guard lock(mutex_);
    kept_.push_front({added, bytes});
    std::uint64_t sum = 0;
    kept_.remove_if([&](const Kept& entry) { return (sum += entry.bytes) > most_bytes_; });
    return added;
  }

private:
  struct Kept {
    std::shared_ptr<const Value> value;
    std::uint64_t bytes;
  };

  std::uint64_t most_bytes_;
  std::mutex mutex_;
  std::list<Kept> kept_; ///< the last used first
};

} // namespace nephroid
