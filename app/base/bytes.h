// SPDX-License-Identifier: Apache-2.0
// Bytes that are written or read piece by piece, so that nobody has to hold all of them: a checkpoint is as large as
// the films.
#pragma once
#include "base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace nephroid {

class ByteSink {
public:
  virtual ~ByteSink() = default;
  /// Throws failed where they cannot be written.
  virtual void write(std::span<const std::byte> bytes) = 0;
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    write(std::as_bytes(std::span(&value, 1)));
  }
};

class ByteSource {
public:
  virtual ~ByteSource() = default;
  /// Fills `into` with the next bytes. Throws bad_input where fewer are left.
  virtual void read(std::span<std::byte> into) = 0;
  /// How many bytes are left.
  virtual std::uint64_t left() const = 0;
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    read(std::as_writable_bytes(std::span(&value, 1)));
  }
};

/// Keeps what is written.
class ByteStore final : public ByteSink {
public:
  void write(std::span<const std::byte> bytes) override {
    const std::size_t size = bytes_.size();
    bytes_.resize(size + bytes.size());
    if (!bytes.empty()) std::memcpy(bytes_.data() + size, bytes.data(), bytes.size());
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

private:
  std::vector<std::byte> bytes_;
};

/// Bytes in memory, which outlive it. `where`: what an error calls them.
class StoredBytes final : public ByteSource {
public:
  StoredBytes(std::span<const std::byte> bytes, Place where) : bytes_(bytes), where_(std::move(where)) {}
  void read(std::span<std::byte> into) override {
    if (into.size() > bytes_.size()) throw bad_input(where_, "is cut short");
    if (!into.empty()) std::memcpy(into.data(), bytes_.data(), into.size());
    bytes_ = bytes_.subspan(into.size());
  }
  std::uint64_t left() const override { return bytes_.size(); }

private:
  std::span<const std::byte> bytes_;
  Place where_;
};

/// What a job saves and loads again, said once for both ways: by a function state(State&) of whoever has some.
class State {
public:
  /// to, from: outlive it.
  explicit State(ByteSink& to) : to_(&to) {}
  explicit State(ByteSource& from) : from_(&from) {}
  bool is_read() const { return from_ != nullptr; }

  template <class T>
  void value(T& value) {
    to_ ? to_->value(value) : from_->value(value);
  }
  void value(bool& value) // of a file a byte may be any number
  {
    std::uint8_t byte = value ? 1 : 0;
    this->value(byte);
    value = byte != 0;
  }
  /// Items whose number both sides know.
  template <class T>
  void items(std::span<T> items) {
    to_ ? to_->write(std::as_bytes(items)) : from_->read(std::as_writable_bytes(items));
  }
  template <class T>
  void items(std::vector<T>& list) {
    items(std::span<T>(list));
  }
  /// Items and their number. Throws bad_input at one that the rest cannot hold, so that no wrong number takes all
  /// memory.
  template <class T>
  void list(std::vector<T>& list) {
    std::uint64_t count = list.size();
    value(count);
    if (is_read() && count > from_->left() / sizeof(T)) throw bad_input("checkpoint.bin", "is of another run");
    list.resize(count);
    items(list);
  }

protected:
  ByteSink* to_ = nullptr;
  ByteSource* from_ = nullptr;
};

} // namespace nephroid
