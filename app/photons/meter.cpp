// SPDX-License-Identifier: Apache-2.0
#include "photons/meter.h"

#include "photons/passes.h"
#include "photons/plan_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace nephroid::photons {
namespace {

/// A stage that has passes of its own.
struct Turns {
  std::int64_t passes = 0; ///< complete ones
  double rate = 1;         ///< how many passes each replicate has in a cycle
  double owed = 0;         ///< of those, in the cycle in hand

  double for_each() const { return static_cast<double>(passes) / meter_replicates; }
};

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Of the mean of values of one distribution.
double variance_of_mean(std::span<const double> values) {
  const double mean = mean_of(values);
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  return square / static_cast<double>(values.size() * (values.size() - 1));
}

/// [replicate][cell], watts of a layer.
class Watts {
public:
  explicit Watts(const MeterLayer& layer) : values_(layer.replicates), cells_(values_.size() / 2 / meter_replicates) {}
  std::size_t cells() const { return cells_; }
  std::array<double, meter_replicates> of(std::size_t cell) const {
    std::array<double, meter_replicates> all;
    for (std::size_t r = 0; r < all.size(); ++r) all[r] = values_[2 * (r * cells_ + cell)];
    return all;
  }

private:
  std::span<const double> values_;
  std::size_t cells_;
};

/// What the noise of a meter hangs on.
struct NoiseOfMeter {
  std::vector<double> of_stages; ///< [stage]: of the relative variance of the mean, and of the cells near the peak
  std::vector<float> worth;      ///< [cell]: Stage::weigh_cells
};

NoiseOfMeter noise_of(const std::vector<MeterLayer>& of_stages, const scene::MeterSurface& meter) {
  constexpr double near_peak = 16;  // a cell with .9 of the peak counts a fifth, one with half of it nothing
  constexpr double elsewhere = 0.1; // the worth of those
  const auto shown = [&](std::size_t c) { return meter.areas[c] / meter.weights()[c]; }; // a goniometer's intensity
  std::vector<double> cells(meter.count(), 0);
  for (const MeterLayer& stage : of_stages)
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] += shown(c) * mean_of(Watts(stage).of(c));
  const double peak = *std::ranges::max_element(cells);
  double total = 0, weights = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    total += meter.weights()[c] * cells[c];
    weights += cells[c] = peak > 0 ? std::pow(std::max(cells[c] / peak, 0.0), near_peak) : 0;
  }
  NoiseOfMeter result;
  for (const double near : cells) result.worth.push_back(static_cast<float>(std::max(near, elsewhere)));
  for (const MeterLayer& stage : of_stages) {
    std::array<double, meter_replicates> totals{};
    double at_peak = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto watts = Watts(stage).of(c);
      for (std::size_t r = 0; r < totals.size(); ++r) totals[r] += meter.areas[c] * watts[r];
      if (cells[c] > 0) at_peak += cells[c] * std::pow(shown(c), 2) * variance_of_mean(watts);
    }
    result.of_stages.push_back(
        total > 0 ? variance_of_mean(totals) / (total * total) + at_peak / (weights * peak * peak) : 0);
  }
  return result;
}

class Run final : public MeterRun {
public:
  Run(const preset::Preset& preset, const scene::Scene& view, const scene::Bvh& bvh, const RunPlan& plan,
      const mpi::RankContext& context)
      : world_(make_stage_context(preset, view, bvh, plan, context)), meter_(view.camera.meter) {
    world_.white = 1; // numbers, not a picture
    for (const RunPart* part : plan.parts)
      if (part->make) stages_.push_back({part->make(world_, view, plan.settings), part->layer});
    turns_.resize(now_ = stages_.size());
    warm_up(world_, stages_);
  }

  void advance() override {
    if (now_ == stages_.size()) begin_cycle();
    Stage& stage = *stages_[now_].stage;
    Turns& turns = turns_[now_];
    bool complete = false;
    work_seconds_ +=
        tracing::seconds_of([&] { complete = turns.passes >= stage.passes() || stage.advance(turns.passes); });
    if (!complete || ++turns.passes % meter_replicates != 0) return;
    --turns.owed;
    go_on();
    if (now_ == stages_.size()) ++cycles_;
  }
  std::int64_t cycles() const override { return cycles_; }
  std::uint64_t photons() const override {
    double photons = 0;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      photons += passes_of(s) * static_cast<double>(stages_[s].stage->photons_per_pass());
    return static_cast<std::uint64_t>(photons);
  }
  double work_seconds() const override { return work_seconds_; }

