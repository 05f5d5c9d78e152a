// SPDX-License-Identifier: Apache-2.0
#include "base/inflate.h"

#include "base/counted.h"

#include <algorithm>
#include <limits>
#include <zlib.h>

namespace nephroid {

struct Inflater::Stream {
  z_stream z{};
  std::string_view packed; ///< what zlib was not given yet
  bool ended = false;
};

Inflater::Inflater(std::string_view packed, Location where) : stream_(new Stream), where_(std::move(where)) {
  stream_->packed = packed;
  constexpr int zlib_or_gzip = 32;
  if (inflateInit2(&stream_->z, MAX_WBITS + zlib_or_gzip) != Z_OK) throw failed(where_, "zlib has no memory");
}

Inflater::~Inflater() { inflateEnd(&stream_->z); }

std::size_t Inflater::read_some(std::span<std::byte> into) {
  constexpr std::size_t most = std::numeric_limits<uInt>::max() / 2; // zlib counts in 32 bits
  z_stream& z = stream_->z;
  std::size_t filled = 0;
  while (filled < into.size() && !stream_->ended) {
    if (z.avail_in == 0) {
      const std::size_t piece = std::min(stream_->packed.size(), most);
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stream_->packed.data()));
      z.avail_in = static_cast<uInt>(piece);
      stream_->packed.remove_prefix(piece);
    }
    const auto room = static_cast<uInt>(std::min(into.size() - filled, most));
    z.next_out = reinterpret_cast<Bytef*>(into.data() + filled);
    z.avail_out = room;
    const int state = inflate(&z, Z_NO_FLUSH);
    filled += room - z.avail_out;
    if (state == Z_STREAM_END) {
      const bool another = z.avail_in > 1 && z.next_in[0] == 0x1f && z.next_in[1] == 0x8b; // gzip may follow gzip
      if (another)
        inflateReset(&z);
      else
        stream_->ended = true;
    } else if (state == Z_BUF_ERROR && z.avail_in == 0 && stream_->packed.empty())
      throw bad_input(where_, "its packed bytes end too early", {}, "check that the file is whole");
    else if (state != Z_OK && state != Z_BUF_ERROR)
      throw bad_input(where_, std::string("its packed bytes are damaged: ") + (z.msg ? z.msg : "no zlib or gzip"));
  }
  return filled;
}

void Inflater::read(std::span<std::byte> into) {
  if (read_some(into) < into.size())
    throw bad_input(where_, "its packed bytes end too early", {}, "check that the file is whole");
}

std::string inflated(std::string_view packed, const Location& where, std::size_t most) {
  constexpr std::size_t piece = 1 << 20;
  Inflater from(packed, where);
  std::string unpacked;
  for (std::size_t got = piece; got == piece;) {
    const std::size_t before = unpacked.size();
    unpacked.resize(before + piece);
    got = from.read_some(std::as_writable_bytes(std::span(unpacked).subspan(before)));
    unpacked.resize(before + got);
    if (unpacked.size() > most)
      throw bad_input(where, "holds more than " + counted(most >> 20, "MiB", "MiB"), {},
                      "unpack it, and name the file that is in it");
  }
  return unpacked;
}

} // namespace nephroid
