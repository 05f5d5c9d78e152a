// SPDX-License-Identifier: Apache-2.0
// The direct layer, and what glass and mirrors show of the light that photons have left on receivers: paths from the
// eye find both (kernels/photons/direct.cl).
#include "base/counted.h"
#include "photons/eye_stage.h"

#include <fmt/format.h>

#include <numbers>
#include <optional>

namespace nephroid::photons {
namespace {

/// NEPHROID_SKY of the kernel.
enum class Sky { without, with_lamps, alone };

/// Paths that find lamps, and light on receivers where that is kept. Without `direct` they find the latter alone, and
/// the stage's own film is that of caustics.
class PathStage final : public EyeStage {
public:
  PathStage(StageContext& world, const char* name, const char* layer, const Settings& settings, bool direct,
            Sky of_sky = Sky::with_lamps)
      : EyeStage(world, name, layer, settings), no_table_(world.context, "no receivers", 0),
        no_totals_(world.context, "no receivers", 0), no_film_(world.context, "no receivers", 0) {
    compute::Defines defines = world.eye_defines(true);
    defines["NEPHROID_DIRECT"] = std::to_string(int(direct));
    defines["NEPHROID_SKY"] = std::to_string(int(of_sky));
    kernel_ = compute::Program(world.context, "photons/direct.cl", defines).kernel("direct");
    if (!world.receivers) return;
    const auto make = [&](const char* film) {
      return SeenLight{world.zeroed(film, world.film_size()), world.preview_film(),
                       [this](std::size_t pixel) { return pixels_.samples(pixel); }};
    };
    if (direct) world.caustics_seen = make("film light on receivers");
    if (world.keeps_indirect()) world.indirect_seen = make("film indirect light on receivers");
  }

  void warm_up(const Communicator& communicator) override {
    EyeStage::warm_up(communicator);
    if (world_.receivers) world_.receivers->clear(); // of what the photons' own has left
  }

  bool advance_preview() override {
    for_seen([&](SeenLight& seen) { seen.preview = world_.preview_film(); });
    return EyeStage::advance_preview();
  }

  void serialize(tracing::Archive& archive) override {
    EyeStage::serialize(archive);
    if (world_.receivers) world_.receivers->serialize(archive);
    for_seen([&](SeenLight& seen) {
      archive.buffer(seen.film);
      if (archive.is_read()) seen.preview = world_.preview_film();
      archive.buffer(seen.preview);
    });
  }

private:
  template <class Work>
  void for_seen(const Work& work) {
    for (std::optional<SeenLight>* seen : {&world_.caustics_seen, &world_.indirect_seen})
      if (*seen) work(**seen);
  }

  void run(std::uint32_t count, bool is_preview, std::initializer_list<compute::Argument> more) override {
    const auto film_of = [&](const std::optional<SeenLight>& seen, const compute::Buffer<std::int64_t>& other) {
      return !seen ? other : is_preview ? seen->preview : seen->film;
    };
    const std::optional<ReceiverLight>& light = world_.receivers;
    const double metres = world_.tables.scene.metres_per_unit,
                 square_metres = std::numbers::pi * metres * metres * world_.tables.power_unit;
    world_.run(
        kernel_, count, 64,
        {{"seen_caustic", film_of(world_.caustics_seen, is_preview ? preview_film_ : film_)},
         {"seen_indirect", film_of(world_.indirect_seen, no_film_)},
         {"receiver_table", light ? light->table() : no_table_},
         {"totals", light ? light->totals() : no_totals_},
         {"radiance_per_quantum", light ? static_cast<float>(1 / (light->quanta_per_watt() * square_metres)) : 0.0f}},
        more);
  }

