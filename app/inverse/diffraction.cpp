// SPDX-License-Identifier: Apache-2.0
#include "inverse/diffraction.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

/// The part of the object that lights a place of its own, in mm.
glm::dvec2 aperture(const Settings& settings, const Layout& layout) {
  return settings.method == Settings::Method::lens ? layout.size / glm::dvec2(layout.cells) : layout.facet();
}

glm::dvec2 spread_cells(const Settings& settings, const Layout& layout, std::size_t receiver) {
  return layout.wavelength * layout.distances[receiver] / (aperture(settings, layout) * layout.cell());
}

} // namespace

double diffraction_cells(const Settings& settings, const Layout& layout, std::size_t receiver) {
  const glm::dvec2 cells = spread_cells(settings, layout, receiver);
  return std::max(cells.x, cells.y);
}

std::vector<std::string> diffraction_notes(const Settings& settings, const Layout& layout) {
  const bool lens = settings.method == Settings::Method::lens;
  std::vector<std::string> notes;
  for (std::size_t j = 0; j < layout.distances.size(); ++j) {
    const glm::dvec2 cells = spread_cells(settings, layout, j);
    const double worst = diffraction_cells(settings, layout, j);
    if (worst <= 1) continue;
    // With fewer facets each is wider; with fewer cells of a lens each is wider, and so is what lights it.
    const glm::dvec2 count = lens ? glm::dvec2(layout.cells) / glm::sqrt(cells) : glm::dvec2(layout.facets) / cells;
    const glm::ivec2 finest(glm::max(glm::min(count, glm::dvec2(lens ? layout.cells : layout.facets)), 1.0));
    const glm::dvec2 width = aperture(settings, layout);
    notes.push_back(fmt::format(
        "light is a wave: {} of {:.3g} x {:.3g} mm spreads {:.4g} nm over {:.3g} cells of picture {}, {} mm away{}; {} "
        "x {} {} are the finest of use there; choose fewer, a larger object or a nearer receiver",
        lens ? "the part of the lens that lights a cell" : "a facet", width.x, width.y, layout.wavelength / mm_a_nm,
        worst, j + 1, layout.distances[j], layout.diffracts ? "" : ", which no ray shows", finest.x, finest.y,
        lens ? "cells" : "facets"));
  }
  return notes;
}

std::vector<float> slit_quantiles(std::size_t count) {
  constexpr double step = 1e-4;
  const auto light = [](double t) {
    const double x = glm::pi<double>() * t;
    return x == 0 ? 1 : std::pow(std::sin(x) / x, 2);
  };
  std::vector<float> quantiles{0};
  double before = 0; // both sides together
  for (double t = 0; quantiles.size() < count; t += step) {
    const double here = step / 3 * (light(t) + 4 * light(t + step / 2) + light(t + step));
    for (before += here; static_cast<double>(quantiles.size()) <= before * static_cast<double>(count);)
      quantiles.push_back(static_cast<float>(t + step / 2));
  }
  return quantiles;
}

} // namespace nephroid::inverse
