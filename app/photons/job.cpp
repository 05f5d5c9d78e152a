// SPDX-License-Identifier: Apache-2.0
// A run: previews first, then passes of all stages; between passes their work is divided anew.
#include "photons/job.h"

#include "engine/engine.h"
#include "photons/development.h"
#include "photons/passes.h"
#include "photons/pixel_surfaces.h"
#include "photons/relight/layer_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

namespace nephroid::photons {
namespace {

std::vector<int> edges_of_previews(const RunPlan& plan, const scene::Scene& scene) {
  if (plan.settings.relight || plan.settings.estimator == Settings::Estimator::sppm) return {};
  return preview_edges(scene.camera.width, scene.camera.height);
}

/// As Smoothing::FindTexture.
std::vector<float> seen_texture(StageContext& world) {
  constexpr float least = 0.02f; // what a black texel reflects is dark, not without light
  const compute::Buffer<float> colours(world.context, "textures in pixels", std::size_t{3} * world.pixels.count);
  compute::Kernel kernel =
      compute::Program(world.context, "photons/seen_texture.cl", world.eye_defines()).kernel("seen_texture");
  const auto count = static_cast<std::uint32_t>(world.pixels.count);
  world.run(kernel, count, 64, {{"camera", world.tables.camera}, {"count", count}, {"colours", colours}});
  std::vector<float> seen = colours.read();
  for (float& value : seen) value = std::max(value, least);
  return seen;
}

std::optional<BlockSmoothing> make_smoothing(StageContext& world, const RunPlan& plan, const scene::Scene& scene,
                                             const scene::Bvh& bvh) {
  if (!plan.runs(smoothing_part)) return std::nullopt;
  const std::vector<int> edges = edges_of_previews(plan, scene);
  const bool everywhere = plan.settings.smoothing == Settings::Smoothing::on;
  return BlockSmoothing(scene, bvh, everywhere ? Smoothing::Spread::everywhere : Smoothing::Spread::where_it_helps,
                        edges.empty() ? 1 : edges[0],
                        any_material(scene, scatter::is_textured) ? [&world] { return seen_texture(world); }
                                                                  : Smoothing::FindTexture());
}

class PassesJob final : public PhotonJob, public job::SpectrumSource {
public:
  PassesJob(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const RunPlan& plan,
            const mpi::RankContext& context)
      : world_(make_stage_context(preset, scene, bvh, plan, context)), preset_(preset),
        why_no_layers_(plan.why_no_layers), passes_(plan.tables.batches),
        preview_(world_, edges_of_previews(plan, scene)),
        development_(world_, passes_, preview_, make_smoothing(world_, plan, scene, bvh), !plan.runs(tile_stage),
                     plan.settings.smoothing == Settings::Smoothing::automatic),
        shares_work_(plan.settings.effort == Settings::Effort::automatic && !plan.settings.relight &&
                     plan.estimates_error) {
    if (plan.runs(receiver_stage)) world_.receivers.emplace(make_receiver_light(world_, scene));
    for (const RunPart* part : plan.parts)
      if (part->make) passes_.add(part->make(world_, scene, plan.settings), part->layer);
    if (preset.stop.passes || !(preset.stop.seconds || preset.stop.error))
      most_passes_ = preset.stop.passes.value_or(preset::default_passes);
    warm_up(world_, passes_.stages());
    if (const std::int64_t most = passes_.most(); most < preset::max_passes)
      most_passes_ = most_passes_ < 0 ? most : std::min(most_passes_, most);
  }

  bool finished() const override {
    if (preset_.stop.seconds && passes_.work_seconds() >= *preset_.stop.seconds) return true;
    return passes_.complete() >= (most_passes_ >= 0 ? most_passes_ : preset::max_passes); // sums are exact for so long
  }

  void advance() override {
    if (preview_.has_more()) return preview_.next(passes_);
    if (passes_.is_between_passes()) begin_pass();
    passes_.advance();
  }

  bool estimates_error() const override { return world_.halves == 2; }

  job::Progress progress() const override {
    job::Progress p;
    p.step = passes_.complete();
    p.steps = most_passes_;
    p.work = passes_.photons();
    p.work_seconds = passes_.work_seconds();
    p.whole = p.step > 0 || preview_.has_picture();
    const double by_seconds = preset_.stop.seconds ? p.work_seconds / *preset_.stop.seconds : 0,
                 by_passes = most_passes_ > 0 ? passes_.with_fraction() / static_cast<double>(most_passes_) : 0;
    p.fraction = finished() ? 1 : std::min(std::max(by_seconds, by_passes), 1.0);
    return p;
  }

