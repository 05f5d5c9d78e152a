// SPDX-License-Identifier: Apache-2.0
// Running kernels: arguments are checked here, because PoCL checks few of them and crashes on the rest.
#include "compute/state.h"

#include <fmt/format.h>

namespace nephroid::compute {

void Kernel::begin(std::size_t argument_count)
{
  if (argument_count == state->is_pointer.size()) return;
  throw failed(state->name, fmt::format("called with {} arguments", argument_count), fmt::format("it takes {}", state->is_pointer.size()));
}

void Kernel::set_buffer(int index, const RawBuffer& buffer)
{
  if (!buffer.state) throw failed(state->name, fmt::format("argument {} is a buffer that was never made", index));
  if (!state->is_pointer[static_cast<std::size_t>(index)])
    throw failed(state->name, fmt::format("argument {} is buffer {}", index, buffer.state->name), "it takes a value there");
  try {
    state->kernel.setArg(static_cast<cl_uint>(index), buffer.state->buffer);
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, fmt::format("{}, argument {} ({})", state->name, index, buffer.state->name));
  }
}

void Kernel::set_bytes(int index, const void* data, std::size_t bytes)
{
  if (state->is_pointer[static_cast<std::size_t>(index)])
    throw failed(state->name, fmt::format("argument {} is a value of {} bytes", index, bytes), "it takes a buffer there");
  try {
    state->kernel.setArg(static_cast<cl_uint>(index), bytes, data);
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, fmt::format("{}, argument {} of {} bytes", state->name, index, bytes));
  }
}

void Kernel::enqueue(std::size_t global, std::size_t local)
{
  if (global == 0) return;
  if (local == 0) throw failed(state->name, "queued in groups of 0 items");
  const std::size_t rounded = (global + local - 1) / local * local;
  try {
    state->context->queue.enqueueNDRangeKernel(state->kernel, cl::NullRange, cl::NDRange(rounded), cl::NDRange(local));
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, fmt::format("{} over {} items in groups of {}", state->name, rounded, local));
  }
}

} // namespace nephroid::compute
