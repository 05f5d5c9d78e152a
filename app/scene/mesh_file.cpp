// SPDX-License-Identifier: Apache-2.0
// Mesh files, read by a small program of its own (reader/main.cpp), which may crash, hang or run out of memory over them.
#include "base/error.h"
#include "base/files.h"
#include "scene/mesh.h"
#include "scene/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace nephroid::scene {
namespace {

constexpr const char* formats = "a triangle mesh as OBJ, PLY, STL, glTF or 3DS";

/// The reader at its work. It does not outlive this.
class Reader {
public:
  /// Throws failed where it is not installed, or the system has no process or pipe left.
  Reader(const std::filesystem::path& file, unsigned cpu_seconds, std::size_t memory_bytes)
  {
    const std::string program = library_file("nephroid_mesh_reader").string();
    std::array<std::string, 4> words{program, file.string(), std::to_string(cpu_seconds), std::to_string(memory_bytes)};
    std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw failed("pipe", std::strerror(errno), {}, "close some programs or files");
    answer_.reset(fdopen(ends[0], "rb"));
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int reason = posix_spawn(&id_, program.c_str(), &streams, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    close(ends[1]);
    if (reason != 0)
      throw failed(program, fmt::format("cannot be started: {}", std::strerror(reason)), {}, "build or install Nephroid again");
  }

  ~Reader()
  {
    if (id_ < 0) return;
    kill(id_, SIGKILL);
    wait();
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::FILE* answer() const { return answer_.get(); }

  /// Waits for its end; the status as waitpid gives it.
  int wait()
  {
    answer_.reset();
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> answer_;
  pid_t id_ = -1;
};

/// Why the reader did not end well, as the rest of a sentence.
std::string reason_of_death(int status, unsigned cpu_seconds)
{
  if (!WIFSIGNALED(status)) return "ended early";
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return fmt::format("did not end within {} s of processor time", cpu_seconds);
  if (signal == SIGALRM) return fmt::format("did not end within {} s", mesh_reader_patience * cpu_seconds);
  return fmt::format("crashed ({})", strsignal(signal));
}

/// The mesh as the reader program has it. Throws std::runtime_error with the reason why there is none.
Mesh ask_reader(Reader& reader, unsigned cpu_seconds)
{
  std::optional<MeshAnswer> answer = take_answer(reader.answer());
  const int status = reader.wait();
  if (!answer || status != 0) throw std::runtime_error(reason_of_death(status, cpu_seconds));
  return mesh_of(std::move(*answer));
}

} // namespace

Mesh load_mesh(const std::filesystem::path& file)
{
  const Place where = file.string();
  std::size_t size = 0;
  {
    const std::string bytes = read_file(file);
    if (bytes.empty()) throw bad_input(where, "the mesh file is empty", formats);
    check_declared_size(bytes, where);
    size = bytes.size();
  }
  // Good files need some 20 times their size and a second for 50 MB; glTF may keep its data in another file.
  const unsigned cpu_seconds = 5 + static_cast<unsigned>(size >> 20);
  Reader reader(file, cpu_seconds, (std::size_t{2} << 30) + 64 * size);
  Mesh mesh = [&] {
    try {
      return ask_reader(reader, cpu_seconds);
    } catch (const std::runtime_error& refusal) {
      throw bad_input(where, "the mesh cannot be read: " + printable(refusal.what()), formats, "check the file in another program");
    }
  }();
  if (std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                  [&mesh](const glm::uvec3& triangle) { return is_degenerate(mesh, triangle); }))
    throw bad_input(where, mesh.triangles.empty() ? "the mesh has no triangles" : "no triangle of the mesh has an area", formats);
  return mesh;
}

} // namespace nephroid::scene