  job::Snapshot snapshot() override {
    job::Snapshot snapshot;
    snapshot.picture = std::make_shared<const job::Picture>(development_.picture());
    snapshot.left = development_.left();
    for (const TimedStage& s : passes_.stages()) snapshot.phases.emplace_back(s.stage->name(), s.seconds);
    if (development_.smooths()) snapshot.phases.emplace_back("smoothing", development_.smoothing_seconds());
    snapshot.progress = progress();
    const double batches = passes_.energy_batches();
    Energy energy{
        balance_of(outcome_watts(world_.context.all_reduced_sum(world_.energy), world_.tables.energy_scale, batches)),
        {}};
    for (std::size_t s = 0; s < passes_.stages().size(); ++s)
      passes_.stages()[s].stage->report(passes_.complete(), passes_.had_turn(s), energy);
    add_energy(energy, passes_.photons(), snapshot);
    return snapshot;
  }

  std::shared_ptr<const job::PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override {
    const auto [x, y] = pixel;
    if (x < 0 || y < 0 || x >= world_.tables.camera.width || y >= world_.tables.camera.height) return nullptr;
    auto spectrum = std::make_shared<job::PixelSpectrum>();
    spectrum->pixel = pixel;
    if (!world_.relighting) {
      spectrum->why_not =
          "the film adds up colours, and a spectrum is not kept; spectral.relight true keeps a layer for each cluster";
      if (why_no_layers_.empty())
        spectrum->remedy = "spectral.relight=true";
      else
        spectrum->why_not += ", but not here: " + why_no_layers_;
      return spectrum;
    }
    for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
      Stage& stage = *passes_.stages()[s].stage;
      if (!stage.add_spectrum(passes_.complete(), passes_.had_turn(s), *spectrum))
        spectrum->notes.push_back(fmt::format("Without the layer \"{}\", of which no spectrum is kept.", stage.name()));
    }
    if (development_.smooths()) spectrum->notes.push_back("The picture's caustics are smoothed, the spectrum is not.");
    return spectrum;
  }

  void save(ByteSink& sink) override {
    tracing::Archive archive(sink, world_.context.communicator());
    this->serialize(archive);
  }

  void load(ByteSource& source) override {
    tracing::Archive archive(source, world_.context.communicator());
    this->serialize(archive);
    world_.context.finish();
  }

  bool adopt(const preset::Preset& preset) override {
    if (!world_.relighting || !engine::adoptable(preset_, preset)) return false;
    change_light(*world_.relighting, world_, layer_light(preset));
    preset_ = preset;
    world_.white = preset.white.value_or(1);
    passes_.begin_energy();
    return true;
  }

  void begin_with(const job::Beginning& beginning) override {
    world_.seed = tracing::seed_words(beginning.seed);
    development_.begin_with(beginning.before);
  }

  void set_estimate(std::vector<float> direct) override { development_.set_estimate(std::move(direct)); }
  void set_white(double white) override { world_.white = white; }
  double passes() const override { return passes_.with_fraction(); }

  void serialize(tracing::Archive& archive) override {
    passes_.state_of_position(archive);
    preview_.serialize(archive);
    archive.buffer(world_.energy);
    passes_.state_of_stages(archive);
  }

private:
  void begin_pass() {
    const std::int64_t passes = passes_.complete();
    if (passes == 1) development_.prepare();
    if (shares_work_ && passes >= 2 && std::has_single_bit(static_cast<std::uint64_t>(passes)))
      passes_.work(0, [&] { development_.share_work(); });
  }

  StageContext world_;    ///< used by the stages
  preset::Preset preset_; ///< preset with the present lights
  std::string why_no_layers_;
  Passes passes_;
  Preview preview_;
  Development development_;
  bool shares_work_;              ///< whether time is divided among stages by its gain
  std::int64_t most_passes_ = -1; ///< -1: until the stop's seconds are over, or the caller stops
};

} // namespace

std::unique_ptr<PhotonJob> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                    const RunPlan& plan, const mpi::RankContext& context) {
  return std::make_unique<PassesJob>(preset, scene, bvh, plan, context);
}

} // namespace nephroid::photons
