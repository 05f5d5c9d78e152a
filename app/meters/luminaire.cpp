// SPDX-License-Identifier: Apache-2.0
#include "meters/luminaire.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace nephroid::meters {
namespace {

/// Candela by C and gamma.
struct Grid {
  int gammas = 0, planes = 0; ///< from 0 to 180; from 0, without 360
  double step_deg = 1;
  std::vector<double> candela; ///< [plane][gamma]
  double at(int plane, int gamma) const {
    return candela[static_cast<std::size_t>(plane % planes) * static_cast<std::size_t>(gammas) +
                   static_cast<std::size_t>(gamma)];
  }
};

Grid grid_of(const preset::Meter& meter, const scene::MeterSurface& goniometer, const Reading& reading) {
  const int quarter = static_cast<int>(std::ceil(90 / meter.step_deg - 1e-9));
  Grid grid{2 * quarter + 1, 4 * quarter, 90.0 / quarter, {}};
  std::vector<double> values;
  for (const Interval& cell : reading.all().cells[static_cast<std::size_t>(Quantity::illuminance)])
    values.push_back(cell.value);
  for (int plane = 0; plane < grid.planes; ++plane)
    for (int gamma = 0; gamma < grid.gammas; ++gamma)
      grid.candela.push_back(scene::at_direction(goniometer, values, {gamma * grid.step_deg, plane * grid.step_deg}));
  return grid;
}

/// As long as a line of EULUMDAT may be.
std::string cut(const std::string& text) { return text.substr(0, 78); }

double lumens_of(const Reading& reading) { return reading.all().numbers(Quantity::illuminance).total.value; }
double watts_of(const Reading& reading) { return reading.all().numbers(Quantity::irradiance).total.value; }

} // namespace

std::string ies(const preset::Meter& meter, const scene::MeterSurface& goniometer, const Reading& reading,
                const std::string& name) {
  const Grid grid = grid_of(meter, goniometer, reading);
  std::string text = fmt::format(
      "IESNA:LM-63-2002\n[TEST] {}\n[TESTLAB] Nephroid\n[ISSUEDATE] none\n[MANUFAC] Nephroid\n[LUMINAIRE] {}\n"
      "TILT=NONE\n1 {:.6g} 1 {} {} 1 2 0 0 0\n1 1 {:.6g}\n",
      cut(meter.name), cut(name), lumens_of(reading), grid.gammas, grid.planes + 1, watts_of(reading));
  const auto numbers = [&](int count, const auto& number) { // lines of few numbers: some readers take 256 characters
    for (int i = 0; i < count; ++i)
      fmt::format_to(std::back_inserter(text), "{:.6g}{}", number(i), i + 1 == count || i % 12 == 11 ? "\n" : " ");
  };
  numbers(grid.gammas, [&](int i) { return i * grid.step_deg; });
  numbers(grid.planes + 1, [&](int i) { return i * grid.step_deg; });
  for (int plane = 0; plane <= grid.planes; ++plane)
    numbers(grid.gammas, [&](int gamma) { return grid.at(plane, gamma); });
  return text;
}

std::string eulumdat(const preset::Meter& meter, const scene::MeterSurface& goniometer, const Reading& reading,
                     const std::string& name) {
  const Grid grid = grid_of(meter, goniometer, reading);
  const double lumens = lumens_of(reading);
  double below = 0, everywhere = 0; // the flux, up to a factor
  for (int gamma = 0; gamma < grid.gammas; ++gamma)
    for (int plane = 0; plane < grid.planes; ++plane) {
      const double angle = gamma * grid.step_deg, flux = grid.at(plane, gamma) * std::sin(angle * M_PI / 180);
      everywhere += flux;
      below += angle < 90 ? flux : angle > 90 ? 0 : flux / 2;
    }
  std::string text = fmt::format("Nephroid\n3\n0\n{}\n{:.6g}\n{}\n{:.6g}\n{}\n{}\n\n\n\n", grid.planes, grid.step_deg,
                                 grid.gammas, grid.step_deg, cut(meter.name), cut(name));
  for (int i = 0; i < 9; ++i) text += "0\n"; // its sizes
  text += fmt::format("{:.4g}\n100\n1\n0\n1\n1\n-\n{:.6g}\n-\n-\n{:.6g}\n",
                      everywhere > 0 ? 100 * below / everywhere : 0, lumens, watts_of(reading));
  for (int i = 0; i < 10; ++i) text += "0\n"; // ratios for a room's indices
  for (int plane = 0; plane < grid.planes; ++plane) text += fmt::format("{:.6g}\n", plane * grid.step_deg);
  for (int gamma = 0; gamma < grid.gammas; ++gamma) text += fmt::format("{:.6g}\n", gamma * grid.step_deg);
  for (const double candela : grid.candela) text += fmt::format("{:.6g}\n", lumens > 0 ? 1000 * candela / lumens : 0);
  return text;
}

} // namespace nephroid::meters
