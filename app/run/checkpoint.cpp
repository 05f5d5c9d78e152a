// SPDX-License-Identifier: Apache-2.0
// checkpoint.bin: a header, the job's own bytes, and a hash of everything before it, written and read piece by piece.
// Because it is written whole, kill -9 leaves the checkpoint before or the new one, never half of one.
#include "run/checkpoint.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "engine/engine.h"
#include "preset/settings_type.h"
#include "run/afterimage.h"
#include "run/content.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

using Word = std::array<char, 16>; ///< filled up with zeros

Word word_of(std::string_view text) {
  Word word{};
  text.copy(word.data(), word.size() - 1);
  return word;
}

std::string text_of(const Word& word) { return {word.begin(), std::ranges::find(word, '\0')}; }

struct Header {
  std::array<char, 8> magic{'N', 'E', 'P', 'H', 'C', 'K', 'P', 'T'};
  std::uint32_t format = 4; ///< this header's and that of the history behind it (measure/measured_job.cpp)
  std::uint32_t state = 0;  ///< engine::Engine::state_version
  Word engine{}, program{}; ///< the engine's name, the program's version
  std::uint64_t device = 0, kernels = 0, content = 0; ///< hashes: another one of these gives other bits
};
static_assert(sizeof(Header) == 72, "the header has no padding: it is written as it is");

std::string device_of(const compute::Context& context) {
  const compute::DeviceInfo& device = context.device();
  return fmt::format("{}\n{}\n{}\n{}", device.name, device.platform, device.version, device.driver);
}

Header header_of(const Prepared& prepared, const compute::Context& context) {
  const std::string_view engine = prepared.preset.settings.engine();
  Header header;
  header.state = engine::engine_of(prepared.preset).state_version;
  header.engine = word_of(engine);
  header.program = word_of(version());
  header.device = hash_of(device_of(context));
  header.kernels = hash_of(compute::kernel_sources(context, engine) + compute::kernel_sources(context, "photons"));
  header.content = content_hash(prepared.preset, prepared.plan->inputs);
  if (prepared.before) header.content = hash_of(prepared.before->input.content, header.content);
  return header;
}

/// Why a file with the header `its` is none of a run with the header `ours`; empty where it is.
std::string fault_of(const Header& its, const Header& ours, const std::string& changed) {
  if (its.engine != ours.engine)
    return fmt::format("is of the engine '{}', and the preset's is '{}'", text_of(its.engine), text_of(ours.engine));
  if (its.state != ours.state)
    return fmt::format("has a state of version {} of the engine '{}', and this program has version {}", its.state,
                       text_of(ours.engine), ours.state);
  if (its.program != ours.program)
    return fmt::format("was written by version {} of the program, and this is {}", text_of(its.program),
                       text_of(ours.program));
  if (!changed.empty()) return "cannot go on: " + changed;
  if (its.content != ours.content) return "belongs to another preset or seed, or to other files";
  if (its.device != ours.device) return "was written on another device, which rounds in its own way";
  if (its.kernels != ours.kernels) return "was written with other kernels";
  return {};
}

bool hash_is_right(ByteSource& file, const fs::path& path) {
  std::uint64_t wanted = 0;
  HashedSource part(file, path, sizeof wanted);
  read_to_end(part);
  file.value(wanted);
  return part.hash() == wanted;
}

fs::path file_in(const fs::path& folder) { return folder / "checkpoint.bin"; }

} // namespace

void write_checkpoint(const fs::path& folder, const Prepared& prepared, const compute::Context& context,
                      job::Job& job) {
  const Header header = header_of(prepared, context);
  write_file_whole(file_in(folder), [&](ByteSink& file) {
    HashedSink hashed(file);
    hashed.value(header);
    job.save(hashed);
    file.value(hashed.hash());
  });
}

std::vector<std::pair<std::string, std::string>> bit_dependencies(const Prepared& prepared,
                                                                  const compute::Context& context) {
  const Header header = header_of(prepared, context);
  std::string device = device_of(context);
  std::ranges::replace(device, '\n', ' ');
  return {{"version", std::string(version())},
          {"device", std::move(device)},
          {"kernels", fmt::format("{:016x}", header.kernels)},
          {"preset and files", fmt::format("{:016x}", header.content)}};
}

bool load_checkpoint(const fs::path& folder, const Prepared& prepared, const compute::Context& context, job::Job& job) {
  const fs::path path = file_in(folder);
  if (!is_there(path)) return false;
  const auto refuse = [&](const std::string& what) { return bad_input(path, what); };
  const std::unique_ptr<ByteSource> file = open_file(path);
  const Header ours = header_of(prepared, context);
  Header header;
  HashedSource part(*file, path, sizeof(std::uint64_t));
  if (part.left() < sizeof header) throw refuse("is no checkpoint");
  part.value(header);
  if (header.magic != ours.magic) throw refuse("is no checkpoint");
  if (header.format != ours.format)
    throw refuse(fmt::format("has format {}, and this program has {}", header.format, ours.format));
  if (!hash_is_right(*open_file(path), path)) throw refuse("is cut or damaged");
  if (const std::string fault = fault_of(header, ours, changed_input(folder, prepared.plan->inputs)); !fault.empty())
    throw refuse(fault);
  job.load(part);
  if (part.left() != 0) throw refuse(fmt::format("has {} bytes more than the run's state", part.left()));
  return true;
}

} // namespace nephroid::run
