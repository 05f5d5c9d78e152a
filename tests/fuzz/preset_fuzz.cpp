// SPDX-License-Identifier: Apache-2.0
// A preset's JSON, then an override a part. What is read is written and read again.
#include "preset/read.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  const std::vector<std::string> parts = parts_of(input);
  const std::string& json = parts.front();
  const preset::Overrides overrides(parts.begin() + 1, parts.end());
  accepts([&] {
    const preset::Preset preset = preset::parse_preset(json, "fuzz.json", overrides);
    if (preset::parse_preset(preset::to_json(preset), "fuzz.json") != preset)
      finding("another preset is read than was written");
  });
  const preset::WithSweep read = preset::parse_with_sweep(json, "fuzz.json");
  constexpr double most_runs = 20;
  if (preset::count_runs(read.sweep) <= most_runs) preset::swept_runs(read.preset, read.sweep);
}

std::vector<std::string> seeds() {
  std::vector<std::string> seeds = shipped("", ".json");
  const std::string overrides[] = {"seed=7",
                                   "scene.camera.resolution=[64,64]",
                                   "scene.lights.0.power_w=3",
                                   "spectral.method=optimal",
                                   "environment.spheres=4",
                                   "inverse.receivers.0.distance_mm=.5"};
  for (const std::string& override : overrides)
    seeds.push_back(seeds[seeds.size() / 2] + std::string(between) + override);
  seeds.push_back(R"({"parent":"first-light","name":"x"})");
  seeds.push_back(R"({"engine":"spectral","sweep":{"seed":[1,2],"spectral.threshold_deg":[0.1,0.2]}})");
  return seeds;
}

} // namespace nephroid::fuzz
