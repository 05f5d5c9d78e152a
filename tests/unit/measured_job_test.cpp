// SPDX-License-Identifier: Apache-2.0
// A job that measures itself, on a job whose error is known: n steps give a picture whose noise has the deviation sigma
// / sqrt(n).
#include "measure/measured_job.h"

#include "measure/run_files.h"
#include "spectral/settings.h"
#include "tests/support/presets.h"
#include "tests/support/saved_jobs.h"

#include <thread>

namespace nephroid::measured_job_test {

constexpr int size = 64;
constexpr double grey = 0.5, sigma = 0.2;

/// Even and odd steps are the two halves; a step takes 10 s of work that nobody waits for, so
/// that no machine is too slow to afford measuring.
class NoisyJob final : public job::Job {
public:
  NoisyJob(int steps, unsigned seed, bool halves = true)
      : steps_(steps), random_(seed), halves_(halves), sums_{zeros(), zeros()} {}

  void advance() override {
    std::normal_distribution<double> noise(0, sigma);
    for (double& sum : sums_[done_ % 2]) sum += grey + noise(random_);
    ++done_;
  }
  bool finished() const override { return done_ >= steps_; }
  job::Progress progress() const override {
    return {.fraction = static_cast<double>(done_) / steps_,
            .step = done_,
            .steps = steps_,
            .work = static_cast<std::uint64_t>(done_) * 1000,
            .work_seconds = 10.0 * done_};
  }
  job::Snapshot snapshot() override {
    auto picture = std::make_shared<job::Picture>();
    picture->width = picture->height = size;
    const double n = std::max(done_, 1), a = (done_ + 1) / 2, b = done_ / 2;
    for (std::size_t i = 0; i < sums_[0].size(); ++i) {
      picture->rgb.push_back(static_cast<float>((sums_[0][i] + sums_[1][i]) / n));
      if (halves_ && b > 0)
        picture->error_draw.push_back(static_cast<float>((sums_[0][i] / a - sums_[1][i] / b) * std::sqrt(a * b) / n));
    }
    return {.picture = std::move(picture), .progress = progress()};
  }
  void save(ByteSink& to) override { to.write(std::vector<std::byte>(static_cast<std::size_t>(done_))); }
  void load(ByteSource& from) override { done_ = static_cast<int>(from.left()); }
  bool adopt(const preset::Preset& preset) override { return spectral::settings(preset).relight; }

private:
  static std::vector<double> zeros() { return std::vector<double>(3 * size * size); }
  int steps_, done_ = 0;
  std::mt19937 random_;
  bool halves_;
  std::vector<double> sums_[2];
};

std::shared_ptr<const measure::Reference> truth() {
  auto reference = std::make_shared<measure::Reference>();
  reference->width = reference->height = size;
  reference->rgb.assign(static_cast<std::size_t>(3 * size * size), static_cast<float>(grey));
  reference->origin = "truth.exr";
  reference->noise_floor.emplace();
  reference->noise_floor->lab_mean = 0.125;
  return reference;
}

preset::Preset settings() {
  preset::Preset p = test::empty_preset(size);
  p.stop = {};
  p.source = "p.json";
  return p;
}

std::unique_ptr<job::Job> noisy(const preset::Preset& preset, std::shared_ptr<const measure::Reference> reference,
                                int steps = 200, unsigned seed = 1) {
  return measure::measured(std::make_unique<NoisyJob>(steps, seed), preset, std::move(reference));
}

job::History run(job::Job& job) {
  while (!job.finished()) job.advance();
  return *job.snapshot().history;
}

TEST(MeasuredJob, ErrorsFallAsTheNoiseDoes) {
  const auto job = noisy(settings(), truth());
  const job::History history = run(*job);
  ASSERT_GT(history.rows.size(), 10u);
  for (const job::HistoryRow& row : history.rows) {
    // mse is a mean over 12288 squares of normal deviates: its relative deviation is sqrt(2 / 12288) = 1.3 %; six of
    // them.
    const double expected = sigma * sigma / static_cast<double>(row.step);
    EXPECT_NEAR(job::error_in(history, row, "mse") / expected, 1, 0.077) << row.step;
    EXPECT_EQ(row.work, static_cast<std::uint64_t>(row.step) * 1000);
    EXPECT_DOUBLE_EQ(row.seconds, 10.0 * static_cast<double>(row.step));
  }
  EXPECT_EQ(history.rows.back().step, 200) << "the end is always a row";
  EXPECT_EQ(history.error_column, "lab_mean");
}

TEST(MeasuredJob, TheEstimateIsTheErrorWithoutAReference) {
  const auto job = noisy(settings(), truth());
  const job::History history = run(*job);
  for (const job::HistoryRow& row : history.rows) {
    if (row.step < 4) continue;
    for (const std::string metric : {"mse", "rel_l2", "lab_mean", "lab_rms"}) {
      // Both are of 12288 normal deviates and independent: 1.9 % apart at most once in three, and Lab takes its small
      // curvature at the noisy picture instead of the truth.
      const double ratio = job::error_in(history, row, "estimated_" + metric) / job::error_in(history, row, metric);
      EXPECT_NEAR(ratio, 1, row.step < 20 ? 0.16 : 0.11) << metric << " after " << row.step;
    }
  }
}

TEST(MeasuredJob, WithoutAReferenceTheEstimateIsWhatThereIs) {
  const auto job = noisy(settings(), nullptr);
  const job::History history = run(*job);
  EXPECT_EQ(history.error_column, "estimated_lab_mean");
  EXPECT_THAT(history.columns, Not(Contains("lab_mean")));
  EXPECT_GE(history.rows.front().step, 2) << "it needs both halves";
}

/// Its pictures take 2 ms each and tell nothing of their error; a step is 1 ms of work.
class SilentJob final : public job::Job {
public:
  explicit SilentJob(int& pictures) : pictures_(pictures) {}
  void advance() override { ++done_; }
  bool finished() const override { return done_ >= 200; }
  job::Progress progress() const override { return {.step = done_, .work_seconds = 0.001 * done_, .whole = true}; }
  job::Snapshot snapshot() override {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ++pictures_;
    return {.picture = std::make_shared<job::Picture>(), .progress = progress()};
  }
  void save(ByteSink&) override {}
  void load(ByteSource&) override {}

private:
  int done_ = 0, &pictures_;
};

TEST(MeasuredJob, PicturesThatTellNothingCountAsMeasuringToo) {
  int pictures = 0;
  const auto job = measure::measured(std::make_unique<SilentJob>(pictures), settings(), nullptr);
  while (!job->finished()) job->advance();
  EXPECT_GE(pictures, 2);
  EXPECT_LE(pictures, 6) << "4 % of .2 s, the first and the last";
}

TEST(MeasuredJob, NothingToMeasureIsNoHistory) {
  preset::Preset preset = settings();
  preset.measure.estimate = false;
  const auto job = noisy(preset, nullptr, 20);
  while (!job->finished()) job->advance();
  EXPECT_EQ(job->snapshot().history, nullptr);
  EXPECT_EQ(job->history(), nullptr);
  EXPECT_EQ(job->progress().step, 20);
}

TEST(MeasuredJob, StopsAtTheErrorItWasGiven) {
  for (const bool with_reference : {true, false}) {
    preset::Preset preset = settings();
    preset.stop.metric = preset::Stop::Metric::mse;
    preset.stop.error = sigma * sigma / 50; // after 50 steps
    const auto job = noisy(preset, with_reference ? truth() : nullptr, 100000);
    const job::History history = run(*job);
    EXPECT_NEAR(static_cast<double>(history.rows.back().step), 50, 5) << with_reference;
    EXPECT_LE(job::error_in(history, history.rows.back(), history.error_column), *preset.stop.error);
    EXPECT_GT(job::error_in(history, history.rows[history.rows.size() - 2], history.error_column), *preset.stop.error);
    EXPECT_EQ(job->progress().fraction, 1);
    EXPECT_EQ(history.target, preset.stop.error);
  }
}

TEST(MeasuredJob, AnErrorThatIsNotReachedEndsAsTheWorkDoes) {
  preset::Preset preset = settings();
  preset.stop.error = 1e-6;
  const auto job = noisy(preset, nullptr, 20);
  while (!job->finished()) {
    job->advance();
    EXPECT_LE(job->progress().fraction, 1);
  }
  EXPECT_EQ(job->progress().fraction, 1);
  EXPECT_EQ(job->progress().step, 20);
}

TEST(MeasuredJob, ProgressLooksAheadToTheError) {
  preset::Preset preset = settings();
  preset.stop.metric = preset::Stop::Metric::mse;
  preset.stop.error = sigma * sigma / 100;
  const auto job = noisy(preset, truth(), 100000);
  while (job->progress().step < 50) job->advance();
  EXPECT_NEAR(job->progress().fraction, 0.5, 0.06);
}

TEST(MeasuredJob, ASavedJobGoesOnWithItsHistory) {
  const auto whole = noisy(settings(), truth());
  while (whole->progress().step < 100) whole->advance();
  const std::vector<std::byte> saved = test::saved(*whole);
  const job::History before = *whole->history();

  const auto resumed = noisy(settings(), truth());
  test::load(*resumed, saved);
  EXPECT_EQ(measure::to_csv(*resumed->history()), measure::to_csv(before));
  EXPECT_EQ(resumed->progress().step, 100);
  const job::History after = run(*resumed);
  EXPECT_GT(after.rows.size(), before.rows.size());
  EXPECT_GE(after.rows.back().wall_seconds, before.rows.back().wall_seconds);
  EXPECT_GE(after.rows[before.rows.size()].seconds, before.rows.back().seconds);
  for (std::size_t cut = 0; cut < saved.size() - 100; cut += 31)
    EXPECT_THAT(error_of([&] { test::load(*noisy(settings(), truth()), std::span(saved).first(cut)); }).line(),
                HasSubstr("checkpoint: is cut"))
        << cut;
}

TEST(MeasuredJob, AResumedRunMayHaveGotAReference) {
  const auto without = noisy(settings(), nullptr);
  while (without->progress().step < 100) without->advance();
  const auto with = noisy(settings(), truth());
  test::load(*with, test::saved(*without));
  const job::History history = *with->history();
  ASSERT_FALSE(history.rows.empty());
  EXPECT_TRUE(std::isnan(job::error_in(history, history.rows.front(), "lab_mean")));
  EXPECT_EQ(job::error_in(history, history.rows.front(), "estimated_mse"),
            job::error_in(*without->history(), without->history()->rows.front(), "estimated_mse"));
}

TEST(MeasuredJob, TheReferencesOwnErrorIsBesideIt) {
  const auto job = noisy(settings(), truth(), 10);
  const job::History history = run(*job);
  ASSERT_EQ(history.noise_floor.size(), history.columns.size());
  EXPECT_EQ(history.noise_floor[0], 0.125);
  EXPECT_TRUE(std::isnan(history.noise_floor.back())) << "an estimate has none";
}

TEST(MeasuredJob, AMaskIsMeasuredOnItsOwn) {
  auto reference = std::make_shared<measure::Reference>(*truth());
  reference->mask.assign(size * size, 0);
  reference->mask[5] = 1;
  const auto job = noisy(settings(), reference, 10);
  const job::History history = run(*job);
  EXPECT_THAT(history.columns, Contains("masked_lab_mean"));
  EXPECT_NE(job::error_in(history, history.rows.back(), "masked_mse"),
            job::error_in(history, history.rows.back(), "mse"));
}

TEST(MeasuredJob, AnotherLightBeginsAHistoryWithoutTheReference) {
  preset::Preset p = settings();
  spectral::settings(p).relight = true;
  const auto job = noisy(p, truth());
  EXPECT_THAT(run(*job).columns, Contains("lab_mean"));
  ASSERT_TRUE(job->adopt(p));
  EXPECT_FALSE(job->finished()) << "the picture under the new light has not been measured";
  const job::History history = run(*job);
  EXPECT_EQ(history.rows.size(), 1u);
  EXPECT_THAT(history.columns, Each(StartsWith("estimated_"))) << "the reference is of the old light";
  EXPECT_EQ(history.error_column, "estimated_lab_mean");

  spectral::settings(p).relight = false;
  EXPECT_FALSE(job->adopt(p)) << "the job itself refuses";
  EXPECT_EQ(run(*job).rows.size(), 1u) << "and nothing has changed";
}

TEST(MeasuredJob, ARunThatStopsByItsReferenceStartsAgainUnderAnotherLight) {
  preset::Preset p = settings();
  spectral::settings(p).relight = true;
  p.stop.error = 1;
  EXPECT_FALSE(noisy(p, truth())->adopt(p));
  EXPECT_TRUE(noisy(p, nullptr)->adopt(p)) << "its estimate needs none";
}

TEST(MeasuredJob, RefusesWhatCannotBeMeasured) {
  preset::Preset preset = settings();
  preset.stop.error = 1;
  preset.measure.estimate = false;
  EXPECT_EQ(error_of([&] { noisy(preset, nullptr); }).line(),
            "p.json#/stop/error: nothing measures the error of this run in lab_mean; expected a 'reference', or "
            "'measure.estimate' true");
  preset = settings();
  preset.stop.error = 1;
  preset.stop.metric = preset::Stop::Metric::rel_mse;
  EXPECT_THAT(error_of([&] { noisy(preset, nullptr); }).line(),
              HasSubstr("in rel_mse; expected a 'reference', or a 'stop.metric'"));
  preset.stop.error.reset();
  EXPECT_EQ(noisy(preset, nullptr)->history()->error_column, "estimated_lab_mean");
}

} // namespace nephroid::measured_job_test
