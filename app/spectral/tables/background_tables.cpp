// SPDX-License-Identifier: Apache-2.0
#include "spectral/tables/background_tables.h"

#include "optics/colour.h"
#include "optics/primary_spectra.h"
#include "tracing/exact_cdf.h"
#include "tracing/scales.h"
#include "tracing/worth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::spectral {
namespace {

using optics::Spectrum;
using optics::wavelength_count;

shared::float4 to_float4(const optics::Colour& xyz)
{
  return {static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2]), 0};
}

optics::Colour one_wavelength(const Spectrum& spectrum, std::size_t w)
{
  const optics::ColourMatching& eye = optics::cie_1931();
  return {spectrum[w] * eye.x[w], spectrum[w] * eye.y[w], spectrum[w] * eye.z[w]};
}

} // namespace

BackgroundTables make_background_tables(const scene::Environment& environment, int pixel_samples)
{
  BackgroundTables tables;
  tables.size = {environment.width, environment.height, static_cast<float>(std::fmod(environment.rotate_deg, 360.0) / 360), 0};
  std::vector<double> weights(wavelength_count, 0.0); // of grey
  for (std::size_t w = 0; w < weights.size(); ++w)
    for (const Spectrum& primary : optics::primary_spectra()) {
      const optics::Colour xyz = one_wavelength(primary, w);
      tables.primary_xyz.push_back(to_float4(xyz));
      weights[w] += tracing::worth((xyz[0] + xyz[1] + xyz[2]) / 3, primary[w]);
    }
  for (const Spectrum& primary : optics::primary_spectra()) tables.primary_xyz.push_back(to_float4(optics::to_xyz(primary)));
  tables.spectrum_cdf = tracing::exact_cdf(weights);
  // 2^24 quanta for a mean texel; all samples of a pixel together cannot leave 63 bits.
  const double mean = std::accumulate(environment.rgb.begin(), environment.rgb.end(), 0.0) / static_cast<double>(environment.rgb.size());
  tables.film_scale = tracing::power_of_two_below(0x1p24 / mean);
  tables.limit = 0x1p62 / pixel_samples;
  return tables;
}

bool goes_one_way(const scene::Scene& scene)
{
  return std::none_of(scene.objects.begin(), scene.objects.end(), [&](const scene::Object& object) {
    const scene::Material& material = material_of(scene, object);
    const auto same = [&](double n) { return n == material.n.front(); };
    return material.type == scene::Material::Type::dielectric && !std::all_of(material.n.begin(), material.n.end(), same);
  });
}

} // namespace nephroid::spectral
