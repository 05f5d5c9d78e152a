// SPDX-License-Identifier: Apache-2.0
// Whether a run fits, asked before anything is allocated: Linux grants memory that it does not have and kills the process later.
#include "run/memory.h"

#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>

namespace nephroid::run {
namespace {

constexpr const char* remedy = "choose a smaller scene.camera.resolution";

/// What saving a picture takes at its peak, in bytes, for `layers` films of 3 channels where a checkpoint holds saved_bytes:
/// the snapshot's floats, 12 a pixel for each layer, for their sum and for the draw of its error, are held throughout; beside them come
///  - the EXR writer's interleaved copy, its encoded file and the copy of that which is written, each at most about as large, or
///  - the checkpoint: once as the job's bytes and once as the file's.
/// Reading a film back for a snapshot, one at a time, is less than either, and so are measuring, 24 a pixel for CIELAB, and smoothing, less
/// than 100 a pixel.
std::uint64_t peak_bytes(std::uint64_t layers, std::uint64_t pixels, std::uint64_t saved_bytes)
{
  const std::uint64_t floats = 12 * (layers + 2) * pixels;
  return floats + std::max(3 * floats, 2 * saved_bytes);
}

/// Of the buffers on the device, or of those on the host.
std::uint64_t total_bytes(const plan::Plan& plan, bool on_host)
{
  return std::accumulate(
      plan.buffers.begin(), plan.buffers.end(), std::uint64_t{0},
      [&](std::uint64_t sum, const plan::PlannedBuffer& buffer) { return sum + (buffer.on_host == on_host ? buffer.bytes : 0); });
}

Error does_not_fit(const std::string& what, const std::string& there_is) { return failed("memory", what, there_is, remedy); }

} // namespace

std::uint64_t host_bytes(const plan::Plan& plan, int width, int height)
{
  std::uint64_t layers = 0, saved_bytes = 0;
  for (const plan::PlannedBuffer& buffer : plan.buffers)
    if (const bool film = buffer.name.starts_with("film "); film || buffer.saved) {
      layers += film;
      saved_bytes += buffer.bytes;
    }
  return total_bytes(plan, true) + peak_bytes(layers, static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height), saved_bytes);
}

std::optional<std::uint64_t> available_memory_bytes()
{
  std::string text;
  try {
    text = read_file("/proc/meminfo");
  } catch (const Error&) {
    return std::nullopt; // /proc is not mounted
  }
  const std::string_view key = "MemAvailable:";
  const std::size_t at = text.find(key);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t digits = std::min(text.find_first_not_of(' ', at + key.size()), text.size());
  std::uint64_t kib = 0;
  const auto [end, error] = std::from_chars(text.data() + digits, text.data() + text.size(), kib);
  return error == std::errc() ? std::optional(kib * 1024) : std::nullopt;
}

void require_memory(const plan::Plan& plan, int width, int height, const compute::DeviceInfo& device,
                    std::optional<std::uint64_t> available)
{
  using plan::readable_bytes;
  const std::uint64_t on_device = total_bytes(plan, false);
  if (on_device > device.memory_bytes)
    throw does_not_fit(fmt::format("the run needs {} on the device", readable_bytes(on_device)),
                       fmt::format("{} has {}", device.name, readable_bytes(device.memory_bytes)));
  for (const plan::PlannedBuffer& buffer : plan.buffers)
    if (!buffer.on_host && buffer.bytes > device.max_buffer_bytes)
      throw does_not_fit(fmt::format("the buffer '{}' needs {}", buffer.name, readable_bytes(buffer.bytes)),
                         fmt::format("{} has at most {} for one buffer", device.name, readable_bytes(device.max_buffer_bytes)));
  const std::uint64_t here = host_bytes(plan, width, height) + (device.type == "cpu" ? on_device : 0);
  if (available && here > *available)
    throw does_not_fit(fmt::format("a picture of {} x {} pixels needs about {}", width, height, readable_bytes(here)),
                       fmt::format("{} of this machine's memory are free", readable_bytes(*available)));
}

} // namespace nephroid::run
