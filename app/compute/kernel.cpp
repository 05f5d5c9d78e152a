// SPDX-License-Identifier: Apache-2.0
// Device memory, and kernels run in it. Arguments are checked here: PoCL checks few of them and crashes on the rest.
#include "compute/state.h"

#include <cxxabi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

namespace nephroid::compute {
namespace {

/// The pattern of clEnqueueFillBuffer; allocations are whole multiples of it.
struct Zeros {
  cl_ulong low = 0, high = 0;
};

/// The most items in a row of a launch: half of what PoCL calls a small grid (kernels/tracing/work_item.h), so that
/// rows of whole groups stay below that, too.
constexpr std::size_t most_in_a_row = 0x8000;

std::size_t divided_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// Calls work(), and names the buffer if that fails.
template <class Work>
void named(const detail::BufferState& buffer, const Work& work) {
  try {
    work();
  } catch (const cl::Error& error) {
    throw detail::buffers_failed(error, "buffer " + buffer.name, buffer.context->info, {&buffer});
  }
}

detail::BufferState buffer_state(const Context& context, std::string name, std::size_t bytes) {
  const DeviceInfo& device = context.device();
  if (bytes > device.max_buffer_bytes)
    throw failed("buffer " + name, fmt::format("{} do not fit on {}", detail::megabytes(bytes), device.name),
                 fmt::format("at most {} a buffer", detail::megabytes(device.max_buffer_bytes)),
                 "use a smaller image, mesh or number of photons");
  return {context.state, std::move(name), {}, bytes};
}

void check_range(const char* does, std::size_t bytes, std::size_t offset_bytes, const detail::BufferState& buffer) {
  if (offset_bytes > buffer.bytes || bytes > buffer.bytes - offset_bytes)
    throw failed("buffer " + buffer.name,
                 fmt::format("{} {} bytes at {} of {}", does, bytes, offset_bytes, buffer.bytes));
}

} // namespace

RawBuffer::RawBuffer(const Context& context, std::string name, std::size_t bytes, const void* initial)
    : state(std::make_shared<detail::BufferState>(buffer_state(context, std::move(name), bytes))) {
  const std::size_t allocated = std::max<std::size_t>((bytes + sizeof(Zeros) - 1) / sizeof(Zeros), 1) * sizeof(Zeros);
  named(*state, [&] { state->buffer = cl::Buffer(context.state->context, CL_MEM_READ_WRITE, allocated); });
  if (bytes > 0 && initial) write(initial, bytes, 0);
}

RawBuffer RawBuffer::wrapping_host_memory(const Context& context, std::string name, std::size_t bytes,
                                          const void* items) {
  if (bytes == 0 || context.device().type != "cpu") return {context, std::move(name), bytes, items};
  RawBuffer buffer;
  buffer.state = std::make_shared<detail::BufferState>(buffer_state(context, std::move(name), bytes));
  named(*buffer.state, [&] {
    buffer.state->buffer = cl::Buffer(context.state->context, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, bytes,
                                      const_cast<void*>(items)); // the buffer is read-only
  });
  return buffer;
}

void RawBuffer::write(const void* from, std::size_t bytes, std::size_t offset_bytes) {
  if (bytes == 0) return;
  check_range("writing", bytes, offset_bytes, *state);
  named(*state, [&] { state->context->queue.enqueueWriteBuffer(state->buffer, CL_TRUE, offset_bytes, bytes, from); });
}

void RawBuffer::read(void* to, std::size_t bytes, std::size_t offset_bytes) const {
  if (bytes == 0) return;
  check_range("reading", bytes, offset_bytes, *state);
  named(*state, [&] { state->context->queue.enqueueReadBuffer(state->buffer, CL_TRUE, offset_bytes, bytes, to); });
}

void RawBuffer::fill_zero() {
  named(*state, [&] {
    state->context->queue.enqueueFillBuffer(state->buffer, Zeros{}, 0, state->buffer.getInfo<CL_MEM_SIZE>());
  });
}

std::string device_type_name(const std::type_info& type) {
  static const std::map<std::string, std::string> names{{"unsigned int", "uint"},     {"long", "long"},
                                                        {"unsigned long", "ulong"},   {"short", "short"},
                                                        {"unsigned short", "ushort"}, {"unsigned char", "uchar"}};
  const std::unique_ptr<char, void (*)(void*)> demangled(abi::__cxa_demangle(type.name(), nullptr, nullptr, nullptr),
                                                         std::free);
  const std::string name = demangled.get();
  const std::size_t open = name.find('<'), comma = name.rfind(", ");
  const bool vector = name.starts_with("std::array<") && comma != std::string::npos; // "std::array<float, 4ul>"
  const std::string scalar = vector ? name.substr(open + 1, comma - open - 1) : name;
  const auto known = names.find(scalar);
  return (known != names.end() ? known->second : scalar.substr(scalar.rfind(':') + 1)) +
         (vector ? name.substr(comma + 2, name.find("ul>") - comma - 2) : "");
}

void Kernel::set(const Argument& argument, std::vector<bool>& given) {
  const auto& parameters = state->parameters;
  std::size_t index = 0;
  while (index < parameters.size() && parameters[index].name != argument.name_) ++index;
  const auto refuse = [&](const std::string& what, const std::string& expected) {
    return failed(state->name, fmt::format("argument {}{}", argument.name_, what), expected);
  };
  if (index == parameters.size()) throw refuse(": the kernel has none of this name", {});
  const detail::KernelState::Parameter& parameter = parameters[index];
  if (given[index]) throw refuse(" is given twice", "each argument once");
  given[index] = true;
  const std::string& type = *argument.type_;
  if (type != parameter.type || parameter.is_pointer != (argument.buffer_ != nullptr))
    throw refuse(
        fmt::format(" is {} {}", argument.buffer_ ? "a buffer of" : "a value of type", type),
        fmt::format("it takes {} {}", parameter.is_pointer ? "a buffer of" : "a value of type", parameter.type));
  if (argument.buffer_ && !argument.buffer_->state) throw refuse(" is a buffer that was never made", {});
  try {
    if (argument.buffer_)
      state->kernel.setArg(static_cast<cl_uint>(index), argument.buffer_->state->buffer);
    else
      state->kernel.setArg(static_cast<cl_uint>(index), argument.bytes_, argument.value_);
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, fmt::format("{}, argument {}", state->name, argument.name_));
  }
}

