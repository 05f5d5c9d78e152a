// SPDX-License-Identifier: Apache-2.0
#include "gradient.h"

#include "preset/settings_type.h"
#include "tests/support/standard.h"

namespace nephroid::gradient {

void describe(preset::Fields& v, Settings& s) {
  v.about("Gradient", "A picture of a gradient.");
  v.field("level", "Brightness at the right edge.", s.level, {.bounds = preset::within(0, 10)});
  v.field("noise", "Standard deviation of one sample.", s.noise, {.bounds = preset::within(0, 1)});
  v.field("samples_per_pass", "Samples of a pixel in one pass.", s.samples_per_pass,
          {.bounds = preset::within(1, 1000)});
}

namespace {

const Settings& settings(const preset::Preset& preset) { return preset.settings.as<Settings>(); }

void check(const preset::Preset& preset, const preset::Where& where) {
  if (settings(preset).level == 0 && settings(preset).noise == 0)
    throw bad_input(where("/gradient"), "is black", "expected a level or noise above 0");
}

struct GradientPlan : plan::Plan {
  Settings settings;
};

/// A pass adds a mean of samples to every pixel, to one half of the sums after the other.
class GradientJob final : public job::Job {
public:
  GradientJob(const preset::Preset& preset, const GradientPlan& plan)
      : settings_(plan.settings), seed_(preset.seed), width_(preset.scene.camera.resolution[0]),
        height_(preset.scene.camera.resolution[1]), passes_(preset.stop.passes.value_or(preset::default_passes)),
        estimates_(plan.estimates_error) {
    for (auto& half : sums_) half.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  }

  void advance() override {
    std::mt19937_64 random(seed_ * 1000003 + static_cast<std::uint64_t>(done_));
    const double sigma = settings_.noise / std::sqrt(settings_.samples_per_pass);
    std::normal_distribution<double> noise;
    auto& half = sums_[static_cast<std::size_t>(done_ % 2)];
    for (std::size_t i = 0; i < half.size(); ++i) half[i] += truth(i) + sigma * noise(random);
    ++done_;
  }
  bool finished() const override { return done_ >= passes_; }
  bool estimates_error() const override { return estimates_; }

  job::Progress progress() const override {
    return {.fraction = static_cast<double>(done_) / passes_,
            .step = done_,
            .steps = passes_,
            .work = static_cast<std::uint64_t>(done_) * static_cast<std::uint64_t>(settings_.samples_per_pass) *
                    sums_[0].size(),
            .work_seconds = 1e-3 * static_cast<double>(done_),
            .units = {.step = "sweep", .steps = "sweeps", .work = "sample", .works = "samples"}};
  }

  job::Snapshot snapshot() override {
    auto picture = std::make_shared<job::Picture>();
    picture->width = width_;
    picture->height = height_;
    const double a = static_cast<double>((done_ + 1) / 2), b = static_cast<double>(done_ / 2);
    for (std::size_t i = 0; i < sums_[0].size(); ++i)
      for (int channel = 0; channel < 3; ++channel) {
        picture->rgb.push_back(static_cast<float>(done_ > 0 ? (sums_[0][i] + sums_[1][i]) / (a + b) : 0));
        if (estimates_ && b > 0)
          picture->error_draw.push_back(
              static_cast<float>((sums_[0][i] / a - sums_[1][i] / b) * std::sqrt(a * b) / (a + b)));
      }
    picture->layers.push_back({"gradient", picture->rgb});
    job::Snapshot snapshot{.picture = picture};
    snapshot.pictures.push_back({"upside_down", picture});
    snapshot.progress = progress();
    snapshot.scalars.push_back({"gradient", "level", settings_.level});
    snapshot.scalars.push_back({"gradient", "adopted", static_cast<double>(adopted_)});
    snapshot.curves.push_back(
        {"settling",
         {"sweep", "standard_deviation"},
         {{1, settings_.noise}, {static_cast<double>(done_), settings_.noise / std::sqrt(a + b)}}});
    const std::string size = fmt::format("{} {}\n", width_, height_);
    snapshot.files.push_back({"gradient.txt", [size](ByteSink& to) { to.write(std::as_bytes(std::span(size))); }});
    return snapshot;
  }

