// SPDX-License-Identifier: Apache-2.0
// Engine 2 while something moves: from an edit of the preset to the picture that shows it, as the window has it
// (Job::adopt and a snapshot), and how long it takes then until the first full picture. The bunny at 512 x 512 with 24
// lights and an occluder; NEPHROID_BENCH_PRESET names another preset. Its bake is read where there is one.
#include "environment/engine.h"
#include "environment/job.h"
#include "preset/read.h"
#include "tests/support/standard.h"

#include <benchmark/benchmark.h>

namespace {

using namespace nephroid;

preset::Preset benched_preset() {
  const char* name = std::getenv("NEPHROID_BENCH_PRESET");
  preset::Preset made = preset::read_preset(name ? name : NEPHROID_SOURCE_DIR "/presets/environment/bunny.json",
                                            {"scene.camera.resolution=[512, 512]"});
  if (name) return made;
  preset::Object occluder = made.scene.objects.back();
  occluder.name = "occluder";
  occluder.shape->size = {3, 1, 3};
  occluder.transform.translate = {-5, 4, 0};
  occluder.transform.rotate_deg = {0, 0, -60};
  made.scene.objects.insert(made.scene.objects.begin() + 1, occluder);
  return made;
}

/// Set up once for all benches.
struct Bench {
  preset::Preset preset = benched_preset();
  compute::Context context = compute::Context::open();
  std::unique_ptr<job::Job> job;

  Bench() {
    const scene::Scene scene = scene::load_scene(preset);
    const environment::EnvironmentPlan plan = environment::make_plan(preset, scene, scene::build_bvh(scene.geometry));
    job = environment::make_job(preset, plan, context);
    while (job->progress().step < 2) job->advance();
  }
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// change(preset, how far): what moves.
void move(benchmark::State& state, const std::function<void(preset::Preset&, int)>& change) {
  static Bench bench;
  preset::Preset moved = bench.preset;
  double pass_s = 0;
  int frame = 0;
  const auto show_change = [&] {
    change(moved, ++frame);
    if (!bench.job->adopt(moved)) state.SkipWithError("is not adopted");
    benchmark::DoNotOptimize(bench.job->snapshot());
  };
  show_change(); // the first of its kind compiles kernels
  for (auto _ : state) {
    show_change();
    state.PauseTiming();
    const auto begin = std::chrono::steady_clock::now();
    while (bench.job->progress().step < 1) bench.job->advance();
    pass_s += seconds_since(begin);
    state.ResumeTiming();
  }
  state.counters["full_picture_ms"] = 1e3 * pass_s / static_cast<double>(state.iterations());
  bench.job->adopt(bench.preset);
}

// Processor time is that of all threads: half of it is what two quiet cores take at best.
[[maybe_unused]] const bool registered = [] {
  using Preset = preset::Preset;
  const std::pair<const char*, std::function<void(Preset&, int)>> changes[] = {
      {"camera_moves", [](Preset& p, int frame) { p.scene.camera.position[0] += 0.02 * (frame % 2 ? 1 : -1) * frame; }},
      {"light_turns", [](Preset& p, int) { p.scene.environment->rotate_deg += 3; }},
      {"object_turns", [](Preset& p, int) { p.scene.objects.front().transform.rotate_deg[1] += 3; }},
      {"receiver_moves", [](Preset& p, int) { p.scene.objects.back().transform.translate[1] -= 0.01; }},
      // The object before the last: a preset that is named should have one there.
      {"occluder_moves",
       [](Preset& p, int) { p.scene.objects[p.scene.objects.size() - 2].transform.translate[2] += 0.1; }}};
  for (const auto& [name, change] : changes)
    benchmark::RegisterBenchmark(name, move, change)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(8)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  return true;
}();

} // namespace
