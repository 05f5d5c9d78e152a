// SPDX-License-Identifier: Apache-2.0
// Mesh files that are broken on purpose: each is refused with one line that names the file and says why, quickly, and
// nothing crashes, hangs or takes all memory, whatever the reader underneath does.
#include "scene/mesh.h"
#include "tests/support/program_test.h"

#include <bit>
#include <sys/stat.h>

namespace nephroid::mesh_test {

using scene::load_mesh;

constexpr const char* corners = "0 0 0\n1 0 0\n0 1 0\n";

std::string ply(const std::string& vertices, const std::string& faces, const std::string& body,
                const char* format = "ascii") {
  return fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face {}\nproperty list uchar int vertex_indices\nend_header\n{}",
                     format, vertices, faces, body);
}

/// 36 bytes: three vertices of a binary PLY file.
std::string binary_corners() {
  const float values[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(values), sizeof values};
}

std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

/// One triangle whose buffer is 42 bytes; the words are replaced in it.
std::string gltf(const std::string& from = {}, const std::string& to = {}) {
  std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
  const std::size_t at = from.empty() ? std::string::npos : text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A chain of nodes, each the child of the one before: readers that recurse overrun their stack.
std::string deep_gltf() {
  std::string nodes;
  for (int i = 1; i <= 200000; ++i) nodes += fmt::format(R"({{"children":[{}]}},)", i);
  return gltf(R"("nodes":[{"mesh":0}])", fmt::format(R"("nodes":[{}{{"mesh":0}}])", nodes));
}

struct BadFile {
  const char* name;
  std::string bytes;
  const char* says;
};

std::vector<BadFile> bad_files() {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string stl_head(80, 'x');
  const std::string little = "binary_little_endian", three_bytes("\3\0\0", 3);
  return {
      {"empty.obj", "", "the mesh file is empty"},
      {"words.obj", "This is no mesh at all.\nNot one line of it.\n", "the mesh"},
      {"points.obj", triangle + "l 1 2\np 3\n", "no triangles"},
      {"truncated.obj", "v 0 0 0\nv 1 0 0\nv 0 1", "line 3: a coordinate is missing"},
      {"beyond.obj", triangle + "f 1 2 9\n", "out of range"},
      {"zero.obj", triangle + "f 0 1 2\n", "index 0 of a vertex is out of range"},
      {"negative.obj", triangle + "f -1 -2 -9\n", "out of range"},
      {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not a finite number"},
      {"huge.obj", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not a finite number"},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle of the mesh has an area"},
      {"no_format", "hello", "No suitable reader"},
      {"stone.asc", "GemCad 5.0\ng 96 0.0\n",
       "is a cutting list of GemCad, which is not read; expected a triangle mesh as OBJ"},
      {"part.step", "ISO-10303-21;\nHEADER;\n", "is a CAD model, which is not read"},
      {"picture.png", "\x89PNG\r\n\x1a\n....................", "No suitable reader"},
      {"vertices.ply", ply("4000000000", "1", corners), "of the 4000000000 that its header declares"},
      {"faces.ply", ply("3", "4000000000", std::string(corners) + "3 0 1 2\n"), "'face' of the 4000000000"},
      {"minus.ply", ply("-3", "1", corners), "declares '-3' elements 'vertex'"},
      {"more_than_64_bits.ply", ply("99999999999999999999", "1", corners), "declares '99999999999999999999'"},
      {"truncated.ply", ply("3", "1", "0 0 0\n1 0"), "ends in element 1 'vertex'"},
      {"beyond.ply", ply("3", "1", std::string(corners) + "3 0 1 9\n"), "names vertex 9 of 3"},
      {"negative.ply", ply("3", "1", std::string(corners) + "3 0 1 -1\n"), "names vertex -1 of 3"},
      {"far.obj", "v 3e38 0 0\nv -3e38 0 0\nv 0 1 0\nf 1 2 3\n", "more than 1e18 units"},
      {"nan.ply", ply("3", "1", "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"), "not a finite number"},
      {"list.ply", ply("3", "1", std::string(corners) + "4000000000 0 1 2\n"), "ends in element 0 'face'"},
      {"binary.ply", ply("100000000", "1", binary_corners(), little.c_str()), "'vertex' of the 100000000"},
      {"binary_list.ply", ply("3", "1", binary_corners() + "\xff" + three_bytes, little.c_str()), "'face' of the 1"},
      {"type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n", "unknown type 'quad'"},
      {"format.ply", "ply\nformat ebcdic 1.0\nend_header\n", "unknown format 'ebcdic'"},
      {"zero_byte.ply", std::string("ply\0format ascii 1.0\nelement vertex 4\n", 39), "no end_header"},
      {"header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "no end_header"},
      {"count.stl", stl_head + little_endian(0xffffffff) + std::string(50, '\0'), "cannot be read"},
      {"truncated.stl", stl_head + little_endian(1) + std::string(20, '\0'), "cannot be read"},
      {"none.stl", stl_head + little_endian(0), "no triangles"},
      {"ascii.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0", "cannot be read"},
      {"ascii_none.stl", "solid a\nendsolid a\n", "no triangles"},
      {"truncated.gltf", gltf().substr(0, 300), "cannot be read"},
      {"count.gltf", gltf(R"("count":3,"type":"VEC3")", R"("count":4000000000,"type":"VEC3")"), "out of range"},
      {"buffer.gltf", gltf(R"("byteLength":42)", R"("byteLength":4000000000)"), "expected 4000000000 bytes"},
      {"missing.gltf", gltf("data:application/octet-stream;base64,", "missing_"), "could not open referenced file"},
      {"cycle.gltf", gltf(R"("nodes":[{"mesh":0}])", R"("nodes":[{"children":[1]},{"children":[0]}])"),
       "recursive reference"},
      {"no_mesh.gltf", gltf(R"({"mesh":0})", R"({"mesh":7})"), "out of bounds"},
      {"deep.gltf", deep_gltf(), "crashed"},
      {"instances.gltf", gltf(R"({"mesh":0})", R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{}}})"),
       "it uses EXT_mesh_gpu_instancing, which makes it a scene: nephroid import takes it"},
      {"length.glb", "glTF" + little_endian(2) + little_endian(4000000000u) + "JSON",
       "of the 4000000000 that its header declares"},
      {"stub.glb", "glTF", "header declares"},
      {"stub.3ds", std::string("MM\x10\0\0\0\x3d\x3d\xff\xff\xff\x7f", 12), "cannot be read"},
  };
}

class HostileMesh : public testing::Test {
protected:
  std::string refusal(const fs::path& file) const {
    try {
      load_mesh(file);
      return "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.line();
      EXPECT_EQ(error.line().find('\n'), std::string::npos) << error.line();
      return error.line();
    }
  }
  test::TemporaryFolder folder;
};

TEST_F(HostileMesh, EachIsRefusedWithItsReason) {
  for (const BadFile& bad : bad_files()) {
    const fs::path file = folder.path() / bad.name;
    write_file_whole(file, bad.bytes);
    const std::string line = refusal(file);
    EXPECT_THAT(line, StartsWith(file.string() + ": ")) << bad.name;
    EXPECT_THAT(line, HasSubstr(bad.says)) << bad.name;
  }
}

TEST_F(HostileMesh, TheGoodFileOfTheFamilyIsRead) {
  write_file_whole(folder.path() / "good.gltf", gltf());
  EXPECT_EQ(load_mesh(folder.path() / "good.gltf").triangles.size(), 1u);
  write_file_whole(folder.path() / "good.ply", ply("3", "1", std::string(corners) + "3 0 1 2\n"));
  EXPECT_EQ(load_mesh(folder.path() / "good.ply").triangles.size(), 1u);
}

TEST_F(HostileMesh, MissingFilesAndFolders) {
  EXPECT_THAT(refusal(folder.path() / "nowhere.obj"), StartsWith((folder.path() / "nowhere.obj").string() + ": "));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("folder"));
}

