// SPDX-License-Identifier: Apache-2.0
#include "run/afterimage.h"

#include "base/files.h"
#include "base/hashed_bytes.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

constexpr std::array<char, 8> magic{'N', 'E', 'P', 'H', 'L', 'A', 'S', 'T'};
constexpr std::uint32_t format = 1;

void serialize(Archive& archive, Afterimage& left) {
  std::array<char, 8> its = magic;
  std::uint32_t its_format = format;
  archive.value(its);
  archive.value(its_format);
  if (its != magic || its_format != format) throw bad_input(afterimage_file, "is of another version");
  archive.value(left.white);
  left.seen.serialize(archive);
  std::uint32_t count = static_cast<std::uint32_t>(left.layers.size());
  archive.value(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (archive.is_read()) left.layers.emplace_back();
    std::vector<char> name(left.layers[i].name.begin(), left.layers[i].name.end());
    archive.list(name);
    left.layers[i].name.assign(name.begin(), name.end());
    archive.list(left.layers[i].rgb);
    archive.list(left.layers[i].error_draw);
  }
}

bool is_whole(const Afterimage& left) {
  const std::size_t pixels = left.seen.places.size();
  bool whole = pixels == left.seen.camera.pixels() && left.white > 0;
  for (const job::Layer& layer : left.layers)
    whole = whole && layer.rgb.size() == 3 * pixels && layer.error_draw.size() == 3 * pixels;
  return whole;
}

} // namespace

std::shared_ptr<const Afterimage> read_afterimage(const fs::path& frame_folder) {
  const fs::path path = frame_folder / afterimage_file;
  if (!is_there(path)) return nullptr;
  try {
    auto left = std::make_shared<Afterimage>();
    const std::unique_ptr<ByteSource> file = open_file(path);
    HashedSource part(*file, path, sizeof(std::uint64_t));
    Archive archive(part);
    serialize(archive, *left);
    std::uint64_t hash = 0;
    if (part.left() > 0 || file->left() != sizeof hash) return nullptr;
    file->value(hash);
    if (hash != part.hash() || !is_whole(*left)) return nullptr;
    left->input = {fmt::format("../{}/{}", frame_folder.filename().string(), afterimage_file),
                   fmt::format("{:016x}", hash)};
    return left;
  } catch (const Error&) {
    return nullptr;
  }
}

void write_afterimage(const fs::path& frame_folder, const Prepared& prepared, const photons::SeenPlaces& seen,
                      const std::vector<job::Layer>& layers) {
  Afterimage left{seen, prepared.preset.white.value_or(1), layers, {}};
  write_file_whole(frame_folder / afterimage_file, [&](ByteSink& to) {
    HashedSink hashed(to);
    Archive archive(hashed);
    serialize(archive, left);
    to.value(hashed.hash());
  });
}

job::Beginning beginning_of(const Prepared& prepared, const photons::SeenPlaces& seen) {
  job::Beginning beginning{nullptr, prepared.preset.seed};
  if (!prepared.before) return beginning;
  const Afterimage& left = *prepared.before;
  beginning.seed = hash_of(fmt::format("{} {}", prepared.preset.seed, left.input.content));
  const std::vector<photons::Taps> taps = taps_before(seen, prepared.loaded->scene.geometry, left.seen);
  const auto scale = static_cast<float>(left.white / prepared.preset.white.value_or(1));
  auto before = std::make_shared<std::vector<job::Layer>>();
  for (const job::Layer& layer : left.layers) {
    job::Layer& there =
        before->emplace_back(job::Layer{layer.name, moved(layer.rgb, taps), moved(layer.error_draw, taps)});
    for (std::vector<float>* const values : {&there.rgb, &there.error_draw})
      for (float& value : *values) value *= scale;
  }
  beginning.before = std::move(before);
  return beginning;
}

} // namespace nephroid::run
