// SPDX-License-Identifier: Apache-2.0
// Device memory.
#include "compute/state.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::compute {
namespace {

/// What clEnqueueFillBuffer writes at a time: allocations are whole multiples of it.
struct Zeros {
  cl_ulong low = 0, high = 0;
};

} // namespace

RawBuffer::RawBuffer(const Context& context, std::string name, std::size_t bytes, const void* initial)
    : state(std::make_shared<detail::BufferState>())
{
  const DeviceInfo& device = context.device();
  if (bytes > device.max_buffer_bytes)
    throw failed("buffer " + name, fmt::format("{} do not fit on {}", detail::megabytes(bytes), device.name),
                 fmt::format("at most {} a buffer", detail::megabytes(device.max_buffer_bytes)),
                 "use a smaller image, mesh or number of photons");
  state->context = context.state;
  state->name = std::move(name);
  state->bytes = bytes;
  const std::size_t allocated = std::max<std::size_t>((bytes + sizeof(Zeros) - 1) / sizeof(Zeros), 1) * sizeof(Zeros);
  try {
    state->buffer = cl::Buffer(context.state->context, CL_MEM_READ_WRITE, allocated);
  } catch (const cl::Error& error) {
    throw detail::buffers_failed(error, "buffer " + state->name, device, {state.get()});
  }
  if (bytes > 0 && initial) write(initial, bytes, 0);
}

void RawBuffer::write(const void* from, std::size_t bytes, std::size_t offset_bytes)
{
  if (bytes == 0) return;
  if (offset_bytes > state->bytes || bytes > state->bytes - offset_bytes)
    throw failed("buffer " + state->name, fmt::format("writing {} bytes at {} to {}", bytes, offset_bytes, state->bytes));
  try {
    state->context->queue.enqueueWriteBuffer(state->buffer, CL_TRUE, offset_bytes, bytes, from);
  } catch (const cl::Error& error) {
    throw detail::buffers_failed(error, "buffer " + state->name, state->context->info, {state.get()});
  }
}

void RawBuffer::read(void* to, std::size_t bytes, std::size_t offset_bytes) const
{
  if (bytes == 0) return;
  if (offset_bytes > state->bytes || bytes > state->bytes - offset_bytes)
    throw failed("buffer " + state->name, fmt::format("reading {} bytes at {} of {}", bytes, offset_bytes, state->bytes));
  try {
    state->context->queue.enqueueReadBuffer(state->buffer, CL_TRUE, offset_bytes, bytes, to);
  } catch (const cl::Error& error) {
    throw detail::buffers_failed(error, "buffer " + state->name, state->context->info, {state.get()});
  }
}

void RawBuffer::fill_zero()
{
  try {
    state->context->queue.enqueueFillBuffer(state->buffer, Zeros{}, 0, state->buffer.getInfo<CL_MEM_SIZE>());
  } catch (const cl::Error& error) {
    throw detail::buffers_failed(error, "buffer " + state->name, state->context->info, {state.get()});
  }
}

} // namespace nephroid::compute
