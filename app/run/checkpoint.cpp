// SPDX-License-Identifier: Apache-2.0
// checkpoint.bin: a header, the job's own bytes, and a hash of everything before it. A file that was cut, changed or made for
// another preset, mesh or spectrum is refused; because it is written whole, kill -9 leaves the checkpoint before or the new one, never half
// of one.
#include "base/files.h"
#include "run/content_hash.h"
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

template <class T>
std::string_view bytes_of(const T& value)
{
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::uint64_t content_of(const Prepared& prepared) { return content_hash(prepared.preset, prepared.loaded->scene); }

fs::path file_in(const fs::path& folder) { return folder / "checkpoint.bin"; }

} // namespace

void write_checkpoint(const fs::path& folder, const Prepared& prepared, job::Job& job)
{
  const std::vector<std::byte> payload = job.save();
  Header header;
  header.content_hash = content_of(prepared);
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
  if (!is_there(file)) return false;
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
  if (header.content_hash != content_of(prepared))
    throw refuse("belongs to another preset or seed, or a file that the preset names has changed");
  job.load(std::as_bytes(std::span(bytes).subspan(sizeof header, header.payload_bytes)));
  return true;
}

} // namespace nephroid::run
