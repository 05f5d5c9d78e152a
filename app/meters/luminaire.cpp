// SPDX-License-Identifier: Apache-2.0
#include "meters/luminaire.h"

#include <cmath>

namespace nephroid::meters {

scene::LuminaireGrid luminaire(const preset::Meter& meter, const scene::MeterSurface& goniometer,
                               const Reading& reading) {
  const int quarter = static_cast<int>(std::ceil(90 / meter.step_deg - 1e-9));
  scene::LuminaireGrid grid;
  for (int gamma = 0; gamma <= 2 * quarter; ++gamma) grid.gamma_deg.push_back(gamma * 90.0 / quarter);
  grid.planes = 4 * quarter;
  grid.lumens = reading.all().numbers(Quantity::illuminance).total.value;
  grid.watts = reading.all().numbers(Quantity::irradiance).total.value;
  std::vector<double> values;
  for (const Interval& cell : reading.all().cells[static_cast<std::size_t>(Quantity::illuminance)])
    values.push_back(cell.value);
  for (int plane = 0; plane < grid.planes; ++plane)
    for (const double gamma : grid.gamma_deg)
      grid.candela.push_back(scene::at_direction(goniometer, values, {gamma, grid.c_deg(plane)}));
  return grid;
}

} // namespace nephroid::meters
