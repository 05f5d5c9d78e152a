// SPDX-License-Identifier: Apache-2.0
// A forked child, a pipe back, and the system's own limits on processor time and memory.
#include "scene/isolated.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <new>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nephroid::scene {
namespace {

/// Pages of address space this process has: the first number of /proc/self/statm.
std::size_t address_space_bytes()
{
  unsigned long pages = 0;
  if (FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void lower_limit(int resource, rlim_t value)
{
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  limit.rlim_cur = std::min(value, limit.rlim_cur); // RLIM_INFINITY is the largest value
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void write_all(int descriptor, const void* data, std::size_t size)
{
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(descriptor, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1); // the parent is gone
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

struct Header {
  std::uint64_t done = 0; ///< 1: the work's bytes follow, 0: the text of its exception
  std::uint64_t size = 0;
};

void send(int descriptor, std::uint64_t done, std::string_view bytes)
{
  const Header header{done, bytes.size()};
  write_all(descriptor, &header, sizeof header);
  write_all(descriptor, bytes.data(), bytes.size());
}

/// The child's whole life: quiet, limited, without the parent's signal handlers, and it ends without running any destructor.
[[noreturn]] void child(int descriptor, const std::function<std::string()>& work, rlim_t memory_bytes, rlim_t cpu_seconds)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(signal, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_CPU, cpu_seconds);
  lower_limit(RLIMIT_AS, memory_bytes);
  lower_limit(RLIMIT_STACK, 8 << 20); // so that endless recursion ends early whatever the shell's limit
  try {
    send(descriptor, 1, work());
  } catch (const std::bad_alloc&) {
    send(descriptor, 0, "asked for more memory than its size explains");
  } catch (const std::exception& e) {
    send(descriptor, 0, e.what());
  }
  _exit(0);
}

std::string read_all(int descriptor)
{
  std::string bytes;
  std::array<char, 1 << 16> block;
  for (;;) {
    const ssize_t got = read(descriptor, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(got));
  }
}

std::string reason_of_death(int status, const IsolationLimits& limits)
{
  if (!WIFSIGNALED(status)) return "ended early";
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return fmt::format("did not end within {} s of processor time", limits.cpu_seconds);
  return fmt::format("crashed ({})", strsignal(signal));
}

} // namespace

std::string run_isolated(const std::function<std::string()>& work, const IsolationLimits& limits)
{
  const rlim_t memory_bytes = address_space_bytes() + limits.extra_memory_bytes;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw failed("pipe", std::strerror(errno), {}, "close some programs or files");
  const pid_t id = fork();
  if (id < 0) {
    const int reason = errno;
    close(ends[0]);
    close(ends[1]);
    throw failed("fork", std::strerror(reason), {}, "close some programs");
  }
  if (id == 0) child(ends[1], work, memory_bytes, limits.cpu_seconds);
  close(ends[1]);
  std::string bytes = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }

  Header header;
  if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
  if (bytes.size() < sizeof header || bytes.size() - sizeof header != header.size) throw IsolatedFailure(reason_of_death(status, limits));
  bytes.erase(0, sizeof header);
  if (header.done == 0) throw IsolatedFailure(bytes);
  return bytes;
}

} // namespace nephroid::scene
