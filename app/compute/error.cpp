// SPDX-License-Identifier: Apache-2.0
// Failed OpenCL calls as Errors.
#include "compute/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace nephroid::compute {
namespace detail {

// The codes and, as one text, their names.
#define NEPHROID_CODES(...)                                                                                                                \
  constexpr cl_int codes[] = {__VA_ARGS__};                                                                                                \
  constexpr const char* code_names = #__VA_ARGS__;
NEPHROID_CODES(CL_DEVICE_NOT_FOUND, CL_DEVICE_NOT_AVAILABLE, CL_COMPILER_NOT_AVAILABLE, CL_MEM_OBJECT_ALLOCATION_FAILURE,
               CL_OUT_OF_RESOURCES, CL_OUT_OF_HOST_MEMORY, CL_BUILD_PROGRAM_FAILURE, CL_MISALIGNED_SUB_BUFFER_OFFSET,
               CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, CL_COMPILE_PROGRAM_FAILURE, CL_LINKER_NOT_AVAILABLE, CL_LINK_PROGRAM_FAILURE,
               CL_KERNEL_ARG_INFO_NOT_AVAILABLE, CL_INVALID_VALUE, CL_INVALID_PLATFORM, CL_INVALID_DEVICE, CL_INVALID_CONTEXT,
               CL_INVALID_COMMAND_QUEUE, CL_INVALID_MEM_OBJECT, CL_INVALID_BUILD_OPTIONS, CL_INVALID_PROGRAM, CL_INVALID_PROGRAM_EXECUTABLE,
               CL_INVALID_KERNEL_NAME, CL_INVALID_KERNEL, CL_INVALID_ARG_INDEX, CL_INVALID_ARG_VALUE, CL_INVALID_ARG_SIZE,
               CL_INVALID_KERNEL_ARGS, CL_INVALID_WORK_DIMENSION, CL_INVALID_WORK_GROUP_SIZE, CL_INVALID_WORK_ITEM_SIZE,
               CL_INVALID_OPERATION, CL_INVALID_BUFFER_SIZE, CL_INVALID_GLOBAL_WORK_SIZE, CL_INVALID_COMPILER_OPTIONS,
               CL_INVALID_LINKER_OPTIONS)
#undef NEPHROID_CODES

std::string error_name(cl_int code)
{
  if (code == -1001) return "CL_PLATFORM_NOT_FOUND_KHR"; // cl_khr_icd; CL/cl_ext.h only
  const auto place = std::ranges::find(codes, code) - std::begin(codes);
  if (place == std::ssize(codes)) return fmt::format("OpenCL error {}", code);
  std::istringstream names(code_names);
  std::string name;
  for (std::ptrdiff_t i = 0; i <= place; ++i) names >> name;
  return name.substr(0, name.find(','));
}

Error call_failed(const cl::Error& error, const Place& where)
{
  const std::string what = fmt::format("{} gave {}", error.what(), error_name(error.err()));
  if (const std::string problem = kernel_cache_problem(); !problem.empty())
    return failed(where, what, problem, "free space there or set POCL_CACHE_DIR to a folder that can be written");
  return failed(where, what);
}

std::string megabytes(std::uint64_t bytes) { return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6); }

Error buffers_failed(const cl::Error& error, const Place& where, const DeviceInfo& device, std::vector<const BufferState*> buffers)
{
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
                fmt::format("{} gave {}", error.what(), error_name(code)), fmt::format("the device has {}", megabytes(device.memory_bytes)),
                "use a smaller image, mesh or number of photons");
}

} // namespace detail

BuildError::BuildError(Place where, std::string what, std::string log)
    : Error(ErrorKind::failed, std::move(where), std::move(what)), log_(std::move(log))
{
}

} // namespace nephroid::compute
