// SPDX-License-Identifier: Apache-2.0
// What a person reads of a segmentation: each light's figures in the scene's frame, and how much of it a run found not to be hidden. And
// how a drag in the picture turns the environment. No Dear ImGui.
#pragma once
#include "environment/segment/segment.h"
#include "job/job.h"
#include "ui/environment/picture.h"

#include <optional>
#include <vector>

namespace nephroid::ui {

struct RegionFigures {
  double flux = 0;          ///< W/m^2 of Y on a plane that faces it
  double share = 0;         ///< of all lights' flux together, 0..1
  double azimuth_deg = 0;   ///< from -z to the right (+x), -180..180,
  double elevation_deg = 0; ///< and above the horizon; both in the scene
  double solid_angle_sr = 0;
  Colour colour{};                ///< for a screen, its largest channel 255; black where there is no light
  std::optional<double> occluded; ///< 0..1, where a run says so
};

/// One each of the lights, then of the dropped regions, whose flux is counted in a light's. radiance: what the segmentation's flux, of a
/// map of radiance 1, is multiplied by. visible: as visible_shares gives it.
std::vector<RegionFigures> figures_of(const environment::Segmentation& segmentation, double radiance, double rotate_deg,
                                      const std::vector<double>& visible);

/// Of a run's curve "lights", its column "visible": the part of each light that no occluder hides, 0..1, in the order of the segmentation.
/// Empty where the snapshot has no such curve of so many lights, or a value is no such part.
std::vector<double> visible_shares(const job::Snapshot& snapshot, std::size_t lights);

/// rotate_deg, -180..180 and in tenths, after the mouse went `across` widths of the picture to the right. In latitude and longitude the map
/// goes with the mouse. In the cube, which lies still, the mark of the scene's front does.
double dragged_rotation(double start_deg, double across, MapLayout layout);

} // namespace nephroid::ui
