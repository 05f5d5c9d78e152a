// SPDX-License-Identifier: Apache-2.0
// Verbs load what they need and no more: pictures, windows and devices each cost time to start. The dynamic loader itself says what was
// loaded (LD_DEBUG, see ld.so(8)).
#include "tests/support/child.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::loaded_libraries_test {

/// By the file name of each program that a run of nephroid started, itself among them: every library that it initialised, one a line.
std::map<std::string, std::string> programs_of(const std::vector<std::string>& arguments)
{
  const TemporaryFolder folder;
  Child child(arguments, folder.path(), folder.path(), {{"LD_DEBUG", "libs"}, {"LD_DEBUG_OUTPUT", (folder.path() / "loader").string()}});
  const Ended ended = child.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  std::map<std::string, std::string> programs;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().filename().string().rfind("loader.", 0) != 0) continue;
    std::ifstream file(entry.path());
    std::string program, loaded;
    for (std::string line; std::getline(file, line);) {
      if (const std::size_t at = line.find("calling init: "); at != std::string::npos) loaded += line.substr(at + 14) + "\n";
      if (line.find("initialize program: ") != std::string::npos) program = line.substr(line.rfind('/') + 1);
    }
    programs[program] += loaded;
  }
  EXPECT_THAT(programs["nephroid"], HasSubstr("libc.so")); // the loader was heard at all
  return programs;
}

std::string loaded_by(const std::vector<std::string>& arguments) { return programs_of(arguments)["nephroid"]; }

const char* const pictures = "libOpenImageIO";
#ifndef NEPHROID_UI
const char* const window = "libGL";
#endif
const char* const compiler = "libLLVM"; // of the device's driver

TEST(LoadedLibraries, VerbsThatOnlyReadLoadNoPicturesNoWindowAndNoDriver)
{
  const std::string material = NEPHROID_SOURCE_DIR "/presets/materials/N-BK7.yml";
  for (const std::vector<std::string>& verb :
       {std::vector<std::string>{"version"}, {"dispersion", material}, {"schema"}, {"plan", "first-light"}}) {
    const std::string loaded = loaded_by(verb);
    EXPECT_THAT(loaded, Not(HasSubstr(pictures))) << verb[0];
#ifndef NEPHROID_UI // a program with a window is linked with GLFW, which is initialised where a window is opened
    EXPECT_THAT(loaded, Not(HasSubstr(window))) << verb[0];
#endif
    EXPECT_THAT(loaded, Not(HasSubstr(compiler))) << verb[0];
  }
}

// Its reader meets corrupt files in a process of its own, which has neither the driver nor the window nor their threads.
TEST(LoadedLibraries, OnlyTheMeshReaderLoadsAssimp)
{
  const TemporaryFolder folder;
  const std::string mesh = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  std::map<std::string, std::string> programs = programs_of({"plan", "first-light", "--set", "scene.objects.0.mesh=" + mesh});
  EXPECT_THAT(programs, SizeIs(2));
  EXPECT_THAT(programs["nephroid"], Not(HasSubstr("libassimp")));
  EXPECT_THAT(programs["nephroid_mesh_reader"], HasSubstr("libassimp"));
  EXPECT_THAT(programs["nephroid_mesh_reader"], Not(AnyOf(HasSubstr("libOpenCL"), HasSubstr("libembree"), HasSubstr("libGL"))));
}

TEST(LoadedLibraries, ARunLoadsPicturesAndTheDriver)
{
  const std::string loaded = loaded_by({"run", "spectral/plate", "--passes", "1", "-o", "out", "--set", "scene.camera.resolution=[16,16]",
                                        "--set", "spectral.photons_per_pass=1000"});
  EXPECT_THAT(loaded, HasSubstr(pictures));
  EXPECT_THAT(loaded, HasSubstr("libpocl"));
}

} // namespace nephroid::loaded_libraries_test