  std::vector<MeterLayer> layers(bool steers) override {
    std::vector<MeterLayer> of_stages, layers;
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      job::Picture picture;
      picture.width = world_.tables.camera.width;
      picture.height = 1;
      stages_[s].stage->develop(turns_[s].passes, false, picture);
      of_stages.push_back(in_watts(picture.layers.front()));
    }
    if (steers) share_work(of_stages);
    for (const MeterLayer& stage : of_stages) {
      const auto same = std::ranges::find(layers, stage.name, &MeterLayer::name);
      if (same == layers.end())
        layers.push_back(stage);
      else
        std::ranges::transform(same->replicates, stage.replicates, same->replicates.begin(), std::plus());
    }
    return layers;
  }

  double lost_share() override {
    const EnergyBalance balance = this->balance();
    return balance.emitted_w > 0 ? balance.lost_w / balance.emitted_w : 0;
  }
  std::uint64_t refused() override { return balance().refused_contributions; }
  void serialize(tracing::Archive& archive) override {
    archive.items(turns_);
    archive.value(now_);
    archive.value(cycles_);
    archive.value(work_seconds_);
    archive.buffer(world_.energy);
    for (const TimedStage& s : stages_) s.stage->serialize(archive);
    if (archive.is_read()) world_.context.finish();
  }

private:
  static MeterLayer in_watts(const job::Layer& layer) {
    MeterLayer to{layer.name, {}};
    to.replicates.reserve(layer.replicates.size() / 3 * 2);
    for (std::size_t i = 0; i < layer.replicates.size(); i += 3)
      for (std::size_t c = 0; c < 2; ++c) to.replicates.push_back(std::numbers::pi * layer.replicates[i + c]);
    return to;
  }

  double passes_of(std::size_t stage) const {
    return static_cast<double>(turns_[stage].passes) + stages_[stage].stage->fraction_done();
  }

  /// In that of a photon, of a pass in each replicate.
  double work_of(std::size_t s) const {
    const Stage& stage = *stages_[s].stage;
    return std::max(
        meter_replicates * static_cast<double>(stage.photons_per_pass()) + stage.work() / turns_[s].for_each(), 1.0);
  }

  void begin_cycle() {
    while (now_ == stages_.size()) {
      for (Turns& turns : turns_) turns.owed += turns.rate;
      now_ = 0;
      go_on();
    }
  }
  /// To the stage, from this one on, that is owed a pass.
  void go_on() {
    while (now_ < turns_.size() && turns_[now_].owed < 1) ++now_;
  }

  /// A stage of n passes, each of the work c, leaves the variance v / n: for the same work in all the sum is least
  /// where n is proportional to sqrt(v / c). The next cycles lead there until there is twice the work that there was.
  void share_work(const std::vector<MeterLayer>& of_stages) {
    constexpr double least = 1.0 / 8; // of the passes that there were: a variance that looked small may not be
    const auto [variance, worth] = noise_of(of_stages, *meter_);
    double a_cycle = 0, all = 0, roots = 0, wanted = 0;
    std::vector<double> passes(stages_.size());
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      a_cycle += work_of(s), all += work_of(s) * turns_[s].for_each();
      roots += std::sqrt(variance[s] * turns_[s].for_each() * work_of(s));
    }
    if (!(roots > 0)) return;
    for (const TimedStage& s : stages_) s.stage->weigh_cells(worth);
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      const double had = turns_[s].for_each(), best = 2 * all * std::sqrt(variance[s] * had / work_of(s)) / roots;
      passes[s] = std::max(best - had, least * had);
      wanted += work_of(s) * passes[s];
    }
    for (std::size_t s = 0; s < stages_.size(); ++s) turns_[s].rate = passes[s] * a_cycle / wanted;
  }

  EnergyBalance balance() {
    double batches = 0;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (stages_[s].stage->counts_energy()) batches += passes_of(s) * world_.tables.batches;
    return balance_of(
        outcome_watts(world_.context.all_reduced_sum(world_.energy), world_.tables.energy_scale, batches));
  }

  StageContext world_;
  std::shared_ptr<const scene::MeterSurface> meter_;
  std::vector<TimedStage> stages_;
  std::vector<Turns> turns_; ///< [stage]
  std::size_t now_ = 0;      ///< the stage whose turn it is; behind the last between cycles
  std::int64_t cycles_ = 0;
  double work_seconds_ = 0;
};

/// Where there is no light.
class DarkRun final : public MeterRun {
public:
  explicit DarkRun(std::size_t cells) : dark_{"direct", std::vector<double>(cells * 2 * meter_replicates)} {}
  void advance() override { ++cycles_; }
  std::int64_t cycles() const override { return cycles_; }
  std::uint64_t photons() const override { return 0; }
  double work_seconds() const override { return 0; }
  std::vector<MeterLayer> layers(bool) override { return {dark_}; }
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
  settings.effort = Settings::Effort::variance; // others ask what an eye sees, and not where the peak is
  // Short passes: there is a first interval after a cycle of them.
  constexpr int passes_in_one = 4 * static_cast<int>(meter_replicates);
  settings.photons_per_pass = std::max(wanted.photons_per_pass / passes_in_one, 1);
  settings.indirect_photons_per_pass = std::max(wanted.indirect_photons_per_pass / passes_in_one, 1);
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
