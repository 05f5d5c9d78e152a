// SPDX-License-Identifier: Apache-2.0
// checkpoint.bin: a header, the job's own bytes, and a hash of everything before it. A file that was cut, changed or made for
// another preset, mesh or spectrum is refused; because it is written whole, kill -9 leaves the checkpoint before or the new one, never half
// of one.
#include "base/files.h"
#include "preset/read.h"
#include "run/run.h"

#include <cstring>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

struct Header {
  char magic[8] = {'N', 'E', 'P', 'H', 'C', 'K', 'P', 'T'};
  std::uint64_t version = 1;
  std::uint64_t content_hash = 0;
  std::uint64_t payload_bytes = 0;
};
static_assert(sizeof(Header) == 32, "the header has no padding: it is written as it is");

/// FNV-1a: enough to tell presets apart and to notice damage; not against forgery. `hash` continues an earlier one.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325u)
{
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

template <class T>
std::string_view bytes_of(const T& value)
{
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

template <class T>
std::uint64_t hash_of(const std::vector<T>& items, std::uint64_t hash)
{
  return hash_of({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)}, hash);
}

/// What the sums in a checkpoint depend on: the preset, and what the files that it names held. How long a run goes on is not part of
/// what it computes: a run may be resumed with a later stop.
std::uint64_t content_hash(const Prepared& prepared, const fs::path& folder)
{
  preset::Preset preset = prepared.preset;
  preset.stop = {};
  std::uint64_t hash = hash_of(preset::to_json(preset, folder));
  const scene::Scene& scene = prepared.loaded->scene;
  hash = hash_of(scene.geometry.positions, hash);
  hash = hash_of(scene.geometry.normals, hash);
  hash = hash_of(scene.geometry.triangles, hash);
  for (const scene::Material& material : scene.materials)
    for (const optics::Spectrum* spectrum : {&material.n, &material.k, &material.reflectance}) hash = hash_of(bytes_of(*spectrum), hash);
  for (const scene::Light& light : scene.lights) hash = hash_of(bytes_of(light.spectrum), hash);
  return hash;
}

fs::path file_in(const fs::path& folder) { return folder / "checkpoint.bin"; }

} // namespace

void write_checkpoint(const fs::path& folder, const Prepared& prepared, job::Job& job)
{
  const std::vector<std::byte> payload = job.save();
  Header header;
  header.content_hash = content_hash(prepared, folder);
  header.payload_bytes = payload.size();
  std::string bytes(bytes_of(header));
  bytes.append(reinterpret_cast<const char*>(payload.data()), payload.size());
  const std::uint64_t hash = hash_of(bytes);
  bytes += bytes_of(hash);
  write_file_whole(file_in(folder), bytes);
}

bool load_checkpoint(const fs::path& folder, const Prepared& prepared, job::Job& job)
{
  const fs::path file = file_in(folder);
  if (std::error_code ignored; !fs::exists(file, ignored)) return false;
  const std::string bytes = read_file(file);
  const auto refuse = [&](const char* what) { return bad_input(file.string(), what, {}, "run without --resume to start over"); };
  Header header;
  std::uint64_t hash = 0;
  const Header ours;
  if (bytes.size() < sizeof header + sizeof hash || std::memcmp(bytes.data(), ours.magic, sizeof ours.magic) != 0)
    throw refuse("is no checkpoint");
  std::memcpy(&header, bytes.data(), sizeof header);
  std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
  if (header.version != ours.version) throw refuse("was written by another version of the program");
  const std::string_view hashed(bytes.data(), bytes.size() - sizeof hash);
  if (hashed.size() - sizeof header != header.payload_bytes || hash_of(hashed) != hash) throw refuse("is cut or damaged");
  if (header.content_hash != content_hash(prepared, folder))
    throw refuse("belongs to another preset or seed, or a file that the preset names has changed");
  job.load(std::as_bytes(std::span(bytes).subspan(sizeof header, header.payload_bytes)));
  return true;
}

} // namespace nephroid::run
