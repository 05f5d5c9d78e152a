// SPDX-License-Identifier: Apache-2.0
// The worker with a job that counts: every order of commands ends in a defined state, and readers never wait.
#include "job/worker.h"
#include "tests/support/test.h"

#include <future>

namespace nephroid::worker_test {

using namespace nephroid::job;
using namespace std::chrono_literals;

/// Counts to `steps`; can be held inside a step. Its picture is one pixel with the count.
class CountingJob : public Job {
public:
  explicit CountingJob(int steps, std::atomic<int>* alive = nullptr) : steps_(steps), alive_(alive) {
    if (alive_) ++*alive_;
  }
  ~CountingJob() override {
    if (alive_) --*alive_;
  }
  void advance() override {
    ++count_;
    std::this_thread::sleep_for(200us);
  }
  bool finished() const override { return count_ >= steps_; }
  Progress progress() const override { return {.fraction = double(count_) / steps_, .step = count_, .steps = steps_}; }
  Snapshot snapshot() override {
    auto picture = std::make_shared<job::Picture>();
    picture->width = picture->height = 1;
    picture->rgb = {float(count_), 0, 0};
    return {.picture = std::move(picture), .progress = progress()};
  }
  void save(ByteSink&) override {}
  void load(ByteSource&) override {}

protected:
  int count_ = 0, steps_;
  std::atomic<int>* alive_;
};

constexpr int endless = 1 << 30;

auto counting(int steps, std::atomic<int>* alive = nullptr) {
  return [=] { return std::make_unique<CountingJob>(steps, alive); };
}

/// Tells its count as every pixel's spectrum.
class SpectrumJob : public CountingJob, public SpectrumSource {
public:
  using CountingJob::CountingJob;
  std::shared_ptr<const PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override {
    if (pixel[0] < 0) return nullptr;
    if (pixel[0] == 13) throw failed("clEnqueueReadBuffer", "the device is gone");
    auto made = std::make_shared<PixelSpectrum>();
    made->pixel = pixel;
    made->layers = {{"direct", {double(count_)}}};
    return made;
  }
};

auto with_spectra(int steps) {
  return [=] { return std::make_unique<SpectrumJob>(steps); };
}

/// Whether the worker comes to tell the spectrum of this pixel.
bool tells(const Worker& worker, std::array<int, 2> pixel) {
  return eventually([&] { return worker.spectrum() && worker.spectrum()->pixel == pixel; });
}

/// How the job that is made ends.
template <class Make>
job::State end_of(Worker& worker, Make make) {
  worker.start(make);
  worker.wait();
  return worker.status().state;
}

TEST(Worker, IsIdleAtFirst) {
  Worker worker;
  EXPECT_EQ(worker.status().state, job::State::idle);
  EXPECT_EQ(worker.snapshot(), nullptr);
  worker.cancel(); // of nothing: must not cancel what is started later
  EXPECT_EQ(end_of(worker, counting(3)), job::State::finished);
}

TEST(Worker, FinishesWithTheLastSnapshot) {
  for (const int steps : {20, 0}) { // a job that is finished at once is never advanced
    Worker worker;
    worker.set_snapshot_interval(1h);
    worker.start(counting(steps));
    EXPECT_EQ(worker.status().generation, 1u);
    worker.wait();
    EXPECT_EQ(worker.status().state, job::State::finished);
    EXPECT_EQ(worker.status().progress.step, steps);
    EXPECT_EQ(worker.snapshot()->picture->rgb[0], float(steps));
  }
}

TEST(Worker, TellsItsObserverOfEachStepAndOfTheEndHoweverItComes) {
  struct Counts : Observer {
    void begun(Job&) override { ++beginnings; }
    void advanced(Job&) override { ++steps; }
    void ended(Job& job) override {
      ++ends;
      finished = job.finished();
    }
    std::atomic<int> beginnings = 0, steps = 0, ends = 0;
    std::atomic<bool> finished = false;
  } counts;
  {
    Worker worker;
    worker.set_observer(&counts);
    worker.start(counting(5));
    worker.wait();
    EXPECT_EQ(std::tuple(counts.beginnings.load(), counts.steps.load(), counts.ends.load()), std::tuple(1, 5, 1));
    EXPECT_TRUE(counts.finished);
    worker.start(counting(endless));
    while (counts.steps < 6) std::this_thread::yield();
  }
  EXPECT_EQ(counts.ends, 2) << "the worker is gone";
  EXPECT_FALSE(counts.finished);
}

TEST(Worker, SnapshotsComeAtTheirInterval) {
  Worker worker;
  worker.set_snapshot_interval(0ms);
  worker.start(counting(endless));
  float last = 0;
  for (int i = 0; i < 5; ++i) // each is newer than the one before
    ASSERT_TRUE(eventually([&] {
      const auto snapshot = worker.snapshot();
      return snapshot && snapshot->picture->rgb[0] > last && (last = snapshot->picture->rgb[0]) > 0;
    }));
}

/// Its pictures take longer than its steps; it notes when they begin and end.
class SlowPictureJob : public CountingJob {
public:
  using Clock = std::chrono::steady_clock;
  struct Times {
    std::atomic<int> begun{0};
    Clock::time_point begin[8], end[8];
  };
  SlowPictureJob(int steps, Times& times) : CountingJob(steps), times_(times) {}
  Snapshot snapshot() override {
    const auto i = static_cast<std::size_t>(std::min(times_.begun++, 7));
    times_.begin[i] = Clock::now();
    std::this_thread::sleep_for(5ms);
    times_.end[i] = Clock::now();
    return CountingJob::snapshot();
  }

private:
  Times& times_;
};

// What the job measures of itself is less than what the worker does, and what lies between two snapshots is more: this
// holds however busy the machine is.
TEST(Worker, SlowSnapshotsLeaveANewJobTwoThirdsOfTheTime) {
  SlowPictureJob::Times times;
  {
    Worker worker;
    worker.set_snapshot_interval(0ms);
    worker.start([&] { return std::make_unique<SlowPictureJob>(endless, times); });
    ASSERT_TRUE(eventually([&] { return times.begun > 4; }));
  } // joined; the last one may be the one at the end, which does not wait
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_GE(times.begin[i] - times.end[i - 1], 2 * (times.end[i - 1] - times.begin[i - 1])) << i;
}

TEST(Worker, TheLastSnapshotDoesNotWait) {
  SlowPictureJob::Times times;
  Worker worker;
  worker.set_snapshot_interval(0ms);
  worker.start([&] { return std::make_unique<SlowPictureJob>(2, times); });
  worker.wait();
  EXPECT_GE(times.begun, 2) << "after the first step and at the end";
  EXPECT_EQ(worker.snapshot()->picture->rgb[0], 2);
}

TEST(Worker, CancelLeavesTheLastSnapshot) {
  Worker worker;
  worker.start(counting(endless));
  ASSERT_TRUE(eventually([&] { return worker.status().progress.step > 5; }));
  worker.cancel();
  worker.wait();
  EXPECT_EQ(worker.status().state, job::State::cancelled);
  EXPECT_EQ(worker.snapshot()->progress.step, worker.status().progress.step);
  EXPECT_GT(worker.snapshot()->progress.step, 5);
}

TEST(Worker, CancelWhilePreparingNeverSteps) {
  Worker worker;
  std::promise<void> entered, leave;
  worker.start([&]() -> std::unique_ptr<Job> {
    entered.set_value();
    leave.get_future().wait();
    return std::make_unique<CountingJob>(endless);
  });
  entered.get_future().wait();
  EXPECT_EQ(worker.status().state, job::State::preparing);
  worker.cancel();
  leave.set_value();
  worker.wait();
  EXPECT_EQ(worker.status().state, job::State::cancelled);
  EXPECT_EQ(worker.snapshot(), nullptr);
}

TEST(Worker, TheNewestStartWins) {
  Worker worker;
  std::atomic<int> alive{0}, made{0};
  for (int i = 0; i < 50; ++i)
    worker.start([&, i] {
      ++made;
      EXPECT_EQ(alive, 0) << "the old job is gone before the new one is made";
      return std::make_unique<CountingJob>(i == 49 ? 7 : endless, &alive);
    });
  worker.wait();
  EXPECT_EQ(worker.status().state, job::State::finished);
  EXPECT_EQ(worker.status().generation, 50u);
  EXPECT_EQ(worker.snapshot()->progress.steps, 7);
  EXPECT_LE(made, 50);
}

TEST(Worker, AReplacedJobsErrorIsNotTheNewJobs) {
  Worker worker;
  std::promise<void> entered, leave;
  worker.start([&]() -> std::unique_ptr<Job> {
    entered.set_value();
    leave.get_future().wait();
    throw bad_input("old.json", "is broken");
  });
  entered.get_future().wait();
  worker.start(counting(2));
  leave.set_value();
  worker.wait();
  EXPECT_EQ(worker.status().state, job::State::finished);
  EXPECT_FALSE(worker.status().error);
}

TEST(Worker, PausesAndGoesOn) {
  Worker worker;
  worker.start(counting(endless));
  ASSERT_TRUE(eventually([&] { return worker.status().state == job::State::running; }));
  worker.pause(true);
  ASSERT_TRUE(eventually([&] { return worker.status().state == job::State::paused; }));
  const auto step = worker.status().progress.step;
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(worker.status().progress.step, step);
  worker.pause(false);
  ASSERT_TRUE(eventually([&] { return worker.status().progress.step > step; }));
  worker.pause(true);
  worker.cancel(); // ends a pause too
  worker.wait();
  EXPECT_EQ(worker.status().state, job::State::cancelled);
}

class FailingJob : public CountingJob {
public:
  FailingJob() : CountingJob(endless) {}
  void advance() override {
    if (++count_ == 3) throw failed("trace.cl", "out of registers");
  }
};

TEST(Worker, ErrorsBecomeAStateAndTheWorkerGoesOn) {
  Worker worker;
  EXPECT_EQ(end_of(worker, [] { return std::make_unique<FailingJob>(); }), job::State::failed);
  EXPECT_EQ(worker.status().error->line(), "trace.cl: out of registers");
  EXPECT_EQ(end_of(worker, []() -> std::unique_ptr<Job> { throw std::bad_alloc(); }), job::State::failed);
  EXPECT_EQ(worker.status().error->line(), "out of memory");
  EXPECT_EQ(end_of(worker, []() -> std::unique_ptr<Job> { return nullptr; }),
            job::State::cancelled); // there is nothing to do
  EXPECT_EQ(end_of(worker, counting(1)), job::State::finished);
}

TEST(Worker, ReadersNeverWaitForAStep) {
  /// Its one step lasts until it is let go.
  class HeldJob : public CountingJob {
  public:
    explicit HeldJob(std::future<void> let_go) : CountingJob(1), let_go_(std::move(let_go)) {}
    void advance() override {
      let_go_.wait();
      ++count_;
    }

  private:
    std::future<void> let_go_;
  };
  std::promise<void> let_go;
  Worker worker;
  worker.start([&] { return std::make_unique<HeldJob>(let_go.get_future()); });
  ASSERT_TRUE(eventually([&] { return worker.status().state == job::State::running; }));
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(worker.status().state, job::State::running); // a reader that waited for the step would wait for ever
    worker.snapshot();
  }
  let_go.set_value();
  worker.wait();
  EXPECT_EQ(worker.status().state, job::State::finished);
}

