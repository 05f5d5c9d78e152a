// SPDX-License-Identifier: Apache-2.0
// Passes, in each of which every stage has its turn, step by step.
#include "photons/job.h"
#include "engine/engine.h"
#include "photons/block_smoothing.h"
#include "photons/relight/layer_film.h"
#include "photons/pixel_surfaces.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace nephroid::photons {
namespace {

/// Smoothing::BiasedEstimate::noise. Direct light has shadows that are broader than what is fine in a caustic.
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
  const char* layer = "";
  double seconds = 0;
  bool caustics() const { return std::string_view(layer) == "caustic"; }
};

class PassesJob final : public PhotonJob, public job::SpectrumSource {
public:
  PassesJob(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const RunPlan& plan,
            const mpi::RankContext& context)
      : world_{tracing::make_world(context, scene, bvh, plan.tables, plan.defines, preset.seed), plan.tables, preset.white,
               plan.estimates_error ? 2u : 1u},
        preset_(preset), stop_seconds_(preset.stop.seconds)
  {
    const Settings& settings = plan.settings;
    if (plan.has_previews && !settings.relight && settings.estimator != Settings::Estimator::sppm)
      preview_edges_ = preview_edges(scene.camera.width, scene.camera.height);
    smooths_seen_ = plan.has_previews && settings.smoothing == Settings::Smoothing::automatic;
    if (plan.runs(smoothing_part))
      smoothing_.emplace(scene, bvh,
                         settings.smoothing == Settings::Smoothing::on ? Smoothing::Spread::everywhere : Smoothing::Spread::where_it_helps,
                         preview_edges_.empty() ? 1 : preview_edges_[0]);
    shares_work_ = settings.effort == Settings::Effort::automatic && !settings.relight && plan.estimates_error;
    world_.energy = world_.zeroed("energy", OUTCOME_COUNT);
    world_.pixels = make_pixel_lists(context, scene);
    world_.emitters = compute::Buffer(context, "emitters", plan.tables.emitters);
    if (plan.runs(map_stage)) world_.map.emplace(context, world_.tables.photons_per_pass(), world_.defines);
    for (const RunPart* part : plan.parts)
      if (part->make) stages_.push_back({part->make(world_, scene, settings), part->layer});
    if (preset.stop.passes || !(preset.stop.seconds || preset.stop.error)) passes_ = preset.stop.passes.value_or(preset::default_passes);
    if (context.communicator().broadcast(context.is_cold())) { // rank 0 may have rendered a reference before
      for (const TimedStage& s : stages_) s.stage->warm_up(context.communicator());
      world_.energy.fill_zero();
      world_.context.finish(); // a run that never comes to work must not end while kernels run
      context.set_warm();
    }
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

  void advance() override
  {
    if (previews_ < preview_edges_.size()) return advance_preview();
    if (at_.pass == 1 && at_.stage == 0 && !at_.fraction_of_pass && smooths_seen_ && smoothing_)
      timed([&] { smoothing_->pixels().find_surfaces(); }); // before a picture waits for it
    const auto begin = Clock::now();
    if (shares_work_ && at_.stage == 0 && !at_.fraction_of_pass && at_.pass >= 2 && std::has_single_bit(static_cast<std::uint64_t>(at_.pass)))
      share_work();
    TimedStage& now = stages_[at_.stage];
    const bool complete = at_.pass >= now.stage->passes() || now.stage->advance(at_.pass);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    now.seconds += seconds;
    at_.work_seconds += seconds;
    at_.fraction_of_pass = !complete;
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
      p.work += static_cast<std::uint64_t>((static_cast<double>(at_.pass) + fraction_of(s)) *
                                           static_cast<double>(stages_[s].stage->photons_per_pass()));
    p.work_seconds = at_.work_seconds;
    p.whole = at_.pass > 0 || previews_ > 0;
    const double by_seconds = stop_seconds_ ? at_.work_seconds / *stop_seconds_ : 0,
                 by_passes = passes_ > 0 ? passes_with_fraction() / static_cast<double>(passes_) : 0;
    p.fraction = finished() ? 1 : std::min(std::max(by_seconds, by_passes), 1.0);
    return p;
  }

  job::Snapshot snapshot() override
  {
    auto picture = std::make_shared<job::Picture>(black());
    job::Snapshot snapshot;
    bool has_caustics = false;
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      snapshot.phases.emplace_back(stages_[s].stage->name(), stages_[s].seconds);
      if (stages_[s].caustics() && std::exchange(has_caustics, true)) continue;
      add(stages_[s].layer, stages_[s].caustics() ? caustics() : seen(s), *picture);
    }
    if (smoothing_) snapshot.phases.emplace_back("smoothing", smoothing_seconds_);
    snapshot.picture = std::move(picture);
    snapshot.progress = progress();
    const double batches = photon_batches() - at_.energy_from;
    Energy energy{balance_of(outcome_watts(world_.context.all_reduced_sum(world_.energy), world_.tables.energy_scale, batches)), {}};
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
    tracing::State state(sink, world_.context.communicator());
    this->state(state);
  }

