// SPDX-License-Identifier: Apache-2.0
// The program that reads mesh files for nephroid: whatever happens to it, nephroid says so in one line; and it ends within its limits.
#include "tests/support/program_test.h"

#include <bit>
#include <csignal>
#include <sys/stat.h>

namespace nephroid::mesh_reader_test {

const fs::path real_reader = fs::path(NEPHROID_PROGRAM).parent_path().parent_path() / "lib/nephroid/nephroid_mesh_reader";

/// nephroid in an installation of its own, where a shell script takes the reader's place.
class StrangeMeshReader : public ProgramTest {
protected:
  StrangeMeshReader()
  {
    fs::create_directories(folder / "bin");
    fs::create_directories(reader.parent_path());
    fs::copy_file(NEPHROID_PROGRAM, folder / "bin/nephroid");
    write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  std::string refusal(int exit_code) const
  {
    const std::vector<std::string> arguments{"plan", "first-light", "--set", "scene.objects.0.mesh=" + (folder / "a.obj").string()};
    const Environment environment{{"NEPHROID_PRESETS", NEPHROID_SOURCE_DIR "/presets"}};
    const Ended ended = Child(arguments, folder, logs, environment, folder / "bin/nephroid").wait();
    EXPECT_EQ(ended.exit_code, exit_code);
    expect_one_line(ended);
    return ended.err;
  }
  std::string refusal_with(const std::string& script) const
  {
    std::ofstream(reader) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(reader, fs::perms::owner_all);
    return refusal(2);
  }
  const fs::path reader = folder / "lib/nephroid/nephroid_mesh_reader";
};

TEST_F(StrangeMeshReader, IsMissingOrCannotBeStarted)
{
  EXPECT_THAT(refusal(1), HasSubstr("nephroid_mesh_reader: not found in lib/nephroid beside " + (folder / "bin").string() + "; build or"));
  std::ofstream(reader) << "words\n";
  EXPECT_THAT(refusal(1), HasSubstr(reader.string() + ": cannot be started: Permission denied; build or"));
}

TEST_F(StrangeMeshReader, EndsAsItShouldNot)
{
  const std::string line = (folder / "a.obj").string() + ": the mesh cannot be read: ";
  EXPECT_THAT(refusal_with("kill -SEGV $$"), HasSubstr(line + "crashed (Segmentation fault); a triangle mesh as"));
  EXPECT_THAT(refusal_with("kill -ABRT $$"), HasSubstr(line + "crashed (Aborted); "));
  EXPECT_THAT(refusal_with("kill -XCPU $$"), HasSubstr(line + "did not end within 5 s of processor time; "));
  EXPECT_THAT(refusal_with("kill -ALRM $$"), HasSubstr(line + "did not end within 25 s; "));
  EXPECT_THAT(refusal_with("exit 0"), HasSubstr(line + "ended early; "));
  const std::string three = R"(\3\0\0\0\0\0\0\0)", zero = R"(\0\0\0\0\0\0\0\0)", one_number = R"(\1\0\0\0\0\0\0\0\0\0\0\0)";
  EXPECT_THAT(refusal_with("printf '" + three + "not'"), HasSubstr(line + "ended early; ")); // cut after its first part
  EXPECT_THAT(refusal_with("printf '" + three + "not" + zero + zero + zero + one_number + "'"), HasSubstr(line + "not; "));
}

/// Bytes as printf has them.
template <class... T>
std::string printed(const T&... values)
{
  std::string text;
  const auto add = [&](const auto& value) {
    for (const unsigned char byte : std::bit_cast<std::array<unsigned char, sizeof value>>(value)) {
      text += '\\';
      for (const int shift : {6, 3, 0}) text += static_cast<char>('0' + (byte >> shift & 7));
    }
  };
  (add(values), ...);
  return text;
}

/// An answer for three vertices and a triangle, but for what a test makes wrong.
struct Answer {
  std::uint64_t refusal = 0, vertices = 3, normals = 0, triangles = 1, counts = 1;
  float coordinate = 1, normal = 1;
  std::uint32_t corner = 2, mended = 0;

