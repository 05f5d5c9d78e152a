// SPDX-License-Identifier: Apache-2.0
// A run on a thread of its own. Python asks for what there is, and never waits for the device.
#include "compute/compute.h"
#include "job/worker.h"
#include "measure/measured_job.h"
#include "preset/origins.h"
#include "python/bindings.h"
#include "run/exposure.h"
#include "run/folder.h"
#include "run/prepare.h"
#include "run/reference.h"
#include "run/write_run.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <unistd.h>
#include <utility>

namespace nephroid::python {
namespace {

/// What a run is made of, once its thread has made it.
struct Made {
  run::Prepared prepared;
  compute::DeviceInfo device;
  std::shared_ptr<const measure::Reference> reference;
};

const char* word(job::State state)
{
  switch (state) {
  case job::State::idle:
  case job::State::preparing:
    return "preparing";
  case job::State::running:
    return "running";
  case job::State::paused:
    return "paused";
  case job::State::finished:
    return "finished";
  case job::State::cancelled:
    return "stopped";
  case job::State::failed:
    return "failed";
  }
  return "";
}

/// Waits for the slice in hand, and holds up no other Python thread meanwhile.
void end(job::Worker* worker)
{
  std::optional<py::gil_scoped_release> released;
  if (PyGILState_Check() != 0) released.emplace();
  delete worker;
}

class RunHandle {
public:
  RunHandle(const preset::Preset& preset, std::string device) : process_(::getpid()), worker_(new job::Worker, &end)
  {
    use_opencl();
    worker_->start([this, preset, device = std::move(device)] { return make(preset, device); });
  }
  ~RunHandle() { close(); }
  RunHandle(const RunHandle&) = delete;
  RunHandle& operator=(const RunHandle&) = delete;

  /// A forked process has none of the threads: what waits for them would wait for ever, and a mutex may be locked for ever.
  bool is_of_this_process() const { return process_ == ::getpid(); }

  job::Status status() const { return worker()->status(); }
  std::shared_ptr<const job::Snapshot> snapshot() const { return worker()->snapshot(); }
  void stop()
  {
    const std::shared_ptr<job::Worker> held = worker();
    stopping_.request_stop();
    held->cancel();
  }
  void pause(bool paused) { worker()->pause(paused); }
  void watch(std::optional<std::array<int, 2>> pixel) { worker()->watch_spectrum(pixel); }
  std::shared_ptr<const job::PixelSpectrum> spectrum() const { return worker()->spectrum(); }
  /// "reading bunny.obj"
  std::string doing() const
  {
    check_process();
    const std::scoped_lock lock(mutex_);
    return doing_;
  }
  std::vector<std::string> notes() const
  {
    check_process();
    const std::scoped_lock lock(mutex_);
    return made_ ? made_->prepared.plan->notes : std::vector<std::string>();
  }

  /// Waits for the slice in hand. A call of another thread that is at it keeps the worker until it returns.
  void close()
  {
    if (!is_of_this_process()) return;
    stopping_.request_stop();
    const std::shared_ptr<job::Worker> dropped = [&] {
      const std::scoped_lock lock(mutex_);
      return std::exchange(worker_, nullptr);
    }();
  }

  /// As `nephroid run` writes them, but for a checkpoint. close() may come meanwhile.
  void save(const std::string& folder) const
  {
    std::shared_ptr<job::Worker> held = worker();
    const bool finished = held->status().state == job::State::finished; // before the picture, which is the last one then
    const std::shared_ptr<const job::Snapshot> shown = held->snapshot();
    held.reset();
    const std::shared_ptr<const Made> made = [&] {
      const std::scoped_lock lock(mutex_);
      return made_;
    }();
    if (!made || !shown || shown->stands_in) throw failed(folder, "the run has no picture yet", {}, "wait for one");
    const run::ClaimedFolder claimed(folder);
    run::begin_run(folder, made->prepared);
    run::write_run(folder, made->prepared, made->device, *shown, made->reference.get(), finished);
    if (finished && shown->history) run::write_report(folder);
  }

private:
  void check_process() const
  {
    if (!is_of_this_process())
      throw failed("run", "belongs to the process that started it, and this one was forked from that", {},
                   "use multiprocessing's start method 'spawn'");
  }

  std::shared_ptr<job::Worker> worker() const
  {
    check_process();
    const std::scoped_lock lock(mutex_);
    if (!worker_) throw failed("run", "is closed");
    return worker_;
  }

  /// On the worker's thread.
  std::unique_ptr<job::Job> make(const preset::Preset& preset, const std::string& device)
  {
    const Watch watch{stopping_.get_token(), [this](const std::string& doing) {
                        const std::scoped_lock lock(mutex_);
                        doing_ = doing;
                      }};
    auto made = std::make_shared<Made>(Made{preset::at_origins(preset, [&] { return run::prepare(preset, nullptr, watch); }), {}, nullptr});
    const compute::Context context = compute::Context::open({.selector = device});
    made->device = context.device();
    const compute::TellOfCompiling telling(context, [&] { watch.begin("compiling kernels"); });
    if (!preset.white) made->prepared.preset.white = run::fitted_white(made->prepared, context, watch);
    made->reference = run::find_reference(made->prepared, context);
    if (!made->reference && made->prepared.preset.reference) {
      watch.begin("rendering the reference");
      made->reference = run::make_reference(made->prepared, context, stopping_.get_token(), [](double, double) {});
    }
    watch.begin("setting up the run");
    auto job = measure::measured(run::make_job(made->prepared, context), made->prepared.preset, made->reference);
    const std::scoped_lock lock(mutex_);
    made_ = std::move(made);
    doing_.clear();
    return job;
  }

  pid_t process_;
  std::stop_source stopping_;
  mutable std::mutex mutex_; ///< of what follows
  std::string doing_;
  std::shared_ptr<const Made> made_;
  std::shared_ptr<job::Worker> worker_; ///< null: closed. Who calls it holds it
};

/// In a forked process a run stays where it is: its threads may have left anything of it half done.
struct Deleter {
  void operator()(RunHandle* run) const
  {
    if (run->is_of_this_process()) delete run;
  }
};

} // namespace

void add_runs(py::module_& module)
{
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
          layers[py::str(layer.name)] =
              lent<double, job::PixelSpectrum>(spectrum, layer.radiance, {static_cast<py::ssize_t>(layer.radiance.size())});
        return layers;
      });
  py::class_<RunHandle, std::unique_ptr<RunHandle, Deleter>>(module, "Run")
      .def(py::init<const preset::Preset&, std::string>(), py::arg("preset"), py::arg("device"), released)
      .def("state", [](const RunHandle& run) { return word(run.status().state); })
      .def("progress", [](const RunHandle& run) { return run.status().progress; })
      .def("doing", &RunHandle::doing)
      .def("notes", &RunHandle::notes)
      .def("raise_failure",
           [](const RunHandle& run) {
             if (const job::Status status = run.status(); status.state == job::State::failed && status.error) throw Error(*status.error);
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
