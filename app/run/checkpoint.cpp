// SPDX-License-Identifier: Apache-2.0
// checkpoint.bin: a header, the job's own bytes, and a hash of everything before it, written and read piece by piece. A file that was cut,
// changed or made for another preset, mesh or spectrum, or on another device, is refused; because it is written whole, kill -9 leaves the
// checkpoint before or the new one, never half of one.
#include "base/build_info.h"
#include "base/bytes.h"
#include "base/files.h"
#include "preset/settings_type.h"
#include "run/content_hash.h"
#include "run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

struct Header {
  char magic[8] = {'N', 'E', 'P', 'H', 'C', 'K', 'P', 'T'};
  std::uint64_t format = 3;
  std::uint64_t program = 0, device = 0, kernels = 0, content = 0; ///< hashes: another one of these gives other bits
};
static_assert(sizeof(Header) == 48, "the header has no padding: it is written as it is");

std::uint64_t hash_more(std::span<const std::byte> bytes, std::uint64_t hash)
{
  return hash_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, hash);
}

class HashedSink final : public ByteSink {
public:
  explicit HashedSink(ByteSink& to) : to_(to) {}
  void write(std::span<const std::byte> bytes) override
  {
    hash_ = hash_more(bytes, hash_);
    to_.write(bytes);
  }
  std::uint64_t hash() const { return hash_; }

private:
  ByteSink& to_;
  std::uint64_t hash_ = hash_of({});
};

/// The header and the job's bytes: what comes before the hash.
class HashedPart final : public ByteSource {
public:
  explicit HashedPart(ByteSource& file) : file_(file) {}
  void read(std::span<std::byte> into) override
  {
    if (into.size() > left()) throw bad_input("checkpoint", "is cut short", "expected one of this preset", "delete it and start again");
    file_.read(into);
  }
  std::uint64_t left() const override { return file_.left() - sizeof(std::uint64_t); }

private:
  ByteSource& file_;
};

bool hash_is_right(ByteSource& file)
{
  HashedPart part(file);
  std::vector<std::byte> piece(1 << 18);
  std::uint64_t hash = hash_of({}), wanted = 0;
  while (part.left() > 0) {
    const auto next = std::span(piece).first(static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), part.left())));
    part.read(next);
    hash = hash_more(next, hash);
  }
  file.value(wanted);
  return hash == wanted;
}

Header header_of(const Prepared& prepared, const compute::Context& context)
{
  const compute::DeviceInfo& device = context.device();
  Header header;
  header.program = hash_of(version());
  header.device = hash_of(fmt::format("{}\n{}\n{}\n{}", device.name, device.platform, device.version, device.driver));
  header.kernels = hash_of(compute::kernel_sources(context, prepared.preset.settings.type().name));
  header.content = content_hash(prepared.preset, prepared.loaded->scene);
  return header;
}

fs::path file_in(const fs::path& folder) { return folder / "checkpoint.bin"; }

} // namespace

void write_checkpoint(const fs::path& folder, const Prepared& prepared, const compute::Context& context, job::Job& job)
{
  const Header header = header_of(prepared, context);
  write_file_whole(file_in(folder), [&](ByteSink& file) {
    HashedSink hashed(file);
    hashed.value(header);
    job.save(hashed);
    file.value(hashed.hash());
  });
}

bool load_checkpoint(const fs::path& folder, const Prepared& prepared, const compute::Context& context, job::Job& job)
{
  const fs::path path = file_in(folder);
  if (!is_there(path)) return false;
  const auto refuse = [&](const char* what) { return bad_input(path.string(), what, {}, "run without --resume to start over"); };
  const std::unique_ptr<ByteSource> file = open_file(path);
  const Header ours = header_of(prepared, context);
  Header header;
  if (file->left() < sizeof header + sizeof(std::uint64_t)) throw refuse("is no checkpoint");
  HashedPart part(*file);
  part.value(header);
  if (std::memcmp(header.magic, ours.magic, sizeof ours.magic) != 0) throw refuse("is no checkpoint");
  if (header.format != ours.format || header.program != ours.program) throw refuse("was written by another version of the program");
  if (!hash_is_right(*open_file(path))) throw refuse("is cut or damaged");
  if (header.content != ours.content) throw refuse("belongs to another preset or seed, or a file that the preset names has changed");
  if (header.device != ours.device) throw refuse("was written on another device, which rounds in its own way");
  if (header.kernels != ours.kernels) throw refuse("was written with other kernels");
  job.load(part);
  return true;
}

} // namespace nephroid::run
