// SPDX-License-Identifier: Apache-2.0
#include "photons/development.h"

#include "base/summed_area.h"
#include "photons/mixture.h"
#include "tracing/film.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

namespace nephroid::photons {
namespace {

/// The noise that may remain in what paths from the eye see. Shadows and light from walls are broader than the fine
/// lines of a caustic, and the halves show where they are not.
constexpr double noise_of_paths = 0.02;

/// Adds as many values as both have; a sum that is empty stays so.
void add(const std::vector<float>& more, std::vector<float>& sum) {
  std::ranges::transform(sum, more, sum.begin(), std::plus());
}

/// Several stages may add to one layer. The picture's sum comes last.
void add(const char* name, const LayerEstimate& layer, job::Picture& picture) {
  if (layer.draw.empty()) picture.error_draw.clear();
  add(layer.draw, picture.error_draw);
  std::vector<float>& sum = tracing::layer_of(picture, name).rgb;
  add(layer.rgb, sum);
}

/// The pixels where one path would be confetti: in many blocks around them the two paths of a preview differ by more
/// than light that is lit evenly has. Few blocks do at the edge of a shadow; a fine texture of strong contrast passes
/// for noise.
std::vector<bool> where_paths_are_noisy(const Blocks& blocks, const LayerEstimate& coarse) {
  constexpr int radius = 3;
  constexpr double noise = 0.2, many_of_them = 0.4;
  const SummedArea noisy(blocks.across(), blocks.down(), [&](std::size_t i) {
    double square = 0, light = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3 && !coarse.draw.empty(); ++c)
      square += std::pow(coarse.draw[c], 2), light += coarse.rgb[c];
    return square / 3 > std::pow(noise * light / 3, 2) ? 1.0 : 0.0;
  });
  std::vector<bool> result(static_cast<std::size_t>(blocks.width) * static_cast<std::size_t>(blocks.height));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const int block = static_cast<int>(blocks.block_of(i));
    result[i] = noisy.mean(block % blocks.across(), block / blocks.across(), radius) > many_of_them;
  }
  return result;
}

} // namespace

job::Picture Development::picture() {
  job::Picture picture = black();
  left_.clear();
  bool has_caustics = false;
  for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
    const TimedStage& stage = passes_.stages()[s];
    if (!stage.caustics())
      add(stage.layer, layer_of(s), picture);
    else if (!std::exchange(has_caustics, true))
      add(stage.layer, caustics(), picture);
  }
  for (const job::Layer& layer : picture.layers) add(layer.rgb, picture.rgb);
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

void Development::mix_with_before(const std::string& name, LayerEstimate& layer) {
  if (!is_frame_ || layer.draw.empty()) return;
  const auto before = before_ ? std::ranges::find(*before_, name, &job::Layer::name) : decltype(before_->end())();
  std::vector<float> draw = layer.draw;
  if (before_ && before != before_->end())
    draw = mix_before({before->rgb, before->error_draw}, world_.tables.camera.width, world_.tables.camera.height,
                      layer.rgb, layer.draw);
  left_.push_back({name, layer.rgb, std::move(layer.draw)});
  layer.draw = std::move(draw);
}

void Development::share_work() {
  job::Picture picture = black(), caustics = picture;
  std::vector<std::vector<float>> draws; // each stage's draw
  std::uint64_t photons = 0;
  for (const TimedStage& s : passes_.stages()) {
    job::Picture own = black();
    s.stage->develop(passes_.complete(), false, own);
    if (own.error_draw.empty()) return;
    LayerEstimate layer{own.layers.empty() ? own.rgb : std::move(own.layers[0].rgb), std::move(own.error_draw)};
    if (s.caustics())
      photons += s.stage->photons_per_pass();
    else if (smoothing_ && smooths_paths_)
      smoothing_->pixels().spread(layer.rgb, layer.draw, {}, noise_of_paths);
    add(s.layer, layer, s.caustics() ? caustics : picture);
    draws.push_back(std::move(layer.draw));
  }
  if (draws.empty()) return;
  LayerEstimate splatted{std::move(tracing::layer_of(caustics, "caustic").rgb), std::move(caustics.error_draw)};
  const std::vector<float> plain = splatted.draw;
  if (smoothing_ && photons > 0) smooth(splatted);
  tracing::layer_of(picture, "caustic").rgb = std::move(splatted.rgb);
  for (const job::Layer& layer : picture.layers) add(layer.rgb, picture.rgb);

  const auto noise_of = [&](const std::vector<float>& draw) {
    const Noise noise{draw, picture.rgb};
    double sum = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) sum += noise.of(i);
    return sum;
  };
  const double noise = noise_of(splatted.draw), smoothed = noise > 0 ? noise / noise_of(plain) : 1;
  std::vector<float> seen;                         // the draw of what paths find of caustics in glass
  double by_photons = 0, by_samples = 0, work = 0; // noise that they bring, and the samples' work
  for (std::size_t s = 0; s < draws.size(); ++s) {
    const TimedStage& timed = passes_.stages()[s];
    if (timed.caustics())
      for (float& value : draws[s]) value *= static_cast<float>(std::sqrt(smoothed));
    if (timed.stage->samples_pixels())
      by_samples += noise_of(draws[s]);
    else if (timed.stage->photons_per_pass() > 0 && timed.caustics())
      by_photons += noise_of(draws[s]);
    else if (timed.caustics())
      seen = draws[s];
    work += timed.stage->work();
  }
  // The samples of the direct layer find those, too, and lower that noise.
  for (std::size_t s = 0; s < draws.size(); ++s)
    if (passes_.stages()[s].layer == std::string_view("direct"))
      for (std::size_t i = 0; i < seen.size(); ++i) draws[s][i] = std::hypot(draws[s][i], seen[i]);
  const double gain = by_photons > 0
                          ? by_photons / (static_cast<double>(passes_.complete()) * static_cast<double>(photons))
                          : by_samples / work;
  if (!(gain > 0)) return;
  for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
    Stage& stage = *passes_.stages()[s].stage;
    stage.share_work({stage.samples_pixels() ? draws[s] : splatted.draw, picture.rgb, passes_.complete(), gain});
  }
}

