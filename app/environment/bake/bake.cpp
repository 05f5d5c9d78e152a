// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/bake.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "base/parallel.h"
#include "kernels/environment/render_types.h"

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

/// The header of NAME.bake. Then come radii, where light went, texels, blocks, and a hash of all of these.
struct Header {
  std::array<char, 8> magic{'N', 'E', 'P', 'H', 'B', 'A', 'K', 'E'};
  std::uint64_t format = 5;
  std::uint64_t program = 0, kernels = 0, key = 0;
  std::uint64_t directions = 0, spheres = 0, side = 0, channels = 0;
  double size = 0;
};
static_assert(sizeof(Header) == 80, "the header has no padding: it is written as it is");

/// Without what its vectors hold. Only of a header that is possible.
Bake bake_of(const Header& h) {
  Bake bake;
  bake.map.side = static_cast<int>(h.side);
  bake.channels = static_cast<int>(h.channels);
  bake.size = h.size;
  bake.radii.resize(h.spheres);
  bake.directions = light_directions(static_cast<int>(h.directions));
  return bake;
}

std::uint64_t length_of(const Header& h) {
  return sizeof h + h.spheres * sizeof(double) + h.directions * sizeof(BakedDirection) +
         bake_of(h).bytes(h.directions) + sizeof(std::uint64_t);
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

// A texel's brightness and its block's colour, as kernels/environment/render_types.h has them.

double brightness(const glm::dvec3& rgb) { return (rgb.x + 2 * rgb.y + rgb.z) / 4; }

double step_of(std::uint16_t code) { return double{std::bit_cast<float>(std::uint32_t{code} << 16)}; }

/// The least step by which a brightness of `most` fits 8 bits.
std::uint16_t step_code(double most) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(most / 255));
  return static_cast<std::uint16_t>((bits + 0xffff) >> 16);
}

glm::dvec3 colour_of(std::uint16_t code) {
  const double red = ((code & 255) - double{COLOUR_ZERO}) / double{COLOUR_STEPS},
               blue = ((code >> 8) - double{COLOUR_ZERO}) / double{COLOUR_STEPS};
  return {red, 2 - (red + blue) / 2, blue};
}

