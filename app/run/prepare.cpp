// SPDX-License-Identifier: Apache-2.0
// Whether a run fits is asked before anything is allocated: Linux grants memory that it does not have and kills the process later.
#include "run/run.h"

#include "base/files.h"
#include "engine/engine.h"
#include "scene/camera_and_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <numeric>
#include <utility>

namespace nephroid::run {
namespace {

/// Whether two presets load the same scene but for the camera.
bool same_but_camera(const preset::Preset& a, const preset::Preset& b)
{
  preset::Scene scene = a.scene;
  scene.camera = b.scene.camera;
  return a.source == b.source && a.unit == b.unit && scene == b.scene;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_triangles(const scene::Mesh& a, const scene::Mesh& b)
{
  return same_bytes(a.positions, b.positions) && same_bytes(a.triangles, b.triangles);
}

/// What the scene that `lender` lends was read from, at its time.
std::vector<plan::Input> inputs_of_scene(const Prepared& lender)
{
  preset::Preset scene_only;
  scene_only.source = lender.preset.source;
  scene_only.scene = lender.preset.scene;
  return read_inputs(scene_only, lender.plan->inputs);
}

LoadedScene load(const preset::Preset& preset, const Prepared* previous, bool lends_scene, const Watch& watch)
{
  if (lends_scene) {
    LoadedScene loaded = *previous->loaded;
    loaded.scene.camera = scene::make_camera(preset.scene.camera, loaded.scene);
    return loaded;
  }
  LoadedScene loaded{scene::load_scene(preset, watch), nullptr};
  if (previous && same_triangles(loaded.scene.geometry, previous->loaded->scene.geometry))
    loaded.bvh = previous->loaded->bvh;
  else {
    watch.begin("sorting the triangles");
    loaded.bvh = std::make_shared<const scene::Bvh>(scene::build_bvh(loaded.scene.geometry));
  }
  return loaded;
}

/// Of the buffers on the device, or of those on the host.
std::uint64_t total_bytes(const plan::Plan& plan, bool on_host)
{
  return std::accumulate(
      plan.buffers.begin(), plan.buffers.end(), std::uint64_t{0},
      [&](std::uint64_t sum, const plan::PlannedBuffer& buffer) { return sum + (buffer.on_host == on_host ? buffer.bytes : 0); });
}

Error does_not_fit(const plan::Plan& plan, const std::string& what, const std::string& there_is)
{
  return failed("memory", what, there_is, plan.smaller.empty() ? "choose a smaller scene.camera.resolution" : plan.smaller);
}

} // namespace

plan::PlannedBuffer picture_and_files(const plan::Plan& plan, int width, int height)
{
  const auto layers = static_cast<std::uint64_t>(plan.layers);
  // Bytes a pixel. A snapshot has three floats for each layer, for their sum and for the draw of its error.
  const std::uint64_t snapshot = 12 * (layers + 2);
  // Beside it, one after the other: what the engine takes to make it; the EXR writer's interleaved copy and its encoded file, each about as
  // large as the layers and their sum; the error's draw, two pictures in XYZ and three summed areas, in double. The report takes less, and
  // a checkpoint is written piece by piece.
  const std::uint64_t exr = 24 * (layers + 1), estimate = plan.estimates_error ? 84 : 0;
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return {"picture and its files (host)", pixels * (snapshot + std::max({plan.picture_bytes_a_pixel, exr, estimate})), true};
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
    throw does_not_fit(plan, fmt::format("the run needs {} on the device", readable_bytes(on_device)),
                       fmt::format("{} has {}", device.name, readable_bytes(device.memory_bytes)));
  for (const plan::PlannedBuffer& buffer : plan.buffers)
    if (!buffer.on_host && buffer.bytes > device.max_buffer_bytes)
      throw does_not_fit(plan, fmt::format("the buffer '{}' needs {}", buffer.name, readable_bytes(buffer.bytes)),
                         fmt::format("{} has at most {} for one buffer", device.name, readable_bytes(device.max_buffer_bytes)));
  const std::uint64_t here = total_bytes(plan, true) + (device.type == "cpu" ? on_device : 0);
  if (available && here > *available)
    throw does_not_fit(plan,
                       plan.smaller.empty() ? fmt::format("a picture of {} x {} pixels needs about {}", width, height, readable_bytes(here))
                                            : fmt::format("the run needs about {}", readable_bytes(here)),
                       fmt::format("{} of this machine's memory are free", readable_bytes(*available)));
}

Prepared prepare(const preset::Preset& preset, const Prepared* previous, const Watch& watch)
{
  const bool lends_scene = previous && same_but_camera(preset, previous->preset);
  // Before the files are loaded: of one that is written meanwhile the run is bound to what it held before, and goes on nowhere.
  std::vector<plan::Input> inputs = read_inputs(preset, lends_scene ? inputs_of_scene(*previous) : std::vector<plan::Input>());
  auto loaded = std::make_shared<const LoadedScene>(load(preset, previous, lends_scene, watch));
  watch.begin("making the plan");
  std::unique_ptr<plan::Plan> plan = engine::engine_of(preset).plan(preset, loaded->scene, *loaded->bvh);
  plan->buffers.push_back(picture_and_files(*plan, loaded->scene.camera.width, loaded->scene.camera.height));
  plan->inputs = std::move(inputs);
  plan->notes.insert(plan->notes.begin(), preset.provenance.notes.begin(), preset.provenance.notes.end());
  return {preset, std::move(loaded), std::move(plan)};
}

void require_memory(const Prepared& prepared, const compute::Context& context)
{
  const scene::Camera& camera = prepared.loaded->scene.camera;
  require_memory(*prepared.plan, camera.width, camera.height, context.device(), available_memory_bytes());
}

std::unique_ptr<job::Job> make_job(const Prepared& prepared, const mpi::RankContext& context)
{
  require_memory(prepared, context);
  return engine::engine_of(prepared.preset).job(prepared.preset, prepared.loaded->scene, *prepared.loaded->bvh, *prepared.plan, context);
}

} // namespace nephroid::run
