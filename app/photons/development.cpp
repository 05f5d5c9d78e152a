// SPDX-License-Identifier: Apache-2.0
#include "photons/development.h"

#include "base/parallel.h"
#include "base/summed_area.h"
#include "photons/mixture.h"
#include "tracing/film.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// Neighbours in a layer of single samples that differ by a larger part are no grain.
constexpr float step_of_light = 0.25f;

float light_of(const std::vector<float>& rgb, std::size_t pixel) {
  return rgb[3 * pixel] + rgb[3 * pixel + 1] + rgb[3 * pixel + 2];
}

/// [pixel] of a layer: from how many of the four beside it its light differs by more than grain.
std::vector<std::uint8_t> steps_beside(const std::vector<float>& rgb, int width, int height) {
  std::vector<std::uint8_t> steps(rgb.size() / 3);
  for_ranges(steps.size(), static_cast<std::size_t>(width), [&](std::size_t, Range row) {
    for (std::size_t i = row.begin; i < row.end; ++i) {
      const auto look = [&](bool is_there, std::size_t other) {
        if (!is_there) return;
        const float a = light_of(rgb, i), b = light_of(rgb, other);
        if (std::abs(a - b) > step_of_light * std::max(a, b)) ++steps[i];
      };
      const auto down = static_cast<std::size_t>(width);
      look(i > row.begin, i - 1);
      look(i + 1 < row.end, i + 1);
      look(row.begin > 0, i - down);
      look(i + down < down * static_cast<std::size_t>(height), i + down);
    }
  });
  return steps;
}

/// A layer of single samples without those that met a lamp where their neighbours do not, or missed it (salt-and-pepper
/// noise): where two steps are beside a pixel that is far from the median of the 5 x 5 about it, it becomes that.
std::vector<float> without_specks(const std::vector<float>& rgb, const std::vector<std::uint8_t>& steps, int width,
                                  int height) {
  constexpr int radius = 2;
  std::vector<float> result = rgb;
  for_ranges(steps.size(), static_cast<std::size_t>(width), [&](std::size_t, Range row) {
    std::vector<std::pair<float, std::size_t>> around;
    for (std::size_t i = row.begin; i < row.end; ++i) {
      if (steps[i] < 2) continue; // as nearly everywhere: the median takes long
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      around.clear();
      for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u) {
          const std::size_t pixel =
              static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
          around.emplace_back(light_of(rgb, pixel), pixel);
        }
      const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
      std::ranges::nth_element(around, middle);
      if (std::abs(light_of(rgb, i) - middle->first) > step_of_light * middle->first)
        std::copy_n(&rgb[3 * middle->second], 3, &result[3 * i]);
    }
  });
  return result;
}

/// [pixel], 0..1: how much of a layer of single samples is confetti. There neighbours differ again and again; at an
/// edge they do so along a line only.
std::vector<float> confetti(const std::vector<std::uint8_t>& steps, int width, int height) {
  constexpr int radius = 6;
  constexpr double edge = 0.05, noise = 0.12; // parts of all pairs of neighbours
  const SummedArea pairs(width, height, [&](std::size_t i) { return steps[i] / 4.0; });
  std::vector<float> part(steps.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double mean = pairs.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, radius);
    part[i] = static_cast<float>(std::clamp((mean - edge) / (noise - edge), 0.0, 1.0));
  }
  return part;
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

LayerEstimate Development::preview_of(Stage& stage, double noise) {
  const Blocks& blocks = world_.preview.blocks;
  job::Picture picture = black(blocks);
  stage.develop_preview(picture);
  if (picture.layers.empty()) return {};
  return pixels_of({std::move(picture.layers[0].rgb), std::move(picture.error_draw)}, noise);
}

LayerEstimate Development::pixels_of(LayerEstimate coarse, double noise) {
  const Blocks& blocks = world_.preview.blocks;
  if (!smoothing_) return between(blocks, coarse);
  timed([&] { coarse = smoothing_->pixels_of(blocks, std::move(coarse), noise); });
  return coarse;
}

LayerEstimate Development::layer_of(std::size_t s) {
  Stage& stage = *passes_.stages()[s].stage;
  const bool is_estimated = !estimate_.empty() && passes_.stages()[s].layer == std::string_view("direct");
  const bool whole = passes_.complete() > 0 || passes_.had_turn(s);
  const bool is_previewed = preview_.has_picture() && !passes_.has_halves(s) && (!whole || smoothing_);
  LayerEstimate preview = is_previewed ? preview_of(stage, noise_of_paths) : LayerEstimate();
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
    const int width = world_.tables.camera.width, height = world_.tables.camera.height;
    const std::vector<std::uint8_t> steps = steps_beside(layer.rgb, width, height);
    const std::vector<float> noisy = confetti(steps, width, height);
    layer.rgb = without_specks(layer.rgb, steps, width, height);
    for (std::size_t i = 0; i < layer.rgb.size(); ++i)
      layer.rgb[i] += (world_.pixels.may_show_glass[i / 3] ? 1 : noisy[i / 3]) * (preview.rgb[i] - layer.rgb[i]);
    layer.draw = std::move(preview.draw);
  } else if (smoothing_ && smooths_paths_ && passes_.has_halves(s)) {
    timed([&] {
      smoothing_->pixels().spread(layer.rgb, layer.draw, is_estimated ? estimate_ : std::vector<float>(),
                                  noise_of_paths);
    });
  } else if (is_previewed) { // photons of a stage that has no preview of its own: their second half is not complete
    const Blocks& blocks = world_.preview.blocks;
    LayerEstimate coarse{mean_of_blocks(blocks, layer.rgb), {}};
    if (world_.halves == 2) coarse.draw = draw_by_places(blocks, layer.rgb);
    layer = pixels_of(std::move(coarse), noise_of_paths);
    layer.draw.clear(); // it is good enough to smooth by, and no estimate of the error
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