// Whatever is cut out of a good file's end, and whichever byte is changed, it is read or refused; this process stays.
TEST_F(HostileMesh, CutAndChangedFilesDoNotBringTheProgramDown) {
  const std::string good[] = {ply("3", "2", std::string(corners) + "3 0 1 2\n3 0 2 1\n"),
                              "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"};
  const char* names[] = {"fuzz.ply", "fuzz.obj"};
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = good[i % 2];
    if (i % 3 == 0) bytes.resize(1 + random() % (bytes.size() - 1));
    if (i % 3 != 0) bytes[random() % bytes.size()] = "09-#\n\xff "[random() % 7];
    const fs::path file = folder.path() / names[i % 2];
    write_file_whole(file, bytes);
    try {
      load_mesh(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.line();
    }
  }
}

// The program that reads mesh files for nephroid: whatever happens to it, nephroid says so in one line; and it ends
// within its limits.

const fs::path real_reader =
    fs::path(NEPHROID_PROGRAM).parent_path().parent_path() / "lib/nephroid/nephroid_mesh_reader";

/// nephroid in an installation of its own, where a shell script takes the reader's place.
class StrangeMeshReader : public ProgramTest {
protected:
  StrangeMeshReader() {
    fs::create_directories(folder / "bin");
    fs::create_directories(reader.parent_path());
    fs::copy_file(NEPHROID_PROGRAM, folder / "bin/nephroid");
    write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  std::string refusal(int exit_code) const {
    const std::vector<std::string> arguments{"plan", "first-light", "--set",
                                             "scene.objects.0.mesh=" + (folder / "a.obj").string()};
    const Environment environment{{"NEPHROID_PRESETS", NEPHROID_SOURCE_DIR "/presets"}};
    const Ended ended = Child(arguments, folder, logs, environment, folder / "bin/nephroid").wait();
    EXPECT_EQ(ended.exit_code, exit_code);
    expect_one_line(ended);
    return ended.err;
  }
  std::string refusal_with(const std::string& script) const {
    std::ofstream(reader) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(reader, fs::perms::owner_all);
    return refusal(2);
  }
  const fs::path reader = folder / "lib/nephroid/nephroid_mesh_reader";
};

TEST_F(StrangeMeshReader, IsMissingOrCannotBeStarted) {
  EXPECT_THAT(refusal(1), HasSubstr("nephroid_mesh_reader: not found in lib/nephroid beside " +
                                    (folder / "bin").string() + "; build or"));
  std::ofstream(reader) << "words\n";
  EXPECT_THAT(refusal(1), HasSubstr(reader.string() + ": cannot be started: Permission denied; build or"));
}

TEST_F(StrangeMeshReader, EndsAsItShouldNot) {
  const std::string line = (folder / "a.obj").string() + ": the mesh cannot be read: ";
  EXPECT_THAT(refusal_with("kill -SEGV $$"), HasSubstr(line + "crashed (Segmentation fault); a triangle mesh as"));
  EXPECT_THAT(refusal_with("kill -ABRT $$"), HasSubstr(line + "crashed (Aborted); "));
  EXPECT_THAT(refusal_with("kill -XCPU $$"), HasSubstr(line + "did not end within 5 s of processor time; "));
  EXPECT_THAT(refusal_with("kill -ALRM $$"), HasSubstr(line + "did not end within 25 s; "));
  EXPECT_THAT(refusal_with("exit 0"), HasSubstr(line + "ended early; "));
  const std::string three = R"(\3\0\0\0\0\0\0\0)", zero = R"(\0\0\0\0\0\0\0\0)",
                    one_number = R"(\1\0\0\0\0\0\0\0\0\0\0\0)";
  EXPECT_THAT(refusal_with("printf '" + three + "not'"), HasSubstr(line + "ended early; ")); // cut after its first part
  EXPECT_THAT(refusal_with("printf '" + three + "not" + zero + zero + zero + zero + one_number + zero + "'"),
              HasSubstr(line + "not; "));
}

/// Bytes as printf has them.
template <class... T>
std::string printed(const T&... values) {
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
  std::uint64_t refusal = 0, vertices = 3, normals = 0, triangles = 1, counts = 1, middles = 3, texcoords = 0;
  float coordinate = 1, normal = 1, texcoord = 0;
  std::uint32_t corner = 2, mended = 0;
  double middle = 0;

  std::string script() const {
    std::string bytes = printed(refusal, vertices, 0.0f, 0.0f, 0.0f, coordinate, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, normals);
    for (std::uint64_t i = 0; i < normals; ++i) bytes += printed(0.0f, 0.0f, normal);
    bytes += printed(triangles, 0u, 1u, corner, texcoords);
    for (std::uint64_t i = 0; i < 6 * texcoords; ++i) bytes += printed(texcoord);
    bytes += counts > 0 ? printed(counts, mended) : printed(counts);
    return "printf '" + bytes + printed(middles, middle, 0.0, 0.0) + "'";
  }
};

TEST_F(StrangeMeshReader, AnswersNonsense) {
  const std::string line =
      (folder / "a.obj").string() + ": the mesh cannot be read: the program that reads it answers nonsense: ";
  constexpr std::uint64_t many = std::uint64_t{1} << 62;
  EXPECT_THAT(refusal_with(Answer{.corner = 3}.script()),
              HasSubstr(line + "a triangle with vertex 3 of 3; a triangle mesh as"));
  EXPECT_THAT(refusal_with(Answer{.coordinate = NAN}.script()), HasSubstr(line + "a coordinate that is not finite; "));
  EXPECT_THAT(refusal_with(Answer{.normals = 2}.script()), HasSubstr(line + "2 normals of 3 vertices; "));
  EXPECT_THAT(refusal_with(Answer{.texcoords = 2}.script()), HasSubstr(line + "texcoords for 2 of 1 triangles; "));
  EXPECT_THAT(refusal_with(Answer{.texcoords = 1, .texcoord = NAN}.script()),
              HasSubstr(line + "a texcoord that is not finite; "));
  EXPECT_THAT(refusal_with(Answer{.normals = 3, .normal = 0}.script()),
              HasSubstr(line + "a normal that is no unit vector; "));
  EXPECT_THAT(refusal_with(Answer{.mended = 1}.script()), HasSubstr(line + "1 mended normals of 0; "));
  EXPECT_THAT(refusal_with(Answer{.counts = 0}.script()), HasSubstr(line + "no count of mended normals; "));
  EXPECT_THAT(refusal_with(Answer{.middles = 0}.script()), HasSubstr(line + "no middle; "));
  EXPECT_THAT(refusal_with(Answer{.middle = NAN}.script()), HasSubstr(line + "a middle that is not finite; "));
  for (const Answer& promise :
       {Answer{.refusal = many}, Answer{.vertices = many}, Answer{.triangles = many}, Answer{.counts = 2}})
    EXPECT_THAT(refusal_with(promise.script()), HasSubstr(line)) << promise.script();
}

TEST_F(StrangeMeshReader, PromisesMoreThanComes) {
  const std::string line = (folder / "a.obj").string() + ": the mesh cannot be read: ";
  EXPECT_THAT(refusal_with(Answer{.triangles = std::uint64_t{1} << 28}.script()),
              HasSubstr(line + "ended early; ")); // 3 GB
  EXPECT_THAT(refusal_with(Answer{}.script() + "; exit 1"), HasSubstr(line + "ended early; "));
}

// It would go on beside the program, and in the window stay as a zombie.
TEST_F(StrangeMeshReader, EndsWithTheProgram) {
  refusal_with("echo $$ >" + (folder / "id").string() + "; " + Answer{.refusal = std::uint64_t{1} << 62}.script() +
               "; exec sleep 1000");
  pid_t id = 0;
  std::ifstream(folder / "id") >> id;
  ASSERT_GT(id, 0);
  EXPECT_EQ(::kill(id, 0), -1);
}

/// The reader itself, with small limits.
class MeshReaderLimits : public ProgramTest {
protected:
  Ended read(const std::string& file, const std::string& memory_bytes = "2000000000") const {
    return Child({file, "1", memory_bytes}, folder, logs, {}, real_reader).wait();
  }
  static std::string many_triangles(int count) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < count; ++i) text += "f 1 2 3\n";
    return text;
  }
};

TEST_F(MeshReaderLimits, ProcessorTime) {
  write("long.obj", many_triangles(9'000'000));
  // A second of a processor, or five of a clock where there is hardly a processor to be had.
  EXPECT_THAT(read("long.obj", "8000000000").signal, AnyOf(SIGXCPU, SIGALRM));
}

TEST_F(MeshReaderLimits, Memory) {
  write("large.obj", many_triangles(100'000));
  const Ended ended = read("large.obj", "1000000");
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  EXPECT_NE(ended.exit_code, 0); // their allocators end the program
#else
  EXPECT_THAT(ended.out, HasSubstr("asked for more memory than its size explains"));
#endif
}

// Opening a pipe that nobody writes to takes for ever, and no processor time.
TEST_F(MeshReaderLimits, Patience) {
  ASSERT_EQ(::mkfifo((folder / "waits.obj").c_str(), 0600), 0);
  EXPECT_EQ(read("waits.obj").signal, SIGALRM);
}

} // namespace nephroid::mesh_test
