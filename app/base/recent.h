// SPDX-License-Identifier: Apache-2.0
// What was worked out last, kept for the next time.
#pragma once
#include <cstdint>
#include <list>
#include <memory>

namespace nephroid {

/// The values that were used last, as many as take no more than so many bytes together. Not safe from several threads.
template <class Value>
class Recent {
public:
  explicit Recent(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  /// The value for which is(value); null where there is none.
  template <class Is>
  std::shared_ptr<const Value> find(const Is& is) {
    for (auto one = kept_.begin(); one != kept_.end(); ++one)
      if (is(*one->value)) {
        kept_.splice(kept_.begin(), kept_, one);
        return one->value;
      }
    return nullptr;
  }

  std::shared_ptr<const Value> add(Value value, std::uint64_t bytes) {
    auto added = std::make_shared<const Value>(std::move(value));
    kept_.push_front({added, bytes});
    std::uint64_t sum = 0;
    kept_.remove_if([&](const Kept& one) { return (sum += one.bytes) > most_bytes_; });
    return added;
  }

private:
  struct Kept {
    std::shared_ptr<const Value> value;
    std::uint64_t bytes;
  };

  std::uint64_t most_bytes_;
  std::list<Kept> kept_; ///< the last used first
};

} // namespace nephroid
