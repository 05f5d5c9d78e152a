// SPDX-License-Identifier: Apache-2.0
// A job without a device for tests of the window: its picture is one colour that tells which camera it was made for.
#pragma once
#include "engine/engine.h"
#include "photons/energy.h"
#include "tests/support/test.h"
#include "ui/state/workbench.h"

namespace nephroid::test {

inline constexpr const char* preset_text = R"({
  "name": "Test", "engine": "spectral", "unit": "m", "white": 1,
  "scene": {
    "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40, "resolution": [64, 48]},
    "materials": {"wall": {"type": "diffuse", "reflectance": 0.5}},
    "objects": [{"name": "wall", "shape": {"type": "quad", "size": [2, 1, 2]}, "material": "wall", "transform": {"rotate_deg": [90, 0, 0]}}],
    "lights": [{"type": "point", "power_w": 10, "position": [0.5, 0.5, 1]}]
  },
  "stop": {"passes": 20}
})";

/// How the fake jobs shall go. What is not atomic is set before a run starts.
struct FakeSettings {
  std::atomic<int> steps{20};
  std::atomic<int> step_ms{2}, make_ms{0};
  std::atomic<int> whole_from{0}; ///< pictures after so many steps are whole
  std::atomic<bool> fails{false};
  std::atomic<bool> adopts{true}; ///< another light, where the preset keeps layers
  std::atomic<int> adopted{0};
  std::function<std::shared_ptr<const job::History>(int step)>
      history; ///< after so many steps; empty: nothing is measured
  std::vector<job::ExtraFile> files;
};

/// lab_mean = level / sqrt(t) against a reference and the run's own estimate, a tenth above it; a row a step of 10 ms.
inline std::shared_ptr<job::History> falling_history(int rows, double level = 0.01) {
  auto history = std::make_shared<job::History>();
  history->columns = {"lab_mean", "rel_mse", "estimated_lab_mean"};
  history->error_column = "lab_mean";
  for (int row = 1; row <= rows; ++row) {
    const double seconds = 0.01 * row, error = level / std::sqrt(seconds);
    history->rows.push_back(
        {seconds, seconds + 0.5, row, 1000u * static_cast<unsigned>(row), {error, error * error, 1.1 * error}});
  }
  return history;
}

class FakeJob : public job::Job {
public:
  FakeJob(preset::Preset preset, FakeSettings& runs) : preset_(std::move(preset)), runs_(runs) {}
  void advance() override {
    std::this_thread::sleep_for(std::chrono::milliseconds(runs_.step_ms));
    if (runs_.fails && done_ == 2) throw failed("clEnqueueNDRangeKernel", "the device is gone", "", "start again");
    ++done_;
  }
  bool finished() const override { return done_ >= runs_.steps; }
  job::Progress progress() const override {
    return {.fraction = static_cast<double>(done_) / runs_.steps,
            .step = done_,
            .steps = runs_.steps,
            .work = 1000 * static_cast<std::uint64_t>(done_),
            .work_seconds = 0.002 * done_,
            .whole = done_ >= runs_.whole_from};
  }
  job::Snapshot snapshot() override {
    auto picture = std::make_shared<job::Picture>();
    picture->width = preset_.scene.camera.resolution[0];
    picture->height = preset_.scene.camera.resolution[1];
    const std::size_t pixels = static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height);
    for (std::size_t i = 0; i < pixels; ++i)
      for (double c : preset_.scene.camera.position) picture->rgb.push_back(static_cast<float>(c));
    picture->layers = {{"direct", picture->rgb}};
    job::Snapshot made{.picture = picture, .progress = progress(), .phases = {{"photons", 0.002 * done_}}};
    if (!preset_.scene.lights.empty())
      made.scalars.push_back({"energy", "emitted_w", preset_.scene.lights[0].power_w}); // tells which light it is of
    made.files = runs_.files;
    if (runs_.history) made.history = runs_.history(done_);
    return made;
  }
  void save(ByteSink&) override {}
  void load(ByteSource&) override {}
  bool adopt(const preset::Preset& preset) override {
    const auto& lights = preset.scene.lights;
    if (!lights.empty() && lights[0].power_w == 13) throw bad_input("lights/0", "is unlucky");
    if (!runs_.adopts || !engine::adoptable(preset_, preset)) return false;
    preset_ = preset;
    ++runs_.adopted;
    return true;
  }

