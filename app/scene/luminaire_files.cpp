// SPDX-License-Identifier: Apache-2.0
#include "scene/luminaire_files.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace nephroid::scene {
namespace {

/// As long as a line of EULUMDAT may be.
std::string line_of(const std::string& text) { return text.substr(0, 78); }

/// The step of equal steps; 0 of others, as EULUMDAT has it.
double step_of(const std::vector<double>& angles) {
  const double step = angles[1] - angles[0];
  for (std::size_t i = 2; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-9) return 0;
  return step;
}

} // namespace

std::string ies(const LuminaireGrid& grid, const std::string& test, const std::string& name) {
  const int gammas = static_cast<int>(grid.gamma_deg.size());
  std::string text = fmt::format(
      "IESNA:LM-63-2002\n[TEST] {}\n[TESTLAB] Nephroid\n[ISSUEDATE] none\n[MANUFAC] Nephroid\n[LUMINAIRE] {}\n"
      "TILT=NONE\n1 {:.6g} 1 {} {} 1 2 0 0 0\n1 1 {:.6g}\n",
      line_of(test), line_of(name), grid.lumens, gammas, grid.planes + 1, grid.watts);
  const auto numbers = [&](int count, const auto& number) { // lines of few numbers: some readers take 256 characters
    for (int i = 0; i < count; ++i)
      fmt::format_to(std::back_inserter(text), "{:.6g}{}", number(i), i + 1 == count || i % 12 == 11 ? "\n" : " ");
  };
  numbers(gammas, [&](int i) { return grid.gamma_deg[static_cast<std::size_t>(i)]; });
  numbers(grid.planes + 1, [&](int i) { return grid.c_deg(i); });
  for (int plane = 0; plane <= grid.planes; ++plane)
    numbers(gammas, [&](int gamma) { return grid.at(plane, static_cast<std::size_t>(gamma)); });
  return text;
}

std::string eulumdat(const LuminaireGrid& grid, const std::string& test, const std::string& name) {
  double below = 0, everywhere = 0; // the flux, up to a factor
  for (std::size_t gamma = 0; gamma < grid.gamma_deg.size(); ++gamma) {
    const double angle = grid.gamma_deg[gamma], before = gamma > 0 ? grid.gamma_deg[gamma - 1] : angle,
                 after = gamma + 1 < grid.gamma_deg.size() ? grid.gamma_deg[gamma + 1] : angle;
    for (int plane = 0; plane < grid.planes; ++plane) {
      const double flux = grid.at(plane, gamma) * std::sin(angle * M_PI / 180) * (after - before);
      everywhere += flux;
      below += angle < 90 ? flux : angle > 90 ? 0 : flux / 2;
    }
  }
  std::string text =
      fmt::format("Nephroid\n3\n0\n{}\n{:.6g}\n{}\n{:.6g}\n{}\n{}\n\n\n\n", grid.planes, 360.0 / grid.planes,
                  grid.gamma_deg.size(), step_of(grid.gamma_deg), line_of(test), line_of(name));
  for (int i = 0; i < 9; ++i) text += "0\n"; // its sizes
  text += fmt::format("{:.4g}\n100\n1\n0\n1\n1\n-\n{:.6g}\n-\n-\n{:.6g}\n",
                      everywhere > 0 ? 100 * below / everywhere : 0, grid.lumens, grid.watts);
  for (int i = 0; i < 10; ++i) text += "0\n"; // ratios for a room's indices
  for (int plane = 0; plane < grid.planes; ++plane) text += fmt::format("{:.6g}\n", grid.c_deg(plane));
  for (const double gamma : grid.gamma_deg) text += fmt::format("{:.6g}\n", gamma);
  for (const double candela : grid.candela)
    text += fmt::format("{:.6g}\n", grid.lumens > 0 ? 1000 * candela / grid.lumens : 0);
  return text;
}

} // namespace nephroid::scene
