// SPDX-License-Identifier: Apache-2.0
// What each omission saves: passes of a scene that does not need it, with it left out and turned back on, in turn in
// one run. Seconds are of the processor, which other programs disturb less than the clock on the wall; the smallest of
// all turns counts. Where other photons make the picture, `variance_ratio` is how many more of them the same error
// takes. Building is up to the third step, kernels included: run with POCL_KERNEL_CACHE=0 to have them compiled.
#include "spectral/engine.h"
#include "tests/support/leaving_out_scenes.h"

#include <benchmark/benchmark.h>

namespace {

using namespace nephroid;

using test::processor_seconds;

/// One of the two ways to make the picture.
class Side {
public:
  Side(const preset::Preset& preset, const tracing::LeaveOut& leave_out, const compute::Context& context)
      : preset_(preset), leave_out_(leave_out), scene_(scene::load_scene(preset)),
        bvh_(scene::build_bvh(scene_.geometry)) {
    const photons::RunPlan plan = spectral::make_plan(preset_, scene_, bvh_, leave_out_);
    const double begin = processor_seconds();
    job_ = photons::make_job(preset_, scene_, bvh_, plan, context);
    for (int step = 0; step < 3 && !job_->finished(); ++step)
      job_->advance(); // code is generated at a kernel's first use
    build_s_ = processor_seconds() - begin;
    if (!job_->finished()) pass();
    pass_s_ = std::numeric_limits<double>::max();
  }

  void turn() {
    double begin = processor_seconds();
    benchmark::DoNotOptimize(spectral::make_plan(preset_, scene_, bvh_, leave_out_));
    plan_s_ = std::min(plan_s_, processor_seconds() - begin);
    begin = processor_seconds();
    if (!job_->finished()) pass();
    pass_s_ = std::min(pass_s_, processor_seconds() - begin);
  }

  double pass_ms() const { return 1e3 * pass_s_; }
  double plan_ms() const { return 1e3 * plan_s_; }
  double build_ms() const { return 1e3 * build_s_; }

  /// Sum over the pixels of the variance of one pass's caustic layer.
  double variance() const {
    double sum = 0;
    for (std::size_t i = 0; i < squares_.size(); ++i)
      sum += squares_[i] / passes_ - sums_[i] * sums_[i] / (double(passes_) * passes_);
    return sum;
  }

  /// After a pass: notes its caustic layer.
  void note() {
    const job::Snapshot snapshot = job_->snapshot();
    for (const job::Layer& layer : snapshot.picture->layers) {
      if (layer.name != "caustic") continue;
      const auto done = static_cast<double>(job_->progress().step);
      last_.resize(layer.rgb.size(), 0);
      sums_.resize(layer.rgb.size(), 0);
      squares_.resize(layer.rgb.size(), 0);
      for (std::size_t i = 0; i < layer.rgb.size(); ++i) {
        const double total = done * layer.rgb[i], own = total - last_[i];
        last_[i] = total;
        if (passes_ < 0) continue;
        sums_[i] += own;
        squares_[i] += own * own;
      }
      ++passes_;
    }
  }

private:
  void pass() {
    for (const std::int64_t before = job_->progress().step; !job_->finished() && job_->progress().step == before;)
      job_->advance();
  }

  preset::Preset preset_;
  tracing::LeaveOut leave_out_;
  scene::Scene scene_;
  scene::Bvh bvh_;
  std::unique_ptr<job::Job> job_;
  double build_s_ = 0, pass_s_ = 0, plan_s_ = std::numeric_limits<double>::max();
  std::vector<double> last_, sums_, squares_;
  int passes_ = -1; ///< the first only sets last_
};

void leaving_out(benchmark::State& state, const test::Omission& omission) {
  static const compute::Context context = compute::Context::open();
  preset::Preset without = omission.scene;
  without.scene.camera.resolution = {256, 256};
  spectral::settings(without).photons_per_pass = 1 << 17;
  spectral::settings(without).pixel_samples = 1 << 20;
  without.stop.passes = 1 << 20;
  preset::Preset with = without;
  with.seed = 2;
  Side left_out(without, {}, context), computed(with, test::all_but(omission), context);
  for (auto _ : state) {
    left_out.turn();
    computed.turn();
    if (omission.same_bits) continue;
    left_out.note();
    computed.note();
  }
  state.counters["ms_a_pass_left_out"] = left_out.pass_ms();
  state.counters["ms_a_pass_computed"] = computed.pass_ms();
  state.counters["ratio"] = computed.pass_ms() / std::max(left_out.pass_ms(), 1e-6);
  state.counters["ms_of_building_left_out"] = left_out.build_ms();
  state.counters["ms_of_building_computed"] = computed.build_ms();
  state.counters["ms_of_planning_left_out"] = left_out.plan_ms();
  state.counters["ms_of_planning_computed"] = computed.plan_ms();
  if (!omission.same_bits) state.counters["variance_ratio"] = computed.variance() / left_out.variance();
}

[[maybe_unused]] const bool registered = [] {
  for (const test::Omission& omission : test::omissions())
    benchmark::RegisterBenchmark(("leaving_out/" + omission.key).c_str(), leaving_out, omission)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(12);
  return true;
}();

} // namespace
