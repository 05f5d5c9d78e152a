// SPDX-License-Identifier: Apache-2.0
// Jobs saved to memory and loaded from there.
#pragma once
#include "base/bytes.h"
#include "base/communicator.h"
#include "tests/support/test.h"

namespace nephroid::test {

/// saver: a job, or a part of one with a state of its own (Archive).
template <class Writer = ByteSink, class Saver>
std::vector<std::byte> saved(Saver& saver) {
  ByteStore store;
  if constexpr (std::is_same_v<Writer, ByteSink>) {
    saver.save(store);
  } else if constexpr (std::is_same_v<Writer, Archive>) {
    Archive to(store);
    saver.serialize(to);
  } else {
    Writer to(store, Communicator());
    saver.serialize(to);
  }
  return store.bytes();
}

/// True where all of the bytes were read.
template <class Reader = ByteSource, class Loader>
bool load(Loader& loader, std::span<const std::byte> bytes) {
  StoredBytes stored(bytes, "checkpoint");
  if constexpr (std::is_same_v<Reader, ByteSource>) {
    loader.load(stored);
  } else if constexpr (std::is_same_v<Reader, Archive>) {
    Archive from(stored);
    loader.serialize(from);
  } else {
    Reader from(stored, Communicator());
    loader.serialize(from);
  }
  return stored.left() == 0;
}

} // namespace nephroid::test
