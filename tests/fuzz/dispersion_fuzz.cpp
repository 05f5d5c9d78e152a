// SPDX-License-Identifier: Apache-2.0
// A refractiveindex.info file, sampled in every way.
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  using optics::Extrapolation;
  const optics::DispersionCurve curve = optics::parse_dispersion(std::string(input), "glass.yml");
  for (const Extrapolation outside :
       {Extrapolation::automatic, Extrapolation::hold, Extrapolation::extrapolate, Extrapolation::refuse}) {
    accepts([&] {
      for (const double n : optics::sample_n(curve, outside))
        if (!(n > 0 && std::isfinite(n))) finding("an index that is none");
    });
    accepts([&] {
      for (const double k : optics::sample_k(curve, outside))
        if (!(k >= 0 && std::isfinite(k))) finding("an extinction that is none");
    });
    accepts([&] { optics::outside_note(curve, outside); });
    for (const double nm : {1e-3, 380.0, 555.5, 780.0, 1e9}) accepts([&] { curve.sample(nm, outside); });
  }
}

std::vector<std::string> seeds() {
  std::vector<std::string> seeds = shipped("materials", ".yml");
  for (int formula = 1; formula <= 9; ++formula)
    seeds.push_back("DATA:\n  - type: formula " + std::to_string(formula) +
                    "\n    wavelength_range: 0.38 0.78\n    coefficients: 2.2 0.01 0.02 0.03 0.04 0.05 0.06\n");
  return seeds;
}

} // namespace nephroid::fuzz
