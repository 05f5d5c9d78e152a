// SPDX-License-Identifier: Apache-2.0
#include "run/metered_job.h"

#include "preset/meters.h"
#include "run/meters.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace nephroid::run {
namespace {

using Clock = std::chrono::steady_clock;

class MeteredJob final : public job::Job, public job::SpectrumSource {
public:
  MeteredJob(std::unique_ptr<job::Job> job, const Prepared& prepared, const mpi::RankContext& context, MeterShare share)
      : job_(std::move(job)), prepared_(prepared), context_(context), share_(std::move(share)) {}

  bool finished() const override { return job_->finished() && metering_ && metering_->all_read(); }

  void advance() override {
    if (!is_meters_turn()) return job_->advance();
    const auto begin = Clock::now();
    if (!metering_)
      begin_metering();
    else if (metering_->advance())
      readings_ = std::make_shared<const meters::Readings>(metering_->readings());
    meter_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  job::Progress progress() const override {
    job::Progress progress = job_->progress();
    if (job_->finished() && !finished()) progress.fraction = 0.999;
    return progress;
  }

  job::Snapshot snapshot() override {
    job::Snapshot snapshot = job_->snapshot();
    snapshot.progress = progress();
    snapshot.phases.emplace_back("meters", meter_seconds_);
    snapshot.meters = readings_;
    if (readings_)
      for (const meters::Shown& shown : readings_->meters) add(shown, snapshot);
    return snapshot;
  }

  void begin_with(const job::Beginning& beginning) override { job_->begin_with(beginning); }
  bool estimates_error() const override { return job_->estimates_error(); }
  std::shared_ptr<const job::History> history() const override { return job_->history(); }
  std::shared_ptr<const job::PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override {
    auto* source = dynamic_cast<job::SpectrumSource*>(job_.get());
    return source ? source->spectrum(pixel) : nullptr;
  }

  /// The meters begin anew in the other light. What a camera sees is none of theirs.
  bool adopt(const preset::Preset& preset) override {
    if (!job_->adopt(preset)) return false;
    seconds_before_ = job_->progress().work_seconds; // an engine may count from 0 again
    meter_seconds_ = 0;
    preset::Preset measured = adopted_.value_or(prepared_.preset);
    measured.scene.camera = preset.scene.camera;
    if (measured == preset) return true;
    metering_.reset();
    readings_.reset();
    adopted_ = preset;
    return true;
  }

  void save(ByteSink& to) override {
    job_->save(to);
    tracing::Archive archive(to, context_.communicator());
    this->serialize(archive);
  }
  void load(ByteSource& from) override {
    job_->load(from);
    tracing::Archive archive(from, context_.communicator());
    this->serialize(archive);
  }

private:
  /// Rank 0's clock decides.
  bool is_meters_turn() const {
    const job::Progress progress = job_->progress();
    const double share = share_ ? share_->load() : usual_meter_share;
    const bool is_turn =
        job_->finished() ||
        (progress.step > 0 && meter_seconds_ * (1 - share) < share * (progress.work_seconds - seconds_before_));
    return context_.communicator().broadcast(is_turn);
  }

  void begin_metering() {
    if (adopted_) prepared_ = prepare(*adopted_, &prepared_);
    adopted_.reset();
    metering_ = std::make_unique<Metering>(prepared_, context_);
  }

  void serialize(tracing::Archive& archive) {
    bool has_begun = metering_ != nullptr;
    archive.value(has_begun);
    archive.value(meter_seconds_);
    if (!has_begun) return;
    if (!metering_) begin_metering();
    metering_->serialize(archive);
  }

  /// As figures for run.json and as a curve for the report.
  static void add(const meters::Shown& shown, job::Snapshot& snapshot) {
    if (!shown.reading) return;
    const std::string stem = preset::file_stem(shown.meter), group = "meters/" + stem;
    const meters::LayerReading& all = shown.reading->all();
    for (const meters::Quantity quantity : meters::quantities) {
      const meters::Numbers& numbers = all.numbers(quantity);
      const std::string unit = quantity == meters::Quantity::irradiance ? "w" : "lm";
      const std::string per = shown.surface->is_goniometer() ? "_sr" : "_m2";
      for (const auto& [name, interval] : {std::pair("mean_", &numbers.mean), std::pair("peak_", &numbers.peak)}) {
        const std::string full = fmt::format("{}{}{}", name, unit, per);
        snapshot.scalars.push_back({group, full, interval->value});
        snapshot.scalars.push_back({group, full + "_half_width", interval->half()});
      }
    }
    job::Curve curve{
        "meter-" + stem, {"seconds", "mean", "mean low", "mean high", "peak", "peak low", "peak high"}, {}};
    for (const meters::HistoryRow& row : shown.history)
      curve.rows.push_back(
          {row.seconds, row.mean.value, row.mean.low, row.mean.high, row.peak.value, row.peak.low, row.peak.high});
    snapshot.curves.push_back(std::move(curve));
  }

  std::unique_ptr<job::Job> job_;
  Prepared prepared_;
  mpi::RankContext context_;
  MeterShare share_;
  std::optional<preset::Preset> adopted_; ///< since the metering was made, which is none then
  std::unique_ptr<Metering> metering_;    ///< null before its first turn
  std::shared_ptr<const meters::Readings> readings_;
  double meter_seconds_ = 0;
  double seconds_before_ = 0; ///< of the job's work, before the light that it has adopted
};

} // namespace

std::unique_ptr<job::Job> metered(std::unique_ptr<job::Job> job, const Prepared& prepared,
                                  const mpi::RankContext& context, MeterShare share) {
  if (prepared.preset.scene.meters.empty()) return job;
  check_meters(prepared);
  return std::make_unique<MeteredJob>(std::move(job), prepared, context, std::move(share));
}

} // namespace nephroid::run