LayerEstimate Development::preview_of(Stage& stage, double noise, std::vector<bool>* noisy) {
  const Blocks& blocks = world_.preview.blocks;
  job::Picture picture = black(blocks);
  stage.develop_preview(picture);
  if (picture.layers.empty()) return {};
  LayerEstimate coarse{std::move(picture.layers[0].rgb), std::move(picture.error_draw)}, pixels;
  if (noisy) *noisy = where_paths_are_noisy(blocks, coarse);
  if (!smoothing_) return between(blocks, coarse);
  timed([&] { pixels = smoothing_->pixels_of(blocks, std::move(coarse), noise); });
  return pixels;
}

LayerEstimate Development::layer_of(std::size_t s) {
  Stage& stage = *passes_.stages()[s].stage;
  const bool is_estimated = !estimate_.empty() && passes_.stages()[s].layer == std::string_view("direct");
  const bool whole = passes_.complete() > 0 || passes_.had_turn(s);
  const bool is_previewed = preview_.has_picture() && !passes_.has_halves(s) && (!whole || smoothing_);
  std::vector<bool> noisy;
  LayerEstimate preview = is_previewed ? preview_of(stage, noise_of_paths, &noisy) : LayerEstimate();
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
  if (preview.rgb.empty()) timed([&] { mix_with_before(stage.name(), layer); });
  if (!preview.rgb.empty()) { // a single sample of each pixel: it shows all of an evenly lit wall, and little of glass
    for (std::size_t i = 0; i < layer.rgb.size(); ++i)
      if (world_.pixels.may_show_glass[i / 3] || noisy[i / 3]) layer.rgb[i] = preview.rgb[i];
    layer.draw = std::move(preview.draw);
  } else if (smoothing_ && smooths_paths_ && passes_.has_halves(s)) {
    timed([&] {
      smoothing_->pixels().spread(layer.rgb, layer.draw, is_estimated ? estimate_ : std::vector<float>(),
                                  noise_of_paths);
    });
  } else if (is_previewed) { // photons of a stage that has no preview of its own
    layer = between(world_.preview.blocks, means(world_.preview.blocks, layer));
  }
  return layer;
}

LayerEstimate Development::caustics() {
  LayerEstimate preview; // of stages that come after all photons of a pass
  job::Picture picture = black();
  tracing::layer_of(picture, "caustic");
  for (std::size_t s = 0; s < passes_.stages().size(); ++s) {
    const TimedStage& timed_stage = passes_.stages()[s];
    if (!timed_stage.caustics()) continue;
    if (!smoothing_ || passes_.has_halves(s) || !preview_.has_picture()) {
      timed_stage.stage->develop(passes_.complete(), passes_.had_turn(s), picture);
    } else {
      LayerEstimate more = preview_of(*timed_stage.stage, Smoothing::usual_noise);
      add(preview.rgb, more.rgb);
      add(preview.draw, more.draw);
      if (!more.rgb.empty()) preview = std::move(more);
    }
  }
  LayerEstimate layer{std::move(picture.layers[0].rgb), std::move(picture.error_draw)};
  timed([&] { mix_with_before("caustic", layer); });
  if (smoothing_ && !layer.draw.empty()) timed([&] { smooth(layer); });
  add(preview.rgb, layer.rgb);
  add(preview.draw, layer.draw);
  return layer;
}

} // namespace nephroid::photons