  void load(ByteSource& source) override
  {
    tracing::State state(source, world_.context.communicator());
    this->state(state);
    world_.context.finish();
  }

  bool adopt(const preset::Preset& preset) override
  {
    if (!world_.relighting || !engine::adoptable(preset_, preset)) return false;
    change_light(*world_.relighting, world_, layer_light(preset));
    preset_ = preset;
    world_.white = preset.white;
    at_.energy_from = photon_batches();
    return true;
  }

  void set_estimate(std::vector<float> caustics) override { estimate_ = std::move(caustics); }
  void smooth(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> estimate) override
  {
    if (smoothing_) smoothing_->pixels().spread(rgb, error_draw, {estimate, direct_noise});
  }
  void set_white(double white) override { world_.white = white; }
  std::int64_t batches() const override { return static_cast<std::int64_t>(photon_batches()); }
  std::int64_t batches_per_pass() const override { return world_.tables.batches; }

  void state(tracing::State& state) override
  {
    state.value(at_);
    state.value(previews_);
    if (state.is_read() && previews_ > 0) set_preview();
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
    bool fraction_of_pass = false; ///< whether it has begun
    double work_seconds = 0;
    double energy_from = 0; ///< batches of photons when the energy counters began
  };

  /// Allocates the work of the next passes between photons and paths from the eye, by how much each lowers the picture's noise: the sum of
  /// the variances V_s of what takes the work w_s a pass, V_s w_s being as it is, is smallest where all V_s / w_s are alike. Work is
  /// counted, not timed, so that a seed has its bits. The square of a pixel's noise is over that of its light, as in the metric rel_mse.
  void share_work()
  {
    job::Picture picture = black(), caustics = picture;
    std::vector<std::vector<float>> draws; // of each stage
    std::uint64_t photons = 0;
    for (const TimedStage& s : stages_) {
      job::Picture& into = s.caustics() ? caustics : picture;
      std::vector<float> before = into.error_draw;
      s.stage->develop(at_.pass, false, into);
      if (into.error_draw.empty()) return;
      std::transform(into.error_draw.begin(), into.error_draw.end(), before.begin(), before.begin(), std::minus());
      draws.push_back(std::move(before));
      if (s.caustics()) photons += s.stage->photons_per_pass();
    }
    if (photons == 0) return;
    LayerEstimate splatted{std::move(tracing::layer_of(caustics, "caustic").rgb), std::move(caustics.error_draw)};
    if (smoothing_) smoothing_->spread(splatted, {});
    tracing::layer_of(picture, "caustic").rgb = std::move(splatted.rgb);
    for (const job::Layer& layer : picture.layers)
      std::transform(layer.rgb.begin(), layer.rgb.end(), picture.rgb.begin(), picture.rgb.begin(), std::plus());

    Noise caustic_noise_now{splatted.draw, picture.rgb, at_.pass};
    double noise = 0; // of photons: what glass shows are also paths
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
      if (!world_.pixels.may_show_glass[i / 3]) noise += caustic_noise_now.of(i);
    if (noise == 0) return;
    caustic_noise_now.photon_gain = noise / (static_cast<double>(at_.pass) * static_cast<double>(photons));
    for (std::size_t s = 0; s < stages_.size(); ++s)
      stages_[s].stage->share_work(stages_[s].caustics() ? caustic_noise_now : Noise{draws[s], picture.rgb, at_.pass, caustic_noise_now.photon_gain});
  }

