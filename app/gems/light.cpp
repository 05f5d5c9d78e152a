// SPDX-License-Identifier: Apache-2.0
#include "gems/light.h"

#include "kernels/gems/gem_types.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "tracing/scene_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nephroid::gems {
namespace {

constexpr std::size_t replicates = 8; ///< independent parts, of which intervals are made
constexpr double rounding = 1e-5;     ///< of a share, by single precision
constexpr int tilt_step_deg = 5, most_tilt_deg = 30;
constexpr int tilted_side = 64;  ///< of views that are no pictures, in pixels
constexpr double change_deg = 1; ///< between the two views of the scintillation

/// The stone turned by an angle about an axis of its own, 0 x, 1 y, 2 z, as an eye above sees it.
shared::DeviceGemView view_of(const Stone& stone, glm::length_t axis, double angle_deg) {
  preset::Vec3 turn{0, 0, 0};
  turn[static_cast<std::size_t>(axis)] = angle_deg;
  const glm::dmat3 to_stone = glm::transpose(scene::rotation(turn));
  const auto in_stone = [&](const glm::dvec3& v) { return scene::to_float4(to_stone * v); };
  return {in_stone({1, 0, 0}), in_stone({0, 0, -1}), in_stone({0, 1, 0}),
          scene::to_float4(glm::dvec3(stone.bounds.centre), 1.01 * double{stone.bounds.radius})};
}

/// What a launch's pixels have together: [sum].
std::vector<double> totals_of(const std::vector<float>& sums, std::size_t count) {
  const std::size_t pixels = sums.size() / count;
  std::vector<double> totals(count, 0);
  for (std::size_t i = 0; i < sums.size(); ++i) totals[i / pixels] += sums[i];
  return totals;
}

using Replicates = std::vector<std::vector<double>>; ///< [replicate][sum]

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

meters::Interval share(const Replicates& all, std::size_t part, std::size_t whole, double scale = 1) {
  std::array<double, replicates> values;
  for (std::size_t r = 0; r < replicates; ++r) values[r] = scale * ratio(all[r][part], all[r][whole]);
  return meters::interval_of(values, rounding);
}

Returns returns_of(const Replicates& all) {
  return {share(all, GEM_ISO, GEM_HITS), share(all, GEM_COS, GEM_HITS), share(all, GEM_HEAD, GEM_HITS)};
}

/// The work of one stone on a device.
class Bench {
public:
  Bench(const Stone& stone, const LightOptions& options, const compute::Context& context,
        const std::function<void(double)>& advanced)
      : stone_(stone), options_(options), context_(context), advanced_(advanced),
        nodes_(context, "tree nodes", std::span<const float>(stone.bvh.nodes)),
        blocks_(context, "tree triangles", std::span<const float>(stone.bvh.blocks)),
        primitives_(context, "triangles", tracing::device_primitives(stone.scene)) {
    const compute::Program program(context, "gems/gem.cl", scene::tree_defines(stone.bvh));
    light_ = program.kernel("gem_light");
    change_ = program.kernel("gem_change");
    colour_ = program.kernel("gem_colour");
  }

  /// Of a view; to: where the pixels' sums are added, or null.
  Replicates light(const shared::DeviceGemView& view, std::vector<double>* to) {
    Replicates all;
    for (std::size_t r = 0; r < replicates; ++r) {
      const shared::DeviceGem gem = next(r, to ? options_.side : tilted_side, options_.rays);
      const std::vector<float> sums = run(light_, GEM_SUMS, gem, view, {});
      all.push_back(totals_of(sums, GEM_SUMS));
      lost_ = std::max(lost_, ratio(all.back()[GEM_LOST], all.back()[GEM_HITS]));
      if (!to) continue;
      to->resize(sums.size());
      std::ranges::transform(sums, *to, to->begin(), std::plus<>());
    }
    return all;
  }

