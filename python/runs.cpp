// SPDX-License-Identifier: Apache-2.0
// A run on a thread of its own. Python asks for what there is, and never waits for the device.
#include "job/worker.h"
#include "preset/origins.h"
#include "python/bindings.h"
#include "run/exposure.h"
#include "run/ready.h"
#include "run/recorder.h"
#include "run/write_run.h"

#include <mutex>
#include <optional>
#include <unistd.h>
#include <utility>

namespace nephroid::python {
namespace {

/// What a run is made of, once its thread has made it ready.
struct Origin {
  run::Prepared prepared;
  compute::DeviceInfo device;
  std::shared_ptr<const measure::Reference> reference;
};

/// How a run begins.
struct RunSettings {
  preset::Preset preset;
  std::string device, folder; ///< folder: that it writes its files into; empty: none
  bool resume = false;
};

const char* word(job::State state) {
  switch (state) {
  case job::State::idle:
  case job::State::preparing: return "preparing";
  case job::State::running: return "running";
  case job::State::paused: return "paused";
  case job::State::finished: return "finished";
  case job::State::cancelled: return "stopped";
  case job::State::failed: return "failed";
  }
  return "";
}

/// Keeps a run's folder; what it has to say comes after the notes of the plan.
class Recorder final : public run::Recorder {
public:
  Recorder(const run::ReadyRun& run, const std::string& folder, std::function<void(const std::string&)> tell)
      : run::Recorder(run, {.folder = folder}), tell_(std::move(tell)) {}

private:
  void note(const std::string& sentence) override { tell_(sentence); }
  void warn(const std::string& sentence) override { tell_(sentence); }

  std::function<void(const std::string&)> tell_;
};

class RunHandle final : private job::Observer {
public:
  explicit RunHandle(const RunSettings& settings)
      : process_(::getpid()), worker_(new job::Worker, [this](job::Worker* worker) { end(worker); }) {
    use_opencl();
    worker_->set_observer(this);
    worker_->start([this, settings] { return make(settings); });
  }
  ~RunHandle() override { close(); }
  RunHandle(const RunHandle&) = delete;
  RunHandle& operator=(const RunHandle&) = delete;

  /// A forked process has none of the threads: what waits for them would wait for ever, and a mutex may be locked for
  /// ever.
  bool is_of_this_process() const { return process_ == ::getpid(); }

  job::Status status() const { return worker()->status(); }
  std::shared_ptr<const job::Snapshot> snapshot() const { return worker()->snapshot(); }
  void stop() {
    const std::shared_ptr<job::Worker> held = worker();
    stopping_.request_stop();
    held->cancel();
  }
  void pause(bool paused) { worker()->pause(paused); }
  void watch(std::optional<std::array<int, 2>> pixel) { worker()->watch_spectrum(pixel); }
  std::shared_ptr<const job::PixelSpectrum> spectrum() const { return worker()->spectrum(); }
  /// "reading bunny.obj"
  std::string doing() const {
    check_process();
    const std::scoped_lock lock(mutex_);
    return doing_;
  }
  /// Those of the plan and the folder, and in the end how bright the picture is.
  std::vector<std::string> notes() const {
    const std::shared_ptr<job::Worker> held = worker();
    const bool finished = held->status().state == job::State::finished;
    const std::shared_ptr<const job::Snapshot> shown = held->snapshot();
    const std::scoped_lock lock(mutex_);
    std::vector<std::string> notes = notes_;
    if (finished && shown && shown->picture && origin_)
      if (std::string note = run::exposure_note(*shown->picture, origin_->prepared.preset, "white={}"); !note.empty())
        notes.push_back(std::move(note));
    return notes;
  }

  /// Waits for the slice in hand. A call of another thread that is at it keeps the worker until it returns.
  void close() {
    if (!is_of_this_process()) return;
    stopping_.request_stop();
    const std::shared_ptr<job::Worker> dropped = [&] {
      const std::scoped_lock lock(mutex_);
      return std::exchange(worker_, nullptr);
    }();
  }

  /// As `nephroid run` writes them, but for a checkpoint. close() may come meanwhile.
  void save(const std::string& folder) const {
    std::shared_ptr<job::Worker> held = worker();
    const bool finished =
        held->status().state == job::State::finished; // before the picture, which is the last one then
    const std::shared_ptr<const job::Snapshot> shown = held->snapshot();
    held.reset();
    const std::shared_ptr<const Origin> origin = [&] {
      const std::scoped_lock lock(mutex_);
      return origin_;
    }();
    if (!origin || !shown || shown->stands_in) throw failed(folder, "the run has no picture yet", {}, "wait for one");
    const run::ClaimedFolder claimed(folder);
    run::begin_run(folder, origin->prepared);
    run::write_run(folder, origin->prepared, origin->device, *shown, origin->reference.get(), finished);
    if (finished && shown->history) run::write_report(folder);
  }

private:
  void check_process() const {
    if (!is_of_this_process())
      throw failed("run", "belongs to the process that started it, and this one was forked from that", {},
                   "use multiprocessing's start method 'spawn'");
  }

  std::shared_ptr<job::Worker> worker() const {
    check_process();
    const std::scoped_lock lock(mutex_);
    if (!worker_) throw failed("run", "is closed");
    return worker_;
  }

