// SPDX-License-Identifier: Apache-2.0
// Failed OpenCL calls as Errors.
#include "compute/state.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::compute {
namespace detail {

std::string error_name(cl_int code) {
#define NEPHROID_NAME(name)                                                                                            \
  case name: return #name
  switch (code) {
    NEPHROID_NAME(CL_DEVICE_NOT_FOUND);
    NEPHROID_NAME(CL_DEVICE_NOT_AVAILABLE);
    NEPHROID_NAME(CL_COMPILER_NOT_AVAILABLE);
    NEPHROID_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE);
    NEPHROID_NAME(CL_OUT_OF_RESOURCES);
    NEPHROID_NAME(CL_OUT_OF_HOST_MEMORY);
    NEPHROID_NAME(CL_BUILD_PROGRAM_FAILURE);
    NEPHROID_NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET);
    NEPHROID_NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
    NEPHROID_NAME(CL_COMPILE_PROGRAM_FAILURE);
    NEPHROID_NAME(CL_LINKER_NOT_AVAILABLE);
    NEPHROID_NAME(CL_LINK_PROGRAM_FAILURE);
    NEPHROID_NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE);
    NEPHROID_NAME(CL_INVALID_VALUE);
    NEPHROID_NAME(CL_INVALID_PLATFORM);
    NEPHROID_NAME(CL_INVALID_DEVICE);
    NEPHROID_NAME(CL_INVALID_CONTEXT);
    NEPHROID_NAME(CL_INVALID_COMMAND_QUEUE);
    NEPHROID_NAME(CL_INVALID_MEM_OBJECT);
    NEPHROID_NAME(CL_INVALID_BUILD_OPTIONS);
    NEPHROID_NAME(CL_INVALID_PROGRAM);
    NEPHROID_NAME(CL_INVALID_PROGRAM_EXECUTABLE);
    NEPHROID_NAME(CL_INVALID_KERNEL_NAME);
    NEPHROID_NAME(CL_INVALID_KERNEL);
    NEPHROID_NAME(CL_INVALID_ARG_INDEX);
    NEPHROID_NAME(CL_INVALID_ARG_VALUE);
    NEPHROID_NAME(CL_INVALID_ARG_SIZE);
    NEPHROID_NAME(CL_INVALID_KERNEL_ARGS);
    NEPHROID_NAME(CL_INVALID_WORK_DIMENSION);
    NEPHROID_NAME(CL_INVALID_WORK_GROUP_SIZE);
    NEPHROID_NAME(CL_INVALID_WORK_ITEM_SIZE);
    NEPHROID_NAME(CL_INVALID_OPERATION);
    NEPHROID_NAME(CL_INVALID_BUFFER_SIZE);
    NEPHROID_NAME(CL_INVALID_GLOBAL_WORK_SIZE);
    NEPHROID_NAME(CL_INVALID_COMPILER_OPTIONS);
    NEPHROID_NAME(CL_INVALID_LINKER_OPTIONS);
  case -1001: return "CL_PLATFORM_NOT_FOUND_KHR"; // cl_khr_icd; CL/cl_ext.h only
  default: return fmt::format("OpenCL error {}", code);
  }
#undef NEPHROID_NAME
}

Error call_failed(const cl::Error& error, const Location& where) {
  const std::string what = fmt::format("{} gave {}", error.what(), error_name(error.err()));
  if (const std::string problem = kernel_cache_problem(); !problem.empty())
    return failed(where, what, problem, "free space there or set POCL_CACHE_DIR to a folder that can be written");
  return failed(where, what);
}

std::string megabytes(std::uint64_t bytes) { return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6); }

Error buffers_failed(const cl::Error& error, const Location& where, const DeviceInfo& device,
                     std::vector<const BufferState*> buffers) {
  const cl_int code = error.err();
  if (code != CL_MEM_OBJECT_ALLOCATION_FAILURE && code != CL_OUT_OF_RESOURCES && code != CL_OUT_OF_HOST_MEMORY &&
      code != CL_INVALID_BUFFER_SIZE)
    return call_failed(error, where);
  constexpr std::size_t named = 3;
  std::ranges::stable_sort(buffers, std::greater(), &BufferState::bytes);
  buffers.resize(std::min(buffers.size(), named));
  std::string names;
  for (const BufferState* buffer : buffers)
    names += fmt::format("{}buffer {} of {}", names.empty() ? "" : ", ", buffer->name, megabytes(buffer->bytes));
  return failed(fmt::format("{} on {}", names.empty() ? where.text() : names, device.name),
                fmt::format("{} gave {}", error.what(), error_name(code)),
                fmt::format("the device has {}", megabytes(device.memory_bytes)),
                "use a smaller image, mesh or number of photons");
}

} // namespace detail

BuildError::BuildError(Location where, std::string what, std::string log)
    : Error(ErrorKind::failed, std::move(where), std::move(what)), log_(std::move(log)) {}

} // namespace nephroid::compute
