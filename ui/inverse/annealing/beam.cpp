// SPDX-License-Identifier: Apache-2.0
#include "ui/inverse/annealing/beam.h"

#include <numeric>

namespace nephroid::ui {

std::optional<FacetBeam> facet_beam(const job::Picture& slopes, const inverse::Layout& layout, const glm::ivec2& facet)
{
  if (slopes.width != layout.facets.x || slopes.height != layout.facets.y) return std::nullopt;
  if (facet.x < 0 || facet.y < 0 || facet.x >= layout.facets.x || facet.y >= layout.facets.y) return std::nullopt;
  const std::size_t index = inverse::index_at(facet.x, facet.y, layout.facets.x);
  const glm::dvec2 slope{slopes.rgb[3 * index], slopes.rgb[3 * index + 1]};
  const double height = slopes.rgb[3 * index + 2];
  FacetBeam beam{facet, slope, height, inverse::facet_power(layout, index, slope), {}};
  for (std::size_t j = 0; j < layout.distances.size(); ++j) beam.prints.push_back(inverse::footprint(layout, index, slope, j, height));
  return beam;
}

std::optional<BeamBox> box_of(const inverse::Footprint& print)
{
  if (print.x.empty() || print.y.empty()) return std::nullopt;
  return BeamBox{{print.x0, print.y0}, {print.x0 + static_cast<int>(print.x.size()), print.y0 + static_cast<int>(print.y.size())}};
}

double part_on(const inverse::Footprint& print)
{
  return std::accumulate(print.x.begin(), print.x.end(), 0.0) * std::accumulate(print.y.begin(), print.y.end(), 0.0);
}

} // namespace nephroid::ui