  /// Waits for the slice in hand, and holds up no other Python thread meanwhile.
  void end(job::Worker* worker) {
    std::optional<py::gil_scoped_release> released;
    if (PyGILState_Check() != 0) released.emplace();
    delete worker;
    recorder_.reset();
    ready_.reset();
  }

  // On the worker's thread

  std::unique_ptr<job::Job> make(const RunSettings& settings) {
    const Watch watch{stopping_.get_token(), [this](const std::string& doing) {
                        const std::scoped_lock lock(mutex_);
                        doing_ = doing;
                      }};
    auto ready = std::make_unique<run::ReadyRun>(
        [device = settings.device] { return compute::Context::open({.selector = device}); });
    const auto refuse = [](const Error& error) { throw error.noting("leave out 'resume' to start over"); };
    preset::at_origins(settings.preset, [&] {
      run::make_ready(*ready, settings.preset,
                      {.watch = watch, .folder = settings.folder, .resume = settings.resume, .bad_checkpoint = refuse});
    });
    ready_ = std::move(ready);
    if (ready_->claimed)
      recorder_.emplace(*ready_, settings.folder, [this](const std::string& sentence) { add_note(sentence); });
    const std::scoped_lock lock(mutex_);
    origin_ =
        std::make_shared<const Origin>(Origin{*ready_->prepared, ready_->device.opened().device(), ready_->reference});
    notes_ = ready_->prepared->plan->notes;
    doing_.clear();
    return std::move(ready_->job);
  }
  void add_note(const std::string& sentence) {
    const std::scoped_lock lock(mutex_);
    notes_.push_back(sentence);
  }
  void begun(job::Job& job) override {
    if (recorder_) recorder_->begun(job);
  }
  void advanced(job::Job& job) override {
    if (recorder_) recorder_->advanced(job);
  }
  void ended(job::Job& job) override {
    if (recorder_) recorder_->ended(job);
    ready_->claimed.reset();
  }

  pid_t process_;
  std::stop_source stopping_;
  mutable std::mutex mutex_; ///< guards what follows
  std::string doing_;
  std::vector<std::string> notes_;
  std::shared_ptr<const Origin> origin_; ///< null until it is ready
  std::unique_ptr<run::ReadyRun> ready_; ///< the worker's thread only, as is the next one
  std::optional<Recorder> recorder_;     ///< nothing where the run has no folder
  std::shared_ptr<job::Worker> worker_;  ///< null: closed. Who calls it holds it
};

/// In a forked process a run stays where it is: its threads may have left anything of it half done.
struct Deleter {
  void operator()(RunHandle* run) const {
    if (run->is_of_this_process()) delete run;
  }
};

} // namespace

void add_runs(py::module_& module) {
  const py::call_guard<py::gil_scoped_release> released;
  py::class_<job::Progress>(module, "Progress")
      .def_readonly("fraction", &job::Progress::fraction)
      .def_readonly("step", &job::Progress::step)
      .def_readonly("steps", &job::Progress::steps)
      .def_readonly("work", &job::Progress::work)
      .def_readonly("work_seconds", &job::Progress::work_seconds);
  py::class_<job::PixelSpectrum, std::shared_ptr<job::PixelSpectrum>>(module, "PixelSpectrum")
      .def_readonly("pixel", &job::PixelSpectrum::pixel)
      .def_readonly("why_not", &job::PixelSpectrum::why_not)
      .def_readonly("remedy", &job::PixelSpectrum::remedy)
      .def_readonly("notes", &job::PixelSpectrum::notes)
      .def("layers", [](const std::shared_ptr<job::PixelSpectrum>& spectrum) {
        py::dict layers;
        for (const job::PixelSpectrum::Layer& layer : spectrum->layers)
          layers[py::str(layer.name)] = lent<double, job::PixelSpectrum>(
              spectrum, layer.radiance, {static_cast<py::ssize_t>(layer.radiance.size())});
        return layers;
      });
  py::class_<RunHandle, std::unique_ptr<RunHandle, Deleter>>(module, "Run")
      .def(py::init([](const preset::Preset& preset, std::string device, std::string folder, bool resume) {
             return std::unique_ptr<RunHandle, Deleter>(
                 new RunHandle({preset, std::move(device), std::move(folder), resume}));
           }),
           py::arg("preset"), py::arg("device"), py::arg("folder"), py::arg("resume"), released)
      .def("state", [](const RunHandle& run) { return word(run.status().state); })
      .def("progress", [](const RunHandle& run) { return run.status().progress; })
      .def("doing", &RunHandle::doing)
      .def("notes", &RunHandle::notes)
      .def("raise_failure",
           [](const RunHandle& run) {
             if (const job::Status status = run.status(); status.state == job::State::failed && status.error)
               throw Error(*status.error);
           })
      .def("snapshot", [](const RunHandle& run) { return std::const_pointer_cast<job::Snapshot>(run.snapshot()); })
      .def("stop", &RunHandle::stop)
      .def("pause", &RunHandle::pause, py::arg("paused"))
      .def("watch", &RunHandle::watch, py::arg("pixel"))
      .def("spectrum", [](const RunHandle& run) { return std::const_pointer_cast<job::PixelSpectrum>(run.spectrum()); })
      .def("save", &RunHandle::save, py::arg("folder"), released)
      .def("close", &RunHandle::close, released);
}

} // namespace nephroid::python
