// SPDX-License-Identifier: Apache-2.0
// The direct layer: kernels/photons/direct.cl.
#include "base/counted.h"
#include "photons/eye_stage.h"

#include <fmt/format.h>

namespace nephroid::photons {
namespace {

class DirectStage final : public EyeStage {
public:
  DirectStage(StageContext& world, const scene::Scene&, const Settings& settings)
      : EyeStage(world, "direct", "direct", settings),
        kernel_(compute::Program(world.context, "photons/direct.cl", world.eye_defines(true)).kernel("direct")) {}

private:
  void run(std::uint32_t count, std::initializer_list<compute::Argument> more) override {
    world_.run(kernel_, count, 64, more);
  }

  compute::Kernel kernel_;
};

plan::Decision direct_decision(const PlanInput& input) {
  const char* const name = "direct";
  if (!input.settings.direct) return not_asked_for(name, name);
  const bool shines = input.objects.diffuse > 0 || any_material(input.scene, scatter::is_rough);
  const std::string missing = shines ? no_light(input) : "the scene has no diffuse or rough surface";
  if (!missing.empty()) return tracing::not_needed(name, input.leave_out.direct, missing);
  return tracing::needed(
      name, fmt::format("{} lit by {}, {} a pixel{}", counted(input.objects.diffuse, "diffuse object"),
                        counted(shining_lights(input), "light"), counted(*input.settings.pixel_samples, "sample"),
                        input.settings.relight ? "" : more_through_glass(input)));
}

PlanPart plan_direct(const PlanInput& input) {
  return part_of(direct_decision(input), {{"film direct", input.film_bytes()}});
}

} // namespace

const RunPart direct_stage{plan_direct, make_stage<DirectStage>, "direct"};

} // namespace nephroid::photons
