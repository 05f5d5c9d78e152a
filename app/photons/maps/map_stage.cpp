// SPDX-License-Identifier: Apache-2.0
// Caustics seen through glass or in a mirror: paths from the eye gather the photons that the photon stage has stored
// beside its splats.
#include "base/counted.h"
#include "photons/maps/map_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::photons {
namespace {

class MapStage final : public Stage {
public:
  MapStage(StageContext& world, const scene::Scene& scene, const Settings& settings)
      : world_(world), film_(world, world.map.value(), scene, settings, "film photon maps", {}),
        preview_film_(world.preview_film()) {}

  const char* name() const override { return "photon maps"; }
  double fraction_done() const override { return film_.eye().fraction_done(); }
  void share_work(const Noise& noise) override {
    double sum = 0;
    for (const std::uint32_t pixel : world_.pixels.glass)
      for (std::size_t c = 0; c < 3; ++c) sum += noise.of(3 * std::size_t{pixel} + c);
    const double work = static_cast<double>(noise.passes) * film_.paths() * work_through_glass * film_.eye().size();
    if (work > 0) film_.set_paths(film_.paths() * std::sqrt(sum / work / noise.photon_gain));
  }

  void warm_up(const Communicator& /*communicator*/) override { film_.warm_up(photons(world_.tables.batches)); }

  /// Gathers the photons of the first batches.
  bool advance_preview() override {
    preview_film_ = world_.preview_film();
    if (world_.preview.batches > 0) film_.advance_preview(preview_film_, photons(world_.preview.batches));
    return true;
  }

  void develop_preview(job::Picture& picture) override {
    const auto samples = [](std::size_t) { return std::array{1.0, 1.0}; };
    tracing::add_layer("caustic", {world_.context.all_reduced_sum(preview_film_), scale(), samples}, picture);
  }

  bool advance(std::int64_t pass) override { return film_.advance(pass, photons(world_.tables.batches)); }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override {
    film_.develop(passes, done, "caustic", scale(), picture);
  }

  void serialize(tracing::Archive& archive) override {
    film_.serialize(archive);
    if (archive.is_read()) preview_film_ = world_.preview_film();
    archive.buffer(preview_film_);
  }

private:
  double scale() const { return world_.tables.caustic_scale * world_.white; }
  /// Of the first batches of a pass.
  MapFilm::Photons photons(unsigned batches) const {
    const RunTables& t = world_.tables;
    return {batches * t.photons_per_batch, double(batches), t.caustic_scale,
            photon_scale(t.photons_per_batch, t.light_towards_targets_w)};
  }

  StageContext& world_;
  MapFilm film_;
  compute::Buffer<std::int64_t> preview_film_;
};

PlanPart plan_maps(const PlanInput& input) {
  PlanPart part = plan_gathering(input, map_decision(input), input.tables.photons_per_pass());
  const bool runs = part.decisions[0].runs;
  if (runs) part.buffers.push_back({"film photon maps", input.film_bytes()});
  // Photons and eye paths must share a wavelength. A pass has 32 in all: a picture of fewer has a colour cast.
  const int clusters = std::max(static_cast<int>(input.tables.wavelengths.clusters.size()), 1);
  part.defines = {
      {"NEPHROID_PASS_BANDS", std::to_string(runs && jitter_decision(input).runs ? std::max(1, 32 / clusters) : 1)}};
  return part;
}

} // namespace

plan::Decision map_decision(const PlanInput& input) {
  const char* const name = "photon maps";
  if (input.settings.relight)
    return {name, false, "spectral.relight is true: layers are kept of splats, not of photon maps", "/spectral/relight",
            false};
  if (!input.caustics.runs) return {name, false, "there are no caustics to gather"};
  const bool sees = tracing::may_see_glass_or_mirror(input.scene);
  if (input.settings.estimator == Settings::Estimator::splat)
    return {name, false,
            fmt::format("spectral.estimator is splat: {}", sees ? "what glass and mirrors show of caustics is left out"
                                                                : "the camera sees no glass and no mirror")};
  if (!sees)
    return tracing::not_needed(name, input.leave_out.photon_maps,
                               "the camera sees no glass and no mirror, so every caustic is splatted");
  return tracing::needed(
      name,
      fmt::format(
          "caustics seen through glass or in a mirror are gathered, {}, {} a pixel and pass; the others are splatted",
          map_radius(input.settings, input.scene), counted(input.tables.eye_paths, "path")));
}

const RunPart map_stage{plan_maps, make_stage<MapStage>, "caustic"};

} // namespace nephroid::photons
