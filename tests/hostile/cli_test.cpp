// SPDX-License-Identifier: Apache-2.0
// Bad command lines: each is answered by one line on standard error that says what is wrong, the exit code of the
// contract, nothing on standard output and no file.
#include "tests/support/program_test.h"

namespace nephroid::cli_test {

using nlohmann::json;

class CommandLine : public ProgramTest {};

// "spectral/plate" needs no mesh file.
const std::vector<Wrong> cases{
    {{"--nonsense"}, "unknown option '--nonsense'"},
    {{"--verzion"}, "did you mean '--version'?"},
    {{"-q"}, "unknown option '-q'"},
    {{"rum", "first-light"}, "unknown verb 'rum'; did you mean 'run'?"},
    {{"preset"}, "did you mean 'presets'?"},
    {{"help", "rum"}, "help: unknown verb 'rum'; did you mean 'run'?"},
    {{"--kernels", "folder", "check"}, "--kernels: stands before the verb 'check'; put it after the verb"},
    {{"first-light", "run"}, "first-light: stands before the verb 'run'"},
    {{"run"}, "run: PRESET is required; see nephroid run --help"},
    {{"run", "--device"}, "--device"},
    {{"run", "spectral/plate", "--devise", "0"}, "unknown option '--devise'; did you mean '--device'?"},
    {{"run", "--resum"}, "unknown option '--resum'; did you mean '--resume'?"},
    {{"run", "spectral/plate", "extra"}, "unexpected argument 'extra'"},
    {{"run", "spectral/plate", "run"}, "unexpected argument 'run'"},
    {{"run", ""}, "preset"},
    {{"run", "no-such-preset"}, "no-such-preset"},
    {{"run", "spectral/plat"}, "spectral/plate"},
    {{"run", "no/such/file.json"}, "no/such/file.json"},
    {{"run", "/dev/null"}, "/dev/null"},
    {{"run", "spectral/plate", "--seconds"}, "--seconds"},
    {{"run", "spectral/plate", "--seconds", "soon"}, "--seconds"},
    {{"run", "spectral/plate", "--seconds", "nan"}, "--seconds"},
    {{"run", "spectral/plate", "--seconds", "0"}, "--seconds: '0' is not a number from 0.001 to"},
    {{"run", "spectral/plate", "--seconds", "-1"}, "--seconds: '-1' is not a number"},
    {{"run", "spectral/plate", "--seconds", "inf"}, "--seconds: 'inf' is not a number"},
    {{"run", "spectral/plate", "--passes", "0"}, "--passes: '0' is not a whole number from 1"},
    {{"run", "spectral/plate", "--passes", "1.5"}, "--passes: '1.5' is not a whole number"},
    {{"run", "spectral/plate", "--passes", "99999999999"}, "--passes"},
    {{"run", "spectral/plate", "--passes", "1048577"}, "not a whole number from 1 to 1048576"},
    {{"run", "spectral/plate", "--seed", "-1"}, "--seed"},
    {{"run", "spectral/plate", "--seconds", "+-3"}, "--seconds"},
    {{"run", "spectral/plate", "--passes", "1e-1"}, "--passes: '1e-1' is not a whole number"},
    {{"run", "spectral/plate", "--seed", "1e20"}, "--seed: '1e20' is not a whole number"},
    {{"run", "spectral/plate", "--checkpoint-seconds", "never"}, "--checkpoint-seconds"},
    {{"run", "spectral/plate", "--pictures-at"}, "--pictures-at"},
    {{"run", "spectral/plate", "--pictures-at", ""}, "--pictures-at"},
    {{"run", "spectral/plate", "--pictures-at", "2,soon"}, "--pictures-at: 'soon' is not a number from 0.001 to"},
    {{"run", "spectral/plate", "--pictures-at", "2,0"}, "--pictures-at: '0' is not a number"},
    {{"run", "spectral/plate", "--pictures-at", "2;3"}, "--pictures-at: '2;3' is not a number"},
    {{"run", "spectral/plate", "--pictures-at", "nan"}, "--pictures-at"},
    {{"run", "spectral/plate", "--set"}, "--set"},
    {{"run", "spectral/plate", "--set", "seed"}, "seed"},
    {{"run", "spectral/plate", "--set", "=1"}, "--set"},
    {{"run", "spectral/plate", "--set", "scene.camera.fov=40"}, "fov_deg"},
    {{"run", "spectral/plate", "--set", "scene.camera.fov_deg=wide"}, "number"},
    {{"run", "spectral/plate", "--set", "scene.camera.fov_deg=400"}, "400"},
    {{"run", "spectral/plate", "--set", "scene.lights.7.irradiance_w_m2=2"}, "7"},
    {{"run", "spectral/plate", "--set", "scene.materials.glass.dispersion=no-such-glass.yml"}, "no-such-glass.yml"},
    {{"run", "spectral/plate", "--device", "99"}, "99", 3},
    {{"run", "spectral/plate", "--device", "abacus"}, "abacus", 3},
    {{"run", "spectral/plate", "--kernels", "/no/such/folder"}, "/no/such/folder"},
    {{"plan"}, "plan: PRESET is required"},
    {{"plan", "no-such-preset"}, "no-such-preset"},
    {{"plan", "spectral/plate", "--seed", "1"}, "unknown option '--seed'; did you mean '--set'?"},
    {{"plan", "spectral/plate", "--jason"}, "did you mean '--json'?"},
    {{"version", "extra"}, "version: unexpected argument 'extra'"},
    {{"version", "plan"}, "version: unexpected argument 'plan'"},
    {{"schema", "--jsn"}, "unknown option '--jsn'"},
};

TEST_F(CommandLine, BadOnesAreAnsweredInOneLine) {
  ASSERT_GE(cases.size(), 25u);
  for (const Wrong& wrong : cases) {
    SCOPED_TRACE(wrong.says);
    expect_refused(run(wrong.arguments), wrong);
    EXPECT_TRUE(fs::is_empty(folder)) << "something was written";
    fs::remove_all(folder / "out"); // only this case is to fail
  }
}

TEST_F(CommandLine, HelpTeachesEveryVerb) {
  const Ended help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  EXPECT_EQ(run({"help"}).out, help.out);
  EXPECT_EQ(run({"help", "plate"}).out, run({"plate", "--help"}).out);
  for (const char* verb : {"run", "plan", "presets", "dispersion", "clusters", "devices", "schema", "version"}) {
    EXPECT_THAT(help.out, HasSubstr(std::string("\n  ") + verb));
    const Ended own = run({verb, "--help"});
    EXPECT_EQ(own.exit_code, 0);
    EXPECT_GT(own.out.size(), 60u) << verb;
  }
}

TEST_F(CommandLine, VersionIsOneFigureAndQuick) {
  EXPECT_THAT(run({"--version"}).out, StartsWith("nephroid "));
  const Ended version = run({"version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, HasSubstr("CLI11"));
  EXPECT_THAT(run({"version", "--json"}).out, HasSubstr("\"compiler\":"));
}

TEST_F(CommandLine, WithoutAWindowSomethingSaysWhatToDo) {
  const Ended ended = run({"spectral/plate"}, {{"DISPLAY", std::nullopt}, {"WAYLAND_DISPLAY", std::nullopt}});
  EXPECT_NE(ended.exit_code, 0);
  expect_one_line(ended);
  EXPECT_THAT(ended.err, HasSubstr("nephroid run"));
}

TEST_F(CommandLine, AClosedStandardOutputIsAFailureNotSilence) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "there is no /dev/full";
  for (const char* arguments :
       {"version", "schema", "presets --json", "plan spectral/plate", "--help"}) { // short and long ones
    const std::string command =
        fmt::format("'{}' {} >/dev/full 2>'{}'", NEPHROID_PROGRAM, arguments, (logs / "stderr").string());
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
    EXPECT_EQ(nephroid::read_file(logs / "stderr"),
              "nephroid: standard output: cannot be written: No space left on device\n")
        << arguments;
  }
}

// Verbs load what they need and no more: pictures, windows and devices each cost time to start. The dynamic loader
// itself says what was loaded (LD_DEBUG, see ld.so(8)).

/// By the file name of each program that a run of nephroid started, itself among them: every library that it
/// initialised, one a line.
std::map<std::string, std::string> programs_of(const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  Child child(arguments, folder.path(), folder.path(),
              {{"LD_DEBUG", "libs"}, {"LD_DEBUG_OUTPUT", (folder.path() / "loader").string()}});
  const Ended ended = child.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  std::map<std::string, std::string> programs;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().filename().string().rfind("loader.", 0) != 0) continue;
    std::ifstream file(entry.path());
    std::string program, loaded;
    for (std::string line; std::getline(file, line);) {
      if (const std::size_t at = line.find("calling init: "); at != std::string::npos)
        loaded += line.substr(at + 14) + "\n";
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

TEST(LoadedLibraries, VerbsThatOnlyReadLoadNoPicturesNoWindowAndNoDriver) {
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

// Its reader meets corrupt files in a process of its own, which has neither the driver nor the window nor their
// threads.
TEST(LoadedLibraries, OnlyTheMeshReaderLoadsAssimp) {
  const TemporaryFolder folder;
  const std::string mesh =
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  std::map<std::string, std::string> programs =
      programs_of({"plan", "first-light", "--set", "scene.objects.0.mesh=" + mesh});
  EXPECT_THAT(programs, SizeIs(2));
  EXPECT_THAT(programs["nephroid"], Not(HasSubstr("libassimp")));
  EXPECT_THAT(programs["nephroid_mesh_reader"], HasSubstr("libassimp"));
  EXPECT_THAT(programs["nephroid_mesh_reader"],
              Not(AnyOf(HasSubstr("libOpenCL"), HasSubstr("libembree"), HasSubstr("libGL"))));
}

TEST(LoadedLibraries, ARunLoadsPicturesAndTheDriver) {
  const std::string loaded = loaded_by({"run", "spectral/plate", "--passes", "1", "-o", "out", "--set",
                                        "scene.camera.resolution=[16,16]", "--set", "spectral.photons_per_pass=1000"});
  EXPECT_THAT(loaded, HasSubstr(pictures));
  EXPECT_THAT(loaded, HasSubstr("libpocl"));
}

// `nephroid check` as a script sees it: its JSON, its exit codes, a wrong kernel, Ctrl-C.

class CheckVerb : public ProgramTest {
protected:
  Ended check(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "check");
    return run(arguments);
  }
};

TEST_F(CheckVerb, JsonIsAsTheContractHasIt) {
  const Ended ended = check({"--json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const json all = json::parse(ended.out);
  EXPECT_TRUE(all.at("device").is_string());
  ASSERT_GT(all.at("checks").size(), 30u);
  for (const json& one : all.at("checks")) {
    EXPECT_TRUE(one.at("name").is_string() && one.at("unit").is_string() && one.at("detail").is_string()) << one;
    EXPECT_EQ(one.at("pass").get<bool>(), std::abs(one.at("figure").get<double>()) <= one.at("tolerance").get<double>())
        << one;
  }
}

TEST_F(CheckVerb, AWrongKernelIsNamedAndExitsWithOne) {
  const fs::path kernels = folder / "kernels";
  fs::copy(NEPHROID_SOURCE_DIR "/kernels", kernels, fs::copy_options::recursive);
  std::string text = nephroid::read_file(kernels / "check/check_sums.cl"); // the other programs stay compiled
  text.replace(text.find("FILM_LIMIT"), 10, "(4 * FILM_LIMIT)");
  nephroid::write_file_whole(kernels / "check/check_sums.cl", text);
  nephroid::write_file_whole(kernels / "tracing/trace.cl", "nonsense\n");
  const Ended ended = check({"--kernels", kernels.string()});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("6 failed: film: takes what fits, refuses the rest, rays: closest hits, "));
  EXPECT_THAT(ended.out, HasSubstr("trace.cl:1: "));                  // why, under the line
  EXPECT_THAT(ended.out, HasSubstr("interface: Snell's directions")); // and it went on
}

TEST_F(CheckVerb, NoSuchDeviceExitsWithThree) {
  const Ended ended = check({"--device", "abacus"});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_THAT(ended.err, HasSubstr("abacus"));
  EXPECT_EQ(check({"--device", "0", "--all"}).exit_code, 2);
  EXPECT_EQ(check({"--kernels", "nowhere"}).exit_code, 2);
}

TEST_F(CheckVerb, ASeedIsAWholeNumber) {
  for (const char* seed : {"-1", "x", "1.5", "nan", "18446744073709551616"}) {
    const Ended ended = check({"--seed", seed});
    EXPECT_EQ(ended.exit_code, 2) << seed;
    EXPECT_THAT(ended.err,
                HasSubstr(std::string("--seed: '") + seed + "' is not a whole number from 0 to 18446744073709551615"));
  }
}

TEST_F(CheckVerb, CtrlCEndsInOrder) {
  Child child({"check"}, folder, logs);
  ASSERT_TRUE(child.until([&] { return child.out().find("built-in: exp") != std::string::npos; }));
  child.send(SIGINT);
  const Ended ended = child.wait();
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("interrupted after "));
}

} // namespace nephroid::cli_test