void Kernel::run(std::size_t global, std::size_t local, std::span<const Argument> shared,
                 std::initializer_list<Argument> own) {
  std::vector<bool> given(state->parameters.size(), false);
  for (const Argument& argument : shared) set(argument, given);
  for (const Argument& argument : own) set(argument, given);
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i]) throw failed(state->name, fmt::format("argument {} is not given", state->parameters[i].name));
  if (global == 0) return;
  if (local == 0) throw failed(state->name, "queued in groups of 0 items");
  const std::size_t groups = divided_up(global, local), rows = divided_up(groups * local, most_in_a_row),
                    row = divided_up(groups, rows) * local;
  try {
    state->context->queue.enqueueNDRangeKernel(state->kernel, cl::NullRange, cl::NDRange(row, rows),
                                               cl::NDRange(local, 1));
  } catch (const cl::Error& error) {
    std::vector<const detail::BufferState*> buffers;
    for (const std::span<const Argument> arguments : {shared, std::span<const Argument>(own)})
      for (const Argument& argument : arguments)
        if (argument.buffer_) buffers.push_back(argument.buffer_->state.get());
    throw detail::buffers_failed(error,
                                 fmt::format("{} over {} items in groups of {}", state->name, groups * local, local),
                                 state->context->info, std::move(buffers));
  }
}

} // namespace nephroid::compute