  compute::Kernel kernel_;
  compute::Buffer<int> no_table_;
  compute::Buffer<float> no_totals_;
  compute::Buffer<std::int64_t> no_film_;
};

std::unique_ptr<Stage> make_direct_stage(StageContext& world, const scene::Scene& scene, const Settings& settings) {
  return std::make_unique<PathStage>(world, "direct", "direct", settings, true,
                                     scene.camera.meter ? Sky::without : Sky::with_lamps);
}

std::unique_ptr<Stage> make_sky_stage(StageContext& world, const scene::Scene&, const Settings& settings) {
  return std::make_unique<PathStage>(world, "sky", "sky", settings, true, Sky::alone);
}

/// A meter has a layer of its own for what the environment sends to it straight.
PlanPart plan_sky(const PlanInput& input) {
  if (!input.scene.camera.meter || !input.tables.sky) return {};
  return part_of({"sky", true, "what the environment sends to a meter straight"}, {{"film sky", input.film_bytes()}});
}

/// What the paths of the layer "direct" have found of caustics.
class SeenCausticsStage final : public Stage {
public:
  explicit SeenCausticsStage(StageContext& world) : world_(world) {}
  const char* name() const override { return "light on receivers"; }
  double fraction_done() const override { return 0; }
  void warm_up(const Communicator&) override {}
  bool advance(std::int64_t) override { return true; }
  void develop(std::int64_t, bool, job::Picture& picture) override {
    world_.add_seen_light(*world_.caustics_seen, "caustic", picture);
  }
  void develop_preview(job::Picture& picture) override {
    world_.add_seen_preview(*world_.caustics_seen, "caustic", picture);
  }
  void serialize(tracing::Archive&) override {}

private:
  StageContext& world_;
};

std::unique_ptr<Stage> make_receiver_stage(StageContext& world, const scene::Scene&, const Settings& settings) {
  if (world.caustics_seen) return std::make_unique<SeenCausticsStage>(world);
  return std::make_unique<PathStage>(world, "light on receivers", "caustic", settings, false);
}

plan::Decision direct_decision(const PlanInput& input) {
  const char* const name = "direct";
  if (!input.settings.direct) return not_asked_for(name, name);
  const bool shines = input.objects.diffuse > 0 || any_material(input.scene, scatter::is_rough);
  const std::string missing = shines ? no_light(input) : "the scene has no diffuse or rough surface";
  if (!missing.empty()) return tracing::not_needed(name, input.leave_out.direct, missing);
  return tracing::needed(
      name, fmt::format("{} lit by {}, {} a pixel{}", counted(input.objects.diffuse, "diffuse object"),
                        counted(shining_lights(input), "light"), counted(*input.settings.pixel_samples, "sample"),
                        input.settings.relight ? "" : more_through_glass(input)));
}

PlanPart plan_direct(const PlanInput& input) {
  return part_of(direct_decision(input), {{"film direct", input.film_bytes()}});
}

/// Whether receivers keep what diffuse surfaces make of caustics, for the layer "indirect".
bool keeps_indirect(const PlanInput& input) {
  return indirect_decision(input).runs && input.objects.throw_caustics() && !input.tables.emitters.empty();
}

plan::Decision receiver_decision(const PlanInput& input) {
  const char* const name = "light on receivers";
  if (input.settings.relight)
    return {name, false, "spectral.relight is true: layers are kept of splats alone", "/spectral/relight", false};
  const bool sees = tracing::may_see_glass_or_mirror(input.scene);
  if (!keeps_indirect(input)) {
    if (!input.caustics.runs) return {name, false, "there are no caustics to keep"};
    if (input.is_sppm()) return {name, false, "spectral.estimator is sppm, which gathers every caustic"};
    if (input.settings.estimator == Settings::Estimator::splat)
      return {name, false,
              fmt::format("spectral.estimator is splat: {}", sees
                                                                 ? "what glass and mirrors show of caustics is left out"
                                                                 : "the camera sees no glass and no mirror")};
  }
  if (input.scene.camera.meter) return {name, false, "a meter sees neither glass nor mirrors"};
  if (!sees)
    return tracing::not_needed(name, input.leave_out.light_on_receivers,
                               "the camera sees no glass and no mirror, so every caustic is splatted");
  const bool splat = input.settings.estimator == Settings::Estimator::splat;
  return tracing::needed(
      name, fmt::format("what glass and mirrors show of {} is kept in texels where it falls, and found by paths from "
                        "the eye{}",
                        splat || input.is_sppm() ? "walls that caustics light" : "caustics",
                        splat ? "; spectral.estimator is splat: caustics themselves are left out there" : ""));
}

PlanPart plan_receivers(const PlanInput& input) {
  PlanPart part{.decisions = {receiver_decision(input)}};
  const bool runs = part.decisions[0].runs;
  part.defines = {{"NEPHROID_RECEIVERS", std::to_string(int(runs))}};
  if (!runs) return part;
  const int kinds = keeps_indirect(input) ? 2 : 1;
  part.defines["NEPHROID_KINDS_OF_LIGHT"] = std::to_string(kinds);
  part.buffers = {{"films of light on receivers", static_cast<std::uint64_t>(kinds) * input.film_bytes()},
                  {"light on receivers, at most",
                   most_receiver_bytes(input.scene, input.tables.wavelengths, jitter_decision(input).runs,
                                       static_cast<unsigned>(input.halves()), kinds)}};
  return part;
}

} // namespace

const RunPart direct_stage{plan_direct, make_direct_stage, "direct"};
const RunPart sky_stage{plan_sky, make_sky_stage, "sky"};
const RunPart receiver_stage{plan_receivers, make_receiver_stage, "caustic"};

} // namespace nephroid::photons