private:
  preset::Preset preset_;
  FakeSettings& runs_;
  int done_ = 0;
};

/// Gives fake jobs; outlives the workbench.
class FakeRuns : public ui::RunSource, public FakeSettings {
public:
  ui::NewRun make(const preset::Preset& preset, const Watch& watch) override {
    do {
      watch.begin("reading bunny.obj");
      std::this_thread::sleep_for(std::chrono::milliseconds(make_ms));
    } while (reads_on);
    ++made;
    if (refusal) throw *refusal;
    if (broken) throw failed("photons.cl:12", "expected ';' after expression");
    plan::Plan made_plan = plan;
    made_plan.notes = {preset.name + ": n is extrapolated below 390 nm"};
    return {std::make_unique<FakeJob>(preset, *this),
            std::make_shared<const plan::Plan>(std::move(made_plan)),
            reference,
            {},
            {},
            white};
  }
  std::unique_ptr<job::Job> make_beside(const preset::Preset& preset, const Watch&) override {
    ++made_beside;
    if (refuses_beside) throw bad_input("scene", "cannot be");
    const std::lock_guard lock(beside_mutex);
    seen_beside = preset;
    return std::make_unique<FakeJob>(preset, beside);
  }
  std::function<compute::Context()> device_opener() const override {
    return [this]() -> compute::Context {
      while (!opens_device) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      throw bad_input("device", "there is none here");
    };
  }
  void reread_files() override { ++reread; }
  void reopen_device() override { ++reopened; }
  bool take_changed() override { return changed.exchange(false); }

  plan::Plan plan;                                     ///< but for its notes; set before a run starts, as is
  std::shared_ptr<const measure::Reference> reference; ///< this
  std::optional<Error> refusal;                        ///< and this: of the preset
  std::optional<double> white = {};                    ///< in place of "auto"
  std::atomic<int> made{0}, reread{0}, reopened{0};
  std::atomic<bool> changed{false}, broken{false}; ///< the kernels
  std::atomic<bool> opens_device{true};            ///< for a film: it does not come to that
  std::atomic<bool> reads_on{false};               ///< runs do not come to the end of a file
  FakeSettings beside;                             ///< of small pictures
  std::atomic<int> made_beside{0};
  std::atomic<bool> refuses_beside{false};
  std::mutex beside_mutex;
  preset::Preset seen_beside; ///< the newest, guarded by the mutex
};

/// The newest message's line; empty where there is none.
inline std::string last_message(const ui::Workbench& workbench) {
  return workbench.messages().empty() ? std::string() : workbench.messages().back().line;
}
/// The one message's line; where there are more, all of them.
inline std::string only_message(const ui::Workbench& workbench) {
  std::string lines;
  for (const ui::Message& message : workbench.messages()) lines += (lines.empty() ? "" : " | ") + message.line;
  return lines;
}

/// The workbench on fake jobs and the program's real worker thread, without a window.
struct Bench {
  FakeRuns runs;
  ui::Workbench workbench{runs};

  bool until(const std::function<bool()>& done) {
    return eventually([&] { workbench.update(); }, done);
  }
  bool until(job::State state) {
    return until([&] { return workbench.run().status().state == state; });
  }
  /// As a panel does; gesture and live: as command::Edit has them.
  void edit(const std::function<void(preset::Preset&)>& change, std::uint64_t gesture = 0, bool live = false) {
    preset::Preset edited = *workbench.preset();
    change(edited);
    workbench.apply({ui::command::Edit{"edit", edited, gesture, live}});
  }
};

class WorkbenchFixture : public testing::Test, protected Bench {
protected:
  TemporaryFolder folder;

  void open(const std::string& text = preset_text) { ASSERT_TRUE(workbench.open(folder.write("test.json", text))); }
  /// Opens the preset and runs it to its end.
  void run_through() {
    open();
    ASSERT_TRUE(until(job::State::finished));
  }
};

} // namespace nephroid::test
