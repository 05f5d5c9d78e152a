// SPDX-License-Identifier: Apache-2.0
#include "run/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <numeric>

namespace nephroid::run {
namespace {

/// The bytes of the buffers on the device, or of those on the host.
std::uint64_t total_bytes(const plan::Plan& plan, bool on_host) {
  return std::accumulate(plan.buffers.begin(), plan.buffers.end(), std::uint64_t{0},
                         [&](std::uint64_t sum, const plan::PlannedBuffer& buffer) {
                           return sum + (buffer.on_host == on_host ? buffer.bytes : 0);
                         });
}

Error does_not_fit(const plan::Plan& plan, const std::string& what, const std::string& there_is) {
  return failed("memory", what, there_is,
                plan.smaller.empty() ? "choose a smaller scene.camera.resolution" : plan.smaller);
}

} // namespace

plan::PlannedBuffer picture_and_files(const plan::Plan& plan, int width, int height) {
  const auto layers = static_cast<std::uint64_t>(plan.layers);
  // Bytes a pixel. A snapshot has three floats for each layer, for their sum and for the draw of its error.
  const std::uint64_t snapshot = 12 * (layers + 2);
  // Beside it, one after the other: what the engine takes to make it; the EXR writer's interleaved copy and its encoded
  // file, each about as large as the layers and their sum; the error's draw, two pictures in XYZ and three summed
  // areas, in double. The report takes less, and a checkpoint is written piece by piece.
  const std::uint64_t exr = 24 * (layers + 1), estimate = plan.estimates_error ? 84 : 0;
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return {"picture and its files (host)", pixels * (snapshot + std::max({plan.picture_bytes_a_pixel, exr, estimate})),
          true};
}

plan::PlannedBuffer held_of_frame_before(const plan::Plan& plan, int width, int height) {
  // Bytes a pixel: light and draw of each layer, as it was left, moved, mixed and copied; places and taps; what is in
  // hand while one layer is mixed.
  const std::uint64_t layers = std::uint64_t{4} * 24 * static_cast<std::uint64_t>(plan.layers), places = 88,
                      mixing = 160;
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return {"frame before (host)", pixels * (layers + places + mixing), true};
}

std::optional<std::uint64_t> available_memory_bytes() {
  std::ifstream file("/proc/meminfo"); // "MemAvailable:   12345 kB"; it may not be mounted
  std::string key;
  for (std::uint64_t kib = 0; file >> key >> kib; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (key == "MemAvailable:") return kib * 1024;
  return std::nullopt;
}

void require_memory(const plan::Plan& plan, int width, int height, const compute::DeviceInfo& device,
                    std::optional<std::uint64_t> available) {
  using plan::readable_bytes;
  const std::uint64_t on_device = total_bytes(plan, false);
  if (on_device > device.memory_bytes)
    throw does_not_fit(plan, fmt::format("the run needs {} on the device", readable_bytes(on_device)),
                       fmt::format("{} has {}", device.name, readable_bytes(device.memory_bytes)));
  for (const plan::PlannedBuffer& buffer : plan.buffers)
    if (!buffer.on_host && buffer.bytes > device.max_buffer_bytes)
      throw does_not_fit(
          plan, fmt::format("the buffer '{}' needs {}", buffer.name, readable_bytes(buffer.bytes)),
          fmt::format("{} has at most {} for one buffer", device.name, readable_bytes(device.max_buffer_bytes)));
  const std::uint64_t here = total_bytes(plan, true) + (device.type == "cpu" ? on_device : 0);
  if (available && here > *available)
    throw does_not_fit(plan,
                       plan.smaller.empty() ? fmt::format("a picture of {} x {} pixels needs about {}", width, height,
                                                          readable_bytes(here))
                                            : fmt::format("the run needs about {}", readable_bytes(here)),
                       fmt::format("{} of this machine's memory are free", readable_bytes(*available)));
}

void require_memory(const Prepared& prepared, const compute::Context& context) {
  const scene::Camera& camera = prepared.loaded->scene.camera;
  require_memory(*prepared.plan, camera.width, camera.height, context.device(), available_memory_bytes());
}

} // namespace nephroid::run
