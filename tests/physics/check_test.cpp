// SPDX-License-Identifier: Apache-2.0
// `nephroid check` on every device there is: every check passes, with other seeds, too; and a wrong kernel makes the right check fail.
// The faults are edits of one place in a copy of kernels/, as a slip of the hand or a wrong compiler would make them.
#include "base/error.h"
#include "base/files.h"
#include "check/check.h"
#include "compute/compute.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_kernels.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>
#include <set>

using namespace nephroid;
namespace fs = std::filesystem;

namespace {

std::string line_of(const check::Result& r)
{
  return r.name + ": " + std::to_string(r.figure) + " of " + std::to_string(r.tolerance) + " " + r.unit + "; " + r.detail;
}

const check::Check& check_named(const std::string& name)
{
  for (const check::Check& check : check::checks())
    if (check.name == name) return check;
  throw failed(name, "no such check");
}

TEST(Check, PassesOnEveryDevice)
{
  const std::vector<compute::DeviceInfo> devices = compute::list_devices();
  ASSERT_FALSE(devices.empty());
  for (const compute::DeviceInfo& device : devices) {
    compute::DeviceOptions options = test::device_options();
    options.selector = std::to_string(device.index);
    const compute::Context context = compute::Context::open(options);
    for (const check::Check& check : check::checks()) {
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

TEST(Check, EachHasItsName)
{
  std::set<std::string> names;
  for (const check::Check& check : check::checks()) EXPECT_TRUE(names.insert(check.name).second) << check.name;
  EXPECT_GT(names.size(), 30u);
}

TEST(Check, AFigureThatIsNoNumberFails)
{
  check::Result result{"", std::nan(""), 1, "", ""};
  EXPECT_FALSE(result.passed());
  result.figure = -1;
  EXPECT_TRUE(result.passed());
  result.figure = -1.0001;
  EXPECT_FALSE(result.passed());
}

TEST(Check, AKernelThatDoesNotCompileFailsWithItsPlace)
{
  const test::TemporaryFolder folder;
  fs::copy(test::kernel_folder(), folder.path(), fs::copy_options::recursive);
  std::ofstream(folder.path() / "check_sums.cl", std::ios::app) << "\nnonsense\n";
  const compute::Context context = compute::Context::open({{}, folder.path()});
  const check::Result result = check::run_check(check_named("sums: the device's own atomics"), context);
  EXPECT_FALSE(result.passed());
  EXPECT_THAT(result.detail, testing::HasSubstr("check_sums.cl:"));
}

struct Fault {
  const char* name;
  const char* file;
  const char* right;
  const char* wrong;
  const char* check; ///< that must fail
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.file << ": " << fault.right << " -> " << fault.wrong; }

class CheckFault : public testing::TestWithParam<Fault> {};

TEST_P(CheckFault, IsSeen)
{
  const Fault& fault = GetParam();
  const test::TemporaryFolder folder;
  fs::copy(test::kernel_folder(), folder.path(), fs::copy_options::recursive);
  std::string text = read_file(folder.path() / fault.file);
  const std::size_t place = text.find(fault.right);
  ASSERT_NE(place, std::string::npos) << fault.file << " has no " << fault.right;
  text.replace(place, std::string(fault.right).size(), fault.wrong);
  std::ofstream(folder.path() / fault.file) << text;
  const check::Result result = check::run_check(check_named(fault.check), compute::Context::open({{}, folder.path()}));
  EXPECT_FALSE(result.passed()) << line_of(result);
  EXPECT_FALSE(std::isnan(result.figure)) << "failed for another reason: " << result.detail;
}

const Fault faults[] = {
    {"PhiloxMultiplier", "random.h", "0xD2511F53u", "0xD2511F55u", "random numbers: published vectors"},
    {"UniformsUpToOne", "random.h", "bits >> 8", "bits >> 7", "random numbers: uniforms bit for bit"},
    {"CarryForgotten", "film.h", "(uint)(value >> 32) + carry", "(uint)(value >> 32)", "sums: 32-bit halves with carry"},
    {"FilmLimit", "film.h", "0x1p42f", "0x1p44f", "film: takes what fits, refuses the rest"},
    {"QuantaRoundDown", "film.h", "add_exactly(sum + 1, convert_long_rte(", "add_exactly(sum + 1, convert_long_rtz(",
     "film: takes what fits, refuses the rest"},
    {"BoxesNotGrown", "bvh.h", "0x1p-20f * BVH_MAX", "-0x1p-10f * BVH_MAX", "rays: no gap between triangles"},
    {"FarthestFirst", "bvh.h", "t[lane] > hit.t ||", "t[lane] < hit.t ||", "rays: closest hits"},
    {"WrongBarycentric", "bvh.h", "*v = ec * scale", "*v = ea * scale", "rays: distance and place of hits"},
    {"SkipIgnored", "bvh.h", "!= skip) return true", "!= skip + 1) return true", "rays: any hit"},
    {"OnePolarisation", "fresnel.h", "0.5f * (s * s + p * p)", "p * p", "interface: Brewster's angle"},
    {"IndicesSwapped", "fresnel.h", "(n_i * cos_i - n_t * cos_t)", "(n_t * cos_i - n_i * cos_t)", "interface: Fresnel's reflectance"},
    {"RefractedBeyondNormal", "fresnel.h", "(eta * cos_i - cos_t)", "(eta * cos_i + cos_t)", "interface: Snell's directions"},
    {"CriticalAngleByCancellation", "fresnel.h", "(1.0f - sin_t) * (1.0f + sin_t)", "1.0f - eta * eta * (0.99999f - cos_i * cos_i)",
     "interface: critical angle"},
    {"FirstOfEqualPriority", "media.h", "priority >= best_priority", "priority > best_priority", "media: nested dielectrics"},
    {"WavelengthForgotten", "attenuation.h", "int i = tables->first[cluster]", "int i = tables->first[cluster] + 1",
     "spectra: clusters add up to the light"},
    {"GlassThatAmplifies", "attenuation.h", "exp(-exponent)", "exp(exponent)", "spectra: absorption after Beer and Lambert"},
    {"OverlapCountedTwice", "emission.h", "2.0f * PI_F * sum / (float)count", "2.0f * PI_F * sum", "emission: point light"},
    {"SpotOutsideItsCone", "light.h", "<= light->one_minus_cos", "<= 1.1f * light->one_minus_cos", "emission: spot"},
    {"DirectionalOverlap", "emission.h", "square_metres / (float)count", "square_metres", "emission: directional light"},
    {"AreaWithoutPi", "emission.h", "cosine / PI_F * steradians", "cosine / 3.0f * steradians", "emission: area light"},
    {"InverseDistance", "eye_path.h", "cosine / (metres * metres)", "cosine / metres", "picture: direct light of a point"},
    {"SplatOfOneMoreDepth", "splat.h", "(z * depth * depth * pixel_area)", "(depth * depth * pixel_area)",
     "picture: photons through nothing"},
    {"MirrorTakesTwice", "world.h", "lose(&path->losses, material->attenuator, 1.0f)", "lose(&path->losses, material->attenuator, 2.0f)",
     "picture: a coloured mirror"},
    {"EnergyCountedTwice", "photons.cl", "outcomes[OUTCOME_ABSORBED] += quanta - left", "outcomes[OUTCOME_ABSORBED] += quanta",
     "picture: energy balance"},
    {"ReflectsTooOften", "surface.h", "!(choice < fresnel_reflectance", "!(0.9f * choice < fresnel_reflectance",
     "plate: Fresnel's transmittance"},
    {"PriorityIgnored", "media.h", "objects[candidate].priority", "0", "plate: air inside glass"},
    {"OneIndexForAll", "interface.h", "n_of[far_material]", "(n_of[far_material] + 0.001f)", "prism: wavelengths where Snell says"},
    {"SmoothNormalsMixed", "surface.h", "(1.0f - hit.u - hit.v) * vload3(corner.x, geometry->normals)",
     "(1.0f - hit.u) * vload3(corner.x, geometry->normals)", "ball lens: rays towards its focus"},
};

INSTANTIATE_TEST_SUITE_P(Kernels, CheckFault, testing::ValuesIn(faults), [](const auto& tested) { return std::string(tested.param.name); });

} // namespace
