// SPDX-License-Identifier: Apache-2.0
// The layer "indirect" without what photons bring: kernels/photons/indirect.cl.
#include "photons/eye_stage.h"

#include <string>

namespace nephroid::photons {
namespace {

constexpr int paths_of_a_sample = 4;  ///< that a walk between walls takes about as long as
constexpr int least_enough = 1 << 16; ///< samples of a pixel: light from walls has more noise than that of lamps

class IndirectStage final : public EyeStage {
public:
  IndirectStage(StageContext& world, const scene::Scene&, const Settings& settings)
      : EyeStage(world, "indirect", "indirect", settings, paths_of_a_sample, least_enough) {
    compute::Defines defines = world.eye_defines();
    defines.insert_or_assign("NEPHROID_JITTER", std::to_string(1)); // a path has wavelengths, not clusters
    kernel_ = compute::Program(world.context, "photons/indirect.cl", defines).kernel("indirect");
  }

private:
  void run(std::uint32_t count, bool, std::initializer_list<compute::Argument> more) override {
    world_.run(kernel_, count, 64, more);
  }

  compute::Kernel kernel_;
};

PlanPart plan_indirect(const PlanInput& input) {
  return part_of(indirect_decision(input), {{"film indirect", input.film_bytes()}});
}

} // namespace

plan::Decision indirect_decision(const PlanInput& input) {
  const char* const name = "indirect";
  const std::string missing = input.objects.diffuse == 0 ? "the scene has no diffuse surface" : no_light(input);
  if (!missing.empty()) return {name, false, missing};
  if (!*input.settings.indirect) return {name, false, input.why_no_indirect, "/spectral/indirect", true};
  return {name, true, std::string("paths from the eye find the light that walls send on") + more_through_glass(input),
          "/spectral/indirect", true};
}

const RunPart indirect_stage{plan_indirect, make_stage<IndirectStage>, "indirect"};

} // namespace nephroid::photons
