// SPDX-License-Identifier: Apache-2.0
#include "environment/view/receivers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace nephroid::environment {
namespace {

constexpr std::size_t square = 4; ///< texels across and down; divides a cube's size

std::size_t texels_of(int size) { return 6 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }

} // namespace

std::uint64_t Receivers::bytes(int size) {
  return texels_of(size) * (sizeof(int) + 7 * sizeof(float) + sizeof(shared::float4) + sizeof(std::uint32_t));
}

Receivers::Receivers(const mpi::RankContext& context, int size)
    : context_(context), size_(size), states_(context, "wanted receivers", texels_of(size)),
      distances_(context, "receivers' distances", texels_of(size)),
      caustics_(context, "caustics on receivers", 3 * texels_of(size)),
      parts_seen_(context, "environment that receivers see", 3 * texels_of(size)),
      normals_(context, "receivers' normals", texels_of(size)), list_(context, "list of receivers", texels_of(size)) {
  list_on_host_.reserve(texels_of(size));
  caustics_.fill_zero();
  forget();
}

void Receivers::forget() {
  states_.fill_zero();
  distances_.write(std::vector<float>(distances_.size(), std::numeric_limits<float>::infinity()));
  list_on_host_.clear();
  known_ = lit_ = shared_ = 0;
}

void Receivers::find_wanted(std::optional<Surroundings>& surroundings, const glm::dvec3& middle) {
  states_read_ = context_.all_reduced_or(states_);
  // Square after square: neighbouring texels look up neighbouring places. It is a sixth faster than row after row.
  const std::size_t size = static_cast<std::size_t>(size_);
  for (std::size_t top = 0; top < 6 * size; top += square)
    for (std::size_t left = 0; left < size; left += square)
      for (std::size_t y = top; y < top + square; ++y)
        for (std::size_t texel = size * y + left; texel < size * y + left + square; ++texel)
          if (states_read_[texel] == RECEIVER_WANTED) {
            states_read_[texel] = RECEIVER_KNOWN;
            list_on_host_.push_back(static_cast<std::uint32_t>(texel));
          }
  if (list_on_host_.size() == known_) return;
  states_.write(states_read_);
  const std::span<const std::uint32_t> added(list_on_host_.data() + known_, list_on_host_.size() - known_);
  list_.write(added, known_);
  const auto first = static_cast<std::uint32_t>(known_), count = static_cast<std::uint32_t>(added.size());
  known_ = list_on_host_.size();
  if (!surroundings) {
    distances_.write(std::vector<float>(distances_.size(), std::numeric_limits<float>::infinity()));
    return;
  }
  const shared::DeviceTexels slice{tracing::to_float4(middle), first, count, size_, 0};
  surroundings->world.run(surroundings->receivers, count, 32,
                          {{"list", list_}, {"slice", slice}, {"distances", distances_}, {"facing", normals_}});
}

void Receivers::find_all(std::optional<Surroundings>& surroundings, const glm::dvec3& middle) {
  states_.write(std::vector<int>(states_.size(), RECEIVER_WANTED));
  find_wanted(surroundings, middle);
}

bool Receivers::cast(const std::function<void(const CastTexels&)>& light) {
  if (lit_ == known_) return true;
  const Communicator& communicator = context_.communicator();
  const auto count = std::clamp<std::int64_t>(std::llround(texels_a_slice_.amount(communicator)), 1,
                                              static_cast<std::int64_t>(known_ - lit_));
  const Partition partition(communicator, static_cast<std::int64_t>(known_ - shared_));
  texels_a_slice_.timed(static_cast<double>(count), [&] {
    partition.for_own(static_cast<std::int64_t>(lit_ - shared_), count, [&](std::int64_t first, std::int64_t own) {
      light({&list_, static_cast<std::uint32_t>(shared_) + static_cast<std::uint32_t>(first),
             static_cast<std::uint32_t>(own), &distances_, &normals_, &caustics_, size_});
    });
  });
  lit_ += static_cast<std::size_t>(count);
  if (lit_ < known_) return false;
  for (compute::Buffer<float>* values : {&caustics_, &parts_seen_}) share(partition, *values);
  shared_ = known_;
  return true;
}

/// Gives all ranks the values that each has worked out of the list's newest texels.
void Receivers::share(const Partition& partition, compute::Buffer<float>& values) const {
  if (context_.communicator().is_alone()) return;
  std::vector<float> all = values.read(), newest;
  const auto each = [&](const auto& use) {
    for (std::size_t i = shared_; i < known_; ++i)
      for (std::size_t c = 0; c < 3; ++c) use(3 * (i - shared_) + c, 3 * std::size_t{list_on_host_[i]} + c);
  };
  newest.resize(3 * (known_ - shared_));
  each([&](std::size_t to, std::size_t from) { newest[to] = all[from]; });
  partition.clear_others(std::span(newest), 3);
  context_.communicator().all_reduce_or(std::as_writable_bytes(std::span(newest)));
  each([&](std::size_t from, std::size_t to) { all[to] = newest[from]; });
  values.write(all);
}

} // namespace nephroid::environment
