// SPDX-License-Identifier: Apache-2.0
// OpenCL as the engines use it: a device, typed buffers, programs from kernels/, kernels called like functions. Every
// failure is an Error with the call, the kernel and the build log.
#pragma once
#include "base/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace nephroid::compute {

struct DeviceInfo {
  int index = 0;                                     ///< the number for --device
  std::string name, platform, driver, version, type; ///< type: "cpu", "gpu" or "accelerator"
  int compute_units = 0;
  std::uint64_t memory_bytes = 0, max_buffer_bytes = 0;
  std::uint64_t max_group_items = 0; ///< the most work items in one group
  bool fp64 = false, int64_atomics = false;
};

/// PoCL compiles into a cache folder and shows no device without one. If that folder is missing, unwritable or full,
/// this sets POCL_CACHE_DIR to a private temporary folder and returns a line to show, else an empty one. Call it before
/// any thread starts. list_devices and Context::open also call it, and drop the line.
std::string prepare_kernel_cache();

/// Every device of every platform, in a stable order. An empty list is no error.
std::vector<DeviceInfo> list_devices();

/// Error(no_device), with a line for each likely cause.
Error no_device_error();

/// A kernel source that does not compile. line() has the first error at FILE:LINE; log() is the compiler's whole log.
class BuildError : public Error {
public:
  BuildError(Location where, std::string what, std::string log);
  const std::string& log() const { return log_; }

private:
  std::string log_;
};

struct DeviceOptions {
  std::string selector{};          ///< "": a GPU if there is one, else the first device; an index; or part of a name
  std::filesystem::path kernels{}; ///< folder to load kernels from, instead of the embedded ones
  int turn = 0;                    ///< which of the devices that match the selector, counted around
};

using Defines = std::map<std::string, std::string>;

namespace detail {
struct ContextState;
struct ProgramState;
struct KernelState;
struct BufferState;
} // namespace detail

/// One device with its context and one in-order queue. Copies share it. Use it from one thread at a time.
class Context {
public:
  /// Throws Error(no_device) with likely causes if no device exists, or with those there are if none matches.
  static Context open(const DeviceOptions& options = {});
  const DeviceInfo& device() const;
  /// Whether a program was built since set_warm(). The first run of its kernels compiles them.
  bool is_cold() const;
  void set_warm() const;
  /// Waits until all queued work is done. Throws failed with the first error.
  void finish();
  std::shared_ptr<detail::ContextState> state;
};

/// Untyped device memory; use Buffer<T>.
class RawBuffer {
public:
  RawBuffer() = default;
  RawBuffer(const Context& context, std::string name, std::size_t bytes, const void* initial);
  /// A read-only buffer. A device may read `items` in place, so they must not change while the buffer lives.
  static RawBuffer wrapping_host_memory(const Context& context, std::string name, std::size_t bytes, const void* items);
  void write(const void* from, std::size_t bytes, std::size_t offset_bytes);
  void read(void* to, std::size_t bytes, std::size_t offset_bytes) const; ///< waits
  void fill_zero();
  std::shared_ptr<detail::BufferState> state;
};

/// count items of T on the device. An empty buffer has a few bytes, so that it can be a kernel's argument. Throws
/// failed if the memory is not enough; on many devices only the first use does.
template <class T>
class Buffer : public RawBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  Buffer() = default;
  Buffer(const Context& context, std::string name, std::size_t count)
      : RawBuffer(context, std::move(name), count * sizeof(T), nullptr), count_(count) {}
  Buffer(const Context& context, std::string name, std::span<const T> items)
      : RawBuffer(context, std::move(name), items.size_bytes(), items.data()), count_(items.size()) {}
  static Buffer wrapping_host_memory(const Context& context, std::string name, std::span<const T> items) {
    Buffer buffer;
    static_cast<RawBuffer&>(buffer) =
        RawBuffer::wrapping_host_memory(context, std::move(name), items.size_bytes(), items.data());
    buffer.count_ = items.size();
    return buffer;
  }
  std::size_t size() const { return count_; }
  std::size_t bytes() const { return count_ * sizeof(T); }
  void write(std::span<const T> items, std::size_t first = 0) {
    RawBuffer::write(items.data(), items.size_bytes(), first * sizeof(T));
  }
  std::vector<T> read() const {
    std::vector<T> items(count_);
    if (count_) RawBuffer::read(items.data(), bytes(), 0);
    return items;
  }

