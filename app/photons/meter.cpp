// SPDX-License-Identifier: Apache-2.0
#include "photons/meter.h"

#include "photons/passes.h"
#include "photons/plan_part.h"

#include <algorithm>
#include <numbers>

namespace nephroid::photons {
namespace {

class Run final : public MeterRun {
public:
  Run(const preset::Preset& preset, const scene::Scene& view, const scene::Bvh& bvh, const RunPlan& plan,
      const mpi::RankContext& context)
      : world_(make_stage_context(preset, view, bvh, plan, context)), passes_(plan.tables.batches) {
    world_.white = 1; // numbers, not a picture
    for (const RunPart* part : plan.parts)
      if (part->make) passes_.add(part->make(world_, view, plan.settings), part->layer);
    passes_.warm_up(world_);
  }

  void advance() override { passes_.advance(); }
  std::int64_t cycles() const override { return passes_.complete() / meter_replicates; }
  std::uint64_t photons() const override { return passes_.photons(); }
  double work_seconds() const override { return passes_.work_seconds(); }

  std::vector<MeterLayer> layers() override {
    job::Picture picture;
    picture.width = world_.tables.camera.width;
    picture.height = 1;
    for (const TimedStage& s : passes_.stages()) s.stage->develop(passes_.complete(), false, picture);
    std::vector<MeterLayer> layers;
    for (const job::Layer& layer : picture.layers) {
      MeterLayer& to = layers.emplace_back(MeterLayer{layer.name, {}});
      to.replicates.reserve(layer.replicates.size() / 3 * 2);
      for (std::size_t i = 0; i < layer.replicates.size(); i += 3)
        for (std::size_t c = 0; c < 2; ++c) to.replicates.push_back(std::numbers::pi * layer.replicates[i + c]);
    }
    return layers;
  }

  double lost_share() override {
    const EnergyBalance balance = this->balance();
    return balance.emitted_w > 0 ? balance.lost_w / balance.emitted_w : 0;
  }
  std::uint64_t refused() override { return balance().refused_contributions; }
  void serialize(tracing::Archive& archive) override {
    passes_.state_of_position(archive);
    archive.buffer(world_.energy);
    passes_.state_of_stages(archive);
    if (archive.is_read()) world_.context.finish();
  }

private:
  EnergyBalance balance() {
    return balance_of(outcome_watts(world_.context.all_reduced_sum(world_.energy), world_.tables.energy_scale,
                                    passes_.photon_batches()));
  }

  StageContext world_;
  Passes passes_;
};

/// Where there is no light.
class DarkRun final : public MeterRun {
public:
  explicit DarkRun(std::size_t cells) : dark_{"direct", std::vector<double>(2 * meter_replicates * cells)} {}
  void advance() override { ++cycles_; }
  std::int64_t cycles() const override { return cycles_; }
  std::uint64_t photons() const override { return 0; }
  double work_seconds() const override { return 0; }
  std::vector<MeterLayer> layers() override { return {dark_}; }
  double lost_share() override { return 0; }
  std::uint64_t refused() override { return 0; }
  void serialize(tracing::Archive& archive) override { archive.value(cycles_); }

private:
  MeterLayer dark_;
  std::int64_t cycles_ = 0;
};

} // namespace

RunPlan plan_meter(const preset::Preset& preset, const Settings& wanted, const scene::Scene& view,
                   const scene::Bvh& bvh) {
  Settings settings = wanted;
  settings.estimator = Settings::Estimator::splat;
  settings.smoothing = Settings::Smoothing::off;
  settings.relight = settings.background = false;
  settings.direct = settings.caustic = true; // what falls on it is all of it
  settings.indirect = true;
  settings.effort = Settings::Effort::automatic; // others ask what an eye sees
  // Short passes: there is a first interval after a cycle of them.
  settings.photons_per_pass = std::max(wanted.photons_per_pass / static_cast<int>(meter_replicates), 1);
  settings.indirect_photons_per_pass =
      std::max(wanted.indirect_photons_per_pass / static_cast<int>(meter_replicates), 1);
  settings.pixel_samples = 1 << 17; // a cell has light and shadow, also of lamps that are points
  preset::Preset measured = preset;
  measured.measure.estimate = true;
  return make_plan(measured, settings, view, bvh, {.all = preset.leave_out});
}

std::unique_ptr<MeterRun> make_meter_run(const preset::Preset& preset, const scene::Scene& view, const scene::Bvh& bvh,
                                         const RunPlan& plan, const mpi::RankContext& context) {
  if (plan.layers == 0) return std::make_unique<DarkRun>(static_cast<std::size_t>(view.camera.width));
  return std::make_unique<Run>(preset, view, bvh, plan, context);
}

} // namespace nephroid::photons
