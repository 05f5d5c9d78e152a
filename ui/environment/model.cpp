// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/model.h"

#include "environment/segment/irradiance.h"
#include "environment/settings.h"
#include "environment/view/render_task.h"
#include "image/display.h"
#include "scene/environment.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using environment::SegmentMethod;
using environment::SegmentSettings;

std::shared_ptr<const ReadMap> read(const MapSource& source) {
  auto read_map = std::make_shared<ReadMap>();
  const Location where = Location(source.preset) / "scene" / "environment";
  const FileFinder finder(std::filesystem::path(source.preset).parent_path());
  const scene::Environment map = scene::make_environment(source.environment, finder, where, read_map->warnings);
  read_map->width = map.width;
  read_map->height = map.height;
  read_map->cube = environment::make_cube_map(map);
  read_map->picture = environment::shown_map(map);
  return read_map;
}

std::shared_ptr<const CutMap> cut(const ReadMap& map, const SegmentSettings& settings) {
  auto cut_map = std::make_shared<CutMap>();
  cut_map->settings = settings;
  cut_map->segmentation = environment::segment(map.cube, settings);
  cut_map->region_of_texel = regions_of_texels(cut_map->segmentation);
  return cut_map;
}

Colour colour_of(const glm::dvec3& flux) {
  const double most = std::max({flux.x, flux.y, flux.z});
  if (!(most > 0)) return {};
  const auto byte = [&](double value) { return image::shown(static_cast<float>(value / most)); };
  return {byte(flux.x), byte(flux.y), byte(flux.z)};
}

} // namespace

WantedMap wanted_map(const preset::Preset& preset, const MapPictureSize& picture) {
  WantedMap wanted{{preset.scene.environment.value(), preset.source}, std::nullopt, picture};
  wanted.source.environment.radiance = 1;
  wanted.source.environment.rotate_deg = 0;
  wanted.source.environment.lights = false;
  if (&preset.settings.type() == &environment::settings_type()) wanted.segments = environment::segment_settings(preset);
  return wanted;
}

void EnvironmentModel::want(const WantedMap& wanted, TaskQueue& tasks) {
  wanted_ = wanted;
  const Step step = next();
  if (step == Step::none || tasks.busy(steps_)) return;
  tasks.start(
      steps_, {"lights of the environment"}, [step, wanted, shown = shown_] { return take_step(step, wanted, shown); },
      [this, step, wanted](ShownMap shown) {
        shown_ = std::move(shown);
        refused_ = shown_.error.empty() ? std::nullopt : std::optional(wanted);
        maps_read_ += step == Step::read && !refused_;
        cuts_made_ += step == Step::cut && !refused_;
      });
}

/// What is seen first comes first. A point of the quality is a step of its own, so that it holds nothing else up for
/// long.
EnvironmentModel::Step EnvironmentModel::next() const {
  if (!wanted_) return Step::none;
  if (refused_ && refused_->source == wanted_->source && refused_->segments == wanted_->segments) return Step::none;
  if (!shown_.map || shown_.source != wanted_->source) return Step::read;
  const bool segments = wanted_->segments.has_value();
  if (segments && (!shown_.cut || shown_.cut->settings != *wanted_->segments)) return Step::cut;
  const std::shared_ptr<const CutMap> with = segments ? shown_.cut : nullptr;
  if (!shown_.picture || shown_.picture->size != wanted_->picture || shown_.picture->cut != with) return Step::draw;
  if (!segments) return Step::none;
  if (!shown_.truth) return Step::truth;
  if (!shown_.cut_error) return Step::error;
  return shown_.quality[1].size() < quality_lights.size() ? Step::quality : Step::none;
}

