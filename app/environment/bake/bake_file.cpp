// SPDX-License-Identifier: Apache-2.0
// NAME.bake: a header, radii, where light went, half floats, ways, and a hash of everything before it.
#include "environment/bake/bake_file.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "environment/bake/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <span>

namespace nephroid::environment {
namespace fs = std::filesystem;
namespace {

struct Header {
  std::array<char, 8> magic{'N', 'E', 'P', 'H', 'B', 'A', 'K', 'E'};
  std::uint64_t format = 3;
  std::uint64_t program = 0, kernels = 0, key = 0;
  std::uint64_t directions = 0, spheres = 0, side = 0, channels = 0;
  double size = 0;
};
static_assert(sizeof(Header) == 80, "the header has no padding: it is written as it is");

template <class T>
void read_items(ByteSource& from, std::vector<T>& items, std::uint64_t count)
{
  items.resize(count);
  from.read(std::as_writable_bytes(std::span(items)));
}

std::uint64_t texels_of(const Header& h) { return h.directions * h.spheres * h.side * h.side; }

std::uint64_t length_of(const Header& h)
{
  return sizeof h + h.spheres * sizeof(double) + h.directions * sizeof(BakedDirection) +
         texels_of(h) * (h.channels + 1) * sizeof(std::uint16_t) + sizeof(std::uint64_t);
}

/// Whether a bake can have so many of everything. The length alone does not tell: products wrap around.
bool is_possible(const Header& h)
{
  constexpr std::uint64_t most = 1 << 12; // of spheres, and of texels across
  return std::ranges::count(direction_counts(), h.directions) == 1 && h.spheres > 0 && h.spheres <= most && h.side > 0 && h.side <= most &&
         (h.channels == 1 || h.channels == 3);
}

/// Reads the header. "" where all is right.
std::string fault_of(ByteSource& file, const BakeIdentity& identity, Header& header)
{
  const Header ours;
  const std::uint64_t length = file.left();
  if (length < sizeof header) return "is no bake";
  file.value(header);
  if (header.magic != ours.magic) return "is no bake";
  if (header.format != ours.format || header.program != hash_of(version())) return "was made by another version of the program";
  if (identity.kernels != 0 && header.kernels != identity.kernels) return "was made with other kernels";
  if (header.key != identity.key) return "is of another object or of other settings";
  if (!is_possible(header))
    return fmt::format("says that it has {} directions, {} spheres, {} x {} texels and {} channels", header.directions, header.spheres,
                       header.side, header.side, header.channels);
  if (length != length_of(header)) return fmt::format("has {} bytes, and {} are expected: it was cut short", length, length_of(header));
  return {};
}

void remove_oldest(const fs::path& kept, std::uint64_t most)
{
  struct File {
    fs::file_time_type time;
    fs::path path;
    std::uint64_t bytes;
  };
  std::vector<File> files;
  std::uint64_t sum = fs::file_size(kept);
  for (const fs::directory_entry& entry : fs::directory_iterator(kept.parent_path()))
    if (entry.path().extension() == ".bake" && entry.path() != kept)
      files.push_back({entry.last_write_time(), entry.path(), entry.file_size()});
  std::ranges::sort(files, [](const File& a, const File& b) { return a.time > b.time; });
  for (const File& file : files) {
    sum += file.bytes;
    if (sum > most) fs::remove(file.path);
  }
}

} // namespace

fs::path bake_path(std::uint64_t key)
{
  const fs::path folder = cache_folder("bakes");
  return folder.empty() ? folder : folder / fmt::format("{:016x}.bake", key);
}

std::optional<std::string> bake_file_fault(const fs::path& file, const BakeIdentity& identity)
{
  if (file.empty() || !is_there(file)) return "";
  try {
    Header header;
    const std::string fault = fault_of(*open_file(file), identity, header);
    return fault.empty() ? std::nullopt : std::optional(fault);
  } catch (const Error& error) {
    return error.text();
  }
}

Bake read_bake(const fs::path& file, const BakeIdentity& identity)
{
  const std::unique_ptr<ByteSource> source = open_file(file);
  HashedSource from(*source, file);
  Header header;
  if (const std::string fault = fault_of(from, identity, header); !fault.empty()) throw bad_input(file, fault);
  Bake bake;
  bake.map.side = static_cast<int>(header.side);
  bake.channels = static_cast<int>(header.channels);
  bake.size = header.size;
  read_items(from, bake.radii, header.spheres);
  read_items(from, bake.baked, header.directions);
  bake.directions = light_directions(static_cast<int>(header.directions));
  read_items(from, bake.halves, texels_of(header) * header.channels);
  read_items(from, bake.ways, texels_of(header));
  std::uint64_t hash = 0;
  source->value(hash);
  if (hash != from.hash()) throw bad_input(file, "is damaged: its checksum is wrong");
  return bake;
}

void write_bake(const fs::path& file, const BakeIdentity& identity, const Bake& bake, std::uint64_t most)
{
  if (file.empty()) throw failed("bake", "there is no folder to keep it in: HOME is not set", "", "set XDG_CACHE_HOME");
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw failed(file.parent_path(), "cannot be made: " + error.message(), "", "set XDG_CACHE_HOME to another folder");
  Header header;
  header.program = hash_of(version());
  header.kernels = identity.kernels;
  header.key = identity.key;
  header.directions = bake.baked.size();
  header.spheres = bake.radii.size();
  header.side = static_cast<std::uint64_t>(bake.map.side);
  header.channels = static_cast<std::uint64_t>(bake.channels);
  header.size = bake.size;
  write_file_whole(file, [&](ByteSink& sink) {
    HashedSink to(sink);
    to.value(header);
    to.write(std::as_bytes(std::span(bake.radii)));
    to.write(std::as_bytes(std::span(bake.baked)));
    to.write(std::as_bytes(std::span(bake.halves)));
    to.write(std::as_bytes(std::span(bake.ways)));
    sink.value(to.hash());
  });
  try {
    remove_oldest(file, most);
  } catch (const fs::filesystem_error&) {
    // Another program may be removing them, too.
  }
}

} // namespace nephroid::environment
