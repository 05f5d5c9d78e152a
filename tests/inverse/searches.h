// SPDX-License-Identifier: Apache-2.0
// A search that takes a moment: two receivers, a ring and a disc.
#pragma once
#include "inverse/assign/assignment.h"
#include "inverse/assign/footprint.h"
#include "inverse/pictures/target.h"
#include "tests/inverse/drawn.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::test {

using namespace inverse;

inline Layout small_layout() { return {.facets = {32, 32}, .cells = {16, 16}, .distances = {100, 200}}; }

/// Light without colours whose indices are spread evenly over this width.
inline Spectrum band(double n, double width) {
  constexpr int count = 400;
  Spectrum spectrum;
  for (int i = 0; i < count; ++i)
    spectrum.parts.push_back({n + width * ((i + 0.5) / count - 0.5), glm::dvec3(1.0 / count)});
  return spectrum;
}

inline std::vector<Target> ring_and_disc(const Layout& layout) {
  return {drawn({.type = Picture::Type::ring}, layout), drawn({}, layout)};
}

/// Adds the facet's light, `sign` times, to every receiver's.
inline void add_light(const Layout& layout, std::size_t facet, const glm::dvec2& slope, double sign,
                      std::vector<std::vector<double>>& light, double height = 0) {
  const double power = sign * facet_power(layout, facet, slope);
  for (std::size_t j = 0; j < light.size(); ++j)
    for_cells(layout, footprint(layout, facet, slope, j, height),
              [&](std::size_t cell, double part) { light[j][cell] += power * part; });
}

inline void sweep(Assignment& a, int sweeps) {
  while (a.steps() < sweeps) a.advance();
}

} // namespace nephroid::test
