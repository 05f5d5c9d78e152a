// SPDX-License-Identifier: Apache-2.0
#include "base/zip.h"

#include <array>
#include <limits>
#include <zlib.h>

namespace nephroid {
namespace {

constexpr std::uint64_t most_zip_bytes = std::numeric_limits<std::uint32_t>::max() - 1;

class Deflater final : public ByteSink {
public:
  explicit Deflater(Location where) : where_(std::move(where)) {
    if (deflateInit2(&z_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
      throw failed(where_, "zlib has no memory");
  }
  ~Deflater() override { deflateEnd(&z_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void write(std::span<const std::byte> bytes) override {
    constexpr std::size_t most = 1 << 30; // zlib counts in 32 bits
    for (; bytes.size() > most; bytes = bytes.subspan(most)) write(bytes.first(most));
    size_ += bytes.size();
    if (size_ > most_zip_bytes) throw failed(where_, "takes more than 4 GiB, which a zip archive does not hold");
    const auto* const data = reinterpret_cast<const Bytef*>(bytes.data());
    crc_ = static_cast<std::uint32_t>(crc32(crc_, data, static_cast<uInt>(bytes.size())));
    z_.next_in = const_cast<Bytef*>(data);
    z_.avail_in = static_cast<uInt>(bytes.size());
    pack(Z_NO_FLUSH);
  }
  const std::vector<std::byte>& finish() {
    pack(Z_FINISH);
    return packed_.bytes();
  }
  std::uint32_t crc() const { return crc_; }
  std::uint64_t size() const { return size_; }

private:
  void pack(int how) {
    std::array<std::byte, 1 << 16> piece;
    do {
      z_.next_out = reinterpret_cast<Bytef*>(piece.data());
      z_.avail_out = static_cast<uInt>(piece.size());
      deflate(&z_, how);
      packed_.write(std::span(piece).first(piece.size() - z_.avail_out));
    } while (z_.avail_out == 0);
  }

  Location where_;
  z_stream z_{};
  ByteStore packed_;
  std::uint32_t crc_ = 0;
  std::uint64_t size_ = 0;
};

/// Numbers as an archive has them, little-endian.
class ZipHeader {
public:
  explicit ZipHeader(std::uint32_t signature) { four(signature); }
  ZipHeader& two(std::uint64_t value) { return add(value, 2); }
  ZipHeader& four(std::uint64_t value) { return add(value, 4); }
  void write(ByteSink& to, const std::string& name = {}) const {
    to.write(std::as_bytes(std::span(bytes_)));
    to.write(std::as_bytes(std::span(name)));
  }
  std::uint64_t size() const { return bytes_.size(); }

private:
  ZipHeader& add(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i) & 0xff));
    return *this;
  }

  std::string bytes_;
};

} // namespace

void write_zip(std::span<const ZipEntry> entries, ByteSink& to) {
  constexpr unsigned version = 20, deflated = 8, day_one = 0x21; // 1980-01-01: bytes know no clock
  struct Written {
    std::uint64_t crc, packed, size, at;
  };
  std::vector<Written> written;
  std::uint64_t at = 0;
  const auto common = [&](ZipHeader& header, const Written& w, const std::string& name) {
    header.two(version).two(0).two(deflated).two(0).two(day_one);
    header.four(w.crc).four(w.packed).four(w.size).two(name.size()).two(0);
  };
  for (const ZipEntry& entry : entries) {
    Deflater file(entry.name);
    entry.write(file);
    const std::vector<std::byte>& packed = file.finish();
    written.push_back({file.crc(), packed.size(), file.size(), at});
    ZipHeader header(0x04034b50);
    common(header, written.back(), entry.name);
    header.write(to, entry.name);
    to.write(packed);
    at += header.size() + entry.name.size() + packed.size();
    if (at > most_zip_bytes) throw failed(entry.name, "makes the zip archive larger than 4 GiB");
  }
  const std::uint64_t first = at;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ZipHeader header(0x02014b50);
    header.two(version);
    common(header, written[i], entries[i].name);
    header.two(0).two(0).two(0).four(0).four(written[i].at);
    header.write(to, entries[i].name);
    at += header.size() + entries[i].name.size();
  }
  ZipHeader(0x06054b50)
      .two(0)
      .two(0)
      .two(entries.size())
      .two(entries.size())
      .four(at - first)
      .four(first)
      .two(0)
      .write(to);
}

} // namespace nephroid
