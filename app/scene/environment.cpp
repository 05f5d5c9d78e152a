// SPDX-License-Identifier: Apache-2.0
#include "scene/environment.h"

#include "base/counted.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

namespace nephroid::scene {
namespace {

/// Textures are held in memory twice while they are read, and once on the device: 2 GiB of floats there.
constexpr std::size_t most_texels = std::size_t{1} << 27;

void check_texels(const std::vector<float>& rgb, int width, const Location& file) {
  const auto bad = std::ranges::find_if(rgb, [](float value) { return !(value >= 0 && std::isfinite(value)); });
  if (bad == rgb.end()) return;
  const auto index = static_cast<std::size_t>(bad - rgb.begin()), texel = index / 3;
  const char* const channels[] = {"red", "green", "blue"};
  const char* const fault = std::isnan(*bad) ? "is not a number" : std::isinf(*bad) ? "is infinite" : "is negative";
  throw bad_input(file,
                  fmt::format("{} of the texel in row {}, column {} (from 0) {}", channels[index % 3],
                              texel / static_cast<std::size_t>(width), texel % static_cast<std::size_t>(width), fault),
                  "expected radiances of 0 or more", "mend the picture");
}

/// A file that is compressed with loss, or was sharpened, has values a little below 0 in dark places. Where they are
/// next to nothing in sum they become 0, and that is said; others are left for check_texels to refuse.
void mend_negative_texels(std::vector<float>& rgb, const std::string& name, std::vector<std::string>& warnings) {
  constexpr double next_to_nothing = 1e-3;
  double above = 0, below = 0;
  for (const float value : rgb) (value < 0 ? below : above) += std::abs(double(value));
  const auto count = std::ranges::count_if(rgb, [](float value) { return value < 0; });
  if (count == 0 || !(below <= next_to_nothing * above)) return;
  std::ranges::replace_if(
      rgb, [](float value) { return value < 0; }, 0.0f);
  warnings.push_back(fmt::format("environment {}: {} below 0, in sum {:.1g} of all its light; they are taken as 0",
                                 name, counted(count, "value is", "values are"), below / above));
}

/// The film has 2^24 quanta for a mean texel (photons/background_stage.cpp). Says where few texels are so bright that
/// half of the others, but for those of 0, get fewer than 16.
void check_range(const std::vector<float>& rgb, const std::string& name, std::vector<std::string>& warnings) {
  const double mean = std::accumulate(rgb.begin(), rgb.end(), 0.0) / static_cast<double>(rgb.size()),
               least = 0x1p-20 * mean;
  const auto lit = std::ranges::count_if(rgb, [](float value) { return value > 0; });
  const auto faint = std::ranges::count_if(rgb, [&](float value) { return value > 0 && double(value) < least; });
  if (faint <= lit / 2) return;
  std::vector<float> values; // copied only where there is something to say: maps are large
  values.reserve(static_cast<std::size_t>(lit));
  std::copy_if(rgb.begin(), rgb.end(), std::back_inserter(values), [](float value) { return value > 0; });
  const auto middle = values.begin() + lit / 2;
  std::nth_element(values.begin(), middle, values.end());
  warnings.push_back(fmt::format("environment {}: half of its values above 0 are below {:.1g} of its mean, less than "
                                 "the film's numbers resolve, and "
                                 "look black or are noise; clip its brightest texels",
                                 name, double(*middle) / mean));
}

/// Colours of other primaries than sRGB's that sRGB does not have are mixed with grey of their luminance.
void mix_colours_beyond_srgb(std::vector<float>& rgb, const std::string& name, std::vector<std::string>& warnings) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const float least = std::min({rgb[i], rgb[i + 1], rgb[i + 2]});
    const float luminance = 0.2126f * rgb[i] + 0.7152f * rgb[i + 1] + 0.0722f * rgb[i + 2];
    if (!(least < 0 && luminance > 0 && std::isfinite(luminance))) continue;
    for (std::size_t c = i; c < i + 3; ++c)
      rgb[c] = rgb[c] == least ? 0 : luminance + luminance / (luminance - least) * (rgb[c] - luminance);
    ++count;
  }
  if (count > 0)
    warnings.push_back(fmt::format("environment {}: {} a colour that sRGB does not have, mixed with as much grey as "
                                   "needed; luminances are kept",
                                   name, counted(count, "texel has", "texels have")));
}

void multiply_by_alpha(image::Rgb& colours) {
  for (std::size_t p = 0; p < colours.alpha.size(); ++p)
    for (std::size_t c = 3 * p; c < 3 * p + 3; ++c) colours.values[c] *= colours.alpha[p];
}

/// A preset says how bright white is; a file that says so, too, may mean something else.
void compare_white(double white_cd_m2, double radiance, const std::string& name, std::vector<std::string>& warnings) {
  constexpr double lumens_of_watt = 683; // of light at 555 nm, by which luminances in W/(m^2 sr) are weighted
  const double said = white_cd_m2 / lumens_of_watt;
  if (said > 0 && std::abs(said / radiance - 1) > 1e-3)
    warnings.push_back(fmt::format("environment {}: its file says that white has {:g} cd/m^2; a 'radiance' of {:.4g} "
                                   "makes it so, and the preset has {:g}",
                                   name, white_cd_m2, said, radiance));
}

