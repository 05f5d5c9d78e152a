// SPDX-License-Identifier: Apache-2.0
// Passes, in each of which every stage has its turn, step by step.
#include "photons/job.h"
#include "engine/engine.h"
#include "photons/relight/layer_film.h"
#include "photons/sampled_pixels.h"
#include "photons/sight.h"
#include "photons/smoothing.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace nephroid::photons {
namespace {

/// Smoothing::Known::noise. Direct light has shadows that are broader than what is fine in a caustic.
constexpr double caustic_noise = 0.05, direct_noise = 0.01;

using Clock = std::chrono::steady_clock;

PixelLists make_pixel_lists(const compute::Context& context, const scene::Scene& scene)
{
  PixelLists lists;
  lists.count = static_cast<std::uint32_t>(scene.camera.pixels());
  lists.glass = glass_pixels(scene);
  lists.may_show_glass.assign(lists.count, false);
  for (const std::uint32_t pixel : lists.glass) lists.may_show_glass[pixel] = true;
  std::vector<std::uint32_t> pixels(lists.count);
  std::iota(pixels.begin(), pixels.end(), 0);
  pixels.insert(pixels.end(), lists.glass.begin(), lists.glass.end());
  lists.on_device = compute::Buffer(context, "pixels", pixels);
  return lists;
}

/// A stage with the seconds it has worked.
struct TimedStage {
  std::unique_ptr<Stage> stage;
  bool caustics = false; ///< its layer is "caustic"
  double seconds = 0;
};

class PhotonJob final : public Run, public job::SpectrumSource {
public:
  PhotonJob(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const RunPlan& plan,
            const compute::Context& context)
      : world_{tracing::make_world(context, scene, bvh, plan.tables, plan.defines, preset.seed), plan.tables, preset.white,
               plan.estimates_error ? 2u : 1u},
        preset_(preset), stop_seconds_(preset.stop.seconds)
  {
    const Settings& settings = plan.settings;
    if (plan.runs(smoothing_part))
      smoothing_.emplace(scene, bvh,
                         settings.smoothing == Settings::Smoothing::on ? Smoothing::Spread::everywhere : Smoothing::Spread::where_it_helps);
    shares_work_ = settings.effort == Settings::Effort::automatic && !settings.relight && plan.estimates_error;
    world_.energy = world_.zeroed("energy", OUTCOME_COUNT);
    world_.pixels = make_pixel_lists(context, scene);
    world_.emitters = compute::Buffer(context, "emitters", plan.tables.emitters);
    if (plan.runs(map_stage)) world_.map.emplace(context, world_.tables.photons_per_pass(), world_.defines);
    for (const RunPart* part : plan.parts)
      if (part->make) stages_.push_back({part->make(world_, scene, settings), std::string_view(part->layer) == "caustic"});
    if (preset.stop.passes || !(preset.stop.seconds || preset.stop.error)) passes_ = preset.stop.passes.value_or(preset::default_passes);
    for (const TimedStage& s : stages_) s.stage->warm_up();
    world_.energy.fill_zero();
    // A run is over when no stage takes part any more.
    std::int64_t most = 0;
    for (const TimedStage& s : stages_) most = std::max(most, s.stage->passes());
    if (most < preset::max_passes) passes_ = passes_ < 0 ? most : std::min(passes_, most);
  }

  bool finished() const override
  {
    if (stop_seconds_ && at_.work_seconds >= *stop_seconds_) return true;
    return at_.pass >= (passes_ >= 0 ? passes_ : preset::max_passes); // sums are exact so long
  }

  void step() override
  {
    if (smooths()) smoothing_->look();
    const auto begin = Clock::now();
    if (shares_work_ && at_.stage == 0 && !at_.part_of_pass && at_.pass >= 4 && std::has_single_bit(static_cast<std::uint64_t>(at_.pass)))
      share_work();
    TimedStage& now = stages_[at_.stage];
    const bool complete = at_.pass >= now.stage->passes() || now.stage->step(at_.pass);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    now.seconds += seconds;
    at_.work_seconds += seconds;
    at_.part_of_pass = !complete;
    if (!complete || ++at_.stage < stages_.size()) return;
    at_.stage = 0;
    ++at_.pass;
  }

  bool estimates_error() const override { return world_.halves == 2; }

  job::Progress progress() const override
  {
    job::Progress p;
    p.step = at_.pass;
    p.steps = passes_;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      p.work += static_cast<std::uint64_t>((static_cast<double>(at_.pass) + part_of(s)) *
                                           static_cast<double>(stages_[s].stage->photons_per_pass()));
    p.work_seconds = at_.work_seconds;
    const double by_seconds = stop_seconds_ ? at_.work_seconds / *stop_seconds_ : 0,
                 by_passes = passes_ > 0 ? passes_with_part() / static_cast<double>(passes_) : 0;
    p.fraction = finished() ? 1 : std::min(std::max(by_seconds, by_passes), 1.0);
    return p;
  }

