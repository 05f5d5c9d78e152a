// SPDX-License-Identifier: Apache-2.0
#include "photons/receivers/receiver_light.h"

#include "photons/pixel_surfaces.h"
#include "photons/stage_context.h"
#include "tracing/scales.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

namespace nephroid::photons {
namespace {

/// Bytes that light on receivers may take. Pages are divided as far as they last.
constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20;
constexpr std::size_t page_texels = std::size_t{PAGE_EDGE} * PAGE_EDGE;

template <class Item>
int append(std::vector<int>& table, const std::vector<Item>& items) {
  const auto first = static_cast<int>(table.size());
  table.resize(table.size() + items.size() * sizeof(Item) / sizeof(int));
  if (!items.empty()) std::memcpy(table.data() + first, items.data(), items.size() * sizeof(Item));
  return first;
}

/// Of a page. layers: of all kinds.
std::uint64_t page_bytes(int layers, unsigned halves) {
  return 3 * page_texels * (sizeof(std::int64_t) + sizeof(float)) * static_cast<std::uint64_t>(layers) * halves;
}

/// How many pages there may be for so many pixels that show glass or a mirror.
std::size_t most_pages(std::size_t glass_pixels, int layers, unsigned halves) {
  // A page whose texels are as small as it is asked for is what 16 x 16 pixels show; folds and what is above it in its
  // tree take some more.
  constexpr std::size_t roots = 64, times = 4;
  const std::size_t asked = times * glass_pixels / (page_texels / 4) + roots;
  return std::min(asked, static_cast<std::size_t>(most_bytes / page_bytes(layers, halves)));
}

} // namespace

LightLayers make_layers(const tracing::WavelengthTables& tables, bool jitter, std::size_t most) {
  const std::size_t clusters = tables.clusters.size(), members = tables.cluster_wavelengths.size();
  LightLayers layers;
  if (members == 0) return layers;
  const auto chances = tables.wavelength_cdf.end() - static_cast<std::ptrdiff_t>(members); // those of the eye's paths
  std::vector<double> places;                                                              // of the members, and 1
  std::vector<std::size_t> cluster_of;
  for (std::size_t c = 0; c < clusters; ++c)
    for (int m = tables.cluster_first[c]; m < tables.cluster_first[c + 1]; ++m) {
      const double before = m == tables.cluster_first[c] ? 0 : chances[m - 1];
      places.push_back(std::lerp(tables.cluster_cdf[c], tables.cluster_cdf[c + 1], before));
      cluster_of.push_back(c);
    }
  places.push_back(1);
  const bool of_clusters = clusters >= most || !jitter, few = members <= most;
  const std::size_t count = std::min(of_clusters ? clusters : members, most);
  const auto layer_of = [&](std::size_t m) {
    if (of_clusters) return cluster_of[m] * count / clusters;
    return few ? m : std::min(static_cast<std::size_t>((places[m] + places[m + 1]) / 2 * double(count)), count - 1);
  };
  layers.first_members.clear();
  layers.places.clear();
  for (std::size_t m = 0; m < members; ++m) {
    if (m == 0 ||
        layer_of(m) != layer_of(m - 1)) { // a few lines may leave some without members: these are not numbered
      layers.first_members.push_back(static_cast<int>(m));
      layers.places.push_back(static_cast<float>(places[m]));
    }
    layers.of_wavelengths[static_cast<std::size_t>(tables.cluster_wavelengths[m])] =
        static_cast<int>(layers.places.size()) - 1;
  }
  layers.first_members.push_back(static_cast<int>(members));
  layers.places.push_back(1);
  return layers;
}

std::vector<int> receiver_table(const Charts& charts, const PageTrees& trees, const LightLayers& layers) {
  std::vector<int> table(sizeof(shared::DeviceReceiverTable) / sizeof(int));
  const shared::DeviceReceiverTable at{append(table, charts.receivers),      append(table, trees.roots),
                                       append(table, trees.pages),           append(table, layers.first_members),
                                       append(table, layers.places),         append(table, layers.of_wavelengths),
                                       static_cast<int>(trees.pages.size()), layers.count()};
  std::memcpy(table.data(), &at, sizeof at);
  return table;
}

std::uint64_t most_receiver_bytes(const scene::Scene& scene, const tracing::WavelengthTables& tables, bool jitter,
                                  unsigned halves, int kinds) {
  const int layers = kinds * make_layers(tables, jitter, MOST_LAYERS).count();
  return page_bytes(layers, halves) * most_pages(glass_pixels(scene).size(), layers, halves);
}

ReceiverLight::ReceiverLight(tracing::World& world, const Charts& charts, PageTrees trees, const LightLayers& layers,
                             unsigned halves, int kinds, double quanta_per_watt)
    : world_(world), trees_(std::move(trees)), layers_(layers.count()), halves_(halves),
      quanta_per_watt_(quanta_per_watt),
      table_(world.context, "pages of receivers", receiver_table(charts, trees_, layers)) {
  const std::size_t size = 3 * page_texels * halves * trees_.pages.size() * static_cast<std::size_t>(kinds * layers_);
  sums_ = world.zeroed("light on receivers", size);
  totals_ = compute::zeroed<float>(world.context, "light on receivers that is seen", size);
  const compute::Program program(world.context, "photons/receiver_light.cl", world.defines);
  take_ = program.kernel("take_light");
  sum_ = program.kernel("sum_light");
  clear_ = program.kernel("clear_light");
}

void ReceiverLight::take_tiles(double scale, double part) {
  take(KindOfLight::caustic, {scale, scale}, part, false);
  if (trees_.pages.empty()) return;
  for (unsigned half = 0; half < halves_; ++half)
    clear_.run(page_texels * static_cast<std::size_t>(layers_) * trees_.pages.size(), 64,
               {{"receiver_table", table_},
                {"sums", sums_},
                {"film_half", half},
                {"kind", static_cast<int>(KindOfLight::caustic)}});
}

void ReceiverLight::take_points(KindOfLight kind, std::array<double, 2> count) {
  take(kind, {count[0] > 0 ? 1 / count[0] : 0, count[1] > 0 ? 1 / count[1] : 0}, 1, true);
}

void ReceiverLight::take(KindOfLight kind, std::array<double, 2> scale, double part, bool are_points) {
  if (trees_.pages.empty()) return;
  const bool is_alone = world_.context.communicator().is_alone();
  const compute::Buffer<std::int64_t> all =
      is_alone
          ? sums_
          : compute::Buffer<std::int64_t>(world_.context, "light of all ranks", world_.context.all_reduced_sum(sums_));
  const std::size_t items = page_texels * static_cast<std::size_t>(layers_);
  for (unsigned half = 0; half < halves_; ++half) {
    take_.run(items * trees_.pages.size(), 64,
              {{"receiver_table", table_},
               {"sums", all},
               {"totals", totals_},
               {"film_half", half},
               {"kind", static_cast<int>(kind)},
               {"scale", static_cast<float>(scale[half])},
               {"part", static_cast<float>(part)},
               {"undivided_only", static_cast<int>(are_points)}});
    for (std::size_t level = trees_.first_pages.size() - 1; level-- > 0;) {
      const std::uint32_t first = trees_.first_pages[level], count = trees_.first_pages[level + 1] - first;
      sum_.run(items * count, 64,
               {{"receiver_table", table_},
                {"totals", totals_},
                {"film_half", half},
                {"kind", static_cast<int>(kind)},
                {"first", first},
                {"count", count}});
    }
  }
  world_.context.finish();
}

void ReceiverLight::clear() {
  sums_.fill_zero();
  totals_.fill_zero();
}

void ReceiverLight::serialize(tracing::Archive& archive) {
  archive.buffer(sums_);
  archive.joined(totals_);
}

ReceiverLight make_receiver_light(StageContext& world, const scene::Scene& scene) {
  const int kinds = world.defines.at("NEPHROID_KINDS_OF_LIGHT") == "2" ? 2 : 1;
  // One pixel of four asks, where there are many.
  constexpr std::size_t enough = 20'000;
  std::vector<std::uint32_t> pixels = world.pixels.glass;
  if (pixels.size() > enough)
    std::erase_if(pixels, [&](std::uint32_t pixel) {
      const auto width = static_cast<std::uint32_t>(world.tables.camera.width);
      return pixel % width % 2 != 0 || pixel / width % 2 != 0;
    });
  const Charts charts = make_charts(scene);
  const auto count = static_cast<std::uint32_t>(pixels.size());
  const compute::Buffer<int> table(world.context, "charts of receivers", receiver_table(charts, {}, {}));
  const compute::Buffer<std::uint32_t> on_device(world.context, "pixels that ask", pixels);
  const compute::Buffer<shared::DeviceLook> looks(world.context, "looks",
                                                  std::size_t{ASKING_SAMPLES} * ASKING_ENDS * count);
  compute::Kernel ask =
      compute::Program(world.context, "photons/receiver_pages.cl", world.eye_defines(true)).kernel("ask_for_pages");
  if (count > 0)
    world.run(ask, std::size_t{ASKING_SAMPLES} * count, 64,
              {{"receiver_table", table},
               {"camera", world.tables.camera},
               {"pixels", on_device},
               {"seed", world.seed},
               {"count", count},
               {"looks", looks}});
  std::vector<shared::DeviceLook> asked = looks.read();
  std::erase_if(asked, [](const shared::DeviceLook& look) { return look.chart == NO_PAGE; });
  // Every chart that is looked at has a page. Where there are too many for the layers, layers are joined.
  std::set<int> seen;
  for (const shared::DeviceLook& look : asked) seen.insert(look.chart);
  std::size_t most = MOST_LAYERS;
  LightLayers layers;
  do {
    layers = make_layers(world.tables.wavelengths, world.defines.at("NEPHROID_JITTER") == "1", most);
    most /= 2;
  } while (most > 0 && page_bytes(kinds * layers.count(), world.halves) * seen.size() > most_bytes);
  return {world,
          charts,
          make_pages(asked, charts.count, most_pages(world.pixels.glass.size(), kinds * layers.count(), world.halves)),
          layers,
          world.halves,
          kinds,
          tracing::power_of_two_below(std::exp2(20) * world.tables.photons_per_batch /
                                      world.tables.light_towards_targets_w)};
}

} // namespace nephroid::photons