  /// A black picture without layers, with room for a draw of its error where films have halves.
  job::Picture black() const { return black(blocks_of(1)); }
  job::Picture black(const Blocks& blocks) const
  {
    job::Picture picture;
    picture.width = blocks.across();
    picture.height = blocks.down();
    picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0.0f);
    if (!stages_.empty() && world_.halves == 2) picture.error_draw = picture.rgb;
    return picture;
  }

  bool has_halves(std::size_t stage) const { return stages_[stage].stage->has_halves(at_.pass, stage < at_.stage); }

  /// The next of the previews, whole: nobody wants to see a part of it.
  void advance_preview()
  {
    ++previews_;
    set_preview();
    for (TimedStage& s : stages_) {
      const auto begin = Clock::now();
      while (!s.stage->advance_preview()) {
      }
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      s.seconds += seconds;
      at_.work_seconds += seconds;
    }
  }

  /// Of so many looks.
  void set_preview()
  {
    constexpr unsigned batches_a_preview = 2;
    const Blocks blocks = blocks_of(preview_edges_[previews_ - 1]);
    std::vector<bool> may_show_glass(static_cast<std::size_t>(blocks.across()) * static_cast<std::size_t>(blocks.down()));
    for (const std::uint32_t pixel : world_.pixels.glass) may_show_glass[blocks.block_of(pixel)] = true;
    std::vector<std::uint32_t> glass;
    for (std::size_t block = 0; block < may_show_glass.size(); ++block)
      if (may_show_glass[block]) glass.push_back(static_cast<std::uint32_t>(block));
    world_.preview = {blocks, std::min(batches_a_preview * static_cast<unsigned>(previews_), world_.tables.batches - 1),
                    compute::Buffer(world_.context, "blocks of glass", glass)};
  }

  /// Of a preview: as a stage has seen it, smoothed, of [pixel][3].
  LayerEstimate preview_layer(std::size_t stage)
  {
    const Blocks& first = world_.preview.blocks;
    job::Picture picture = black(first);
    stages_[stage].stage->develop_preview(picture);
    if (picture.layers.empty()) return {};
    LayerEstimate blocks{std::move(picture.layers[0].rgb), std::move(picture.error_draw)}, pixels;
    if (!smoothing_) return between(first, blocks);
    timed([&] { pixels = smoothing_->pixels_of(first, std::move(blocks)); });
    return pixels;
  }

  /// The layer of a stage of no caustics.
  LayerEstimate seen(std::size_t stage)
  {
    Stage& of = *stages_[stage].stage;
    const bool whole = at_.pass > 0 || stage < at_.stage;
    const bool wants_preview = previews_ > 0 && !has_halves(stage) && (!whole || smoothing_);
    LayerEstimate first = wants_preview ? preview_layer(stage) : LayerEstimate();
    if (!first.rgb.empty() && !whole) return first;
    job::Picture picture = black();
    of.develop(at_.pass, stage < at_.stage, picture);
    LayerEstimate layer{std::move(picture.layers[0].rgb), std::move(picture.error_draw)};
    if (!first.rgb.empty()) { // a single sample of each pixel: all there is to see of a wall, and little of glass
      for (std::size_t i = 0; i < layer.rgb.size(); ++i)
        if (world_.pixels.may_show_glass[i / 3]) layer.rgb[i] = first.rgb[i];
      layer.draw = std::move(first.draw);
    } else if (smoothing_ && smooths_seen_ && has_halves(stage)) {
      timed([&] { smoothing_->pixels().spread(layer.rgb, layer.draw); });
    } else if (wants_preview) { // photons of a stage that has no preview of its own
      layer = between(world_.preview.blocks, means(world_.preview.blocks, layer));
    }
    return layer;
  }

  /// The layer of all stages of caustics.
  LayerEstimate caustics()
  {
    const auto is_shown = [&](std::size_t s) { return stages_[s].caustics() && (!smoothing_ || has_halves(s)); };
    LayerEstimate first; // of photon maps, which come after all photons of a pass; until then glass shows what is known otherwise
    bool lacks_maps = false;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (stages_[s].caustics() && !is_shown(s)) {
        lacks_maps = true;
        if (previews_ > 0) first = preview_layer(s);
      }
    job::Picture picture = black();
    tracing::layer_of(picture, "caustic");
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (is_shown(s)) stages_[s].stage->develop(at_.pass, s < at_.stage, picture);
    LayerEstimate layer{std::move(picture.layers[0].rgb), std::move(picture.error_draw)};
    for (std::size_t i = 0; lacks_maps && i < estimate_.size(); ++i)
      if (world_.pixels.may_show_glass[i / 3]) layer.rgb[i] = estimate_[i], layer.draw[i] = 0;
    if (smoothing_ && !layer.draw.empty()) timed([&] { smoothing_->spread(layer, {estimate_, caustic_noise}); });
    if (!first.rgb.empty()) std::ranges::transform(layer.rgb, first.rgb, layer.rgb.begin(), std::plus());
    if (!first.draw.empty() && !layer.draw.empty()) std::ranges::transform(layer.draw, first.draw, layer.draw.begin(), std::plus());
    return layer;
  }

  Blocks blocks_of(int edge) const { return {world_.tables.camera.width, world_.tables.camera.height, edge}; }

  static void add(const char* name, LayerEstimate layer, job::Picture& picture)
  {
    std::ranges::transform(picture.rgb, layer.rgb, picture.rgb.begin(), std::plus());
    if (layer.draw.empty()) picture.error_draw.clear();
    if (!picture.error_draw.empty()) std::ranges::transform(picture.error_draw, layer.draw, picture.error_draw.begin(), std::plus());
    picture.layers.push_back({name, std::move(layer.rgb)});
  }

  template <class Work>
  void timed(const Work& work)
  {
    const auto begin = Clock::now();
    work();
    smoothing_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  /// How much of the pass in hand a stage has done.
  double fraction_of(std::size_t stage) const { return stage < at_.stage ? 1 : stage > at_.stage ? 0 : stages_[stage].stage->fraction_done(); }

  /// Passes done with the part of the one in hand, in which every stage counts as much.
  double passes_with_fraction() const
  {
    double part = 0, count = 0;
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (at_.pass < stages_[s].stage->passes()) part += fraction_of(s), ++count;
    return static_cast<double>(at_.pass) + (count > 0 ? part / count : 0);
  }

  /// Of those that DeviceWorld::energy is about, with the part of the one in hand.
  double photon_batches() const
  {
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (stages_[s].stage->counts_energy()) return (static_cast<double>(at_.pass) + fraction_of(s)) * world_.tables.batches;
    return 0;
  }

  DeviceWorld world_;            ///< the stages use it
  preset::Preset preset_;        ///< with the lights as they are now
  std::vector<int> preview_edges_; ///< of the blocks of previews
  std::size_t previews_ = 0;        ///< previews so far
  bool smooths_seen_ = false;    ///< what paths from the eye see of lights, as well as caustics
  bool shares_work_ = false;     ///< whether time is allocated by what it gains
  std::optional<BlockSmoothing> smoothing_;
  std::vector<float> estimate_;  ///< PhotonJob::set_estimate
  double smoothing_seconds_ = 0; ///< of all pictures since the program began; no work of the run's
  std::optional<double> stop_seconds_;
  std::int64_t passes_ = -1; ///< -1: until stop_seconds_, or until whoever steps it has enough
  std::vector<TimedStage> stages_;
  Position at_;
};

} // namespace

std::unique_ptr<PhotonJob> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const RunPlan& plan,
                              const mpi::RankContext& context)
{
  return std::make_unique<PassesJob>(preset, scene, bvh, plan, context);
}

} // namespace nephroid::photons
