// SPDX-License-Identifier: Apache-2.0
// Glazings: panes of glass with or without coatings, and insulating glass, as one surface (optics/glazing.h).
#include "optics/glazing.h"

#include "base/numbers.h"
#include "optics/spectrum.h"
#include "scatter/kind.h"
#include "scatter/spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::scatter {
namespace {

constexpr double most_sum = 1.005; // of measured parts, which are not exact

std::vector<optics::Film> films_of(const std::vector<preset::Coating>& coatings, const Loading& loading,
                                   const char* field) {
  std::vector<optics::Film> films;
  for (std::size_t i = 0; i < coatings.size(); ++i)
    loading.curve(coatings[i].dispersion, loading.where / field / i / "dispersion",
                  [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
                    films.push_back({optics::sample_n(curve, outside, loading.range),
                                     optics::sample_k(curve, outside, loading.range), coatings[i].thickness_nm});
                  });
  return films;
}

optics::GlassPane glass_pane(const preset::Pane& from, const Loading& loading) {
  optics::GlassPane pane;
  pane.passes = loading.spectrum(from.tint, "tint");
  const Location where = loading.where / "dispersion";
  loading.curve(from.dispersion, where, [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
    pane.n = optics::sample_n(curve, outside, loading.range);
    const optics::Spectrum k = optics::sample_k(curve, outside, loading.range);
    for (std::size_t w = 0; w < k.size(); ++w)
      pane.passes[w] *=
          std::exp(-4 * std::numbers::pi * k[w] * from.thickness_mm * 1e6 / optics::cells(loading.range).nm[w]);
  });
  if (const auto [low, high] = std::ranges::minmax(pane.n); !(low >= 1 && high <= 4))
    throw bad_input(where, fmt::format("has the index {:.3g}", low < 1 ? low : high), "expected 1 to 4 for a pane",
                    "glass has about 1.5");
  pane.front = films_of(from.front_films, loading, "front_films");
  pane.back = films_of(from.back_films, loading, "back_films");
  return pane;
}

/// Rows of wavelength in nm or, where all are below 100, in micrometres; transmittance; front and back reflectance.
/// What is above the first row, and lines in braces or after '#', are for people.
struct MeasuredRows {
  std::vector<std::array<double, 2>> transmittance, front, back;
};

std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  constexpr std::string_view between = " \t,;\r";
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(between), line.size()));
    if (line.empty()) return numbers;
    const std::size_t length = std::min(line.find_first_of(between), line.size());
    const std::optional<double> number = typed_number<double>(line.substr(0, length));
    if (!number) return {};
    numbers.push_back(*number);
    line.remove_prefix(length);
  }
}

MeasuredRows read_rows(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  MeasuredRows rows;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    ++number;
    const Location where(file.string(), number);
    const std::size_t mark = line.find_first_not_of(" \t\r");
    const std::vector<double> row = numbers_of(line);
    if (mark == std::string_view::npos || line[mark] == '{' || line[mark] == '#') continue;
    if (rows.front.empty() && row.size() != 4) continue;
    if (row.size() != 4)
      throw bad_input(where, "is no row of four numbers",
                      "expected wavelength, transmittance, front, back reflectance");
    if (!(row[0] > (rows.front.empty() ? 0 : rows.front.back()[0])))
      throw bad_input(where, fmt::format("has the wavelength {:g}", row[0]),
                      "expected one above that of the row before");
    for (std::size_t i = 1; i < 4; ++i)
      if (!(row[i] >= 0 && row[i] <= 1))
        throw bad_input(where, fmt::format("has the part {:g}", row[i]), "expected 0 to 1");
    rows.transmittance.push_back({row[0], row[1]});
    rows.front.push_back({row[0], row[2]});
    rows.back.push_back({row[0], row[3]});
  }
  if (rows.front.size() < 2)
    throw bad_input(file.string(), "has no table",
                    "expected two or more rows of wavelength, transmittance, front and back reflectance");
  if (rows.front.back()[0] < 100) // micrometres
    for (auto* table : {&rows.transmittance, &rows.front, &rows.back})
      for (auto& row : *table) row[0] *= 1000;
  return rows;
}

