// SPDX-License-Identifier: Apache-2.0
// Photons a second of engine 1 on the first-light scene, by phase: traced only (the camera looks away, so nothing is
// projected into a pixel), traced and splatted, samples a second of the direct layer, and the time of a picture of 512
// x 512, without and with smoothing, and of smoothing alone. Start-up and compiling are not counted.
#include "photons/smoothing.h"
#include "preset/read.h"
#include "spectral/engine.h"

#include <benchmark/benchmark.h>

#include <random>

namespace {

using namespace nephroid;

preset::Preset first_light() {
  preset::Preset p = preset::read_preset("first-light");
  p.stop.seconds.reset();
  p.stop.passes = 1 << 20;
  return p;
}

struct Bench {
  explicit Bench(const preset::Preset& p) {
    const scene::Scene scene = scene::load_scene(p);
    const scene::Bvh bvh = scene::build_bvh(scene.geometry);
    job = photons::make_job(p, scene, bvh, spectral::make_plan(p, scene, bvh), context);
  }
  const compute::Context context = compute::Context::open();
  std::unique_ptr<job::Job> job;
};

/// Steps the preset's job for as long as the benchmark wants; `unit` counts what is done.
template <class Count>
void step_through(benchmark::State& state, const preset::Preset& p, const Count& count) {
  const Bench bench(p);
  job::Job* const job = bench.job.get();
  for (int warm_up = 0; warm_up < 20; ++warm_up) job->advance();
  const double before = count(job->progress());
  for (auto _ : state) job->advance();
  state.counters["per_second"] = benchmark::Counter(count(job->progress()) - before, benchmark::Counter::kIsRate);
}

void photons_traced(benchmark::State& state) {
  preset::Preset p = first_light();
  spectral::settings(p).direct = false;
  const preset::Vec3 position = p.scene.camera.position, target = p.scene.camera.target;
  for (std::size_t i = 0; i < 3; ++i) p.scene.camera.target[i] = 2 * position[i] - target[i];
  step_through(state, p, [](const job::Progress& progress) { return static_cast<double>(progress.work); });
}

void photons_traced_and_splatted(benchmark::State& state) {
  preset::Preset p = first_light();
  spectral::settings(p).direct = false;
  step_through(state, p, [](const job::Progress& progress) { return static_cast<double>(progress.work); });
}

void direct_samples(benchmark::State& state) {
  preset::Preset p = first_light();
  spectral::settings(p).caustic = false;
  spectral::settings(p).pixel_samples = 1 << 20;
  const double pixels = double(p.scene.camera.resolution[0]) * p.scene.camera.resolution[1];
  step_through(state, p, [&](const job::Progress& progress) { return progress.fraction * (1 << 20) * pixels; });
}

/// One picture from the films of 8 passes of the bunny. state.range(0): whether its caustics are smoothed.
void picture(benchmark::State& state) {
  preset::Preset p = preset::read_preset("spectral/thesis/bunny");
  p.stop.passes = 8;
  using Smoothing = photons::Settings::Smoothing;
  spectral::settings(p).smoothing = state.range(0) != 0 ? Smoothing::on : Smoothing::off;
  const Bench bench(p);
  job::Job* const job = bench.job.get();
  while (!job->finished()) job->advance();
  for (auto _ : state) benchmark::DoNotOptimize(job->snapshot());
}

/// Smooths a made picture of 512 x 512 in which range(0) / 100 photons fell in each pixel.
void smoothing(benchmark::State& state) {
  preset::Preset p = preset::read_preset("spectral/thesis/bunny");
  p.scene.camera.resolution = {512, 512};
  const scene::Scene scene = scene::load_scene(p);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  using Smoothing = photons::Smoothing;
  Smoothing smoothing(Smoothing::view_of(scene, bvh), 512, 512, Smoothing::Spread::where_it_helps);
  smoothing.find_surfaces();
  std::mt19937 random(1);
  std::poisson_distribution<int> half(static_cast<double>(state.range(0)) / 200);
  std::vector<float> rgb, draw;
  for (int i = 0; i < 512 * 512; ++i) {
    const int a = half(random), b = half(random);
    rgb.insert(rgb.end(), 3, static_cast<float>(a + b));
    draw.insert(draw.end(), 3, static_cast<float>(a - b));
  }
  for (auto _ : state) {
    std::vector<float> spread = rgb, spread_draw = draw;
    smoothing.spread(spread, spread_draw);
    benchmark::DoNotOptimize(spread);
  }
}

BENCHMARK(smoothing)
    ->ArgName("photons in 100 pixels")
    ->Arg(1000)
    ->Arg(100)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(picture)->ArgName("smoothing")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(photons_traced)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(4);
BENCHMARK(photons_traced_and_splatted)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(4);
BENCHMARK(direct_samples)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(4);

} // namespace
