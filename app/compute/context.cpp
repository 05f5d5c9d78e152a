// SPDX-License-Identifier: Apache-2.0
// Choosing a device and opening it with one queue.
#include "base/lower_case.h"
#include "compute/compute.h"
#include "compute/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace nephroid::compute {
namespace {

namespace fs = std::filesystem;

bool matches(const DeviceInfo& info, const std::string& selector)
{
  const bool number = std::all_of(selector.begin(), selector.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (number) return std::to_string(info.index) == selector;
  return lower_case(info.name).find(lower_case(selector)) != std::string::npos;
}

detail::Device choose(const std::vector<detail::Device>& devices, const std::string& selector)
{
  if (selector.empty()) {
    const auto gpu = std::find_if(devices.begin(), devices.end(), [](const detail::Device& d) { return d.info.type == "gpu"; });
    return gpu != devices.end() ? *gpu : devices.front();
  }
  for (const detail::Device& device : devices)
    if (matches(device.info, selector)) return device;
  std::string there;
  for (const detail::Device& device : devices)
    there += fmt::format("{}{} {}", there.empty() ? "" : ", ", device.info.index, device.info.name);
  throw Error(ErrorKind::no_device, "--device " + selector, "no device has this number or name", "there are: " + there,
              "give a number or part of a name");
}

/// PoCL's compiler would end the process.
void refuse_without_kernel_cache(const DeviceInfo& device)
{
  if (device.platform != "Portable Computing Language") return;
  const std::string problem = detail::kernel_cache_problem();
  if (!problem.empty()) throw Error(ErrorKind::no_device, device.name, problem, {}, "set POCL_CACHE_DIR to a folder that can be written");
}

} // namespace

KernelTimes kernel_times(const fs::path& folder)
{
  KernelTimes times;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone; // a file that an editor replaces may vanish between the two calls
    const auto time = entry->last_write_time(gone);
    if (!gone) times[entry->path()] = time;
  }
  return times;
}

Context Context::open(const DeviceOptions& options)
{
  std::vector<std::string> problems;
  const std::vector<detail::Device> devices = detail::enumerate_devices(problems);
  if (devices.empty()) throw no_device_error();
  if (!options.kernels.empty() && !fs::is_directory(options.kernels))
    throw bad_input("--kernels " + options.kernels.string(), "not a folder", "a folder with every file of kernels/");
  const detail::Device device = choose(devices, options.selector);
  refuse_without_kernel_cache(device.info);
  Context context;
  context.state = std::make_shared<detail::ContextState>();
  detail::ContextState& s = *context.state;
  s.info = device.info;
  s.device = device.handle;
  s.kernels = options.kernels;
  try {
    s.context = cl::Context(device.handle);
    s.queue = cl::CommandQueue(s.context, device.handle);
  } catch (const cl::Error& error) {
    const Error failure = detail::call_failed(error, device.info.name);
    throw Error(ErrorKind::no_device, {}, failure.line());
  }
  return context;
}

void tell_of_compiling(const Context& context, std::function<void()> tell) { context.state->tell_of_compiling = std::move(tell); }

const DeviceInfo& Context::device() const { return state->info; }

void Context::finish()
{
  try {
    state->queue.finish();
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, state->info.name);
  }
}

void Context::flush()
{
  try {
    state->queue.flush();
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, state->info.name);
  }
}

} // namespace nephroid::compute
