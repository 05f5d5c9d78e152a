// SPDX-License-Identifier: Apache-2.0
// Which devices there are and why there might be none.
#include "compute/state.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace nephroid::compute {
namespace {

std::string type_name(cl_device_type type)
{
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  return type & CL_DEVICE_TYPE_CPU ? "cpu" : "accelerator";
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int index)
{
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

std::vector<cl::Platform> platforms()
{
  std::vector<cl::Platform> found;
  try {
    cl::Platform::get(&found);
  } catch (const cl::Error&) { // the loader's way to say that there is none
  }
  return found;
}

} // namespace

std::vector<detail::Device> detail::enumerate_devices(std::vector<std::string>& problems)
{
  prepare_kernel_cache();
  std::vector<Device> found;
  for (const cl::Platform& platform : platforms()) {
    try {
      std::vector<cl::Device> handles;
      platform.getDevices(CL_DEVICE_TYPE_ALL, &handles);
      for (const cl::Device& handle : handles)
        if (handle.getInfo<CL_DEVICE_AVAILABLE>()) found.push_back({handle, describe(platform, handle, static_cast<int>(found.size()))});
    } catch (const cl::Error& error) { // one broken driver must not hide the devices of the others
      problems.push_back(fmt::format("{}: {} gave {}", platform.getInfo<CL_PLATFORM_NAME>(), error.what(), error_name(error.err())));
    }
  }
  if (platforms().empty()) problems.emplace_back("no OpenCL platform is installed");
  return found;
}

std::vector<DeviceInfo> list_devices()
{
  std::vector<std::string> problems;
  std::vector<DeviceInfo> infos;
  for (const detail::Device& device : detail::enumerate_devices(problems)) infos.push_back(device.info);
  return infos;
}

Error no_device_error()
{
  std::vector<std::string> problems;
  detail::enumerate_devices(problems);
  if (const std::string problem = detail::kernel_cache_problem(); !problem.empty()) problems.push_back(problem);
  if (problems.empty()) problems.emplace_back("the installed OpenCL platforms have none");
  return Error(ErrorKind::no_device, "OpenCL", "no usable device", fmt::format("{}", fmt::join(problems, "; ")),
               "for a CPU device: apt install pocl-opencl-icd");
}

} // namespace nephroid::compute
