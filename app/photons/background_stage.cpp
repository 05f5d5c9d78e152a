// SPDX-License-Identifier: Apache-2.0
// The layer "background": kernels/photons/background.cl.
#include "base/counted.h"
#include "kernels/tracing/shared_types.h"
#include "optics/colour.h"
#include "photons/eye_stage.h"
#include "scene/scene.h"
#include "tracing/scales.h"
#include "tracing/scene_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace nephroid::photons {
namespace {

using optics::Spectrum;
using optics::wavelength_count;

optics::Colour one_wavelength(const Spectrum& spectrum, std::size_t w) {
  const optics::ColourMatching& eye = optics::cie_1931();
  return {spectrum[w] * eye.x[w], spectrum[w] * eye.y[w], spectrum[w] * eye.z[w]};
}

struct BackgroundTables {
  shared::DeviceBackground size{};
  std::vector<shared::float4> primary_before; ///< [402][primary]: sums over the wavelengths before
  std::vector<float> spectrum_cdf;            ///< [401]: exact_cdf of what the eye makes of a grey environment
  double film_scale = 1;                      ///< quanta per unit of the picture's values, a power of two
  double limit = 1;                           ///< quanta that one contribution may have
};

/// pixel_samples is the number of a pixel's samples that the film must hold.
BackgroundTables make_background_tables(const scene::Environment& environment, int pixel_samples) {
  BackgroundTables tables;
  tables.size = tracing::picture_size(environment);
  std::vector<double> weights(wavelength_count, 0.0); // for a grey environment
  std::array<glm::dvec3, 3> before{};
  for (std::size_t w = 0; w <= weights.size(); ++w)
    for (std::size_t p = 0; p < before.size(); ++p) {
      tables.primary_before.push_back(tracing::to_float4(before[p]));
      if (w == weights.size()) continue;
      const Spectrum& primary = optics::primary_spectra()[p];
      const optics::Colour xyz = one_wavelength(primary, w);
      before[p] += glm::dvec3(xyz[0], xyz[1], xyz[2]);
      weights[w] += tracing::worth((xyz[0] + xyz[1] + xyz[2]) / 3, primary[w]);
    }
  tables.spectrum_cdf = exact_cdf(weights);
  // A mean texel has 2^24 quanta; all samples of a pixel together stay within 63 bits.
  const double mean = std::accumulate(environment.rgb.begin(), environment.rgb.end(), 0.0) /
                      static_cast<double>(environment.rgb.size());
  tables.film_scale = tracing::power_of_two_below(0x1p24 / mean);
  tables.limit = 0x1p62 / pixel_samples;
  return tables;
}

/// [401]; of a wavelength that is in no cluster the nearest one's.
std::vector<int> clusters_of_wavelengths(const std::vector<std::vector<int>>& clusters) {
  std::vector<int> result(wavelength_count, 0), distance(wavelength_count, wavelength_count);
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (const int w : clusters[c])
      for (int other = 0; other < static_cast<int>(result.size()); ++other) {
        const auto at = static_cast<std::size_t>(other);
        if (std::abs(other - w) >= distance[at]) continue;
        distance[at] = std::abs(other - w);
        result[at] = static_cast<int>(c);
      }
  return result;
}

class BackgroundStage final : public EyeStage {
public:
  BackgroundStage(StageContext& world, const scene::Scene& scene, const Settings& settings)
      : EyeStage(world, "background", "background", settings), radiance_(scene.environment->radiance),
        tables_(make_background_tables(*scene.environment, *settings.pixel_samples)),
        texels_(compute::Buffer(world.context, "environment", scene.environment->rgb)),
        primary_before_(compute::Buffer(world.context, "colours of the primaries", tables_.primary_before)),
        spectrum_cdf_(compute::Buffer(world.context, "wavelengths of the environment", tables_.spectrum_cdf)),
        spectrum_clusters_(compute::Buffer(world.context, "clusters of wavelengths",
                                           clusters_of_wavelengths(world.tables.wavelengths.clusters))) {
    compute::Defines defines = world.eye_defines(true);
    defines.insert_or_assign("NEPHROID_JITTER", std::to_string(1)); // a path has wavelengths, not clusters
    kernel_ = compute::Program(world.context, "photons/background.cl", defines).kernel("background");
  }

private:
  void run(std::uint32_t count, bool, std::initializer_list<compute::Argument> more) override {
    world_.run(kernel_, count, 64,
               {{"texels", texels_},
                {"primary_before", primary_before_},
                {"size", tables_.size},
                {"spectrum_cdf", spectrum_cdf_},
                {"spectrum_clusters", spectrum_clusters_}},
               more);
  }
  float film_scale() const override { return static_cast<float>(tables_.film_scale); }
  double limit() const override { return tables_.limit; }
  double quanta_per_unit() const override { return tables_.film_scale * world_.white / radiance_; }

  double radiance_; ///< radiance of the texel (1, 1, 1)
  BackgroundTables tables_;
  compute::Buffer<float> texels_;
  compute::Buffer<shared::float4> primary_before_;
  compute::Buffer<float> spectrum_cdf_;
  compute::Buffer<int> spectrum_clusters_;
  compute::Kernel kernel_;
};

plan::Decision background_decision(const PlanInput& input) {
  const char* const name = "background";
  const auto& environment = input.scene.environment;
  if (!input.settings.background) return not_asked_for(name, name);
  if (!environment) return {name, false, "there is no environment: what meets nothing is black"};
  if (environment->is_black()) return {name, false, "the environment is black"};
  return {name, true,
          fmt::format("{}, seen directly, through glass and in mirrors; {} a pixel{}", size_of(*environment),
                      counted(*input.settings.pixel_samples, "sample"), more_through_glass(input)),
          "/spectral/background", true};
}

PlanPart plan_background(const PlanInput& input) {
  const std::uint64_t texels = input.scene.environment ? input.scene.environment->rgb.size() : 0;
  return part_of(background_decision(input),
                 {{"environment", texels * sizeof(float)}, {"film background", input.film_bytes()}});
}

} // namespace

const RunPart background_stage{plan_background, make_stage<BackgroundStage>, "background"};

} // namespace nephroid::photons
