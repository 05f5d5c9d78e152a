// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/pixels.h"

#include "measure/lab.h"
#include "optics/wavelength.h"
#include "ui/widgets/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::ui {
namespace {

using Rgb = std::array<float, 3>;

/// The pixels of a region, row by row.
std::vector<Rgb> pixels_of(const measure::Pixels& picture, const PixelRegion& region) {
  std::vector<Rgb> pixels;
  pixels.reserve(static_cast<std::size_t>(region.to[0] - region.from[0]) *
                 static_cast<std::size_t>(region.to[1] - region.from[1]));
  for (int y = region.from[1]; y < region.to[1]; ++y)
    for (int x = region.from[0]; x < region.to[0]; ++x) {
      const float* rgb = &picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                           static_cast<std::size_t>(x))];
      pixels.push_back({rgb[0], rgb[1], rgb[2]});
    }
  return pixels;
}

PictureStatistics statistics(std::string name, const std::vector<Rgb>& pixels, double white) {
  PictureStatistics picture;
  picture.name = std::move(name);
  picture.pixels = pixels.size();
  std::array<std::vector<double>, 4> values;
  for (auto& list : values) list.reserve(pixels.size());
  for (const Rgb& rgb : pixels) {
    if (std::ranges::any_of(rgb, [](float v) { return std::isnan(v); })) {
      ++picture.nan;
      continue;
    }
    if (std::ranges::any_of(rgb, [](float v) { return std::isinf(v); })) {
      ++picture.infinite;
      continue;
    }
    const double luminance = white * measure::luminance(rgb.data());
    picture.dark += luminance < 0;
    picture.coloured += std::ranges::any_of(rgb, [](float v) { return v < 0; });
    values[0].push_back(luminance);
    for (std::size_t c = 0; c < 3; ++c) values[c + 1].push_back(static_cast<double>(rgb[c]));
  }
  for (std::size_t q = 0; q < 4; ++q) picture.of[q] = moments(std::move(values[q]));
  return picture;
}

Histogram histogram(const std::vector<const std::vector<Rgb>*>& pictures, double white) {
  constexpr double bins_a_decade = 10;
  const auto log_of = [&](const Rgb& rgb) {
    const double y = white * measure::luminance(rgb.data());
    return y > 0 && std::isfinite(y) ? std::log10(y) : std::numeric_limits<double>::quiet_NaN();
  };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* pixels : pictures)
    for (const Rgb& rgb : *pixels)
      if (const double l = log_of(rgb); !std::isnan(l)) low = std::min(low, l), high = std::max(high, l);
  Histogram bars;
  if (low > high) low = 0, high = 1;
  bars.last = std::floor(high * bins_a_decade + 1) / bins_a_decade;
  // Twelve decades are enough for an eye.
  bars.first = std::max(std::floor(low * bins_a_decade) / bins_a_decade, bars.last - 12);
  const auto bins = static_cast<std::size_t>(std::lround((bars.last - bars.first) * bins_a_decade));
  for (const auto* pixels : pictures) {
    std::vector<double>& counts = bars.counts.emplace_back(bins, 0.0);
    for (const Rgb& rgb : *pixels)
      if (const double l = log_of(rgb); l >= bars.first)
        ++counts[std::min(static_cast<std::size_t>((l - bars.first) * bins_a_decade), bins - 1)];
  }
  return bars;
}

} // namespace

