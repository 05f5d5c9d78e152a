// SPDX-License-Identifier: Apache-2.0
// Bad command lines: each is answered by one line on standard error that says what is wrong, the exit code of the contract, nothing
// on standard output and no file.
#include "tests/support/program_test.h"

namespace nephroid::cli_test {

class CommandLine : public ProgramTest {};

// "spectral/plate" needs no mesh file.
const std::vector<Wrong> cases{
    {{"--nonsense"}, "unknown option '--nonsense'"},
    {{"--verzion"}, "did you mean '--version'?"},
    {{"-q"}, "unknown option '-q'"},
    {{"rum", "first-light"}, "unknown verb 'rum'; did you mean 'run'?"},
    {{"preset"}, "did you mean 'presets'?"},
    {{"help"}, "unknown verb 'help'; did you mean '--help'?"},
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

TEST_F(CommandLine, BadOnesAreAnsweredInOneLine)
{
  ASSERT_GE(cases.size(), 25u);
  for (const Wrong& wrong : cases) {
    SCOPED_TRACE(wrong.says);
    expect_refused(run(wrong.arguments), wrong);
    EXPECT_TRUE(fs::is_empty(folder)) << "something was written";
    fs::remove_all(folder / "out"); // only this case is to fail
  }
}

TEST_F(CommandLine, HelpTeachesEveryVerb)
{
  const Ended help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* verb : {"run", "plan", "presets", "dispersion", "clusters", "devices", "schema", "version"}) {
    EXPECT_THAT(help.out, HasSubstr(std::string("\n  ") + verb));
    const Ended own = run({verb, "--help"});
    EXPECT_EQ(own.exit_code, 0);
    EXPECT_GT(own.out.size(), 60u) << verb;
  }
}

TEST_F(CommandLine, VersionIsOneFigureAndQuick)
{
  EXPECT_THAT(run({"--version"}).out, StartsWith("nephroid "));
  const Ended version = run({"version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, HasSubstr("CLI11"));
  EXPECT_THAT(run({"version", "--json"}).out, HasSubstr("\"compiler\":"));
}

TEST_F(CommandLine, WithoutAWindowSomethingSaysWhatToDo)
{
  const Ended ended = run({"spectral/plate"}, {{"DISPLAY", std::nullopt}, {"WAYLAND_DISPLAY", std::nullopt}});
  EXPECT_NE(ended.exit_code, 0);
  expect_one_line(ended);
  EXPECT_THAT(ended.err, HasSubstr("nephroid run"));
}

TEST_F(CommandLine, AClosedStandardOutputIsAFailureNotSilence)
{
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "there is no /dev/full";
  for (const char* arguments : {"version", "schema", "presets --json", "plan spectral/plate", "--help"}) { // short and long ones
    const std::string command = fmt::format("'{}' {} >/dev/full 2>'{}'", NEPHROID_PROGRAM, arguments, (logs / "stderr").string());
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
    EXPECT_EQ(nephroid::read_file(logs / "stderr"), "nephroid: standard output: cannot be written: No space left on device\n") << arguments;
  }
}

} // namespace nephroid::cli_test