TEST(Worker, DestructionMidStepCancelsAndFreesTheJob) {
  std::atomic<int> alive{0};
  {
    Worker worker;
    worker.start(counting(endless, &alive));
    ASSERT_TRUE(eventually([&] { return worker.status().progress.step > 0; }));
  }
  EXPECT_EQ(alive, 0);
}

TEST(Worker, ManyReadersAndCommandsAtOnce) {
  Worker worker;
  worker.set_snapshot_interval(0ms);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&worker, t](const std::stop_token& stop) {
      for (int i = 0; !stop.stop_requested(); ++i) {
        if (const auto snapshot = worker.snapshot()) {
          EXPECT_EQ(snapshot->picture->rgb[0], float(snapshot->progress.step));
        }
        if (t == 0 && i % 50 == 0) worker.start(counting(i % 3 ? 2 : endless));
        if (t == 1 && i % 70 == 0) worker.cancel();
        if (t == 2) worker.pause(i % 2);
        std::this_thread::sleep_for(20us);
      }
    });
  std::this_thread::sleep_for(200ms);
  threads.clear();
  EXPECT_EQ(end_of(worker, counting(2)), job::State::finished);
}

TEST(Worker, TellsTheSpectrumOfThePixelThatIsWatched) {
  Worker worker;
  worker.set_snapshot_interval(0ms);
  worker.start(with_spectra(endless));
  ASSERT_TRUE(eventually([&] { return worker.snapshot() != nullptr; }));
  EXPECT_EQ(worker.spectrum(), nullptr) << "nobody asked";
  worker.watch_spectrum(std::array{1, 2});
  ASSERT_TRUE(tells(worker, {1, 2}));
  const double first = worker.spectrum()->layers[0].radiance[0];
  EXPECT_TRUE(eventually([&] { return worker.spectrum()->layers[0].radiance[0] > first; }))
      << "it goes on with the run";
  worker.watch_spectrum(std::nullopt);
  EXPECT_EQ(worker.spectrum(), nullptr);
  worker.watch_spectrum(std::array{1, 1});
  worker.start(counting(5)); // this job has none
  worker.wait();
  EXPECT_EQ(worker.spectrum(), nullptr);
}

