// SPDX-License-Identifier: Apache-2.0
// Checkpoints of every engine: the first byte chooses a job; the rest is a header, before the job's state and a right
// hash, or a whole file. Only what the job wrote is loaded. A wrong state under a right hash is not asked for: nothing
// but the program writes that hash.
#include "base/hashed_bytes.h"
#include "measure/measured_job.h"
#include "preset/read.h"
#include "run/checkpoint.h"
#include "run/prepare.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

constexpr std::size_t header_bytes = 72;   ///< run/checkpoint.cpp
constexpr unsigned char only_header = 130; ///< of a first byte, whose rest by the jobs' number chooses one

std::string inverse_by(const std::string& method) {
  return R"({"engine": "inverse", "stop": {"passes": 3}, "scene": {"camera": {"resolution": [8, 8]}}, "inverse": {"method": ")" +
         method +
         R"(", "facets": [16, 16], "cells": [8, 8], "receivers": [{"distance_mm": 100, "picture": {"type": "ring"}}]}})";
}

const std::string presets[] = {
    R"({"engine": "spectral", "stop": {"passes": 3}, "spectral": {"photons_per_pass": 500, "pixel_samples": 1},
      "scene": {"camera": {"resolution": [4, 4]}, "lights": [{"type": "point", "position": [0, 3, 0]}],
      "materials": {"g": {"type": "dielectric", "dispersion": 1.5}, "w": {"type": "diffuse"}}, "objects": [
      {"shape": {"type": "sphere"}, "material": "g", "transform": {"translate": [0, 1, 0]}},
      {"shape": {"type": "quad", "size": [5, 1, 5]}, "material": "w"}]}})",
    R"({"engine": "environment", "stop": {"passes": 3}, "environment": {"directions": 26, "spheres": 2, "resolution": 16, "photons": 1000},
      "scene": {"camera": {"resolution": [4, 4]}, "lights": [{"type": "directional", "direction": [0, -1, 0]}],
      "materials": {"g": {"type": "dielectric", "dispersion": 1.5}, "w": {"type": "diffuse"}}, "objects": [
      {"shape": {"type": "sphere"}, "material": "g", "transform": {"translate": [0, 1, 0]}},
      {"shape": {"type": "box", "size": [8, 1, 8]}, "material": "w", "transform": {"translate": [0, -3, 0]}}]}})",
    inverse_by("assign"), inverse_by("thesis"), inverse_by("lens")};
constexpr std::size_t jobs_in_all = std::size(presets);
static_assert(only_header % jobs_in_all == 0);

/// A job that has begun, and its checkpoint.
struct Begun {
  run::Prepared prepared;
  std::unique_ptr<job::Job> job;
  std::string header, body;
};

const compute::Context& context() {
  static const compute::Context opened = compute::Context::open();
  return opened;
}

std::string file_of(const std::string& header, std::string_view body) {
  ByteStore store;
  HashedSink hashed(store);
  hashed.write(std::as_bytes(std::span(header)));
  hashed.write(std::as_bytes(std::span(body)));
  store.value(hashed.hash());
  return {reinterpret_cast<const char*>(store.bytes().data()), store.bytes().size()};
}

Begun& begun(std::size_t which) {
  static std::vector<std::unique_ptr<Begun>> jobs(jobs_in_all);
  if (jobs[which]) return *jobs[which];
  setenv("XDG_CACHE_HOME", folder().c_str(), 1); // no bake of an earlier day
  const preset::Preset preset = preset::parse_preset(presets[which], "fuzz.json");
  run::Prepared prepared = run::prepare(preset);
  std::unique_ptr<job::Job> job =
      measure::measured(run::make_job(prepared, context()), preset, nullptr, std::chrono::steady_clock::now());
  for (int step = 0; step < 4 && !job->finished(); ++step) job->advance();
  run::write_checkpoint(folder(), prepared, context(), *job);
  const std::string file = read_file(folder() / "checkpoint.bin");
  jobs[which] =
      std::make_unique<Begun>(Begun{std::move(prepared), std::move(job), file.substr(0, header_bytes),
                                    file.substr(header_bytes, file.size() - header_bytes - sizeof(std::uint64_t))});
  return *jobs[which];
}

} // namespace

void read(std::string_view input) {
  if (input.empty()) return;
  const auto first = static_cast<unsigned char>(input[0]);
  Begun& its = begun(first % jobs_in_all);
  const std::string right = file_of(its.header, its.body), given(input.substr(1));
  const std::string file = first < only_header ? given : file_of(given, its.body);
  const auto load = [&](const std::string& bytes) {
    write("checkpoint.bin", bytes);
    run::load_checkpoint(folder(), its.prepared, context(), *its.job);
  };
  accepts([&] { load(file); });
  load(right); // after whatever that left
}

std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  for (std::size_t which = 0; which < jobs_in_all; ++which) {
    const Begun& its = begun(which);
    seeds.push_back(static_cast<char>(which) + file_of(its.header, its.body));
    seeds.push_back(static_cast<char>(only_header + which) + its.header);
  }
  return seeds;
}

} // namespace nephroid::fuzz
