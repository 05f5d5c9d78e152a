// SPDX-License-Identifier: Apache-2.0
#include "inverse/spectrum.h"

#include "inverse/bending.h"
#include "inverse/settings.h"
#include "optics/colour.h"
#include "scatter/spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

/// Wavelengths that stand for a band.
constexpr int band_samples = 400;

double weight_of(const LightPart& part) { return part.xyz.x + part.xyz.y + part.xyz.z; }

struct Index {
  bool is_mirror;
  optics::DispersionCurve curve;
  optics::Extrapolation outside;
  Location where;
  const char* remedy;

  double at(double nm) const {
    if (is_mirror) return mirror_index;
    const optics::IndexSample sample = curve.sample(nm, outside);
    if (!sample.n) throw bad_input(where, fmt::format("has no n at {} nm", nm), remedy);
    if (std::abs(*sample.n - 1) < 1e-3 * (1 - 1e-9))
      throw bad_input(where, fmt::format("is {:.5f} at {} nm, which bends hardly any light", *sample.n, nm),
                      "expected one that differs from 1 by at least 0.001");
    return *sample.n;
  }
};

std::vector<LightPart> coloured(const optics::Spectrum& power, const Index& index) {
  const optics::ColourMatching& eye = optics::cie_1931();
  const double luminance = optics::to_xyz(power)[1];
  std::vector<LightPart> parts;
  for (std::size_t i = 0; i < power.size(); ++i)
    if (power[i] > 0)
      parts.push_back({index.at(optics::wavelength_nm(static_cast<int>(i))),
                       power[i] / luminance * glm::dvec3(eye.x[i], eye.y[i], eye.z[i]),
                       static_cast<double>(optics::wavelength_nm(static_cast<int>(i)))});
  return parts;
}

std::vector<LightPart> band(const Settings& s, const Index& index) {
  const int count = s.band_nm > 0 ? band_samples : 1;
  std::vector<LightPart> parts;
  for (int i = 0; i < count; ++i) {
    const double nm = s.wavelength_nm + s.band_nm * ((i + 0.5) / count - 0.5);
    parts.push_back({index.at(nm), glm::dvec3(1.0 / count), nm});
  }
  return parts;
}

} // namespace

std::vector<LightPart> equal_parts(const std::vector<LightPart>& spectrum, std::size_t count) {
  double sum = 0;
  for (const LightPart& piece : spectrum) sum += weight_of(piece);
  const double full = sum / static_cast<double>(count);
  std::vector<LightPart> parts(count, {0, glm::dvec3(0), 0});
  std::size_t k = 0;
  double room = full; // in part k
  for (const LightPart& piece : spectrum) {
    const double weight = weight_of(piece);
    for (double left = weight; left > 0;) {
      const bool fits = left <= room || k + 1 == count;
      const double taken = fits ? left : room;
      parts[k].n += piece.n * taken / full;
      parts[k].nm += piece.nm * taken / full;
      parts[k].xyz += piece.xyz * (taken / weight);
      left = fits ? 0 : left - taken;
      room -= taken;
      if (fits) continue;
      ++k;
      room = full;
    }
  }
  return parts;
}

Refraction make_refraction(const preset::Preset& preset) {
  const Settings& s = settings(preset);
  const Location own = Location(preset.source) / "inverse";
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  const bool is_coloured = s.light.spectrum.has_value();
  const Index index{s.kind == Settings::Kind::mirror, scatter::make_curve(s.index, finder, own / "index"),
                    scatter::outside_policy(s.index.outside), own / "index",
                    is_coloured ? "expected one for all wavelengths of light.spectrum"
                                : "expected another wavelength_nm or a narrower band_nm"};
  const std::vector<LightPart> parts =
      is_coloured ? coloured(scatter::make_light_spectrum(*s.light.spectrum, own / "light" / "spectrum"), index)
                  : band(s, index);
  if (!is_coloured && std::ranges::all_of(parts, [&](const LightPart& part) { return part.n == parts.front().n; }))
    return {parts.front().n, s.wavelength_nm, std::nullopt};
  double n = 0, nm = 0;
  for (const LightPart& part : parts) {
    n += part.n * part.xyz.y;
    nm += part.nm * part.xyz.y;
  }
  return {n, nm, Spectrum{parts, is_coloured}};
}

} // namespace nephroid::inverse
