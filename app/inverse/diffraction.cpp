// SPDX-License-Identifier: Apache-2.0
#include "inverse/diffraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

constexpr double mm_a_nm = 1e-6;

/// Of a spectrum, that which is seen best.
double wavelength_nm(const Settings& settings) { return settings.light.spectrum ? 555 : settings.wavelength_nm; }

/// The part of the object that lights a place of its own, in mm.
glm::dvec2 aperture(const Settings& settings, const Layout& layout) {
  return settings.method == Settings::Method::lens ? layout.size / glm::dvec2(layout.cells) : layout.facet();
}

glm::dvec2 spread_cells(const Settings& settings, const Layout& layout, std::size_t receiver) {
  return wavelength_nm(settings) * mm_a_nm * layout.distances[receiver] / (aperture(settings, layout) * layout.cell());
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
        "light is a wave: {} of {:.3g} x {:.3g} mm spreads {:.4g} nm over {:.3g} cells of picture {}, {} mm away, "
        "which no ray shows; {} x {} {} are the finest of use there; choose fewer, a larger object or a nearer "
        "receiver",
        lens ? "the part of the lens that lights a cell" : "a facet", width.x, width.y, wavelength_nm(settings), worst,
        j + 1, layout.distances[j], finest.x, finest.y, lens ? "cells" : "facets"));
  }
  return notes;
}

} // namespace nephroid::inverse
