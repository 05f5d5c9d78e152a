// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/pixel.h"

#include "measure/lab.h"
#include "optics/wavelength.h"
#include "ui/widgets/plots.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::ui {

std::vector<PixelRow> pixel_rows(const Context& context, const std::array<int, 2>& pixel)
{
  if (!context.run.snapshot() || !context.preset()) return {};
  const job::Picture& picture = *context.run.snapshot()->picture;
  const auto [x, y] = pixel;
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return {};
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  const auto value = [&](std::span<const float> rgb) { return std::array{rgb[at], rgb[at + 1], rgb[at + 2]}; };
  std::vector<PixelRow> rows;
  const auto add = [&](std::string name, const std::array<float, 3>& rgb, bool is_colour) {
    rows.push_back({std::move(name), rgb, context.preset()->white * measure::luminance(rgb.data()),
                    is_colour ? measure::lab_of(rgb.data()) : std::array<double, 3>{}, is_colour});
  };
  const auto add_error = [&](std::string name, const std::array<float, 3>& draw) {
    add(std::move(name), draw, false);
    for (float& channel : rows.back().rgb) channel = std::abs(channel);
    rows.back().luminance = std::abs(rows.back().luminance);
  };
  add("this run", value(picture.rgb), true);
  for (const job::Layer& layer : picture.layers) add(layer.name, value(layer.rgb), true);
  if (!picture.error_draw.empty()) add_error("its error, one draw", value(picture.error_draw));
  const HeldPicture other = context.comparing.other_picture();
  if (!other.owner) return rows;
  const Comparison& comparison = context.comparing.comparison();
  const PinnedRun* pin = context.comparing.pinned().find(comparison.pin);
  const std::array<float, 3> a = value(context.comparing.picture().pixels.rgb), b = value(other.pixels.rgb);
  add(fmt::format("{}{}{}", pin ? fmt::format("\"{}\"", pin->name) : "reference", comparison.layer.empty() ? "" : ": ", comparison.layer),
      b, true);
  add("difference", {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, false);
  if (const measure::Reference* reference = context.run.reference().get(); !pin && reference && !reference->error_draw.empty())
    add_error("reference's standard error", value(reference->error_draw));
  return rows;
}

std::string pixel_as_text(const Context& context, const std::array<int, 2>& pixel)
{
  std::string text = fmt::format("pixel ({}, {})\tR\tG\tB\tY W/m2/sr\tL*\ta*\tb*\n", pixel[0], pixel[1]);
  for (const PixelRow& row : pixel_rows(context, pixel)) {
    text += fmt::format("{}\t{}\t{}\t{}\t{}", row.name, row.rgb[0], row.rgb[1], row.rgb[2], row.luminance);
    text += row.is_colour ? fmt::format("\t{}\t{}\t{}\n", row.lab[0], row.lab[1], row.lab[2]) : "\t\t\t\n";
  }
  return text;
}

std::vector<double> total_radiance(const job::PixelSpectrum& spectrum)
{
  std::vector<double> total(optics::wavelength_count, 0);
  for (const job::PixelSpectrum::Layer& layer : spectrum.layers)
    for (std::size_t w = 0; w < total.size(); ++w) total[w] += layer.radiance[w];
  return total;
}

std::string spectrum_as_csv(const job::PixelSpectrum& spectrum)
{
  std::string csv = "wavelength_nm";
  for (const auto& layer : spectrum.layers) csv += fmt::format(",{}", in_csv(layer.name + " W/m2/sr/nm"));
  csv += ",total W/m2/sr/nm\n";
  const std::vector<double> total = total_radiance(spectrum);
  for (std::size_t w = 0; w < total.size(); ++w) {
    csv += std::to_string(optics::wavelength_nm(static_cast<int>(w)));
    for (const auto& layer : spectrum.layers) csv += fmt::format(",{}", layer.radiance[w]);
    csv += fmt::format(",{}\n", total[w]);
  }
  return csv;
}

} // namespace nephroid::ui
