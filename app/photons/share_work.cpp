// SPDX-License-Identifier: Apache-2.0
#include "photons/share_work.h"

#include "tracing/film.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace nephroid::photons {

void share_work(const DeviceWorld& world, const Passes& passes, Development& development)
{
  job::Picture picture = development.black(), caustics = picture;
  std::vector<std::vector<float>> draws; // of each stage
  std::uint64_t photons = 0;
  for (const TimedStage& s : passes.stages()) {
    job::Picture& into = s.caustics() ? caustics : picture;
    std::vector<float> before = into.error_draw;
    s.stage->develop(passes.complete(), false, into);
    if (into.error_draw.empty()) return;
    std::transform(into.error_draw.begin(), into.error_draw.end(), before.begin(), before.begin(), std::minus());
    draws.push_back(std::move(before));
    if (s.caustics()) photons += s.stage->photons_per_pass();
  }
  if (photons == 0) return;
  LayerEstimate splatted{std::move(tracing::layer_of(caustics, "caustic").rgb), std::move(caustics.error_draw)};
  if (BlockSmoothing* smoothing = development.smoothing()) smoothing->spread(splatted, {});
  tracing::layer_of(picture, "caustic").rgb = std::move(splatted.rgb);
  for (const job::Layer& layer : picture.layers)
    std::transform(layer.rgb.begin(), layer.rgb.end(), picture.rgb.begin(), picture.rgb.begin(), std::plus());

  Noise caustic_noise_now{splatted.draw, picture.rgb, passes.complete()};
  double noise = 0; // of photons: what glass shows are also paths
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    if (!world.pixels.may_show_glass[i / 3]) noise += caustic_noise_now.of(i);
  if (noise == 0) return;
  caustic_noise_now.photon_gain = noise / (static_cast<double>(passes.complete()) * static_cast<double>(photons));
  for (std::size_t s = 0; s < passes.stages().size(); ++s) {
    const TimedStage& timed = passes.stages()[s];
    timed.stage->share_work(timed.caustics() ? caustic_noise_now : Noise{draws[s], picture.rgb, passes.complete(), caustic_noise_now.photon_gain});
  }
}

} // namespace nephroid::photons
