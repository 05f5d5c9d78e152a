// SPDX-License-Identifier: Apache-2.0
// Which devices there are and why there might be none; choosing one and opening it with one queue.
#include "base/lower_case.h"
#include "compute/own_queue.h"
#include "compute/state.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>

namespace nephroid::compute {
namespace {

std::string type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  return type & CL_DEVICE_TYPE_CPU ? "cpu" : "accelerator";
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int index) {
  const auto extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
  DeviceInfo info;
  info.index = index;
  info.name = device.getInfo<CL_DEVICE_NAME>();
  info.platform = platform.getInfo<CL_PLATFORM_NAME>();
  info.driver = device.getInfo<CL_DRIVER_VERSION>();
  info.version = device.getInfo<CL_DEVICE_VERSION>();
  info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
  info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.max_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.max_group_items = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  info.fp64 = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
  info.int64_atomics = extensions.find("cl_khr_int64_base_atomics") != std::string::npos;
  return info;
}

std::vector<cl::Platform> platforms() {
  std::vector<cl::Platform> found;
  try {
    cl::Platform::get(&found);
  } catch (const cl::Error&) { // the loader throws this if there is no platform
  }
  return found;
}

bool matches(const DeviceInfo& info, const std::string& selector) {
  const bool number = std::ranges::all_of(selector, [](unsigned char c) { return std::isdigit(c) != 0; });
  if (number) return std::to_string(info.index) == selector;
  return lower_case(info.name).find(lower_case(selector)) != std::string::npos;
}

detail::Device choose(const std::vector<detail::Device>& devices, const std::string& selector, int turn) {
  std::vector<detail::Device> meant;
  std::ranges::copy_if(devices, std::back_inserter(meant), [&](const detail::Device& device) {
    return selector.empty() ? device.info.type == "gpu" : matches(device.info, selector);
  });
  if (meant.empty() && selector.empty()) meant = devices;
  if (!meant.empty()) return meant[static_cast<std::size_t>(turn) % meant.size()];
  std::string there;
  for (const detail::Device& device : devices)
    there += fmt::format("{}{} {}", there.empty() ? "" : ", ", device.info.index, device.info.name);
  throw Error(ErrorKind::no_device, "--device " + selector, "no device has this number or name", "there are: " + there,
              "give a number or part of a name");
}

/// Without a kernel cache, PoCL's compiler would end the process.
void refuse_without_kernel_cache(const DeviceInfo& device) {
  if (device.platform != "Portable Computing Language") return;
  const std::string problem = detail::kernel_cache_problem();
  if (!problem.empty())
    throw Error(ErrorKind::no_device, device.name, problem, {}, "set POCL_CACHE_DIR to a folder that can be written");
}

} // namespace

std::vector<detail::Device> detail::enumerate_devices(std::vector<std::string>& problems) {
  prepare_kernel_cache();
  std::vector<Device> found;
  for (const cl::Platform& platform : platforms()) {
    try {
      std::vector<cl::Device> handles;
      platform.getDevices(CL_DEVICE_TYPE_ALL, &handles);
      for (const cl::Device& handle : handles)
        if (handle.getInfo<CL_DEVICE_AVAILABLE>())
          found.push_back({handle, describe(platform, handle, static_cast<int>(found.size()))});
    } catch (const cl::Error& error) { // one broken driver must not hide the devices of the others
      problems.push_back(
          fmt::format("{}: {} gave {}", platform.getInfo<CL_PLATFORM_NAME>(), error.what(), error_name(error.err())));
    }
  }
  if (platforms().empty()) problems.emplace_back("no OpenCL platform is installed");
  return found;
}

std::vector<DeviceInfo> list_devices() {
  std::vector<std::string> problems;
  std::vector<DeviceInfo> infos;
  for (const detail::Device& device : detail::enumerate_devices(problems)) infos.push_back(device.info);
  return infos;
}

Error no_device_error() {
  std::vector<std::string> problems;
  detail::enumerate_devices(problems);
  if (const std::string problem = detail::kernel_cache_problem(); !problem.empty()) problems.push_back(problem);
  if (problems.empty()) problems.emplace_back("the installed OpenCL platforms have none");
  return Error(ErrorKind::no_device, "OpenCL", "no usable device", fmt::format("{}", fmt::join(problems, "; ")),
               "for a CPU device: apt install pocl-opencl-icd");
}

Context Context::open(const DeviceOptions& options) {
  std::vector<std::string> problems;
  const std::vector<detail::Device> devices = detail::enumerate_devices(problems);
  if (devices.empty()) throw no_device_error();
  if (!options.kernels.empty() && !std::filesystem::is_directory(options.kernels))
    throw bad_input("--kernels " + options.kernels.string(), "not a folder", "a folder with every file of kernels/");
  const detail::Device device = choose(devices, options.selector, options.turn);
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

Context with_own_queue(const Context& context) {
  Context other;
  other.state = std::make_shared<detail::ContextState>();
  detail::ContextState& s = *other.state;
  s.info = context.state->info;
  s.device = context.state->device;
  s.kernels = context.state->kernels;
  s.context = context.state->context;
  try {
    s.queue = cl::CommandQueue(s.context, s.device);
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, s.info.name);
  }
  return other;
}

TellOfCompiling::TellOfCompiling(Context context, std::function<void()> tell) : context_(std::move(context)) {
  context_.state->tell_of_compiling = std::move(tell);
}

TellOfCompiling::~TellOfCompiling() {
  context_.state->tell_of_compiling = [] {};
}

const DeviceInfo& Context::device() const { return state->info; }

bool Context::is_cold() const { return state->cold; }

void Context::set_warm() const { state->cold = false; }

void Context::finish() {
  try {
    state->queue.finish();
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, state->info.name);
  }
}

} // namespace nephroid::compute
