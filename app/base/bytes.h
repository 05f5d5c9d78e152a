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
  /// Throws failed if the bytes cannot be written.
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
  /// Fills `into` with the next bytes. Throws bad_input if fewer are left.
  virtual void read(std::span<std::byte> into) = 0;
  virtual std::uint64_t left() const = 0;
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    read(std::as_writable_bytes(std::span(&value, 1)));
  }
};

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

/// Reads bytes in memory, which outlive it. `where` is what an error calls them.
class StoredBytes final : public ByteSource {
public:
  StoredBytes(std::span<const std::byte> bytes, Location where) : bytes_(bytes), where_(std::move(where)) {}
  void read(std::span<std::byte> into) override {
    if (into.size() > bytes_.size()) throw bad_input(where_, "is cut short");
    if (!into.empty()) std::memcpy(into.data(), bytes_.data(), into.size());
    bytes_ = bytes_.subspan(into.size());
  }
  std::uint64_t left() const override { return bytes_.size(); }

private:
  std::span<const std::byte> bytes_;
  Location where_;
};

/// Saves or loads a job's state. A class with state writes one function serialize(Archive&), which serves both ways.
class Archive {
public:
  /// Both outlive the Archive.
  explicit Archive(ByteSink& to) : to_(&to) {}
  explicit Archive(ByteSource& from) : from_(&from) {}
  bool is_read() const { return from_ != nullptr; }

  template <class T>
  void value(T& value) {
    to_ ? to_->value(value) : from_->value(value);
  }
  void value(bool& value) // a file may hold any number in this byte
  {
    std::uint8_t byte = value ? 1 : 0;
    this->value(byte);
    value = byte != 0;
  }
  /// Both sides know the number of items.
  template <class T>
  void items(std::span<T> items) {
    to_ ? to_->write(std::as_bytes(items)) : from_->read(std::as_writable_bytes(items));
  }
  template <class T>
  void items(std::vector<T>& list) {
    items(std::span<T>(list));
  }
  /// The number of items and the items. Throws bad_input if the rest cannot hold so many: a wrong number cannot take
  /// all memory.
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
