// SPDX-License-Identifier: Apache-2.0
#include "run/meters.h"

#include "base/nearest.h"
#include "engine/engine.h"
#include "preset/json_text.h"
#include "run/memory.h"
#include "scene/placement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <any>
#include <bit>

namespace nephroid::run {
namespace {

/// The scene with all of its light, also beyond the visible, and with its environment as a light where the engine
/// always takes it for one.
scene::Scene lit_scene(const Prepared& prepared) {
  const preset::Preset& preset = prepared.preset;
  const optics::SpectralRange range =
      scene::reaches_beyond_visible(preset) ? optics::SpectralRange::solar : optics::SpectralRange::visible;
  const bool is_sky = preset.scene.environment && preset.scene.environment->type == preset::Environment::Type::sky;
  scene::Scene scene = is_sky || range != optics::SpectralRange::visible
                           ? scene::in_range(prepared.loaded->scene, preset, range)
                           : prepared.loaded->scene;
  const bool decides = std::any_cast<photons::Settings>(&prepared.preset.settings.value()) != nullptr;
  if (decides || !scene.environment || scene.environment->lights || scene.environment->is_black()) return scene;
  scene.environment->lights = true;
  scene.lights.push_back(scene::make_environment_light(*scene.environment));
  return scene;
}

[[noreturn]] void refuse_name(const preset::Preset& preset, const std::string& wanted) {
  std::vector<std::string> names;
  for (const preset::Meter& meter : preset.scene.meters) names.push_back(meter.name);
  const std::string similar = nearest(wanted, names);
  throw bad_input("--meter", fmt::format("there is no meter {}", preset::in_quotes(wanted)),
                  fmt::format("scene.meters has {}", fmt::join(names, ", ")),
                  similar.empty() ? "" : fmt::format("did you mean '{}'?", similar));
}

void require_meters(const preset::Preset& preset) {
  const Location where = Location(preset.source) / "scene" / "meters";
  if (!engine::engine_of(preset).has_scene)
    throw bad_input(Location(preset.source) / "engine",
                    fmt::format("is {}, which has no scene that light falls in", preset.settings.engine()),
                    "expected one with objects and lights");
  if (preset.scene.meters.empty())
    throw bad_input(where, "is empty: there is nothing to measure", "expected a meter",
                    "add one: --set 'scene.meters=[{\"type\":\"surface\",\"name\":\"floor\",\"object\":\"floor\"}]'");
}

} // namespace

photons::Settings meter_settings(const preset::Preset& preset) {
  const auto* settings = std::any_cast<photons::Settings>(&preset.settings.value());
  return settings ? *settings : photons::Settings();
}

void check_meters(const Prepared& prepared) {
  const preset::Preset& preset = prepared.preset;
  require_meters(preset);
  const Location where = Location(preset.source) / "scene" / "meters";
  const scene::Scene scene = lit_scene(prepared); // also what is refused beyond the visible alone
  for (std::size_t i = 0; i < preset.scene.meters.size(); ++i)
    scene::make_meter(preset.scene.meters[i], scene, where / static_cast<int>(i));
}

Metering::Metering(const Prepared& prepared, const mpi::RankContext& context, const std::string& only)
    : prepared_(prepared) {
  require_meters(prepared.preset);
  const preset::Preset& preset = prepared.preset;
  const Location where = Location(preset.source) / "scene" / "meters";
  const scene::Scene scene = lit_scene(prepared);
  range_ = scene.range;
  if (scene.environment && !scene.environment->about.empty()) notes_.push_back(sky_ = scene.environment->about);
  if (scene.environment && !scene.environment->lights && !scene.environment->is_black())
    notes_.push_back("what is behind the scene does not light it: scene.environment.lights is false");
  for (std::size_t i = 0; i < preset.scene.meters.size(); ++i) {
    const preset::Meter& meter = preset.scene.meters[i];
    if (!only.empty() && meter.name != only) continue;
    MeterInHand& next = meters_.emplace_back();
    next.meter = meter;
    next.origin = scene.origin;
    next.surface =
        std::make_shared<const scene::MeterSurface>(scene::make_meter(meter, scene, where / static_cast<int>(i)));
    if (auto line = scene::covered(*next.surface, scene, *prepared.loaded->bvh)) notes_.push_back(std::move(*line));
    const scene::Scene view = scene::meter_view(scene, *next.surface);
    next.plan = photons::plan_meter(preset, meter_settings(preset), view, *prepared.loaded->bvh);
    if (next.is_dark()) notes_.push_back(fmt::format("{} is dark: {}", meter.name, next.plan.decisions.front().reason));
    require_memory(next.plan, view.camera.width, 1, context.device(), available_memory_bytes());
    next.run = photons::make_meter_run(preset, view, *prepared.loaded->bvh, next.plan, context);
  }
  if (meters_.empty()) refuse_name(preset, only);
}

bool Metering::advance() {
  MeterInHand& meter = meters_[next_];
  const std::int64_t before = meter.run->cycles();
  meter.run->advance();
  if (meter.run->cycles() == before) return false;
  // Cycles 1, 2, 3, 4, 6, 8, 12, ...: to read all cells takes a while, and who stops at the first lucky interval has
  // one that is too small.
  next_ = (next_ + 1) % meters_.size();
  const auto cycles = static_cast<std::uint64_t>(meter.run->cycles());
  const bool is_due = std::has_single_bit(cycles) || (cycles % 3 == 0 && std::has_single_bit(cycles / 3));
  if (!is_due && meter.reading) return false;
  read(meter, is_due); // a resumed run reads once more, and goes on as the unbroken one
  return true;
}

void Metering::read(MeterInHand& meter, bool steers) {
  meter.seconds = meter.run->work_seconds();
  meter.photons = meter.run->photons();
  meter.reading = std::make_shared<const meters::Reading>(
      meters::read(meter.meter, *meter.surface, prepared_.loaded->scene.metres_per_unit, meter.run->layers(steers)));
  const meters::Numbers& numbers = meter.reading->all().numbers(meters::quantity_of(meter.meter.unit));
  meter.history.push_back({meter.seconds, numbers.mean, numbers.peak});
}

bool Metering::all_read() const {
  return std::ranges::all_of(meters_, [](const MeterInHand& meter) { return meter.reading != nullptr; });
}

meters::Readings Metering::readings() const {
  meters::Readings readings{{}, range_, notes()};
  for (const MeterInHand& meter : meters_) {
    meters::Shown& shown = readings.meters.emplace_back();
    shown.meter = meter.meter;
    shown.surface = meter.surface;
    shown.origin = meter.origin;
    shown.metres_per_unit = prepared_.loaded->scene.metres_per_unit;
    shown.reading = meter.reading;
    shown.seconds = meter.seconds;
    shown.photons = meter.photons;
    shown.lost_share = meter.run->lost_share();
    shown.refused = meter.run->refused();
    shown.history = meter.history;
  }
  return readings;
}

void Metering::serialize(tracing::Archive& archive) {
  archive.value(next_);
  for (MeterInHand& meter : meters_) {
    meter.run->serialize(archive);
    archive.list(meter.history);
  }
}

bool Metering::is_enough(double percent) const {
  return std::ranges::all_of(meters_, [&](const MeterInHand& meter) {
    return meter.relative_half_width() <= meter.meter.until_percent.value_or(percent) / 100;
  });
}

std::vector<std::string> Metering::notes() const {
  std::vector<std::string> notes = notes_;
  for (const MeterInHand& meter : meters_)
    for (const std::string& note : meter.plan.notes)
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  return notes;
}

double Metering::work_seconds() const {
  double seconds = 0;
  for (const MeterInHand& meter : meters_) seconds += meter.run->work_seconds();
  return seconds;
}

} // namespace nephroid::run
