// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/smoothing.h"

#include "inverse/bending.h"

namespace nephroid::inverse {
namespace {

/// f(neighbour) for each neighbour of a facet.
template <class F>
void for_neighbours(const glm::ivec2& facets, std::size_t facet, const F& f)
{
  const auto columns = static_cast<std::size_t>(facets.x), rows = static_cast<std::size_t>(facets.y);
  const std::size_t column = facet % columns, row = facet / columns;
  if (column > 0) f(facet - 1);
  if (column + 1 < columns) f(facet + 1);
  if (row > 0) f(facet - columns);
  if (row + 1 < rows) f(facet + columns);
}

double neighbours(const glm::ivec2& facets, std::size_t facet)
{
  double count = 0;
  for_neighbours(facets, facet, [&](std::size_t) { ++count; });
  return count;
}

} // namespace

glm::dvec3 normal_of(const Layout& layout, std::size_t facet, const glm::dvec2& slope)
{
  return glm::normalize(glm::dvec3(facet_gradient(slope, layout.n, layout.sines_on(facet)), -1));
}

glm::dvec3 pull(const Layout& layout, const std::vector<glm::dvec2>& slopes, std::size_t facet)
{
  glm::dvec3 sum(0);
  const double own = neighbours(layout.facets, facet);
  for_neighbours(layout.facets, facet, [&](std::size_t other) {
    sum += (1 / own + 1 / neighbours(layout.facets, other)) * normal_of(layout, other, slopes[other]);
  });
  return sum;
}

double roughness(const Layout& layout, const std::vector<glm::dvec2>& slopes)
{
  double sum = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    glm::dvec3 around(0);
    for_neighbours(layout.facets, i, [&](std::size_t other) { around += normal_of(layout, other, slopes[other]); });
    if (const double count = neighbours(layout.facets, i); count > 0) sum += 1 - glm::dot(normal_of(layout, i, slopes[i]), around) / count;
  }
  return sum / static_cast<double>(slopes.size());
}

} // namespace nephroid::inverse
