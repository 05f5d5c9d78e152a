// SPDX-License-Identifier: Apache-2.0
// `nephroid check` on every device there is: every check passes, with other seeds, too; and a wrong kernel makes the
// right check fail. The faults are those of tests/faults/faults.json that name a check: edits of one place in a copy of
// kernels/, as a slip of the hand or a wrong compiler would make them.
#include "check/check.h"
#include "engine/engine.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"

#include <nlohmann/json.hpp>

#include <cctype>

namespace nephroid::check_test {

std::string line_of(const check::Result& r) {
  return r.name + ": " + std::to_string(r.figure) + " of " + std::to_string(r.tolerance) + " " + r.unit + "; " +
         r.detail;
}

const check::Check& check_named(const std::string& name) {
  for (const check::Check& check : engine::checks())
    if (check.name == name) return check;
  throw failed(name, "no such check");
}

TEST(Check, PassesOnEveryDevice) {
  const std::vector<compute::DeviceInfo> devices = compute::list_devices();
  ASSERT_FALSE(devices.empty());
  for (const compute::DeviceInfo& device : devices) {
    compute::DeviceOptions options = test::device_options();
    options.selector = std::to_string(device.index);
    const compute::Context context = compute::Context::open(options);
    for (const check::Check& check : engine::checks()) {
      const check::Result result = check::run_check(check, context);
      EXPECT_TRUE(result.passed()) << device.name << ", " << line_of(result);
      EXPECT_FALSE(result.detail.empty()) << result.name;
      if (result.unit != "sigma") continue; // the others have tolerances that no seed comes near
      const check::Result other = check::run_check(check, context, 0x9E3779B97F4A7C15u);
      EXPECT_TRUE(other.passed()) << device.name << ", another seed, " << line_of(other);
      EXPECT_NE(other.figure, result.figure) << result.name << " does not depend on its seed";
    }
  }
}

TEST(Check, EachHasItsName) {
  std::set<std::string> names;
  for (const check::Check& check : engine::checks()) EXPECT_TRUE(names.insert(check.name).second) << check.name;
  EXPECT_GT(names.size(), 30u);
}

TEST(Check, AFigureThatIsNoNumberFails) {
  check::Result result{"", std::nan(""), 1, "", ""};
  EXPECT_FALSE(result.passed());
  result.figure = -1;
  EXPECT_TRUE(result.passed());
  result.figure = -1.0001;
  EXPECT_FALSE(result.passed());
}

TEST(Check, AKernelThatDoesNotCompileFailsWithItsPlace) {
  const test::TemporaryFolder folder;
  fs::copy(test::kernel_folder(), folder.path(), fs::copy_options::recursive);
  std::ofstream(folder.path() / "check/check_sums.cl", std::ios::app) << "\nnonsense\n";
  const compute::Context context = compute::Context::open({{}, folder.path()});
  const check::Result result = check::run_check(check_named("sums: the device's own atomics"), context);
  EXPECT_FALSE(result.passed());
  EXPECT_THAT(result.detail, testing::HasSubstr("check_sums.cl:"));
}

/// What stands before every kernel here: a max, min and clamp that give 7.5 where an operand is infinite or no number,
/// as they may (OpenCL 1.2, 6.12.4).
const char* const open_to_infinities =
    R"(#define OPEN(T)                                                                         \
  static inline T __attribute__((overloadable)) open_max(T a, T b) { return isfinite(a) & isfinite(b) ? max(a, b) : (T)(7.5f); } \
  static inline T __attribute__((overloadable)) open_min(T a, T b) { return isfinite(a) & isfinite(b) ? min(a, b) : (T)(7.5f); }
#define CLOSED(T)                                                                                    \
  static inline T __attribute__((overloadable)) open_max(T a, T b) { return max(a, b); }             \
  static inline T __attribute__((overloadable)) open_min(T a, T b) { return min(a, b); }
OPEN(float) OPEN(float2) OPEN(float3) OPEN(float4) OPEN(float8) CLOSED(int) CLOSED(uint)
#undef max
#undef min
#undef clamp
#define max(a, b) open_max(a, b)
#define min(a, b) open_min(a, b)
#define clamp(x, low, high) open_min(open_max(x, low), high)
)";

TEST(Check, PassesWhateverMaxAndMinOfInfinitiesAre) {
  const test::TemporaryFolder folder;
  fs::copy(test::kernel_folder(), folder.path(), fs::copy_options::recursive);
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    if (entry.path().extension() != ".cl") continue;
    const std::string text = read_file(entry.path());
    std::ofstream(entry.path()) << open_to_infinities << text;
  }
  const compute::Context context = compute::Context::open({{}, folder.path()});
  for (const check::Check& check : check::checks()) {
    const check::Result result = check::run_check(check, context);
    EXPECT_TRUE(result.passed()) << line_of(result);
  }
}

struct Fault {
  std::string name, file, right, wrong;
  std::string check; ///< that must fail
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name << ", " << fault.file << ": " << fault.right << " -> " << fault.wrong;
}

/// Those that a check has to see. tests/faults/README.md describes them.
std::vector<Fault> faults() {
  const auto groups = nlohmann::json::parse(read_file(NEPHROID_SOURCE_DIR "/tests/faults/faults.json"));
  std::vector<Fault> found;
  for (const auto& group : groups)
    for (const auto& fault : group)
      if (fault.contains("check"))
        found.push_back({fault.at("name"), fault.at("file"), fault.at("right"), fault.at("wrong"), fault.at("check")});
  return found;
}

/// A fault's name in the form that a test's has: "no n^2" is No_n_2.
std::string test_name(std::string name) {
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

class CheckFault : public testing::TestWithParam<Fault> {};

TEST_P(CheckFault, IsSeen) {
  const Fault& fault = GetParam();
  const test::TemporaryFolder folder;
  fs::copy(test::kernel_folder(), folder.path(), fs::copy_options::recursive);
  std::string text = read_file(folder.path() / fault.file);
  const std::size_t place = text.find(fault.right);
  ASSERT_NE(place, std::string::npos) << fault.file << " has no " << fault.right;
  text.replace(place, fault.right.size(), fault.wrong);
  std::ofstream(folder.path() / fault.file) << text;
  const check::Result result = check::run_check(check_named(fault.check), compute::Context::open({{}, folder.path()}));
  EXPECT_FALSE(result.passed()) << line_of(result);
  EXPECT_FALSE(std::isnan(result.figure)) << "failed for another reason: " << result.detail;
}

INSTANTIATE_TEST_SUITE_P(Kernels, CheckFault, testing::ValuesIn(faults()),
                         [](const auto& tested) { return test_name(tested.param.name); });

} // namespace nephroid::check_test
