// SPDX-License-Identifier: Apache-2.0
// Mesh files, read by a small program of its own (reader/main.cpp), which may crash, hang or run out of memory over
// them. Nothing that it answers is believed before it was looked at: a file that corrupts its memory makes it say
// anything.
#include "base/files.h"
#include "base/foreign_kind.h"
#include "base/hashed_bytes.h"
#include "base/recent.h"
#include "scene/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nephroid::scene {
namespace {

constexpr const char* formats = "a triangle mesh as OBJ, PLY, STL, glTF or 3DS";

/// The reader at its work. It does not outlive this.
class Reader {
public:
  /// Throws failed where it is not installed, or the system has no process or pipe left.
  Reader(const std::filesystem::path& file, unsigned cpu_seconds, std::size_t memory_bytes) {
    const std::string program = library_file("nephroid_mesh_reader").string();
    std::array<std::string, 4> words{program, file.string(), std::to_string(cpu_seconds), std::to_string(memory_bytes)};
    std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw failed("pipe", std::strerror(errno), {}, "close some programs or files");
    answer_.reset(fdopen(ends[0], "rb"));
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int reason = posix_spawn(&id_, program.c_str(), &streams, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    close(ends[1]);
    if (reason != 0)
      throw failed(program, fmt::format("cannot be started: {}", std::strerror(reason)), {},
                   "build or install Nephroid again");
  }

  ~Reader() {
    if (id_ < 0) return;
    end();
    wait();
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::FILE* answer() const { return answer_.get(); }

  void end() const { kill(id_, SIGKILL); }

  /// Waits for its end; the status as waitpid gives it.
  int wait() {
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
std::string reason_of_death(int status, unsigned cpu_seconds) {
  if (!WIFSIGNALED(status)) return "ended early";
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return fmt::format("did not end within {} s of processor time", cpu_seconds);
  if (signal == SIGALRM) return fmt::format("did not end within {} s", mesh_reader_patience * cpu_seconds);
  return fmt::format("crashed ({})", strsignal(signal));
}

/// The mesh as the reader program has it. Throws std::runtime_error with the reason why there is none.
Mesh ask_reader(Reader& reader, unsigned cpu_seconds, const std::stop_token& stop) {
  std::optional<MeshAnswer> answer = [&] {
    const std::stop_callback end(stop, [&reader] { reader.end(); });
    return take_answer(reader.answer());
  }();
  const int status = reader.wait();
  if (!answer || status != 0) throw std::runtime_error(reason_of_death(status, cpu_seconds));
  return mesh_of(std::move(*answer));
}

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error("the program that reads it answers nonsense: " + what);
}

/// Fills `items` with the answer's next ones; false where it ends before them. Memory grows with what comes, not with
/// what is promised. Refuses more than `most`.
template <class Items>
bool take_items(std::FILE* from, Items& items, std::uint64_t most) {
  std::uint64_t count = 0;
  if (std::fread(&count, sizeof count, 1, from) != 1) return false;
  if (count > most) refuse(fmt::format("{} items where {} are the most", count, most));
  constexpr std::uint64_t piece = 1 << 20;
  while (items.size() < count) {
    const std::size_t before = items.size(), more = std::min(piece, count - before);
    items.resize(before + more);
    if (std::fread(static_cast<void*>(items.data() + before), sizeof *items.data(), more, from) != more) return false;
  }
  return true;
}

struct CachedMesh {
  std::filesystem::path file;
  std::uint64_t bytes = 0, hash = 0; ///< the file's
  Mesh mesh;
};

std::uint64_t bytes_of(const Mesh& mesh) {
  return mesh.positions.size() * sizeof(glm::vec3) + mesh.normals.size() * sizeof(glm::vec3) +
         mesh.triangles.size() * sizeof(glm::uvec3) + mesh.texcoords.size() * sizeof(Texcoords);
}

/// Throws bad_input where the file is no mesh but something that has a name.
void refuse_foreign(const std::filesystem::path& file, const std::string& begin) {
  if (const ForeignKind* kind = foreign_kind(file, begin))
    throw bad_input(file.string(), fmt::format("is {}, which is not read", kind->what),
                    std::string("expected ") + formats, std::string(kind->remedy));
}

} // namespace

std::optional<MeshAnswer> take_answer(std::FILE* from) {
  constexpr std::uint64_t longest_refusal = 1 << 20;
  MeshAnswer answer;
  Mesh& mesh = answer.mesh;
  const bool whole =
      take_items(from, answer.refusal, longest_refusal) && take_items(from, mesh.positions, 3 * max_triangles) &&
      take_items(from, mesh.normals, 3 * max_triangles) && take_items(from, mesh.triangles, max_triangles) &&
      take_items(from, mesh.texcoords, max_triangles) && take_items(from, answer.mended, 1) &&
      take_items(from, answer.middle, 3);
  return whole ? std::optional(std::move(answer)) : std::nullopt;
}

Mesh mesh_of(MeshAnswer answer) {
  if (!answer.refusal.empty()) throw std::runtime_error(answer.refusal);
  if (answer.mended.empty()) refuse("no count of mended normals");
  if (answer.middle.size() != 3) refuse("no middle");
  Mesh mesh = std::move(answer.mesh);
  for (int axis = 0; axis < 3; ++axis) {
    mesh.middle[axis] = answer.middle[static_cast<std::size_t>(axis)];
    if (!std::isfinite(mesh.middle[axis])) refuse("a middle that is not finite");
  }
  mesh.mended_normals = answer.mended[0];
  const std::size_t vertices = mesh.positions.size();
  if (!mesh.normals.empty() && mesh.normals.size() != vertices)
    refuse(fmt::format("{} normals of {} vertices", mesh.normals.size(), vertices));
  if (!mesh.texcoords.empty() && mesh.texcoords.size() != mesh.triangles.size())
    refuse(fmt::format("texcoords for {} of {} triangles", mesh.texcoords.size(), mesh.triangles.size()));
  if (mesh.mended_normals > mesh.normals.size())
    refuse(fmt::format("{} mended normals of {}", mesh.mended_normals, mesh.normals.size()));
  for (const glm::vec3& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("a coordinate that is not finite");
  for (const glm::vec3& normal : mesh.normals)
    if (!(std::abs(glm::dot(normal, normal) - 1) < 1e-3f)) refuse("a normal that is no unit vector");
  for (const Texcoords& texcoords : mesh.texcoords)
    for (const glm::vec2& corner : texcoords)
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) refuse("a texcoord that is not finite");
  for (Texcoords& texcoords : mesh.texcoords) // farther off there is no place left between texels
    for (glm::vec2& corner : texcoords) corner = glm::clamp(corner, -1e6f, 1e6f);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (triangle[corner] >= vertices)
        refuse(fmt::format("a triangle with vertex {} of {}", triangle[corner], vertices));
  return mesh;
}

Mesh load_mesh(const std::filesystem::path& file, const std::stop_token& stop) {
  const Location where = file.string();
  std::string bytes = read_file(file); // says why, where there is nothing to read
  const std::size_t size = bytes.size();
  bytes.resize(std::min<std::size_t>(size, 64));
  bytes.shrink_to_fit();
  if (size == 0) throw bad_input(where, "the mesh file is empty", formats);
  // Good files need some 20 times their size and a second for 50 MB; glTF may keep its data in another file.
  const unsigned cpu_seconds = 5 + static_cast<unsigned>(size >> 20);
  Reader reader(file, cpu_seconds, (std::size_t{2} << 30) + 64 * size);
  Mesh mesh = [&] {
    try {
      return ask_reader(reader, cpu_seconds, stop);
    } catch (const std::runtime_error& refusal) {
      if (stop.stop_requested()) throw Error(ErrorKind::interrupted, where, "interrupted while the mesh was read");
      refuse_foreign(file, bytes);
      throw bad_input(where, "the mesh cannot be read: " + printable(refusal.what()), formats,
                      "check the file in another program");
    }
  }();
  if (!has_area(mesh)) refuse_foreign(file, bytes);
  if (!has_area(mesh))
    throw bad_input(where, mesh.triangles.empty() ? "the mesh has no triangles" : "no triangle of the mesh has an area",
                    formats);
  return mesh;
}

bool has_further_files(const std::filesystem::path& file) {
  return file.extension() == ".gltf" || file.extension() == ".GLTF";
}

std::shared_ptr<const Mesh> load_mesh_once(const std::filesystem::path& file, const Watch& watch) {
  watch.begin("reading " + file.filename().string());
  static Recent<CachedMesh> recent(std::uint64_t{256} << 20);
  if (has_further_files(file)) return std::make_shared<const Mesh>(load_mesh(file, watch.stop));
  const std::string bytes = read_file(file);
  PieceHash hash;
  hash.add(std::as_bytes(std::span(bytes)));
  std::shared_ptr<const CachedMesh> cached = recent.find([&](const CachedMesh& kept) {
    return kept.file == file && kept.bytes == bytes.size() && kept.hash == hash.value();
  });
  if (!cached) {
    Mesh mesh = load_mesh(file, watch.stop);
    const std::uint64_t size = bytes_of(mesh);
    cached = recent.add({file, bytes.size(), hash.value(), std::move(mesh)}, size);
  }
  return {cached, &cached->mesh};
}

void write_ply(const Mesh& mesh, ByteSink& to, std::string_view comment) {
  const bool with_normals = !mesh.normals.empty(), with_texcoords = !mesh.texcoords.empty();
  const std::string head =
      fmt::format("ply\nformat binary_little_endian 1.0\n{}element vertex {}\nproperty float x\nproperty float y\n"
                  "property float z\n{}element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
                  comment.empty() ? std::string() : fmt::format("comment {}\n", comment), mesh.positions.size(),
                  with_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
                  mesh.triangles.size(), with_texcoords ? "property list uchar float texcoord\n" : "");
  to.write(std::as_bytes(std::span(head)));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    to.write(std::as_bytes(std::span(&mesh.positions[i], 1)));
    if (with_normals) to.write(std::as_bytes(std::span(&mesh.normals[i], 1)));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    to.value(std::uint8_t{3});
    to.write(std::as_bytes(std::span(&mesh.triangles[i], 1)));
    if (!with_texcoords) continue;
    to.value(std::uint8_t{6});
    to.write(std::as_bytes(std::span(&mesh.texcoords[i], 1)));
  }
}

} // namespace nephroid::scene
