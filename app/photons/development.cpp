// SPDX-License-Identifier: Apache-2.0
#include "photons/development.h"

#include "tracing/film.h"

#include <algorithm>
#include <functional>
#include <string_view>

namespace nephroid::photons {
namespace {

/// Adds as many values as both have; a sum that is empty stays so.
void add(const std::vector<float>& more, std::vector<float>& sum) {
  std::ranges::transform(sum, more, sum.begin(), std::plus());
}

void add(const char* name, LayerEstimate layer, job::Picture& picture) {
  add(layer.rgb, picture.rgb);
  if (layer.draw.empty()) picture.error_draw.clear();
  add(layer.draw, picture.error_draw);
  picture.layers.push_back({name, std::move(layer.rgb)});
}

} // namespace

job::Picture Development::picture() {
  job::Picture picture = black();
  bool has_caustics = false;
  for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
    const TimedStage& stage = passes_.stages()[s];
    if (!stage.caustics())
      add(stage.layer, layer_of(s), picture);
    else if (!std::exchange(has_caustics, true))
      add(stage.layer, caustics(), picture);
  }
  return picture;
}

job::Picture Development::black(const Blocks& blocks) const {
  job::Picture picture;
  picture.width = blocks.across();
  picture.height = blocks.down();
  picture.rgb.assign(3 * blocks.count(), 0.0f);
  if (!passes_.stages().empty() && world_.halves == 2) picture.error_draw = picture.rgb;
  return picture;
}

void Development::prepare() {
  if (smoothing_ && smooths_paths_) timed([&] { smoothing_->pixels().find_surfaces(); });
}

void Development::smooth(LayerEstimate& caustics) {
  const LayerEstimate plain = smooths_splats_ ? LayerEstimate() : caustics;
  smoothing_->spread(caustics);
  for (std::size_t i = 0; i < plain.rgb.size(); ++i)
    if (!world_.pixels.may_show_glass[i / 3]) caustics.rgb[i] = plain.rgb[i], caustics.draw[i] = plain.draw[i];
}

void Development::share_work() {
  job::Picture picture = black(), caustics = picture;
  std::vector<std::vector<float>> draws; // each stage's draw
  std::uint64_t photons = 0;
  for (const TimedStage& s : passes_.stages()) {
    job::Picture& into = s.caustics() ? caustics : picture;
    std::vector<float> before = into.error_draw;
    s.stage->develop(passes_.complete(), false, into);
    if (into.error_draw.empty()) return;
    std::transform(into.error_draw.begin(), into.error_draw.end(), before.begin(), before.begin(), std::minus());
    draws.push_back(std::move(before));
    if (s.caustics()) photons += s.stage->photons_per_pass();
  }
  if (photons == 0) return;
  LayerEstimate splatted{std::move(tracing::layer_of(caustics, "caustic").rgb), std::move(caustics.error_draw)};
  if (smoothing_) smooth(splatted);
  tracing::layer_of(picture, "caustic").rgb = std::move(splatted.rgb);
  for (const job::Layer& layer : picture.layers) add(layer.rgb, picture.rgb);

  Noise caustic_noise_now{splatted.draw, picture.rgb, passes_.complete()};
  double noise = 0; // photons' alone: what glass shows are also paths, but beside tiles photons are stored for it only
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    if (!smooths_splats_ || !world_.pixels.may_show_glass[i / 3]) noise += caustic_noise_now.of(i);
  if (noise == 0) return;
  caustic_noise_now.photon_gain = noise / (static_cast<double>(passes_.complete()) * static_cast<double>(photons));
  for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
    const TimedStage& timed = passes_.stages()[s];
    timed.stage->share_work(timed.caustics()
                                ? caustic_noise_now
                                : Noise{draws[s], picture.rgb, passes_.complete(), caustic_noise_now.photon_gain});
  }
}

LayerEstimate Development::preview_of(Stage& stage) {
  const Blocks& blocks = world_.preview.blocks;
  job::Picture picture = black(blocks);
  stage.develop_preview(picture);
  if (picture.layers.empty()) return {};
  LayerEstimate coarse{std::move(picture.layers[0].rgb), std::move(picture.error_draw)}, pixels;
  if (!smoothing_) return between(blocks, coarse);
  timed([&] { pixels = smoothing_->pixels_of(blocks, std::move(coarse)); });
  return pixels;
}

LayerEstimate Development::layer_of(std::size_t s) {
  Stage& stage = *passes_.stages()[s].stage;
  const bool is_estimated = !estimate_.empty() && passes_.stages()[s].layer == std::string_view("direct");
  const bool whole = passes_.complete() > 0 || passes_.had_turn(s);
  const bool is_previewed = preview_.has_picture() && !passes_.has_halves(s) && (!whole || smoothing_);
  LayerEstimate preview = is_previewed ? preview_of(stage) : LayerEstimate();
  if (is_estimated && !passes_.has_halves(s)) {
    if (preview.rgb.empty()) return {estimate_, {}};
    for (std::size_t i = 0; i < estimate_.size(); ++i)
      if (!world_.pixels.may_show_glass[i / 3]) preview.rgb[i] = estimate_[i];
    return preview;
  }
  if (!preview.rgb.empty() && !whole) return preview;
  job::Picture picture = black();
  stage.develop(passes_.complete(), passes_.had_turn(s), picture);
  LayerEstimate layer{std::move(picture.layers[0].rgb), std::move(picture.error_draw)};
  if (!preview.rgb.empty()) { // a single sample of each pixel: it shows all of a wall, and little of glass
    for (std::size_t i = 0; i < layer.rgb.size(); ++i)
      if (world_.pixels.may_show_glass[i / 3]) layer.rgb[i] = preview.rgb[i];
    layer.draw = std::move(preview.draw);
  } else if (smoothing_ && smooths_paths_ && passes_.has_halves(s)) {
    timed([&] { smoothing_->pixels().spread(layer.rgb, layer.draw, is_estimated ? estimate_ : std::vector<float>()); });
  } else if (is_previewed) { // photons of a stage that has no preview of its own
    layer = between(world_.preview.blocks, means(world_.preview.blocks, layer));
  }
  return layer;
}

LayerEstimate Development::caustics() {
  LayerEstimate preview; // photon maps' preview; they come after all photons of a pass, and until then glass shows this
  job::Picture picture = black();
  tracing::layer_of(picture, "caustic");
  for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
    const TimedStage& timed_stage = passes_.stages()[s];
    if (!timed_stage.caustics()) continue;
    if (!smoothing_ || passes_.has_halves(s)) {
      timed_stage.stage->develop(passes_.complete(), passes_.had_turn(s), picture);
    } else if (preview_.has_picture()) {
      preview = preview_of(*timed_stage.stage);
    }
  }
  LayerEstimate layer{std::move(picture.layers[0].rgb), std::move(picture.error_draw)};
  if (smoothing_ && !layer.draw.empty()) timed([&] { smooth(layer); });
  add(preview.rgb, layer.rgb);
  add(preview.draw, layer.draw);
  return layer;
}

} // namespace nephroid::photons
