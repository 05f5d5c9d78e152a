// SPDX-License-Identifier: Apache-2.0
// A run takes the memory that its plan says, and no more: the peak resident set of the program that renders layers for
// another light, whose films are the largest there are, against that of a run of the same scene that is trivially
// small, which stands for the program itself, its libraries and the device's compiler.
#include "tests/support/program_test.h"

#include <sys/resource.h>

namespace nephroid::memory_held_test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool keeps_shadows = true; // of every byte, and freed memory for a while
#else
constexpr bool keeps_shadows = false;
#endif

constexpr double mebi = 1 << 20;

class MemoryHeld : public ProgramTest {
protected:
  static std::vector<std::string> with(const std::string& verb, const std::string& resolution,
                                       std::vector<std::string> more) {
    std::vector<std::string> arguments{verb,    "spectral/prism",
                                       "--set", "spectral.relight=true",
                                       "--set", "spectral.threshold_deg=0.02",
                                       "--set", "scene.camera.resolution=" + resolution};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  double planned_mib(const std::string& resolution) const {
    const Ended ended = run(with("plan", resolution, {"--json"}));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    double bytes = 0;
    const nlohmann::json plan = nlohmann::json::parse(ended.out);
    for (const auto& buffer : plan["buffers"]) bytes += buffer["bytes"].get<double>();
    return bytes / mebi;
  }
  /// The largest of this run and of all programs that this test ran before.
  double peak_mib(const std::string& resolution) const {
    const Ended ended = run(with("run", resolution, {"--passes", "2", "-o", "out"}));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    rusage usage{};
    EXPECT_EQ(::getrusage(RUSAGE_CHILDREN, &usage), 0);
    return static_cast<double>(usage.ru_maxrss) * 1024 / mebi;
  }
};

// A device with memory of its own takes less here. Where kernels are compiled anew, the small run is the one that does,
// and its peak is higher: the test is then less sharp, and never wrong. The margin is for what allocators round up and
// keep.
TEST_F(MemoryHeld, LayersForAnotherLightTakeWhatThePlanSays) {
  if (keeps_shadows) GTEST_SKIP() << "a sanitizer takes memory of its own";
  constexpr double margin_mib = 24;
  const double planned = planned_mib("[256,256]"), small = peak_mib("[16,16]"), large = peak_mib("[256,256]");
  RecordProperty("planned_mib", std::to_string(planned));
  RecordProperty("taken_mib", std::to_string(large - small));
  EXPECT_GT(planned, 64) << "too little to tell";
  EXPECT_LE(large - small, planned + margin_mib);
}

} // namespace nephroid::memory_held_test
