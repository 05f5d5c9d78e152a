// SPDX-License-Identifier: Apache-2.0
// Bytes hashed while they are written or read, for files that end in a hash of what comes before it. The same bytes in
// other pieces have the same hash.
#pragma once
#include "base/bytes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace nephroid {

/// FNV-1a, which tells contents apart and notices damage, but not forgery. `hash` continues an earlier hash.
inline std::uint64_t hash_of(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

/// Hashes eight bytes at a time, because films and bakes have gigabytes. Tells contents apart and notices damage, not
/// forgery.
class PieceHash {
public:
  void add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      if (waiting_ == 0 && bytes.size() >= word_.size()) {
        mix(bytes.data());
        bytes = bytes.subspan(word_.size());
        continue;
      }
      word_[waiting_++] = bytes[0];
      bytes = bytes.subspan(1);
      if (waiting_ < word_.size()) continue;
      mix(word_.data());
      waiting_ = 0;
    }
  }
  std::uint64_t value() const { return hash_of({reinterpret_cast<const char*>(word_.data()), waiting_}, hash_); }

private:
  void mix(const std::byte* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15u;
    hash_ ^= hash_ >> 32; // a product's high bits, where floats have their signs, would never reach the low ones
  }

  std::uint64_t hash_ = hash_of({});
  std::array<std::byte, 8> word_{}; ///< the word begun
  std::size_t waiting_ = 0;         ///< number of bytes in word_
};

class HashedSink final : public ByteSink {
public:
  explicit HashedSink(ByteSink& to) : to_(to) {}
  void write(std::span<const std::byte> bytes) override {
    hash_.add(bytes);
    to_.write(bytes);
  }
  std::uint64_t hash() const { return hash_.value(); }

private:
  ByteSink& to_;
  PieceHash hash_;
};

class HashedSource final : public ByteSource {
public:
  /// where: the name in errors. behind: number of bytes at the end of `from` that do not count, such as the hash.
  HashedSource(ByteSource& from, Location where, std::uint64_t behind = 0)
      : from_(from), where_(std::move(where)), behind_(behind) {}
  void read(std::span<std::byte> into) override {
    if (into.size() > left()) throw bad_input(where_, "is cut short");
    from_.read(into);
    hash_.add(into);
  }
  std::uint64_t left() const override { return from_.left() - std::min(behind_, from_.left()); }
  std::uint64_t hash() const { return hash_.value(); }

private:
  ByteSource& from_;
  Location where_;
  std::uint64_t behind_;
  PieceHash hash_;
};

/// Reads what is left and drops it, so that all bytes are hashed.
inline void read_to_end(ByteSource& from) {
  std::vector<std::byte> piece(1 << 18);
  while (from.left() > 0)
    from.read(std::span(piece).first(static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), from.left()))));
}

} // namespace nephroid
