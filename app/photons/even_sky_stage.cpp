// SPDX-License-Identifier: Apache-2.0
// The environment's even light in the layer "caustic": kernels/photons/even_sky.cl.
#include "base/counted.h"
#include "photons/eye_stage.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::photons {
namespace {

constexpr double bounces = 4; ///< BOUNCES of the kernel

class EvenSkyStage final : public EyeStage {
public:
  EvenSkyStage(StageContext& world, const scene::Scene&, const Settings& settings)
      : EyeStage(world, "even sky", "caustic", settings, bounces),
        light_(static_cast<int>(world.tables.lights.size()) - 1),
        kernel_(compute::Program(world.context, "photons/even_sky.cl", world.eye_defines()).kernel("even_sky")) {}

private:
  void run(std::uint32_t count, bool, std::initializer_list<compute::Argument> more) override {
    world_.run(kernel_, count, 64, {{"light_index", light_}}, more);
  }

  int light_; ///< index of the environment in the table of lights: the last one
  compute::Kernel kernel_;
};

PlanPart plan_even_sky(const PlanInput& input) {
  if (!input.tables.has_even_sky || !input.settings.caustic) return {};
  return part_of(
      {"even sky", true,
       fmt::format("{:.0f} % of the environment's light is even: paths from the eye find what of it comes "
                   "through glass and mirrors, {} a pixel",
                   100 * (1 - input.tables.sky->peak_part), counted(*input.settings.pixel_samples, "sample"))},
      {{"film even sky", input.film_bytes()}});
}

} // namespace

const RunPart even_sky_stage{plan_even_sky, make_stage<EvenSkyStage>, "caustic"};

} // namespace nephroid::photons