TEST(Worker, APausedAndAFinishedJobTellSpectraWithoutAnotherPicture) {
  Worker worker;
  worker.set_snapshot_interval(0ms);
  worker.start(with_spectra(endless));
  ASSERT_TRUE(eventually([&] { return worker.snapshot() != nullptr; }));
  worker.pause(true);
  ASSERT_TRUE(eventually([&] { return worker.status().state == job::State::paused; }));
  const auto paused = worker.snapshot();
  worker.watch_spectrum(std::array{3, 3});
  EXPECT_TRUE(tells(worker, {3, 3}));
  EXPECT_EQ(worker.status().state, job::State::paused);
  EXPECT_EQ(worker.snapshot(), paused);
  worker.start(with_spectra(5));
  worker.wait();
  EXPECT_TRUE(eventually([&] { return worker.spectrum() && worker.spectrum()->layers[0].radiance[0] == 5; }))
      << "the next job is watched too";
  const auto last = worker.snapshot();
  worker.watch_spectrum(std::array{4, 4});
  EXPECT_TRUE(tells(worker, {4, 4}));
  EXPECT_EQ(worker.snapshot(), last);
  EXPECT_EQ(worker.status().state, job::State::finished);
}

TEST(Worker, ASpectrumThatFailsIsTheState) {
  Worker worker;
  worker.start(with_spectra(5));
  worker.wait();
  worker.watch_spectrum(std::array{13, 0});
  ASSERT_TRUE(eventually([&] { return worker.status().state == job::State::failed; }));
  worker.watch_spectrum(std::array{1, 0});
  worker.start(with_spectra(5));
  worker.wait();
  EXPECT_TRUE(tells(worker, {1, 0}));
}

} // namespace nephroid::worker_test