  job::Snapshot snapshot() override
  {
    auto picture = std::make_shared<job::Picture>(black());
    job::Snapshot snapshot;
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      if (smooths() && stages_[s].caustics)
        tracing::layer_of(*picture, "caustic"); // its place among the layers
      else
        stages_[s].stage->develop(at_.pass, s < at_.stage, *picture);
      snapshot.phases.emplace_back(stages_[s].stage->name(), stages_[s].seconds);
    }
    if (smooths()) add_smooth_caustics(*picture);
    if (smoothing_) snapshot.phases.emplace_back("smoothing", smoothing_seconds_);
    for (const job::Layer& layer : picture->layers)
      for (std::size_t i = 0; i < layer.rgb.size(); ++i) picture->rgb[i] += layer.rgb[i];
    snapshot.picture = std::move(picture);
    snapshot.whole = at_.pass > 0;
    snapshot.progress = progress();
    const double rounds = photon_rounds() - at_.energy_from;
    Energy energy{balance_of(outcome_watts(world_.energy.read(), world_.tables.energy_scale, rounds)), {}};
    for (std::size_t s = 0; s < stages_.size(); ++s) stages_[s].stage->report(at_.pass, s < at_.stage, energy);
    add_energy(energy, snapshot);
    return snapshot;
  }

  std::shared_ptr<const job::PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override
  {
    const auto [x, y] = pixel;
    if (x < 0 || y < 0 || x >= world_.tables.camera.width || y >= world_.tables.camera.height) return nullptr;
    auto spectrum = std::make_shared<job::PixelSpectrum>();
    spectrum->pixel = pixel;
    if (!world_.relighting) {
      spectrum->why_not = "the film adds up colours, and a spectrum is not kept; spectral.relight true keeps a layer for each cluster";
      spectrum->remedy = "spectral.relight=true";
      return spectrum;
    }
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (!stages_[s].stage->add_spectrum(at_.pass, s < at_.stage, *spectrum))
        spectrum->notes.push_back(fmt::format("Without the layer \"{}\", of which no spectrum is kept.", stages_[s].stage->name()));
    if (smoothing_) spectrum->notes.push_back("The picture's caustics are smoothed, the spectrum is not.");
    return spectrum;
  }

  void save(ByteSink& sink) override
  {
    tracing::State state(sink);
    this->state(state);
  }

  void load(ByteSource& source) override
  {
    tracing::State state(source);
    this->state(state);
    world_.context.finish();
  }

  bool adopt(const preset::Preset& preset) override
  {
    if (!world_.relighting || !engine::adoptable(preset_, preset)) return false;
    change_light(*world_.relighting, world_, layer_light(preset));
    preset_ = preset;
    world_.white = preset.white;
    at_.energy_from = photon_rounds();
    return true;
  }

  void set_estimate(std::vector<float> caustics) override { estimate_ = std::move(caustics); }
  void smooth(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> estimate) override
  {
    if (smoothing_) smoothing_->spread(rgb, error_draw, {estimate, direct_noise});
  }
  void set_white(double white) override { world_.white = white; }
  std::int64_t rounds() const override { return static_cast<std::int64_t>(photon_rounds()); }

  void state(tracing::State& state) override
  {
    state.value(at_);
    state.buffer(world_.energy);
    for (TimedStage& s : stages_) {
      state.value(s.seconds);
      s.stage->state(state);
    }
  }

private:
  /// Where a run is.
  struct Position {
    std::int64_t pass = 0;     ///< passes completed
    std::size_t stage = 0;     ///< whose turn it is
    bool part_of_pass = false; ///< whether it has begun
    double work_seconds = 0;
    double energy_from = 0; ///< rounds of photons when the energy counters began
  };

