// SPDX-License-Identifier: Apache-2.0
// The program that reads mesh files for nephroid: whatever happens to it, nephroid says so in one line; and it ends within its limits.
#include "tests/support/program_test.h"

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
  write("long.obj", many_triangles(3'000'000));
  EXPECT_EQ(read("long.obj").signal, SIGXCPU);
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
