// SPDX-License-Identifier: Apache-2.0
// Verbs load what they need and no more: pictures, windows and devices each cost time to start. The dynamic loader itself says what was
// loaded (LD_DEBUG, see ld.so(8)).
#include "tests/support/child.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

using namespace nephroid::test;
using testing::HasSubstr;
using testing::Not;

namespace {

/// Every library that a run of the program initialised, one a line.
std::string loaded_by(const std::vector<std::string>& arguments)
{
  const TemporaryFolder folder;
  Child child(arguments, folder.path(), folder.path(), {{"LD_DEBUG", "libs"}, {"LD_DEBUG_OUTPUT", (folder.path() / "loader").string()}});
  const Ended ended = child.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  std::string loaded;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().filename().string().rfind("loader.", 0) != 0) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      if (line.find("calling init: ") != std::string::npos) loaded += line.substr(line.find("calling init: ") + 14) + "\n";
  }
  EXPECT_THAT(loaded, HasSubstr("libc.so")); // the loader was heard at all
  return loaded;
}

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

TEST(LoadedLibraries, ARunLoadsPicturesAndTheDriver)
{
  const std::string loaded = loaded_by({"run", "spectral/plate", "--passes", "1", "-o", "out", "--set", "scene.camera.resolution=[16,16]",
                                        "--set", "spectral.photons_per_pass=1000"});
  EXPECT_THAT(loaded, HasSubstr(pictures));
  EXPECT_THAT(loaded, HasSubstr("libpocl"));
}

} // namespace
