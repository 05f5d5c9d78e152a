// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/bake.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/hashed_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>

namespace nephroid::environment {
namespace fs = std::filesystem;
namespace {

// z > 0 is the diamond |u| + |v| < 1 of the square from -1 to 1; z < 0 is folded out into its corners. |u| + |v| = r,
// with r^2 = 1 - |z| the share of the half sphere nearer to the pole, and |v| / r is the azimuth in quarter turns.
glm::dvec2 with_signs(const glm::dvec2& size, const glm::dvec2& signs) {
  return {std::copysign(size.x, signs.x), std::copysign(size.y, signs.y)};
}

constexpr std::array<int, 3> counts{26, 98, 386};

/// The header of NAME.bake. Then come radii, where light went, light, ways, and a hash of all of these.
struct Header {
  std::array<char, 8> magic{'N', 'E', 'P', 'H', 'B', 'A', 'K', 'E'};
  std::uint64_t format = 4;
  std::uint64_t program = 0, kernels = 0, key = 0;
  std::uint64_t directions = 0, spheres = 0, side = 0, channels = 0;
  double size = 0;
};
static_assert(sizeof(Header) == 80, "the header has no padding: it is written as it is");

template <class T>
void read_items(ByteSource& from, std::vector<T>& items, std::uint64_t count) {
  items.resize(count);
  from.read(std::as_writable_bytes(std::span(items)));
}

std::uint64_t texels_of(const Header& h) { return h.directions * h.spheres * (h.side + 2) * (h.side + 2); }

std::uint64_t length_of(const Header& h) {
  return sizeof h + h.spheres * sizeof(double) + h.directions * sizeof(BakedDirection) +
         texels_of(h) * (h.channels + 1) * sizeof(std::uint16_t) + sizeof(std::uint64_t);
}

/// Whether a bake can have the header's sizes. The length alone does not tell, because products wrap around.
bool is_possible(const Header& h) {
  constexpr std::uint64_t most = 1 << 12; // the most spheres, and texels across
  return std::ranges::count(direction_counts(), h.directions) == 1 && h.spheres > 0 && h.spheres <= most &&
         h.side > 0 && h.side <= most && (h.channels == 1 || h.channels == 3);
}

/// Reads the header and returns its fault, "" where all is right.
std::string fault_of(ByteSource& file, const BakeIdentity& identity, Header& header) {
  const Header ours;
  const std::uint64_t length = file.left();
  if (length < sizeof header) return "is no bake";
  file.value(header);
  if (header.magic != ours.magic) return "is no bake";
  if (header.format != ours.format || header.program != hash_of(version()))
    return "was made by another version of the program";
  if (identity.kernels != 0 && header.kernels != identity.kernels) return "was made with other kernels";
  if (header.key != identity.key) return "is of another object or of other settings";
  if (!is_possible(header))
    return fmt::format("says that it has {} directions, {} spheres, {} x {} texels and {} channels", header.directions,
                       header.spheres, header.side, header.side, header.channels);
  if (length != length_of(header))
    return fmt::format("has {} bytes, and {} are expected: it was cut short", length, length_of(header));
  return {};
}

void remove_oldest(const fs::path& kept, std::uint64_t most) {
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

std::size_t SphereMap::texel(const glm::dvec3& direction) const {
  const glm::dvec3 d = glm::abs(direction) / glm::length(direction);
  const double r = std::sqrt((d.x * d.x + d.y * d.y) / (1 + d.z));
  const double v = r * std::atan2(d.y, d.x) * (2 / std::numbers::pi), u = r - v;
  const glm::dvec2 folded = direction.z < 0 ? glm::dvec2(1 - v, 1 - u) : glm::dvec2(u, v);
  const glm::dvec2 place = (0.5 + 0.5 * with_signs(folded, glm::dvec2(direction))) * static_cast<double>(side);
  const int column = std::clamp(static_cast<int>(place.x), 0, side - 1),
            row = std::clamp(static_cast<int>(place.y), 0, side - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) + static_cast<std::size_t>(column);
}

glm::dvec3 SphereMap::direction(std::size_t texel) const {
  const auto n = static_cast<std::size_t>(side);
  const glm::dvec2 place = (glm::dvec2(texel % n, texel / n) + 0.5) * (2.0 / side) - 1.0, size = glm::abs(place);
  const double height = 1 - size.x - size.y, r = 1 - std::abs(height); // above 0: the upper half
  const double azimuth = r > 0 ? ((size.y - size.x) / r + 1) * std::numbers::pi / 4 : 0;
  const double sine = r * std::sqrt(2 - r * r);
  return {with_signs({std::cos(azimuth) * sine, std::sin(azimuth) * sine}, place), std::copysign(1 - r * r, height)};
}

std::size_t SphereMap::stored_texel(std::size_t texel) const {
  const auto n = static_cast<std::size_t>(side);
  return (texel / n + 1) * (n + 2) + texel % n + 1;
}

std::vector<std::size_t> SphereMap::texels_of_stored() const {
  std::vector<std::size_t> texels;
  const int last = side - 1;
  for (int row = -1; row <= side; ++row)
    for (int column = -1; column <= side; ++column) {
      const bool across = column < 0 || column > last, down = row < 0 || row > last;
      const int x = std::clamp(column, 0, last), y = std::clamp(row, 0, last);
      texels.push_back(static_cast<std::size_t>(across ? last - y : y) * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(down ? last - x : x));
    }
  return texels;
}

std::uint16_t upper_half(double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return static_cast<std::uint16_t>((bits + 0x7fff + (bits >> 16 & 1)) >> 16); // rounds to the nearest, ties to even
}

std::span<const int> direction_counts() { return counts; }

std::vector<glm::ivec3> cube_points(int count) {
  const int m = count == counts[0] ? 1 : count == counts[1] ? 2 : 4;
  std::vector<glm::ivec3> points;
  for (int x = -m; x <= m; ++x)
    for (int y = -m; y <= m; ++y)
      for (int z = -m; z <= m; ++z)
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == m) points.emplace_back(x, y, z);
  return points;
}

std::vector<glm::dvec3> light_directions(int count) {
  std::vector<glm::dvec3> directions;
  for (const glm::ivec3& point : cube_points(count)) directions.push_back(-glm::normalize(glm::dvec3(point)));
  return directions;
}

glm::dvec3 Bake::at(std::size_t direction, std::size_t sphere, std::size_t texel) const {
  const std::size_t map_number = direction * radii.size() + sphere,
                    first = (map_number * map.stored_texels() + map.stored_texel(texel)) *
                            static_cast<std::size_t>(channels);
  const auto channel = [&](std::size_t c) {
    return static_cast<double>(std::bit_cast<float>(std::uint32_t{light[first + c]} << 16));
  };
  return channels == 3 ? glm::dvec3(channel(0), channel(1), channel(2)) : glm::dvec3(channel(0));
}

fs::path bake_path(std::uint64_t key) {
  const fs::path folder = cache_folder("bakes");
  return folder.empty() ? folder : folder / fmt::format("{:016x}.bake", key);
}

std::optional<std::string> bake_file_fault(const fs::path& file, const BakeIdentity& identity) {
  if (file.empty() || !is_there(file)) return "";
  try {
    Header header;
    const std::string fault = fault_of(*open_file(file), identity, header);
    return fault.empty() ? std::nullopt : std::optional(fault);
  } catch (const Error& error) {
    return error.text();
  }
}

Bake read_bake(const fs::path& file, const BakeIdentity& identity) {
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
  read_items(from, bake.light, texels_of(header) * header.channels);
  read_items(from, bake.ways, texels_of(header));
  std::uint64_t hash = 0;
  source->value(hash);
  if (hash != from.hash()) throw bad_input(file, "is damaged: its checksum is wrong");
  return bake;
}

void write_bake(const fs::path& file, const BakeIdentity& identity, const Bake& bake, std::uint64_t most) {
  if (file.empty()) throw failed("bake", "there is no folder to keep it in: HOME is not set", "", "set XDG_CACHE_HOME");
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    throw failed(file.parent_path(), "cannot be made: " + error.message(), "", "set XDG_CACHE_HOME to another folder");
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
    to.write(std::as_bytes(std::span(bake.light)));
    to.write(std::as_bytes(std::span(bake.ways)));
    sink.value(to.hash());
  });
  try {
    remove_oldest(file, most);
  } catch (const fs::filesystem_error&) {
    // Another program may be removing bakes, too.
  }
}

} // namespace nephroid::environment
