// SPDX-License-Identifier: Apache-2.0
// The three streams are files in memory rather than pipes: neither side ever waits for the other, however much there is.
#include "measure/program.h"

#include "base/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace nephroid::measure {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

/// A file that has no name and lives in memory.
class MemoryFile {
public:
  explicit MemoryFile(const std::string& program) : program_(program), number_(::memfd_create("stream", MFD_CLOEXEC))
  {
    if (number_ < 0) throw failed(program_, "cannot be started: " + reason(errno));
  }
  ~MemoryFile() { ::close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int number() const { return number_; }

  /// The text becomes what a reader finds from the beginning on.
  void fill(std::string_view text) const
  {
    while (!text.empty()) {
      const ssize_t count = ::write(number_, text.data(), text.size());
      if (count < 0) throw failed(program_, "cannot be given its input: " + reason(errno));
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    ::lseek(number_, 0, SEEK_SET);
  }

  std::string text() const
  {
    std::string all;
    std::array<char, 65536> piece;
    for (ssize_t count = 0; (count = ::pread(number_, piece.data(), piece.size(), static_cast<off_t>(all.size()))) > 0;)
      all.append(piece.data(), static_cast<std::size_t>(count));
    return all;
  }

private:
  const std::string& program_;
  int number_;
};

/// Starts the program with its streams on the files and no signal blocked: a thread that starts it may have blocked Ctrl-C.
pid_t start(const std::vector<std::string>& command, const MemoryFile& in, const MemoryFile& out, const MemoryFile& err)
{
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, in.number(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, out.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, err.number(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t process = -1;
  const int error = ::posix_spawnp(&process, arguments[0], &streams, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&streams);
  if (error == ENOENT) throw failed(command[0], "is not installed", {}, fmt::format("install {}", command[0]));
  if (error != 0) throw failed(command[0], "cannot be started: " + reason(error));
  return process;
}

/// The process's wait status; kills it at the end of the time.
int wait_for(pid_t process, const std::string& program, std::chrono::milliseconds limit)
{
  const auto end = std::chrono::steady_clock::now() + limit;
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process) return status;
    if (ended < 0 && errno != EINTR) throw failed(program, "cannot be waited for: " + reason(errno));
    if (std::chrono::steady_clock::now() >= end) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::kill(process, SIGKILL);
  ::waitpid(process, &status, 0);
  throw failed(program, fmt::format("was still at work after {} s", std::chrono::duration<double>(limit).count()));
}

} // namespace

std::string run_program(const std::vector<std::string>& command, std::string_view input, std::chrono::milliseconds limit)
{
  const std::string& program = command.at(0);
  const MemoryFile in(program), out(program), err(program);
  in.fill(input);
  const int status = wait_for(start(command, in, out, err), program, limit);
  if (WIFSIGNALED(status)) throw failed(program, fmt::format("was ended by signal {}", WTERMSIG(status)));
  if (const int code = WEXITSTATUS(status); code != 0) {
    const std::string complaint = err.text();
    throw failed(program, fmt::format("failed with exit code {}", code), complaint.substr(0, std::min<std::size_t>(complaint.size(), 200)));
  }
  return out.text();
}

} // namespace nephroid::measure