std::uint16_t colour_code(const glm::dvec3& rgb) {
  const double sum = brightness(rgb);
  const auto code = [&](double channel) {
    const double part = sum > 0 ? channel / sum : 1;
    return static_cast<unsigned>(std::clamp(std::round(part * double{COLOUR_STEPS} + double{COLOUR_ZERO}), 0.0, 255.0));
  };
  return static_cast<std::uint16_t>(code(rgb.x) | code(rgb.z) << 8);
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

std::size_t SphereMap::texel_of_stored(std::size_t stored) const {
  const int stride = side + 2, last = side - 1, column = static_cast<int>(stored) % stride - 1,
            row = static_cast<int>(stored) / stride - 1;
  const bool across = column < 0 || column > last, down = row < 0 || row > last;
  const int x = std::clamp(column, 0, last), y = std::clamp(row, 0, last);
  return static_cast<std::size_t>(across ? last - y : y) * static_cast<std::size_t>(side) +
         static_cast<std::size_t>(down ? last - x : x);
}

std::size_t SphereMap::blocks() const { return static_cast<std::size_t>(BLOCKS_ACROSS(side) * BLOCKS_DOWN(side)); }

std::size_t SphereMap::block(std::size_t stored) const {
  const std::size_t stride = static_cast<std::size_t>(side) + 2;
  return (stored / stride >> BLOCK_DOWN_BITS) * static_cast<std::size_t>(BLOCKS_ACROSS(side)) +
         (stored % stride >> BLOCK_ACROSS_BITS);
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

std::uint64_t Bake::bytes(std::size_t direction_count) const {
  return std::uint64_t{direction_count} * radii.size() *
         (map.stored_texels() * sizeof(std::uint8_t) + map_blocks() * sizeof(std::uint16_t));
}

void Bake::resize(std::size_t direction_count) {
  baked.resize(direction_count);
  texels.resize(direction_count * radii.size() * map.stored_texels());
  blocks.resize(direction_count * radii.size() * map_blocks());
}

void Bake::append(const Bake& more, std::size_t first) {
  const auto join = [&](auto& items, const auto& others) {
    const std::size_t each = others.size() / more.baked.size();
    items.insert(items.end(), others.begin() + static_cast<std::ptrdiff_t>(first * each), others.end());
  };
  join(texels, more.texels);
  join(blocks, more.blocks);
  join(baked, more.baked);
}

glm::dvec3 Bake::at(std::size_t direction, std::size_t sphere, std::size_t texel) const {
  const std::size_t map_number = direction * radii.size() + sphere, stored = map.stored_texel(texel);
  const std::uint16_t* const step = &blocks[map_number * map_blocks() + map.blocks() + map.block(stored)];
  const double brightness = step_of(*step) * texels[map_number * map.stored_texels() + stored];
  return brightness * (channels == 1 ? glm::dvec3(1) : colour_of(step[map.blocks()]));
}

void Bake::store(std::size_t direction, std::size_t sphere, std::span<const TexelLight> light) {
  const std::size_t map_number = direction * radii.size() + sphere, stride = static_cast<std::size_t>(map.side) + 2;
  std::uint8_t* const codes = &texels[map_number * map.stored_texels()];
  std::uint16_t *const ways = &blocks[map_number * map_blocks()], *const steps = ways + map.blocks(),
                       *const colours = steps + map.blocks();
  const auto store_block = [&](std::size_t column, std::size_t row) {
    TexelLight sum;
    double most = 0;
    const auto each_texel = [&](const auto& use) {
      for (std::size_t y = row; y < std::min(row + (1 << BLOCK_DOWN_BITS), stride); ++y)
        for (std::size_t x = column; x < std::min(column + (1 << BLOCK_ACROSS_BITS), stride); ++x)
          use(y * stride + x, light[map.texel_of_stored(y * stride + x)]);
    };
    each_texel([&](std::size_t, const TexelLight& texel) {
      sum.light += texel.light;
      sum.way += texel.way;
      most = std::max(most, brightness(texel.light));
    });
    const std::size_t first = row * stride + column, block = map.block(first);
    if (sum.way == glm::dvec3(0)) sum.way = map.direction(map.texel_of_stored(first)); // straight away from the middle
    ways[block] = static_cast<std::uint16_t>(way_map.texel(sum.way));
    steps[block] = step_code(most);
    if (channels == 3) colours[block] = colour_code(sum.light);
    if (most == 0) return;
    each_texel([&](std::size_t stored, const TexelLight& texel) {
      const double code = std::round(brightness(texel.light) / step_of(steps[block]));
      codes[stored] = static_cast<std::uint8_t>(std::clamp(code, 0.0, 255.0));
    });
  };
  for_ranges((stride + 1) >> BLOCK_DOWN_BITS, 16, [&](std::size_t, const Range& rows) {
    for (std::size_t row = rows.begin; row < rows.end; ++row)
      for (std::size_t column = 0; column < stride; column += 1 << BLOCK_ACROSS_BITS)
        store_block(column, row << BLOCK_DOWN_BITS);
  });
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
  Bake bake = bake_of(header);
  bake.resize(header.directions);
  const auto read = [&](auto& items) { from.read(std::as_writable_bytes(std::span(items))); };
  read(bake.radii);
  read(bake.baked);
  read(bake.texels);
  read(bake.blocks);
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
    to.write(std::as_bytes(std::span(bake.texels)));
    to.write(std::as_bytes(std::span(bake.blocks)));
    sink.value(to.hash());
  });
  try {
    remove_oldest(file, most);
  } catch (const fs::filesystem_error&) {
    // Another program may be removing bakes, too.
  }
}

} // namespace nephroid::environment
