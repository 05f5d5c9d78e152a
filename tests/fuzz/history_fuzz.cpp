// SPDX-License-Identifier: Apache-2.0
// A run's folder as a report reads it, a part a file. What is read of history.csv is written and read again.
#include "base/files.h"
#include "measure/run_files.h"
#include "plan/plan.h"
#include "report/report.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

constexpr const char* names[] = {"history.csv", "run.json", "plan.json", "preset.json", "cost.csv"};

} // namespace

void read(std::string_view input) {
  std::vector<std::string> parts = parts_of(input);
  parts.resize(std::size(names));
  fs::create_directories(folder() / "run");
  for (std::size_t i = 0; i < parts.size(); ++i) write(std::string("run/") + names[i], parts[i]);
  accepts([&] {
    const job::History history = measure::read_history(folder() / "run/history.csv");
    const std::string written = measure::to_csv(history);
    if (measure::to_csv(measure::read_history(write("again.csv", written))) != written)
      finding("another history is read than was written");
  });
  plan::inputs_of(parts[2]);
  const fs::path folders[] = {folder() / "run"};
  const std::vector<report::RunFolder> runs = report::read_runs(folders);
  report::metrics_json(runs, {std::nullopt});
}

std::vector<std::string> seeds() {
  const std::string parts[] = {
      "seconds,wall_seconds,step,work,lab_mean,estimated_lab_mean\n0.5,0.7,1,1000,2.5,\n1,1.25,2,2000,1.25,1.5\n2,2.5,"
      "4,4000,0.7,0.8\n",
      R"({"name":"r","engine":"spectral","seed":1,"version":"0.1.0","commit":"","compiler":"","finished":true,"passes":4,"photons":4000,
        "work_seconds":2,"wall_seconds":2.5,"device":{"name":"d"},"phase_seconds":{"photons":1.5},"energy":{"emitted_w":1},
        "errors":{"lab_mean":0.7},"error_column":"lab_mean","noise_floor":{"lab_mean":0.1},"reference":{"origin":"r.exr"}})",
      R"({"engine":"spectral","passes":[{"name":"direct","runs":true,"reason":"light"}],"buffers":[{"name":"film","bytes":100}],
        "inputs":[{"file":"a.obj","content":"0123456789abcdef"}]})",
      R"({"engine":"spectral","seed":1,"scene":{"lights":[{"power_w":1}]}})", "sweep,cost\n1,0.5\n2,inf\n"};
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : std::string(between)) + part;
  return {all, parts[0]};
}

} // namespace nephroid::fuzz
