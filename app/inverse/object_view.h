// SPDX-License-Identifier: Apache-2.0
// The object while it is designed, as the window shows it: glass, or a mirror, over its receivers, which are sheets of
// light. It is one path a pixel, no rendering: walls between facets are not drawn, and no receiver hides another.
#pragma once
#include "inverse/layout.h"
#include "job/job.h"

namespace nephroid::inverse {

struct ObjectView {
  const Layout& layout;
  std::span<const glm::dvec2> slopes; ///< a slope for each facet
  std::span<const double> heights;    ///< z of the facets' middles
  bool smooth = false;                ///< whether normals are interpolated between facets
  /// What each receiver shows: a picture of its cells.
  std::vector<std::shared_ptr<const job::Picture>> receivers;
};

std::shared_ptr<const job::Picture> view_of(const ObjectView& object, const preset::Camera& camera);

/// The preset's camera, in millimetres about the middle of the facets, with light falling along -z. A camera that was
/// left at its default is replaced by one that has the object and all receivers in sight.
preset::Camera view_camera(const preset::Preset& preset);

} // namespace nephroid::inverse
