// SPDX-License-Identifier: Apache-2.0
// The direct layer: kernels/spectral/direct.cl.
#include "spectral/eye_stage.h"

namespace nephroid::spectral {
namespace {

class DirectStage final : public EyeStage {
public:
  DirectStage(DeviceWorld& world, const Settings& settings)
      : EyeStage(world, "direct", settings), kernel_(compute::Program(world.context, "spectral/direct.cl", world.defines).kernel("direct"))
  {
  }

  bool step(std::int64_t pass) override
  {
    const RunTables& t = world_.tables;
    return sample(pass, kernel_, t.direct_limit,
                  {{"reflected_xyz_all", world_.buffers.reflected_xyz_all},
                   {"cluster_cdf", world_.buffers.cluster_cdf},
                   {"film_scale", world_.on_device(t.direct_scale)}});
  }

  void develop(std::int64_t, bool, job::Picture& picture) override { add_to(picture, world_.tables.direct_scale * world_.white); }

private:
  compute::Kernel kernel_;
};

} // namespace

std::unique_ptr<Stage> make_direct_stage(DeviceWorld& world, const Settings& settings)
{
  return std::make_unique<DirectStage>(world, settings);
}

} // namespace nephroid::spectral