optics::MeasuredPane measured_pane(const preset::Pane& from, const Loading& loading) {
  optics::MeasuredPane pane;
  pane.coated = from.coated;
  if (from.type == preset::Pane::Type::file) {
    const MeasuredRows rows = read_rows(loading.finder.find(from.file, loading.where / "file"));
    pane.transmittance = optics::reflectance_table(rows.transmittance, loading.range);
    pane.front = optics::reflectance_table(rows.front, loading.range);
    pane.back = optics::reflectance_table(rows.back, loading.range);
    loading.known_from(from.file, rows.front.front()[0], rows.front.back()[0]);
  } else {
    pane.transmittance = loading.spectrum(from.transmittance, "transmittance");
    pane.front = loading.spectrum(from.front_reflectance, "front_reflectance");
    pane.back = loading.spectrum(from.back_reflectance, "back_reflectance");
  }
  if (from.flipped) std::swap(pane.front, pane.back);
  constexpr double alike = 0.03; // of two measurements of one glass
  for (std::size_t w = 0; w < pane.front.size(); ++w)
    if (!pane.coated && std::abs(pane.front[w] - pane.back[w]) > alike)
      throw bad_input(loading.where / "coated",
                      fmt::format("is false, and the faces reflect {:.3g} and {:.3g} at {:.0f} nm", pane.front[w],
                                  pane.back[w], optics::cells(loading.range).nm[w]),
                      "expected faces that are alike", "leave it out: a face has a coating");
  for (std::size_t w = 0; w < pane.front.size(); ++w) {
    double &t = pane.transmittance[w], r = std::max(pane.front[w], pane.back[w]);
    if (t + r > most_sum)
      throw bad_input(
          loading.where,
          fmt::format("lets {:.3g} pass and reflects {:.3g} at {:.0f} nm", t, r, optics::cells(loading.range).nm[w]),
          "expected no more than 1 together");
    t = std::min(t, 1 - r);
  }
  return pane;
}

/// The table of kernels/tracing/shared_types.h.
std::vector<double> table_by_angle(std::span<const optics::Pane> panes, optics::SpectralRange range) {
  static_assert(GLAZING_PARTS == optics::wavelength_count + 1);
  constexpr int row_values = GLAZING_ROW;
  constexpr std::size_t row = row_values;
  std::vector<double> table(GLAZING_ANGLES * row);
  const optics::Spectrum sun = optics::blackbody(5778, range);
  const double whole = optics::sum_of(sun);
  for (std::size_t i = 0; i < GLAZING_ANGLES; ++i)
    for (std::size_t w = 0; w < sun.size(); ++w) {
      const double root = double(i) / (GLAZING_ANGLES - 1);
      const optics::GlazingParts at = optics::glazing_parts(panes, root * root, w, range);
      double* column = &table[i * row];
      for (const double part : {at.passes, at.front, at.back}) {
        column[w] = part;
        column[GLAZING_PARTS - 1] += part * sun[w] / whole;
        column += GLAZING_PARTS;
      }
    }
  return table;
}

} // namespace

constinit const Kind kinds::glazing{
    .sentence = "One to three panes of a window or facade as one surface: light goes straight on or is mirrored.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          v.field("panes",
                  "The panes from outside, where the surface's front is, to inside, with air or gas between them. "
                  "Each is a number (mm of clear glass), a file or an object.",
                  m.panes, {.count = {1, 3}, .required = true});
        },
    .load =
        [](const Loading& loading, Material& made) {
          std::vector<optics::Pane> panes;
          for (std::size_t i = 0; i < loading.from.panes.size(); ++i) {
            const preset::Pane& pane = loading.from.panes[i];
            const Location where = loading.where / "panes" / i;
            const Loading of_pane{loading.from, loading.finder, where, loading.range, loading.owner, loading.warnings};
            if (pane.type == preset::Pane::Type::glass)
              panes.emplace_back(glass_pane(pane, of_pane));
            else
              panes.emplace_back(measured_pane(pane, of_pane));
          }
          made.by_angle = table_by_angle(panes, loading.range);
          made.thin = true;
          made.n.fill(1.5); // nothing bends; what asks whether a surface reflects finds that it is no air
          for (std::size_t w = 0; w < made.n.size(); ++w) {
            const optics::GlazingParts straight = optics::glazing_parts(panes, 1, w, loading.range);
            made.reflectance[w] = straight.front;
            made.tint[w] = straight.front < 1 ? std::min(straight.passes / (1 - straight.front), 1.0) : 0;
          }
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          rows.takes_light(true);
          rows.row.surface_first = rows.data(material.by_angle);
        },
    .gltf =
        [](const Material& material) {
          return GltfSurface{.base_colour = material.tint,
                             .roughness = 0,
                             .transmits = true,
                             .left_out = "glazings are clear panes of the colour that they have straight on"};
        },
};

} // namespace nephroid::scatter
