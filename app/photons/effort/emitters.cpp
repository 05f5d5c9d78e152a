// SPDX-License-Identifier: Apache-2.0
#include "photons/effort/emitters.h"

#include "tracing/scales.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace nephroid::photons {
namespace {

constexpr std::size_t bins_x = GUIDE_BINS_X, bins_y = GUIDE_BINS_Y, bins_z = GUIDE_BINS_Z, cells = EmissionGuide::cells;

/// The fraction of the photons that is spread evenly whatever was learned: a cell that looked dark may not be.
constexpr double even_part = 0.15;

/// Means with the neighbours, weights 1 2 1, over the second and the third number, an angle, which wraps around.
std::vector<double> blurred(std::span<const double> values) {
  const auto pass = [](std::span<const double> from, std::size_t bins, std::size_t stride, bool wraps) {
    std::vector<double> to(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t bin = i / stride % bins, first = i - bin * stride;
      const std::size_t below = wraps ? (bin + bins - 1) % bins : std::max<std::size_t>(bin, 1) - 1,
                        above = wraps ? (bin + 1) % bins : std::min(bin + 1, bins - 1);
      to[i] = 0.25 * from[first + below * stride] + 0.5 * from[i] + 0.25 * from[first + above * stride];
    }
    return to;
  };
  return pass(pass(values, bins_y, bins_z, false), bins_z, 1, true);
}

/// The sums of groups of `size` values.
std::vector<double> sums(std::span<const double> values, std::size_t size) {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); i += size)
    result.push_back(std::accumulate(values.begin() + i, values.begin() + i + size, 0.0));
  return result;
}

/// Appends the cdf of each group of `size` values.
void append_cdfs(const std::vector<double>& values, std::size_t size, std::vector<float>& table) {
  for (std::size_t i = 0; i < values.size(); i += size) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(i);
    const std::vector<float> cdf = exact_cdf({first, first + static_cast<std::ptrdiff_t>(size)});
    table.insert(table.end(), cdf.begin(), cdf.end());
  }
}

} // namespace

std::vector<shared::DeviceEmitter> make_emitters(const std::vector<PhotonSource>& sources, unsigned photons) {
  std::vector<double> weights;
  for (const PhotonSource& source : sources) weights.push_back(source.weight);
  const std::vector<unsigned> counts = allocate_photons(weights, photons);
  std::vector<shared::DeviceEmitter> emitters;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    shared::DeviceEmitter emitter{};
    emitter.photon_count = counts[i];
    emitter.light = sources[i].light;
    emitter.cluster = sources[i].cluster;
    emitter.share = static_cast<float>(sources[i].share);
    emitters.push_back(emitter);
  }
  number_photons(emitters);
  return emitters;
}

std::vector<unsigned> allocate_photons(const std::vector<double>& weights, unsigned photons) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto positive = static_cast<unsigned>(std::ranges::count_if(weights, [](double w) { return w > 0; }));
  std::vector<unsigned> counts(weights.size(), 0);
  if (positive == 0) return counts;
  const unsigned spare = photons > positive ? photons - positive : 0;
  // The running sum is rounded, not each count: so the counts add up to `spare` whatever the weights.
  double sum = 0;
  unsigned allocated = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    const auto upto = static_cast<unsigned>(std::llround(spare * std::min(sum / total, 1.0)));
    counts[i] = upto - allocated + (weights[i] > 0 ? 1 : 0);
    allocated = upto;
  }
  return counts;
}

void number_photons(std::vector<shared::DeviceEmitter>& emitters) {
  unsigned first = 0;
  for (auto begin = emitters.begin(); begin != emitters.end();) {
    const auto end =
        std::find_if(begin, emitters.end(), [&](const shared::DeviceEmitter& e) { return e.light != begin->light; });
    const unsigned light_first = first;
    for (auto e = begin; e != end; ++e) {
      e->first_photon = first;
      first += e->photon_count;
    }
    for (auto e = begin; e != end; ++e) {
      e->light_first_photon = light_first;
      e->light_photon_count = first - light_first;
    }
    begin = end;
  }
}

unsigned count_photons(const std::vector<shared::DeviceEmitter>& emitters) {
  return emitters.empty() ? 0 : emitters.back().first_photon + emitters.back().photon_count;
}

void advance_sequence(shared::DeviceEmitter& emitter, std::uint64_t photons) {
  const std::uint64_t at = (std::uint64_t{emitter.sequence_start_high} << 32 | emitter.sequence_start) + photons;
  emitter.sequence_start = static_cast<std::uint32_t>(at);
  emitter.sequence_start_high = static_cast<std::uint32_t>(at >> 32);
}

NeymanAllocation::NeymanAllocation(std::vector<shared::DeviceEmitter> emitters)
    : emitters_(std::move(emitters)), squares_(emitters_.size(), 0), photons_(emitters_.size(), 0) {
  const double photons = count_photons(emitters_);
  for (const shared::DeviceEmitter& emitter : emitters_) {
    initial_counts_.push_back(emitter.photon_count);
    initial_shares_.push_back(emitter.photon_count / photons);
  }
}

bool NeymanAllocation::is_due(std::int64_t batch) const {
  return batch >= 2 && batch > first_iteration_ && std::has_single_bit(static_cast<std::uint64_t>(batch));
}

