// SPDX-License-Identifier: Apache-2.0
// Mesh files, read by a small program of its own (reader/main.cpp), which may crash, hang or run out of memory over them. Nothing that it
// answers is believed before it was looked at: a file that corrupts its memory makes it say anything.
#include "base/error.h"
#include "base/files.h"
#include "scene/mesh.h"
#include "scene/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace nephroid::scene {
namespace {

constexpr const char* formats = "a triangle mesh as OBJ, PLY, STL, glTF or 3DS";

std::string nonsense(const std::string& what) { return "the program that reads it answers nonsense: " + what; }

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

  /// Fills `items` with the answer's next ones; false where it ends before them. Memory grows with what comes, not with what is promised.
  /// Throws std::runtime_error where more than `most` are promised.
  template <class Items>
  bool take(Items& items, std::uint64_t most)
  {
    std::uint64_t count = 0;
    if (std::fread(&count, sizeof count, 1, answer_.get()) != 1) return false;
    if (count > most) throw std::runtime_error(nonsense(fmt::format("{} items where {} are the most", count, most)));
    constexpr std::uint64_t piece = 1 << 20;
    while (items.size() < count) {
      const std::size_t before = items.size(), more = std::min(piece, count - before);
      items.resize(before + more);
      if (std::fread(static_cast<void*>(items.data() + before), sizeof *items.data(), more, answer_.get()) != more) return false;
    }
    return true;
  }

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

/// Throws std::runtime_error where the rest of the program could not rely on the mesh.
void check_answer(const Mesh& mesh)
{
  const std::size_t vertices = mesh.positions.size();
  const auto refuse = [](const std::string& what) { throw std::runtime_error(nonsense(what)); };
  if (!mesh.normals.empty() && mesh.normals.size() != vertices)
    refuse(fmt::format("{} normals of {} vertices", mesh.normals.size(), vertices));
  if (mesh.mended_normals > mesh.normals.size()) refuse(fmt::format("{} mended normals of {}", mesh.mended_normals, mesh.normals.size()));
  for (const glm::vec3& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("a coordinate that is not finite");
  for (const glm::vec3& normal : mesh.normals)
    if (!(std::abs(glm::dot(normal, normal) - 1) < 1e-3f)) refuse("a normal that is no unit vector");
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (triangle[corner] >= vertices) refuse(fmt::format("a triangle with vertex {} of {}", triangle[corner], vertices));
}

/// The mesh as the reader program has it. Throws std::runtime_error with the reason why there is none.
Mesh ask_reader(Reader& reader, unsigned cpu_seconds)
{
  constexpr std::uint64_t longest_refusal = 1 << 20;
  Mesh mesh;
  std::string refusal;
  std::vector<std::uint32_t> mended;
  const bool whole = reader.take(refusal, longest_refusal) && reader.take(mesh.positions, 3 * max_triangles) &&
                     reader.take(mesh.normals, 3 * max_triangles) && reader.take(mesh.triangles, max_triangles) && reader.take(mended, 1);
  const int status = reader.wait();
  if (!whole || status != 0) throw std::runtime_error(reason_of_death(status, cpu_seconds));
  if (!refusal.empty()) throw std::runtime_error(refusal);
  if (mended.empty()) throw std::runtime_error(nonsense("no count of mended normals"));
  mesh.mended_normals = mended[0];
  check_answer(mesh);
  return mesh;
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
