// SPDX-License-Identifier: Apache-2.0
#include "run/exposure.h"

#include "measure/lab.h"
#include "preset/settings_type.h"
#include "run/night.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::run {
namespace {

/// Light is alike in small pictures, and their pixels have less noise.
constexpr int longest_edge = 256;

/// The luminance that half of the pixels lie below, each counted by the root of its luminance: so neither a black
/// background nor a small caustic decides. 0 for a black picture.
double middle_luminance(const std::vector<float>& rgb) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    if (const double y = measure::luminance(&rgb[i]); y > 0 && std::isfinite(y)) luminances.push_back(y);
  std::ranges::sort(luminances);
  double weight = 0, below = 0;
  for (const double y : luminances) weight += std::sqrt(y);
  for (const double y : luminances)
    if ((below += std::sqrt(y)) >= weight / 2) return y;
  return 0;
}

/// Evenly chosen pixels, some 16,000 of a large picture: the window asks again and again.
job::Picture few_pixels(const job::Picture& picture) {
  const std::size_t step = 1 + picture.rgb.size() / 3 / 16384;
  const auto few = [&](const std::vector<float>& rgb) {
    std::vector<float> chosen;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3 * step)
      chosen.insert(chosen.end(), {rgb[i], rgb[i + 1], rgb[i + 2]});
    return chosen;
  };
  job::Picture chosen;
  chosen.rgb = few(picture.rgb);
  for (const job::Layer& layer : picture.layers)
    if (layer.name == "caustic") chosen.layers.push_back({layer.name, few(layer.rgb)});
  return chosen;
}

} // namespace

double white_for(const job::Picture& picture) {
  const double whole = middle_luminance(picture.rgb);
  std::vector<float> rest = picture.rgb;
  for (const job::Layer& layer : picture.layers)
    if (layer.name == "caustic") std::ranges::transform(rest, layer.rgb, rest.begin(), std::minus());
  const double without_caustics = middle_luminance(rest);
  const double middle = without_caustics > whole / 8 ? without_caustics : whole;
  return middle > 0 ? std::clamp(std::stod(fmt::format("{:.1e}", 2 * middle)), 1e-12, 1e12) : 1;
}

std::string exposure_note(const job::Picture& picture, const preset::Preset& preset, const std::string& white_by) {
  constexpr double most_above = 0.2, blackest = 0.5 / 255 / 12.92; // that is shown as more than 0
  constexpr double little = 1.5;                                   // of a factor that changes
  if (!preset::has_white(preset) || picture.rgb.empty()) return {};
  std::size_t above = 0;
  double most = 0;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    const double y = measure::luminance(&picture.rgb[i]);
    above += y > 1;
    most = std::max(most, y);
  }
  const double part = 3 * static_cast<double>(above) / static_cast<double>(picture.rgb.size());
  if (!(most > 0)) return "the picture is black: no light comes to the camera";
  if (most > blackest && part < most_above) return {};
  const double factor = white_for(few_pixels(picture));
  if (most > blackest && factor < little) return {};
  const std::string white = fmt::format("{:.2g}", preset.white.value_or(1) * factor);
  return fmt::format("{}: {} shows it",
                     most > blackest ? fmt::format("{:.0f} % of the picture is above white", 100 * part)
                                     : std::string("the picture is too dark to be seen"),
                     fmt::format(fmt::runtime(white_by), white));
}

double fitted_white(preset::Preset preset, std::optional<Prepared>& lender, DeviceOnDemand& device,
                    const Watch& watch) {
  // The engine's pictures may be bright as they are.
  if (!preset::has_white(preset)) return 1;
  preset = by_day(preset);
  preset.white = 1;
  preset.seed = 1; // runs that differ in their noise alone can be compared
  preset.stop = {};
  preset.stop.passes = 1;
  preset.reference.reset();
  auto& [width, height] = preset.scene.camera.resolution;
  const double scale = std::min(1.0, longest_edge / static_cast<double>(std::max(width, height)));
  for (int* edge : {&width, &height}) *edge = std::max(1, static_cast<int>(std::lround(*edge * scale)));
  lender.emplace(prepare(preset, lender ? &*lender : nullptr, watch));
  const compute::Context& context = device.context(watch);
  const compute::TellOfCompiling telling(context, [&] { watch.begin("compiling kernels"); });
  const auto begin_step = [&] { watch.begin("fitting white to a small picture"); };
  begin_step();
  const job::Snapshot first = render_picture(*lender, context, [&](const job::Progress& progress) {
    begin_step();
    return progress.step < 1;
  });
  return white_for(*first.picture);
}

} // namespace nephroid::run