private:
  std::size_t count_ = 0;
};
template <class T>
Buffer(const Context&, const char*, const std::vector<T>&) -> Buffer<T>;

template <class T>
Buffer<T> zeroed(const Context& context, std::string name, std::size_t count) {
  Buffer<T> buffer(context, std::move(name), count);
  buffer.fill_zero();
  return buffer;
}

/// The name in OpenCL C of a host type: "uint", "float4" for std::array<float, 4>, a struct's own name.
std::string device_type_name(const std::type_info& type);

/// A kernel's argument, by its name in the kernel. It refers to the value, which must live until the kernel is queued.
class Argument {
public:
  template <class T>
  Argument(std::string_view name, const Buffer<T>& buffer) : name_(name), type_(&type_of<T>()), buffer_(&buffer) {}
  template <class T>
  Argument(std::string_view name, const T& value)
      : name_(name), type_(&type_of<T>()), value_(&value), bytes_(sizeof(T)) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_base_of_v<RawBuffer, T>);
  }

private:
  friend class Kernel;
  template <class T>
  static const std::string& type_of() {
    static const std::string name = device_type_name(typeid(T));
    return name;
  }
  std::string_view name_;
  const std::string* type_; ///< device_type_name of the value, or of a buffer's items
  const RawBuffer* buffer_ = nullptr;
  const void* value_ = nullptr;
  std::size_t bytes_ = 0;
};

class Kernel {
public:
  /// Queues the kernel over `global` work items in groups of `local`. `global` is rounded up, so kernels test their
  /// index, which is work_item() (kernels/tracing/work_item.h). Every argument must be given once, in `shared` or in
  /// `own`, in any order. Throws failed for an argument that the kernel does not have, has with another type, or lacks.
  /// Throws failed also if memory runs out, and names the largest of its buffers, their bytes and the device's memory.
  void run(std::size_t global, std::size_t local, std::span<const Argument> shared,
           std::initializer_list<Argument> own);
  void run(std::size_t global, std::size_t local, std::initializer_list<Argument> arguments) {
    run(global, local, {}, arguments);
  }
  std::shared_ptr<detail::KernelState> state;

private:
  void set(const Argument& argument, std::vector<bool>& given);
};

/// One .cl file built for the context's device. The compiler's -D are `defines`, NEPHROID_CPU or NEPHROID_GPU, and
/// NEPHROID_FP64 and NEPHROID_INT64_ATOMICS if the device has them. The context keeps built programs while their
/// sources stay the same.
class Program {
public:
  /// file: its path in kernels/, e.g. "tracing/trace.cl". Throws BuildError; failed if a source is missing.
  Program(const Context& context, const std::string& file, const Defines& defines = {});
  /// Throws failed for an unknown name and lists the kernels.
  Kernel kernel(const std::string& name) const;
  std::shared_ptr<detail::ProgramState> state;
};

/// The text of every .cl file in `folder` of kernels/ with all includes, as this context would build it. Empty if there
/// is no such folder: an engine may have no kernels. Throws failed if it cannot be read.
std::string kernel_sources(const Context& context, std::string_view folder);
/// The text of a kernel source ("photons/photons.cl") with all includes, as this context would build it.
std::string kernel_source(const Context& context, const std::string& file);
/// The last write time of each file in a kernels folder, which shows changes. Empty if the folder cannot be read. It
/// needs no context: a thread may call it while another one builds programs.
using KernelTimes = std::map<std::filesystem::path, std::filesystem::file_time_type>;
KernelTimes kernel_times(const std::filesystem::path& folder);

/// Announces compilation, because the first run with a new option takes seconds to begin. While this exists, the
/// context calls tell() before it compiles a kernel source, on the thread that uses it, but not for programs that it
/// already has. What tell() throws ends the build. OpenCL may compile further until each kernel has run once.
class TellOfCompiling {
public:
  TellOfCompiling(Context context, std::function<void()> tell);
  ~TellOfCompiling();
  TellOfCompiling(const TellOfCompiling&) = delete;
  TellOfCompiling& operator=(const TellOfCompiling&) = delete;

private:
  Context context_;
};

} // namespace nephroid::compute
