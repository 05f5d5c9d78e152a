// SPDX-License-Identifier: Apache-2.0
// `nephroid check` as a script sees it: its JSON, its exit codes, a wrong kernel, Ctrl-C.
#include "tests/support/program_test.h"

#include <nlohmann/json.hpp>

namespace nephroid::check_verb_test {

using nlohmann::json;

class CheckVerb : public ProgramTest {
protected:
  Ended check(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(), "check");
    return run(arguments);
  }
};

TEST_F(CheckVerb, JsonIsAsTheContractHasIt)
{
  const Ended ended = check({"--json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const json all = json::parse(ended.out);
  EXPECT_TRUE(all.at("device").is_string());
  ASSERT_GT(all.at("checks").size(), 30u);
  for (const json& one : all.at("checks")) {
    EXPECT_TRUE(one.at("name").is_string() && one.at("unit").is_string() && one.at("detail").is_string()) << one;
    EXPECT_EQ(one.at("pass").get<bool>(), std::abs(one.at("figure").get<double>()) <= one.at("tolerance").get<double>()) << one;
  }
}

TEST_F(CheckVerb, AWrongKernelIsNamedAndExitsWithOne)
{
  const fs::path kernels = folder / "kernels";
  fs::copy(NEPHROID_SOURCE_DIR "/kernels", kernels, fs::copy_options::recursive);
  std::string text = nephroid::read_file(kernels / "tracing/film.h");
  text.replace(text.find("0x1p42f"), 7, "0x1p44f");
  nephroid::write_file_whole(kernels / "tracing/film.h", text);
  nephroid::write_file_whole(kernels / "tracing/trace.cl", "nonsense\n");
  const Ended ended = check({"--kernels", kernels.string()});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("6 failed: film: takes what fits, refuses the rest, rays: closest hits, "));
  EXPECT_THAT(ended.out, HasSubstr("trace.cl:1: "));                  // why, under the line
  EXPECT_THAT(ended.out, HasSubstr("interface: Snell's directions")); // and it went on
}

TEST_F(CheckVerb, NoSuchDeviceExitsWithThree)
{
  const Ended ended = check({"--device", "abacus"});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_THAT(ended.err, HasSubstr("abacus"));
  EXPECT_EQ(check({"--device", "0", "--all"}).exit_code, 2);
  EXPECT_EQ(check({"--kernels", "nowhere"}).exit_code, 2);
}

TEST_F(CheckVerb, ASeedIsAWholeNumber)
{
  for (const char* seed : {"-1", "x", "1.5", "nan", "18446744073709551616"}) {
    const Ended ended = check({"--seed", seed});
    EXPECT_EQ(ended.exit_code, 2) << seed;
    EXPECT_THAT(ended.err, HasSubstr(std::string("--seed: '") + seed + "' is not a whole number from 0 to 18446744073709551615"));
  }
}

TEST_F(CheckVerb, CtrlCEndsInOrder)
{
  Child child({"check"}, folder, logs);
  ASSERT_TRUE(child.until([&] { return child.out().find("built-in: exp") != std::string::npos; }));
  child.send(SIGINT);
  const Ended ended = child.wait();
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("interrupted after "));
}

} // namespace nephroid::check_verb_test