std::vector<PixelRow> pixel_rows(const Context& context, const std::array<int, 2>& pixel) {
  const auto source = context.comparing.source();
  if (!source) return {};
  const job::Picture& picture = *source;
  const auto [x, y] = pixel;
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return {};
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  const auto value = [&](std::span<const float> rgb) { return std::array{rgb[at], rgb[at + 1], rgb[at + 2]}; };
  std::vector<PixelRow> rows;
  const auto add = [&](std::string name, const std::array<float, 3>& rgb, bool is_colour) {
    rows.push_back({std::move(name), rgb, context.white() * measure::luminance(rgb.data()),
                    is_colour ? measure::lab_of(rgb.data()) : std::array<double, 3>{}, is_colour});
  };
  const auto add_error = [&](std::string name, const std::array<float, 3>& draw) {
    add(std::move(name), draw, false);
    for (float& channel : rows.back().rgb) channel = std::abs(channel);
    rows.back().luminance = std::abs(rows.back().luminance);
  };
  add(context.comparing.name(), value(picture.rgb), true);
  for (const job::Layer& layer : picture.layers) add(layer.name, value(layer.rgb), true);
  if (!picture.error_draw.empty()) add_error("its error, one draw", value(picture.error_draw));
  const HeldPicture other = context.comparing.other_picture();
  if (!other.owner) return rows;
  const Comparison& comparison = context.comparing.comparison();
  const std::array<float, 3> a = value(context.comparing.picture().pixels.rgb), b = value(other.pixels.rgb);
  const std::string name = comparison.pin == 0 ? "reference" : context.comparing.other_name();
  add(name + (comparison.layer.empty() ? "" : ": " + comparison.layer), b, true);
  add("difference", {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, false);
  if (const measure::Reference* reference = context.run.reference().get();
      comparison.pin == 0 && reference && !reference->error_draw.empty())
    add_error("reference's standard error", value(reference->error_draw));
  return rows;
}

std::string pixel_as_text(const Context& context, const std::array<int, 2>& pixel) {
  std::string text = fmt::format("pixel ({}, {})\tR\tG\tB\tY W/m2/sr\tL*\ta*\tb*\n", pixel[0], pixel[1]);
  for (const PixelRow& row : pixel_rows(context, pixel)) {
    text += fmt::format("{}\t{}\t{}\t{}\t{}", row.name, row.rgb[0], row.rgb[1], row.rgb[2], row.luminance);
    text += row.is_colour ? fmt::format("\t{}\t{}\t{}\n", row.lab[0], row.lab[1], row.lab[2]) : "\t\t\t\n";
  }
  return text;
}

std::vector<double> total_radiance(const job::PixelSpectrum& spectrum) {
  std::vector<double> total(optics::wavelength_count, 0);
  for (const job::PixelSpectrum::Layer& layer : spectrum.layers)
    for (std::size_t w = 0; w < total.size(); ++w) total[w] += layer.radiance[w];
  return total;
}

std::string spectrum_as_csv(const job::PixelSpectrum& spectrum) {
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

Moments moments(std::vector<double> values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {none, none, none, none, none};
  const auto n = static_cast<double>(values.size());
  Moments m{0, 0, values[0], values[0], 0};
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  m.mean = sum / n;
  for (const double v : values) {
    squares += (v - m.mean) * (v - m.mean);
    m.least = std::min(m.least, v);
    m.most = std::max(m.most, v);
  }
  m.deviation = std::sqrt(squares / n);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  m.median = values.size() % 2 == 1 ? *middle : (*middle + *std::max_element(values.begin(), middle)) / 2;
  return m;
}

std::optional<PixelRegion> cut_to(const PixelRegion& region, int width, int height) {
  const PixelRegion cut{{std::max(region.from[0], 0), std::max(region.from[1], 0)},
                        {std::min(region.to[0], width), std::min(region.to[1], height)}};
  if (cut.from[0] >= cut.to[0] || cut.from[1] >= cut.to[1]) return std::nullopt;
  return cut;
}

RegionStatistics region_statistics(RegionRequest request) {
  RegionStatistics all;
  request.region = *cut_to(request.region, request.picture.pixels.width, request.picture.pixels.height);
  const std::vector<Rgb> run = pixels_of(request.picture.pixels, request.region);
  all.pictures.push_back(statistics("run", run, request.white));
  if (request.other.owner) {
    const std::vector<Rgb> other = pixels_of(request.other.pixels, request.region);
    std::vector<Rgb> difference = run;
    for (std::size_t i = 0; i < run.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) difference[i][c] -= other[i][c];
    all.pictures.push_back(statistics(request.other_name, other, request.white));
    all.pictures.push_back(statistics("difference", difference, request.white));
    all.histogram = histogram({&run, &other}, request.white);
  } else
    all.histogram = histogram({&run}, request.white);
  all.of = std::move(request);
  return all;
}

void request_statistics(NewestResult<RegionStatistics>& statistics, TaskQueue& tasks, const RegionRequest& request) {
  const auto is_same_but_picture = [&](const RegionRequest& of) { // whose region is cut to its picture
    return of.region == cut_to(request.region, request.picture.pixels.width, request.picture.pixels.height) &&
           of.other.owner == request.other.owner && of.other_name == request.other_name && of.white == request.white;
  };
  const auto& newest = statistics.newest();
  statistics.want(
      tasks, "statistics of the region", newest && is_same_but_picture(newest->of),
      newest && newest->of.picture.owner == request.picture.owner,
      [request] { return std::make_shared<RegionStatistics>(region_statistics(request)); }, TaskQueue::Clock::now());
}

std::string to_csv(const RegionStatistics& statistics) {
  std::string csv =
      "x0,y0,x1,y1,picture,quantity,unit,mean,standard_deviation,min,max,median,pixels,nan,infinite,negative_luminance,"
      "negative_channel\n";
  const PixelRegion& region = statistics.of.region;
  for (const PictureStatistics& picture : statistics.pictures)
    for (std::size_t q = 0; q < region_quantities.size(); ++q) {
      const Moments& m = picture.of[q];
      csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", region.from[0], region.from[1],
                         region.to[0], region.to[1], in_csv(picture.name), region_quantities[q],
                         q == 0 ? "W/m2/sr" : "linear", m.mean, m.deviation, m.least, m.most, m.median, picture.pixels,
                         picture.nan, picture.infinite, picture.dark, picture.coloured);
    }
  return csv;
}

} // namespace nephroid::ui
