// SPDX-License-Identifier: Apache-2.0
#include "photons/receivers/receiver_light.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

namespace nephroid::photons {
namespace {

/// Bytes that light on receivers may take. Pages are divided as far as they last.
constexpr std::uint64_t most_bytes = std::uint64_t{512} << 20;
constexpr std::size_t most_layers = 16;
constexpr std::size_t page_texels = std::size_t{PAGE_EDGE} * PAGE_EDGE;

template <class Item>
int append(std::vector<int>& table, const std::vector<Item>& items) {
  const auto first = static_cast<int>(table.size());
  table.resize(table.size() + items.size() * sizeof(Item) / sizeof(int));
  if (!items.empty()) std::memcpy(table.data() + first, items.data(), items.size() * sizeof(Item));
  return first;
}

} // namespace

int receiver_layers(std::size_t clusters) {
  return static_cast<int>(std::clamp<std::size_t>(clusters, 1, most_layers));
}

std::uint64_t page_bytes(int layers, unsigned halves) {
  return 3 * page_texels * (sizeof(std::int64_t) + sizeof(float)) * static_cast<std::uint64_t>(layers) * halves;
}

std::size_t most_pages(std::size_t glass_pixels, int layers, unsigned halves) {
  // A page whose texels are as small as it is asked for is what 16 x 16 pixels show; folds and what is above it in its
  // tree take some more.
  constexpr std::size_t roots = 64, times = 4;
  const std::size_t asked = times * glass_pixels / (page_texels / 4) + roots;
  return std::min(asked, static_cast<std::size_t>(most_bytes / page_bytes(layers, halves)));
}

std::vector<int> receiver_table(const Charts& charts, const PageTrees& trees, int layers) {
  std::vector<int> table(sizeof(shared::DeviceReceiverTable) / sizeof(int));
  const shared::DeviceReceiverTable at{append(table, charts.receivers), append(table, trees.roots),
                                       append(table, trees.pages), static_cast<int>(trees.pages.size()), layers};
  std::memcpy(table.data(), &at, sizeof at);
  return table;
}

ReceiverLight::ReceiverLight(tracing::World& world, Charts charts, std::vector<shared::DeviceLook> looks,
                             std::size_t pages, int layers, unsigned halves, double quanta_per_watt)
    : world_(world), charts_(std::move(charts)), layers_(layers), halves_(halves), quanta_per_watt_(quanta_per_watt) {
  std::erase_if(looks, [](const shared::DeviceLook& look) { return look.chart == NO_PAGE; });
  // Every chart that is looked at has a page. Where there are too many for the layers, layers are joined.
  std::set<int> seen;
  for (const shared::DeviceLook& look : looks) seen.insert(look.chart);
  while (layers_ > 1 && page_bytes(layers_, halves) * seen.size() > most_bytes) layers_ /= 2;
  trees_ = make_pages(looks, charts_.count, pages);
  table_ = compute::Buffer<int>(world.context, "pages of receivers", receiver_table(charts_, trees_, layers_));
  const std::size_t size = 3 * page_texels * halves * trees_.pages.size() * static_cast<std::size_t>(layers_);
  sums_ = world.zeroed("light on receivers", size);
  totals_ = compute::zeroed<float>(world.context, "light on receivers that is seen", size);
  const compute::Program program(world.context, "photons/receiver_light.cl", world.defines);
  take_ = program.kernel("take_light");
  sum_ = program.kernel("sum_light");
}

void ReceiverLight::take(double scale, double part) {
  has_light_ = true;
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
               {"scale", static_cast<float>(scale)},
               {"part", static_cast<float>(part)}});
    for (std::size_t level = trees_.first_pages.size() - 1; level-- > 0;) {
      const std::uint32_t first = trees_.first_pages[level], count = trees_.first_pages[level + 1] - first;
      sum_.run(
          items * count, 64,
          {{"receiver_table", table_}, {"totals", totals_}, {"film_half", half}, {"first", first}, {"count", count}});
    }
  }
  world_.context.finish();
}

void ReceiverLight::clear() {
  has_light_ = false;
  sums_.fill_zero();
  totals_.fill_zero();
}

void ReceiverLight::serialize(tracing::Archive& archive) {
  archive.value(has_light_);
  archive.buffer(sums_);
  archive.joined(totals_);
}

} // namespace nephroid::photons