  Replicates change(const shared::DeviceGemView& one, const shared::DeviceGemView& other) {
    Replicates all;
    for (std::size_t r = 0; r < replicates; ++r)
      all.push_back(
          totals_of(run(change_, GEM_CHANGE_SUMS, next(r, tilted_side, 4 * options_.rays), one, {{"tilted", other}}),
                    GEM_CHANGE_SUMS));
    return all;
  }

  /// X, Y, Z and the part that shows the stone, [4][pixel].
  std::vector<float> colours(const shared::DeviceGemView& view) {
    constexpr std::size_t bands = 8;
    const int count = bands;
    const optics::Spectrum white = optics::illuminant("D65");
    const optics::ColourMatching& eye = optics::cie_1931();
    std::vector<float> n, loss;
    std::vector<glm::dvec3> colours(bands, glm::dvec3(0));
    for (std::size_t i = 0; i < white.size(); ++i)
      colours[i * bands / white.size()] += white[i] * glm::dvec3(eye.x[i], eye.y[i], eye.z[i]);
    const double luminance =
        std::accumulate(colours.begin(), colours.end(), 0.0, [](double y, const glm::dvec3& c) { return y + c.y; });
    std::vector<shared::float4> xyz;
    for (std::size_t band = 0; band < bands; ++band) {
      const std::size_t middle = (2 * band + 1) * white.size() / (2 * bands);
      n.push_back(static_cast<float>(stone_.n[middle]));
      loss.push_back(static_cast<float>(stone_.loss[middle]));
      xyz.push_back(scene::to_float4(static_cast<double>(bands) / luminance * colours[band]));
    }
    const compute::Buffer<float> n_buffer(context_, "indices", std::span<const float>(n)),
        loss_buffer(context_, "losses", std::span<const float>(loss));
    const compute::Buffer<shared::float4> xyz_buffer(context_, "colours", std::span<const shared::float4>(xyz));
    shared::DeviceGem gem = next(0, options_.side, 0);
    gem.samples = std::max(4, options_.rays / (count * options_.side * options_.side));
    std::vector<float> sums =
        run(colour_, GEM_COLOUR_SUMS, gem, view,
            {{"n", n_buffer}, {"loss", loss_buffer}, {"xyz", xyz_buffer}, {"wavelengths", count}});
    for (float& sum : sums) sum /= static_cast<float>(gem.samples);
    return sums;
  }

  double lost() const { return lost_; }
  int launches = 0; ///< of all, for `advanced`

  /// Of a pixel in one replicate.
  static int samples(int side, int rays) {
    return std::max(1, static_cast<int>(std::lround(rays / (double(replicates) * side * side))));
  }

private:
  shared::DeviceGem next(std::size_t replicate, int side, int rays) const {
    shared::DeviceGem gem{};
    gem.n = static_cast<float>(stone_.n_d);
    gem.n_c = static_cast<float>(stone_.n_c);
    gem.n_f = static_cast<float>(stone_.n_f);
    gem.loss = static_cast<float>(stone_.loss_d);
    gem.cos_head = options_.head_deg > 0 ? static_cast<float>(std::cos(glm::radians(options_.head_deg))) : 2; // none
    gem.root = stone_.bvh.root;
    gem.side = side;
    gem.samples = samples(side, rays);
    gem.first = static_cast<std::uint32_t>(replicate) * static_cast<std::uint32_t>(gem.samples);
    gem.seed = {static_cast<std::uint32_t>(options_.seed), static_cast<std::uint32_t>(options_.seed >> 32)};
    return gem;
  }

  std::vector<float> run(compute::Kernel& kernel, std::size_t count, const shared::DeviceGem& gem,
                         const shared::DeviceGemView& view, std::initializer_list<compute::Argument> own) {
    advanced_(static_cast<double>(done_++) / std::max(launches, 1));
    const auto pixels = static_cast<std::size_t>(gem.side) * static_cast<std::size_t>(gem.side);
    const compute::Buffer<float> sums(context_, "sums", count * pixels);
    const std::array<compute::Argument, 6> shared{{{"nodes", nodes_},
                                                   {"blocks", blocks_},
                                                   {"primitives", primitives_},
                                                   {"view", view},
                                                   {"gem", gem},
                                                   {"sums", sums}}};
    kernel.run(pixels, 64, shared, own);
    return sums.read();
  }