// A photon of an emitter with n of them adds v = Phi f / n, so the sum of v^2 over the n photons of a batch is Phi^2
// E[f^2] / n, and n times that estimates V = Phi^2 E[f^2].
void NeymanAllocation::reallocate(std::int64_t batch, std::span<const std::int64_t> moments, unsigned halves) {
  // The fraction of the photons that keeps its first allocation: a variance that few photons measured may be far off.
  constexpr double first_part = 0.1;
  const double batches = static_cast<double>(batch - first_iteration_);
  std::vector<double> deviation(emitters_.size());
  unsigned photons_per_batch = 0;
  for (std::size_t e = 0; e < emitters_.size(); ++e) {
    const double count = emitters_[e].photon_count;
    squares_[e] += count * count * static_cast<double>(moments[e]);
    photons_[e] += count * batches;
    deviation[e] = std::sqrt(squares_[e] / photons_[e]);
    photons_per_batch += emitters_[e].photon_count;
  }
  last_variance_ = std::accumulate(moments.begin(), moments.end(), 0.0) / batches;
  if (first_iteration_ == 0) first_variance_ = last_variance_;
  const double total = std::accumulate(deviation.begin(), deviation.end(), 0.0);
  std::vector<double> weights = initial_shares_;
  if (total > 0)
    for (std::size_t e = 0; e < weights.size(); ++e)
      weights[e] = first_part * initial_shares_[e] + (1 - first_part) * deviation[e] / total;
  assign(batch, allocate_photons(weights, photons_per_batch), halves);
}

void NeymanAllocation::restore_initial(std::int64_t batch, unsigned halves) { assign(batch, initial_counts_, halves); }

double NeymanAllocation::gain() const { return last_variance_ > 0 ? first_variance_ / last_variance_ : 1; }

void NeymanAllocation::assign(std::int64_t batch, const std::vector<unsigned>& counts, unsigned halves) {
  for (std::size_t e = 0; e < emitters_.size(); ++e) {
    shared::DeviceEmitter& emitter = emitters_[e];
    advance_sequence(emitter,
                     static_cast<std::uint64_t>(batch - first_iteration_) / halves * emitter.light_photon_count);
    emitter.photon_count = counts[e];
  }
  number_photons(emitters_);
  first_iteration_ = batch;
}

void NeymanAllocation::serialize(tracing::Archive& archive) {
  archive.value(first_iteration_);
  archive.value(first_variance_);
  archive.value(last_variance_);
  archive.items(std::span(emitters_));
  archive.items(std::span(squares_));
  archive.items(std::span(photons_));
}

EmissionGuide::EmissionGuide(std::size_t lights) : squares_(lights * cells, 0), samples_(lights * cells, 0) {
  const std::vector<std::int64_t> dark(lights * cells, 0);
  chance_.assign(lights * cells, 1.0 / cells);
  learn(dark, std::vector<double>(lights, 0), 0);
}

// A photon of a cell that comes `density` times as often as evenly counts 1 / density; with n photons of the light it
// adds v = f / (n density). The cell gets n density / GUIDE_CELLS photons, so a batch's sum of v^2 there is E[f^2] / (n
// density GUIDE_CELLS), and n density times that estimates E[f^2] / GUIDE_CELLS. Allocations count by photons.
void EmissionGuide::learn(std::span<const std::int64_t> moments, std::span<const double> photons, double batches) {
  table_.clear();
  for (std::size_t l = 0; l < photons.size(); ++l) {
    const std::size_t first = l * cells;
    std::vector<double> deviation(cells);
    for (std::size_t c = 0; c < cells; ++c) {
      const double n_density = photons[l] * chance_[first + c] * cells;
      squares_[first + c] += n_density * n_density * static_cast<double>(moments[first + c]);
      samples_[first + c] += n_density * batches;
      deviation[c] = squares_[first + c] > 0 ? std::sqrt(squares_[first + c] / samples_[first + c]) : 0;
    }
    deviation = blurred(deviation);
    const double total = std::accumulate(deviation.begin(), deviation.end(), 0.0);
    std::vector<double> chance(cells, 1.0 / cells);
    if (!(total > 0) && batches > 0) // nothing was seen of the light: nothing is learned
      std::copy_n(chance_.begin() + static_cast<std::ptrdiff_t>(first), cells, chance.begin());
    if (total > 0)
      for (std::size_t c = 0; c < cells; ++c) chance[c] = even_part / cells + (1 - even_part) * deviation[c] / total;
    std::copy(chance.begin(), chance.end(), chance_.begin() + static_cast<std::ptrdiff_t>(first));
    const std::vector<double> chance_xy = sums(chance, bins_z);
    append_cdfs(sums(chance_xy, bins_y), bins_x, table_);
    append_cdfs(chance_xy, bins_y, table_);
    append_cdfs(chance, bins_z, table_);
  }
}

void EmissionGuide::forget() {
  std::ranges::fill(squares_, 0);
  std::ranges::fill(samples_, 0);
}

void EmissionGuide::serialize(tracing::Archive& archive) {
  for (std::vector<double>* values : {&chance_, &squares_, &samples_}) archive.items(std::span(*values));
  archive.items(std::span(table_));
}

} // namespace nephroid::photons
