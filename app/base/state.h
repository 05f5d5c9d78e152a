// SPDX-License-Identifier: Apache-2.0
// What a job saves and loads again, said once for both ways: by a function state(State&) of whoever has some.
#pragma once
#include "base/bytes.h"

namespace nephroid {

class State {
public:
  /// to, from: outlive it.
  explicit State(ByteSink& to) : to_(&to) {}
  explicit State(ByteSource& from) : from_(&from) {}
  bool is_read() const { return from_ != nullptr; }

  template <class T>
  void value(T& value)
  {
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
  void items(std::span<T> items)
  {
    to_ ? to_->write(std::as_bytes(items)) : from_->read(std::as_writable_bytes(items));
  }
  template <class T>
  void items(std::vector<T>& list)
  {
    items(std::span<T>(list));
  }
  /// Items and their number. Throws bad_input at one that the rest cannot hold, so that no wrong number takes all memory.
  template <class T>
  void list(std::vector<T>& list)
  {
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
