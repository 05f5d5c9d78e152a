// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/model.h"

#include "environment/segment/quality.h"
#include "environment/settings.h"
#include "scene/environment.h"

#include <exception>
#include <filesystem>
#include <utility>

namespace nephroid::ui {
namespace {

using environment::SegmentMethod;
using environment::SegmentSettings;

std::shared_ptr<const ReadMap> read(const MapSource& source)
{
  auto made = std::make_shared<ReadMap>();
  const Place where = Place(source.preset) / "scene" / "environment";
  const FileFinder finder(std::filesystem::path(source.preset).parent_path());
  const scene::Environment map = scene::make_environment(source.environment, finder, where, made->warnings);
  made->width = map.width;
  made->height = map.height;
  made->cube = environment::make_cube_map(map);
  made->picture = environment::shown_map(map);
  return made;
}

std::shared_ptr<const CutMap> cut(const ReadMap& map, const SegmentSettings& settings)
{
  auto made = std::make_shared<CutMap>();
  made->settings = settings;
  made->segmentation = environment::segment(map.cube, settings);
  made->region_of_texel = regions_of_texels(made->segmentation);
  return made;
}

/// The method that has fewer points so far.
std::size_t method_in_turn(const std::array<Quality, 2>& quality) { return quality[1].size() < quality[0].size() ? 1 : 0; }

} // namespace

WantedMap wanted_map(const preset::Preset& preset, const MapPictureSize& picture)
{
  WantedMap wanted{{preset.scene.environment.value(), preset.source}, std::nullopt, picture};
  wanted.source.environment.radiance = 1;
  wanted.source.environment.rotate_deg = 0;
  wanted.source.environment.lights = false;
  if (&preset.settings.type() == &environment::settings_type()) {
    const environment::Settings& s = environment::settings(preset);
    wanted.segments = SegmentSettings{.lights = s.lights, .method = s.segmentation, .threshold = s.threshold};
  }
  return wanted;
}

EnvironmentModel::EnvironmentModel() : thread_([this](const std::stop_token& stop) { work(stop); }) {}
EnvironmentModel::~EnvironmentModel() = default;

void EnvironmentModel::want(const WantedMap& wanted)
{
  const std::lock_guard lock(mutex_);
  if (wanted_ == wanted) return;
  wanted_ = wanted;
  wake_.notify_one();
}

ShownMap EnvironmentModel::shown() const
{
  const std::lock_guard lock(mutex_);
  return shown_;
}

bool EnvironmentModel::rests() const
{
  const std::lock_guard lock(mutex_);
  return in_hand_ == Task::none && next() == Task::none;
}

int EnvironmentModel::maps_read() const
{
  const std::lock_guard lock(mutex_);
  return maps_read_;
}

int EnvironmentModel::cuts_made() const
{
  const std::lock_guard lock(mutex_);
  return cuts_made_;
}

/// What is seen first comes first. A point of the quality is a task of its own, so that it holds nothing else up for long.
EnvironmentModel::Task EnvironmentModel::next() const
{
  if (!wanted_) return Task::none;
  if (refused_ && refused_->source == wanted_->source && refused_->segments == wanted_->segments) return Task::none;
  if (!shown_.map || shown_.source != wanted_->source) return Task::read;
  const bool segments = wanted_->segments.has_value();
  if (segments && (!shown_.cut || shown_.cut->settings != *wanted_->segments)) return Task::cut;
  const std::shared_ptr<const CutMap> with = segments ? shown_.cut : nullptr;
  if (!shown_.picture || shown_.picture->size != wanted_->picture || shown_.picture->cut != with) return Task::draw;
  if (!segments) return Task::none;
  if (!has_truth_) return Task::truth;
  if (!shown_.cut_error) return Task::error;
  return shown_.quality[1].size() < quality_lights.size() ? Task::quality : Task::none;
}

void EnvironmentModel::work(const std::stop_token& stop)
{
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return next() != Task::none; })) {
    if (stop.stop_requested()) return;
    in_hand_ = next();
    const WantedMap wanted = *wanted_;
    ShownMap made = shown_; // only this thread changes it
    lock.unlock();
    std::string error;
    try {
      carry_out(in_hand_, wanted, made);
    } catch (const std::exception& e) {
      error = e.what();
    }
    lock.lock();
    if (error.empty()) {
      shown_ = std::move(made);
      refused_.reset();
      if (in_hand_ == Task::read) has_truth_ = false, ++maps_read_;
      if (in_hand_ == Task::truth) has_truth_ = true;
      if (in_hand_ == Task::cut) ++cuts_made_;
    } else {
      shown_ = {};
      shown_.source = wanted.source;
      shown_.error = error;
      refused_ = wanted;
    }
    in_hand_ = Task::none;
  }
}

void EnvironmentModel::carry_out(Task task, const WantedMap& wanted, ShownMap& made)
{
  const auto error_of = [&](const environment::Segmentation& segmentation) { return environment::irradiance_error(truth_, segmentation); };
  if (task == Task::read) {
    made = {};
    made.map = read(wanted.source);
    made.source = wanted.source;
  } else if (task == Task::cut) {
    made.cut = cut(*made.map, *wanted.segments);
    made.cut_error.reset();
  } else if (task == Task::draw) {
    if (under_of_ != made.map || under_size_ != wanted.picture) {
      colours_ = colours_under(wanted.picture, made.map->picture);
      texels_ = texels_under(wanted.picture, made.map->cube.size);
      under_of_ = made.map;
      under_size_ = wanted.picture;
    }
    auto picture = std::make_shared<MapPicture>();
    picture->size = wanted.picture;
    if (wanted.segments) picture->cut = made.cut;
    picture->rgba = drawn(wanted.picture, colours_, texels_, picture->cut ? picture->cut->region_of_texel : std::vector<int>());
    made.picture = std::move(picture);
  } else if (task == Task::truth) {
    truth_ = environment::irradiances(made.map->cube);
  } else if (task == Task::error) {
    made.cut_error = error_of(made.cut->segmentation);
  } else {
    const std::size_t method = method_in_turn(made.quality);
    Quality& points = made.quality.at(method);
    const SegmentSettings settings{.lights = quality_lights.at(points.size()), .method = static_cast<SegmentMethod>(method)};
    points.push_back(error_of(environment::segment(made.map->cube, settings)));
  }
}

} // namespace nephroid::ui