ShownMap EnvironmentModel::take_step(Step step, const WantedMap& wanted, ShownMap shown) {
  const auto error_of = [&](const environment::Segmentation& segmentation) {
    return environment::irradiance_error(*shown.truth, segmentation);
  };
  try {
    if (step == Step::read) {
      shown = {};
      shown.map = read(wanted.source);
      shown.source = wanted.source;
    } else if (step == Step::cut) {
      shown.cut = cut(*shown.map, *wanted.segments);
      shown.cut_error.reset();
    } else if (step == Step::draw) {
      auto picture = std::make_shared<MapPicture>();
      picture->size = wanted.picture;
      if (shown.picture && shown.picture->size == wanted.picture)
        picture->under = shown.picture->under;
      else
        picture->under = std::make_shared<PixelsOfMap>(PixelsOfMap{colours_under(wanted.picture, shown.map->picture),
                                                                   texels_under(wanted.picture, shown.map->cube.size)});
      if (wanted.segments) picture->cut = shown.cut;
      picture->rgba = drawn(wanted.picture, picture->under->colours, picture->under->texels,
                            picture->cut ? picture->cut->region_of_texel : std::vector<int>());
      shown.picture = std::move(picture);
    } else if (step == Step::truth) {
      shown.truth = std::make_shared<std::vector<glm::dvec3>>(environment::irradiances(shown.map->cube));
    } else if (step == Step::error) {
      shown.cut_error = error_of(shown.cut->segmentation);
    } else {
      const std::size_t method = shown.quality[1].size() < shown.quality[0].size() ? 1 : 0; // it has fewer points
      Quality& points = shown.quality.at(method);
      const SegmentSettings settings{.lights = quality_lights.at(points.size()),
                                     .method = static_cast<SegmentMethod>(method)};
      points.push_back(error_of(environment::segment(shown.map->cube, settings)));
    }
  } catch (const std::exception& error) {
    shown = {};
    shown.source = wanted.source;
    shown.error = error.what();
  }
  return shown;
}

std::vector<RegionFigures> figures_of(const environment::Segmentation& segmentation, double radiance, double rotate_deg,
                                      const std::vector<double>& visible) {
  const double total = environment::luminance(segmentation.total_flux);
  std::vector<RegionFigures> figures;
  for (const auto* regions : {&segmentation.lights, &segmentation.dropped})
    for (const environment::Region& region : *regions) {
      const glm::dvec3 d = environment::turned(region.direction, rotate_deg);
      const double flux = environment::luminance(region.flux);
      RegionFigures region_figures;
      region_figures.flux = radiance * flux;
      region_figures.share = total > 0 ? flux / total : 0;
      region_figures.azimuth_deg = glm::degrees(std::atan2(d.x, -d.z));
      region_figures.elevation_deg = glm::degrees(std::asin(std::clamp(d.y, -1.0, 1.0)));
      region_figures.solid_angle_sr = region.solid_angle_sr;
      region_figures.colour = colour_of(region.flux);
      if (figures.size() < visible.size()) region_figures.occluded = 1 - visible[figures.size()];
      figures.push_back(region_figures);
    }
  return figures;
}

std::vector<double> visible_shares(const job::Snapshot& snapshot, std::size_t lights) {
  for (const job::Curve& curve : snapshot.curves) {
    if (curve.name != "lights" || curve.rows.size() != lights) continue;
    const auto column = std::find(curve.columns.begin(), curve.columns.end(), "visible");
    if (column == curve.columns.end()) continue;
    std::vector<double> shares;
    for (const std::vector<double>& row : curve.rows) {
      const double share = row.at(static_cast<std::size_t>(column - curve.columns.begin()));
      if (!(share >= 0 && share <= 1)) return {};
      shares.push_back(share);
    }
    return shares;
  }
  return {};
}

double dragged_rotation(double start_deg, double across, MapLayout layout) {
  const double turned_deg = start_deg + (layout == MapLayout::cube ? 360 : -360) * across;
  return std::round(10 * std::remainder(turned_deg, 360.0)) / 10;
}

} // namespace nephroid::ui