  const Stone& stone_;
  const LightOptions& options_;
  compute::Context context_;
  const std::function<void(double)>& advanced_;
  compute::Buffer<float> nodes_, blocks_;
  compute::Buffer<shared::DevicePrimitive> primitives_;
  compute::Kernel light_, change_, colour_;
  double lost_ = 0;
  int done_ = 0;
};

GemPictures pictures_of(const std::vector<double>& sums, const std::vector<float>& colours, int side, int samples) {
  GemPictures pictures;
  pictures.side = side;
  const std::size_t pixels = colours.size() / GEM_COLOUR_SUMS;
  const auto part = [&](std::size_t sum, std::size_t pixel) { return sums[sum * pixels + pixel]; };
  for (std::size_t i = 0; i < pixels; ++i) {
    for (const auto& [to, sum] : {std::pair(&pictures.outline, GEM_HITS), std::pair(&pictures.iso, GEM_ISO),
                                  std::pair(&pictures.cosine, GEM_COS), std::pair(&pictures.head, GEM_HEAD)})
      to->push_back(static_cast<float>(part(static_cast<std::size_t>(sum), i) / samples));
    pictures.spread_deg.push_back(static_cast<float>(glm::degrees(ratio(part(GEM_SPREAD, i), part(GEM_SPREADS, i)))));
    for (std::size_t c = 0; c < 3; ++c) pictures.xyz.push_back(colours[c * pixels + i]);
    pictures.xyz_outline.push_back(colours[3 * pixels + i]);
  }
  return pictures;
}

} // namespace

GemLight measure_light(const Stone& stone, const LightOptions& options, const compute::Context& context,
                       const std::function<void(double part)>& advanced) {
  Bench bench(stone, options, context, advanced);
  constexpr int views = 4 * most_tilt_deg / tilt_step_deg + 3; // face up, two of change, tilts but for 0
  bench.launches = views * static_cast<int>(replicates) + 1;
  const shared::DeviceGemView above = view_of(stone, 0, 0);
  std::vector<double> sums;
  const Replicates up = bench.light(above, &sums);
  GemLight light;
  light.returns = returns_of(up);
  light.below = share(up, GEM_BELOW, GEM_HITS);
  light.window = share(up, GEM_WINDOW, GEM_HITS);
  light.dark = share(up, GEM_DARK, GEM_HITS);
  if (stone.disperses()) light.fire_deg = share(up, GEM_SPREAD, GEM_SPREADS, 180 / std::numbers::pi);
  const int samples = static_cast<int>(replicates) * Bench::samples(options.side, options.rays);
  light.pictures = pictures_of(sums, bench.colours(above), options.side, samples);
  double hits = 0;
  for (const float part : light.pictures.outline) hits += part;
  const double pixel_mm = 2000 * stone.scene.metres_per_unit * double{above.middle.w} / options.side;
  light.area_mm2 = hits * pixel_mm * pixel_mm;

  Replicates change(replicates, std::vector<double>(GEM_CHANGE_SUMS, 0));
  for (const glm::length_t axis : {0, 2}) {
    const Replicates about = bench.change(view_of(stone, axis, -change_deg / 2), view_of(stone, axis, change_deg / 2));
    for (std::size_t r = 0; r < replicates; ++r)
      std::ranges::transform(about[r], change[r], change[r].begin(), std::plus<>());
    for (int angle = -most_tilt_deg; angle <= most_tilt_deg; angle += tilt_step_deg)
      light.tilts.push_back(
          {axis == 0 ? 'x' : 'z', double(angle),
           angle == 0 ? light.returns : returns_of(bench.light(view_of(stone, axis, angle), nullptr))});
  }
  light.scintillation = share(change, GEM_CHANGE, GEM_PAIRS, 1 / change_deg);
  light.lost = bench.lost();
  return light;
}

} // namespace nephroid::gems