  std::string script() const
  {
    std::string bytes = printed(refusal, vertices, 0.0f, 0.0f, 0.0f, coordinate, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, normals);
    for (std::uint64_t i = 0; i < normals; ++i) bytes += printed(0.0f, 0.0f, normal);
    return "printf '" + bytes + printed(triangles, 0u, 1u, corner, counts, mended) + "'";
  }
};

TEST_F(StrangeMeshReader, AnswersNonsense)
{
  const std::string line = (folder / "a.obj").string() + ": the mesh cannot be read: the program that reads it answers nonsense: ";
  constexpr std::uint64_t many = std::uint64_t{1} << 62;
  EXPECT_THAT(refusal_with(Answer{.corner = 3}.script()), HasSubstr(line + "a triangle with vertex 3 of 3; a triangle mesh as"));
  EXPECT_THAT(refusal_with(Answer{.coordinate = NAN}.script()), HasSubstr(line + "a coordinate that is not finite; "));
  EXPECT_THAT(refusal_with(Answer{.normals = 2}.script()), HasSubstr(line + "2 normals of 3 vertices; "));
  EXPECT_THAT(refusal_with(Answer{.normals = 3, .normal = 0}.script()), HasSubstr(line + "a normal that is no unit vector; "));
  EXPECT_THAT(refusal_with(Answer{.mended = 1}.script()), HasSubstr(line + "1 mended normals of 0; "));
  EXPECT_THAT(refusal_with(Answer{.counts = 0}.script()), HasSubstr(line + "no count of mended normals; "));
  for (const Answer& promise : {Answer{.refusal = many}, Answer{.vertices = many}, Answer{.triangles = many}, Answer{.counts = 2}})
    EXPECT_THAT(refusal_with(promise.script()), HasSubstr(line)) << promise.script();
}

TEST_F(StrangeMeshReader, PromisesMoreThanComes)
{
  const std::string line = (folder / "a.obj").string() + ": the mesh cannot be read: ";
  EXPECT_THAT(refusal_with(Answer{.triangles = std::uint64_t{1} << 28}.script()), HasSubstr(line + "ended early; ")); // 3 GB
  EXPECT_THAT(refusal_with(Answer{}.script() + "; exit 1"), HasSubstr(line + "ended early; "));
}

// It would go on beside the program, and in the window stay as a zombie.
TEST_F(StrangeMeshReader, EndsWithTheProgram)
{
  refusal_with("echo $$ >" + (folder / "id").string() + "; " + Answer{.refusal = std::uint64_t{1} << 62}.script() + "; exec sleep 1000");
  pid_t id = 0;
  std::ifstream(folder / "id") >> id;
  ASSERT_GT(id, 0);
  EXPECT_EQ(::kill(id, 0), -1);
}

/// The reader itself, with small limits.
class MeshReaderLimits : public ProgramTest {
protected:
  Ended read(const std::string& file, const std::string& memory_bytes = "2000000000") const
  {
    return Child({file, "1", memory_bytes}, folder, logs, {}, real_reader).wait();
  }
  static std::string many_triangles(int count)
  {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < count; ++i) text += "f 1 2 3\n";
    return text;
  }
};

TEST_F(MeshReaderLimits, ProcessorTime)
{
  write("long.obj", many_triangles(9'000'000));
  EXPECT_EQ(read("long.obj", "8000000000").signal, SIGXCPU);
}

TEST_F(MeshReaderLimits, Memory)
{
  write("large.obj", many_triangles(100'000));
  const Ended ended = read("large.obj", "1000000");
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  EXPECT_NE(ended.exit_code, 0); // their allocators end the program
#else
  EXPECT_THAT(ended.out, HasSubstr("asked for more memory than its size explains"));
#endif
}

// Opening a pipe that nobody writes to takes for ever, and no processor time.
TEST_F(MeshReaderLimits, Patience)
{
  ASSERT_EQ(::mkfifo((folder / "pipe.mtl").c_str(), 0600), 0);
  write("waits.obj", "mtllib pipe.mtl\n" + many_triangles(1));
  EXPECT_EQ(read("waits.obj").signal, SIGALRM);
}

} // namespace nephroid::mesh_reader_test
