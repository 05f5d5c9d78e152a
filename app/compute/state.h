// SPDX-License-Identifier: Apache-2.0
// What compute.h hides: OpenCL's objects, and how a failed call becomes an Error. Private to this folder.
#pragma once
#include "base/location.h"
#include "compute/compute.h"

#include <functional>

#define CL_TARGET_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>

namespace nephroid::compute::detail {

struct Device {
  cl::Device handle;
  DeviceInfo info;
};

/// Every device of every platform. Adds to `problems` a line for each platform that cannot list its devices.
std::vector<Device> enumerate_devices(std::vector<std::string>& problems);

/// A program and the text that it was built from.
struct BuiltProgram {
  std::string source;
  cl::Program program;
};

struct ContextState {
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  std::filesystem::path kernels; ///< empty: the embedded sources
  /// Built programs by file and compiler options. A newer text replaces an older one.
  std::map<std::pair<std::string, std::string>, BuiltProgram> programs;
  std::function<void()> tell_of_compiling = [] {};
  bool cold = false; ///< Context::is_cold
};

struct ProgramState {
  std::shared_ptr<ContextState> context;
  std::string file;
  cl::Program program;
};

struct KernelState {
  std::shared_ptr<ContextState> context;
  cl::Kernel kernel;
  std::string name; ///< "tracing/trace.cl: closest_hits", for messages
  struct Parameter {
    std::string name, type; ///< type of the value, or of what a pointer points to
    bool is_pointer = false;
  };
  std::vector<Parameter> parameters;
};

struct BufferState {
  std::shared_ptr<ContextState> context;
  std::string name;
  cl::Buffer buffer;
  std::size_t bytes = 0;
};

/// "CL_OUT_OF_RESOURCES" for -5; the number if it has no name.
std::string error_name(cl_int code);

/// Error(failed) at `where` for a call that failed. It names an unusable kernel cache, which PoCL does not.
Error call_failed(const cl::Error& error, const Location& where);

/// The error of a call over buffers. If memory ran out, it names the largest of them and what to do.
Error buffers_failed(const cl::Error& error, const Location& where, const DeviceInfo& device,
                     std::vector<const BufferState*> buffers);

std::string megabytes(std::uint64_t bytes);

/// Why PoCL cannot keep its kernels in the folder that it will use; empty if it can.
std::string kernel_cache_problem();

} // namespace nephroid::compute::detail