/// The picture alone, without how bright it is and how it is turned.
Environment read_environment(const std::filesystem::path& file, double radiance, std::vector<std::string>& warnings) {
  const image::Image picture = image::read_image(file);
  const std::string name = file.filename().string();
  if (const auto format = picture.attributes.find("textureformat");
      format != picture.attributes.end() && format->second.find("Cube") != std::string::npos)
    throw bad_input(file.string(), "is a cube of six pictures", "expected a latitude-longitude picture", "convert it");
  if (picture.data.size() / picture.channels.size() > most_texels)
    throw bad_input(file.string(), fmt::format("has {} x {} texels", picture.width, picture.height),
                    fmt::format("expected at most {} in all", most_texels), "make it smaller");
  Environment result;
  result.width = picture.width;
  result.height = picture.height;
  for (const std::string& note : picture.notes) warnings.push_back(fmt::format("environment {}: {}", name, note));
  compare_white(picture.white_cd_m2, radiance, name, warnings);
  image::Rgb colours = image::rgb_of(picture, file.string());
  if (picture.integers) multiply_by_alpha(colours);
  result.rgb = std::move(colours.values);
  if (picture.chromaticities || !picture.profile.empty()) mix_colours_beyond_srgb(result.rgb, name, warnings);
  mend_negative_texels(result.rgb, name, warnings);
  check_texels(result.rgb, result.width, file);
  check_range(result.rgb, name, warnings);
  if (result.width != 2 * result.height)
    warnings.push_back(
        fmt::format("environment {}: has {} x {} texels; a latitude-longitude picture is twice as wide as high, "
                    "so it is stretched to that",
                    name, result.width, result.height));
  return result;
}

using Moments = std::array<std::array<double, 3>, 3>;

/// Adds a texel's flux, and by that weight its colour over grey and the colour's products.
void add_texel(const Environment& environment, std::size_t texel, double steradians, EnvironmentFlux& flux,
               Moments& products) {
  const double value = grey(environment, texel);
  if (!(value > 0)) return;
  const double weight = value * steradians;
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) colour[c] = environment.rgb[3 * texel + c] / value;
  flux.grey += weight;
  for (std::size_t c = 0; c < 3; ++c) {
    flux.mean[c] += weight * colour[c];
    for (std::size_t d = 0; d < 3; ++d) products[c][d] += weight * colour[c] * colour[d];
  }
}

} // namespace

bool Environment::is_black() const {
  return !(radiance > 0) || std::ranges::all_of(rgb, [](float value) { return value == 0; });
}

Environment make_environment(const preset::Environment& environment, const FileFinder& finder, const Location& where,
                             std::vector<std::string>& warnings, optics::SpectralRange range) {
  Environment result;
  if (environment.type == preset::Environment::Type::file) {
    result = read_environment(finder.find(environment.file, where / "file"), environment.radiance, warnings);
    result.rotate_deg = environment.rotate_deg;
  } else if (environment.type == preset::Environment::Type::sky) {
    result = make_sky(environment, range);
    mix_colours_beyond_srgb(result.rgb, "sky", warnings);
    result.rotate_deg = environment.rotate_deg;
  } else {
    result.width = result.height = 1;
    for (const double value : environment.colour) result.rgb.push_back(static_cast<float>(value));
    check_texels(result.rgb, 1, where / "colour");
  }
  if (environment.type != preset::Environment::Type::sky) result.primaries = optics::primary_spectra(range);
  result.radiance = environment.radiance;
  result.lights = environment.lights && !result.is_black();
  return result;
}

double grey(const Environment& environment, std::size_t texel) {
  const float* rgb = environment.rgb.data() + 3 * texel;
  return (double(rgb[0]) + rgb[1] + rgb[2]) / 3;
}

// cos a - cos b as a product, which stays exact for thin rows and at the poles.
double texel_steradians(const Environment& environment, int row) {
  using std::numbers::pi;
  const double step = pi / environment.height;
  return 2 * pi / environment.width * 2 * std::sin((row + 0.5) * step) * std::sin(0.5 * step);
}

EnvironmentFlux flux_of(const Environment& environment) {
  EnvironmentFlux flux;
  Moments products{};
  const auto width = static_cast<std::size_t>(environment.width);
  for (int row = 0; row < environment.height; ++row) {
    const double steradians = texel_steradians(environment, row);
    for (std::size_t column = 0; column < width; ++column)
      add_texel(environment, static_cast<std::size_t>(row) * width + column, steradians, flux, products);
  }
  for (double& channel : flux.mean) channel /= flux.grey;
  const std::array<optics::Spectrum, 3>& primaries = environment.primaries;
  for (std::size_t w = 0; w < flux.spectrum.size(); ++w) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d) square += products[c][d] / flux.grey * primaries[c][w] * primaries[d][w];
    flux.spectrum[w] = std::sqrt(std::max(square, 0.0));
  }
  flux.power = std::accumulate(flux.spectrum.begin(), flux.spectrum.end(), 0.0);
  for (double& value : flux.spectrum) value /= flux.power;
  return flux;
}

Light make_environment_light(const Environment& environment) {
  const EnvironmentFlux flux = flux_of(environment);
  Light light;
  light.type = preset::Light::Type::directional;
  light.irradiance_w_m2 = environment.radiance * flux.grey * flux.power;
  light.spectrum = flux.spectrum;
  light.primaries.assign(environment.primaries.begin(), environment.primaries.end());
  for (optics::Spectrum& primary : light.primaries)
    for (double& value : primary) value /= flux.power;
  return light;
}

} // namespace nephroid::scene