  /// Begins anew.
  bool adopt(const preset::Preset& preset) override {
    settings_ = settings(preset);
    for (auto& half : sums_) std::fill(half.begin(), half.end(), 0);
    done_ = 0;
    ++adopted_;
    return true;
  }

  void save(ByteSink& to) override {
    to.value(done_);
    for (const auto& half : sums_) to.write(std::as_bytes(std::span(half)));
  }
  void load(ByteSource& from) override {
    from.value(done_);
    for (auto& half : sums_) from.read(std::as_writable_bytes(std::span(half)));
  }

private:
  double truth(std::size_t pixel) const {
    return settings_.level * (static_cast<double>(pixel % static_cast<std::size_t>(width_)) + 0.5) / width_;
  }

  Settings settings_;
  std::uint64_t seed_;
  int width_, height_;
  std::int64_t passes_, done_ = 0;
  bool estimates_;
  int adopted_ = 0;                         ///< presets after the first
  std::array<std::vector<double>, 2> sums_; ///< [half][pixel]
};

const preset::SettingsType& settings_type() {
  static const preset::SettingsType type = preset::settings_type<Settings>("gradient", "A gradient, for tests.", check);
  return type;
}

std::unique_ptr<plan::Plan> make_plan(const preset::Preset& preset, const scene::Scene&, const scene::Bvh&) {
  auto plan = std::make_unique<GradientPlan>();
  plan->engine = "gradient";
  plan->settings = settings(preset);
  plan->layers = 1;
  plan->estimates_error = preset.measure.estimate;
  plan->decisions.push_back({"gradient", true, "every pixel by its column"});
  plan->decisions.push_back(
      {"noise", plan->settings.noise > 0, plan->settings.noise > 0 ? "as asked for" : "gradient.noise is 0"});
  return plan;
}

preset::Settings reference(const preset::Preset& preset, int) {
  preset::Settings made = preset.reference->settings.value_or(preset.settings);
  if (!preset.reference->settings) made.as<Settings>().noise = 0;
  return made;
}

/// The rightmost column's mean against its closed form, (width - 1/2) / width of the level, in standard errors.
check::Result rises(const compute::Context&, std::uint64_t seed) {
  preset::Preset preset;
  preset.settings = preset::Settings(settings_type());
  preset.seed = seed;
  preset.scene.camera.resolution = {8, 64};
  preset.stop.passes = 4;
  GradientPlan plan;
  plan.settings = settings(preset);
  GradientJob job(preset, plan);
  while (!job.finished()) job.advance();
  const job::Snapshot snapshot = job.snapshot();
  double mean = 0;
  for (std::size_t row = 0; row < 64; ++row) mean += snapshot.picture->rgb[3 * (8 * row + 7)] / 64.0;
  const double error = plan.settings.noise / std::sqrt(64.0 * 4 * plan.settings.samples_per_pass);
  return {{}, (mean - 7.5 / 8) / error, 5.5, "sigma", "the rightmost column against its closed form"};
}

bool only_level(const preset::Preset& before, const preset::Preset& now) {
  preset::Preset same = now;
  same.settings.as<Settings>().level = settings(before).level;
  return same == before;
}

std::vector<check::Check> checks() { return {{"gradient: it rises", rises}}; }

} // namespace

constinit const engine::Engine engine{
    .settings = settings_type,
    .state_version = 1,
    .plan = make_plan,
    .job = [](const preset::Preset& preset, const scene::Scene&, const scene::Bvh&, const plan::Plan& plan,
              const mpi::RankContext&) -> std::unique_ptr<job::Job> {
      return std::make_unique<GradientJob>(preset, dynamic_cast<const GradientPlan&>(plan));
    },
    .reference = reference,
    .checks = checks,
    .adoptable = only_level};

} // namespace nephroid::gradient