  /// Deals the work of the next passes out between photons and paths through glass, by how much each has left of the picture's noise: the
  /// sum of the variances V_s of films that take the work w_s a pass, V_s w_s being as it is, is smallest where all V_s / w_s are alike.
  /// Work is counted, not timed, so that a seed has its bits. The square of a pixel's noise is over that of its light, as in the metric
  /// rel_mse.
  void share_work()
  {
    job::Picture picture = black();
    std::vector<std::vector<float>> draws{picture.error_draw}; // of the stages up to each
    for (const TimedStage& s : stages_) {
      s.stage->develop(at_.pass, false, picture);
      draws.push_back(picture.error_draw);
    }
    if (picture.error_draw.empty()) return;
    std::vector<float>& rgb = picture.rgb;
    for (const job::Layer& layer : picture.layers)
      std::transform(layer.rgb.begin(), layer.rgb.end(), rgb.begin(), rgb.begin(), std::plus());
    const auto noise_over_work = [&](std::size_t stage, double work, bool of_glass) {
      double sum = 0;
      for (std::size_t i = 0; i < rgb.size(); ++i)
        if (!of_glass || world_.pixels.may_show_glass[i / 3])
          sum += std::pow(static_cast<double>(draws[stage + 1][i]) - draws[stage][i], 2) / (0.01 + static_cast<double>(rgb[i]) * rgb[i]);
      return sum / work;
    };
    double of_photons = 0;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (const auto work = static_cast<double>(stages_[s].stage->photons_per_pass()); stages_[s].caustics && work > 0)
        of_photons = noise_over_work(s, work, false);
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (const double work = stages_[s].stage->glass_work(); work > 0 && of_photons > 0)
        stages_[s].stage->share_work(std::sqrt(noise_over_work(s, work, true) / of_photons));
  }

  /// A black picture without layers, with room for a draw of its error where films have halves.
  job::Picture black() const
  {
    job::Picture picture;
    picture.width = world_.tables.camera.width;
    picture.height = world_.tables.camera.height;
    picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0.0f);
    if (!stages_.empty() && world_.halves == 2) picture.error_draw = picture.rgb;
    return picture;
  }

  /// With both halves whole: what a few photons of one tell of the noise makes blotches.
  bool smooths() const
  {
    for (std::size_t s = 0; smoothing_ && s < stages_.size(); ++s)
      if (stages_[s].caustics && has_halves(s)) return true;
    return false;
  }

  bool has_halves(std::size_t stage) const { return stages_[stage].stage->has_halves(at_.pass, stage < at_.stage); }

  /// Adds the layer "caustic", spread, and its error.
  void add_smooth_caustics(job::Picture& picture)
  {
    job::Picture caustics = black();
    bool lacks_maps = false; // as they come after all rounds of a pass; until then glass shows what is known otherwise
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (stages_[s].caustics && has_halves(s))
        stages_[s].stage->develop(at_.pass, s < at_.stage, caustics);
      else
        lacks_maps = lacks_maps || stages_[s].caustics;
    std::vector<float>& rgb = tracing::layer_of(caustics, "caustic").rgb;
    for (std::size_t i = 0; lacks_maps && i < estimate_.size(); ++i)
      if (world_.pixels.may_show_glass[i / 3]) rgb[i] = estimate_[i], caustics.error_draw[i] = 0;
    const auto begin = Clock::now();
    smoothing_->spread(rgb, caustics.error_draw, {estimate_, caustic_noise});
    smoothing_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
    tracing::layer_of(picture, "caustic").rgb = std::move(rgb);
    if (caustics.error_draw.empty()) picture.error_draw.clear();
    for (std::size_t i = 0; i < picture.error_draw.size(); ++i) picture.error_draw[i] += caustics.error_draw[i];
  }

  /// How much of the pass in hand a stage has done.
  double part_of(std::size_t stage) const { return stage < at_.stage ? 1 : stage > at_.stage ? 0 : stages_[stage].stage->part(); }

  /// Passes done with the part of the one in hand, in which every stage counts as much.
  double passes_with_part() const
  {
    double part = 0, count = 0;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (at_.pass < stages_[s].stage->passes()) part += part_of(s), ++count;
    return static_cast<double>(at_.pass) + (count > 0 ? part / count : 0);
  }

  /// Of those that DeviceWorld::energy is about, with the part of the one in hand.
  double photon_rounds() const
  {
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (stages_[s].stage->counts_energy()) return (static_cast<double>(at_.pass) + part_of(s)) * world_.tables.rounds;
    return 0;
  }

  DeviceWorld world_;        ///< the stages use it
  preset::Preset preset_;    ///< with the lights as they are now
  bool shares_work_ = false; ///< whether time is dealt out by what it gains
  std::optional<Smoothing> smoothing_;
  std::vector<float> estimate_;  ///< Run::set_estimate
  double smoothing_seconds_ = 0; ///< of all pictures since the program began; no work of the run's
  std::optional<double> stop_seconds_;
  std::int64_t passes_ = -1; ///< -1: until stop_seconds_, or until whoever steps it has enough
  std::vector<TimedStage> stages_;
  Position at_;
};

} // namespace

std::unique_ptr<Run> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const RunPlan& plan,
                              const compute::Context& context)
{
  return std::make_unique<PhotonJob>(preset, scene, bvh, plan, context);
}

} // namespace nephroid::photons
