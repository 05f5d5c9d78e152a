// SPDX-License-Identifier: Apache-2.0
// What a checkpoint holds, byte after byte: plain values and device buffers.
#pragma once
#include "base/error.h"
#include "compute/compute.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace nephroid::spectral {

class StateWriter {
public:
  template <class T>
  void value(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof value);
  }
  template <class T>
  void buffer(const compute::Buffer<T>& buffer)
  {
    const std::vector<T> items = buffer.read();
    append(items.data(), items.size() * sizeof(T));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

private:
  void append(const void* from, std::size_t count)
  {
    const std::size_t size = bytes_.size();
    bytes_.resize(size + count);
    if (count > 0) std::memcpy(bytes_.data() + size, from, count);
  }
  std::vector<std::byte> bytes_;
};

/// Throws bad_input where the checkpoint ends early.
class StateReader {
public:
  explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void value(T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  template <class T>
  void buffer(compute::Buffer<T>& buffer)
  {
    std::vector<T> items(buffer.size());
    const std::span<const std::byte> from = take(buffer.bytes());
    if (!items.empty()) std::memcpy(items.data(), from.data(), from.size());
    buffer.write(items);
  }
  bool at_end() const { return bytes_.empty(); }

private:
  std::span<const std::byte> take(std::size_t count)
  {
    if (count > bytes_.size()) throw bad_input("checkpoint", "is cut short", "expected one of this preset", "delete it and start again");
    const std::span<const std::byte> taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  std::span<const std::byte> bytes_;
};

} // namespace nephroid::spectral
