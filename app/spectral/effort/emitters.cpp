// SPDX-License-Identifier: Apache-2.0
#include "spectral/effort/emitters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace nephroid::spectral {

std::vector<shared::DeviceEmitter> make_emitters(const std::vector<PhotonSource>& sources, unsigned photons)
{
  std::vector<double> weights;
  for (const PhotonSource& source : sources) weights.push_back(source.weight);
  const std::vector<unsigned> counts = deal_out(weights, photons);
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

std::vector<unsigned> deal_out(const std::vector<double>& weights, unsigned photons)
{
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto positive = static_cast<unsigned>(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; }));
  std::vector<unsigned> counts(weights.size(), 0);
  if (positive == 0) return counts;
  const unsigned spare = photons > positive ? photons - positive : 0;
  // The running sum is rounded, not each count: then the counts add up to `spare` whatever the weights.
  double sum = 0;
  unsigned dealt = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    const auto upto = static_cast<unsigned>(std::llround(spare * std::min(sum / total, 1.0)));
    counts[i] = upto - dealt + (weights[i] > 0 ? 1 : 0);
    dealt = upto;
  }
  return counts;
}

void number_photons(std::vector<shared::DeviceEmitter>& emitters)
{
  unsigned first = 0;
  for (auto begin = emitters.begin(); begin != emitters.end();) {
    const auto end = std::find_if(begin, emitters.end(), [&](const shared::DeviceEmitter& e) { return e.light != begin->light; });
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

unsigned count_photons(const std::vector<shared::DeviceEmitter>& emitters)
{
  return emitters.empty() ? 0 : emitters.back().first_photon + emitters.back().photon_count;
}

void advance_sequence(shared::DeviceEmitter& emitter, std::uint64_t photons)
{
  const std::uint64_t at = (std::uint64_t{emitter.sequence_start_high} << 32 | emitter.sequence_start) + photons;
  emitter.sequence_start = static_cast<std::uint32_t>(at);
  emitter.sequence_start_high = static_cast<std::uint32_t>(at >> 32);
}

VarianceDeal::VarianceDeal(std::vector<shared::DeviceEmitter> emitters)
    : emitters_(std::move(emitters)), squares_(emitters_.size(), 0), photons_(emitters_.size(), 0)
{
  const double photons = count_photons(emitters_);
  for (const shared::DeviceEmitter& emitter : emitters_) {
    first_counts_.push_back(emitter.photon_count);
    first_deal_.push_back(emitter.photon_count / photons);
  }
}

bool VarianceDeal::is_due(std::int64_t pass) const
{
  return pass >= 2 && pass > first_pass_ && std::has_single_bit(static_cast<std::uint64_t>(pass));
}

// A photon of an emitter with n of them adds v = Phi f / n, so the sum of v^2 over the n photons of a pass is Phi^2 E[f^2] / n, and n times
// that estimates V = Phi^2 E[f^2].
void VarianceDeal::deal(std::int64_t pass, std::span<const std::int64_t> moments, unsigned halves)
{
  // The part of the photons that stays as it was dealt first, whatever was measured: a variance that few photons measured may be far off.
  constexpr double first_part = 0.1;
  const double passes = static_cast<double>(pass - first_pass_);
  std::vector<double> deviation(emitters_.size());
  unsigned photons_per_pass = 0;
  for (std::size_t e = 0; e < emitters_.size(); ++e) {
    const double count = emitters_[e].photon_count;
    squares_[e] += count * count * static_cast<double>(moments[e]);
    photons_[e] += count * passes;
    deviation[e] = std::sqrt(squares_[e] / photons_[e]);
    photons_per_pass += emitters_[e].photon_count;
  }
  last_variance_ = std::accumulate(moments.begin(), moments.end(), 0.0) / passes;
  if (first_pass_ == 0) first_variance_ = last_variance_;
  const double total = std::accumulate(deviation.begin(), deviation.end(), 0.0);
  std::vector<double> weights = first_deal_;
  if (total > 0)
    for (std::size_t e = 0; e < weights.size(); ++e) weights[e] = first_part * first_deal_[e] + (1 - first_part) * deviation[e] / total;
  give_out(pass, deal_out(weights, photons_per_pass), halves);
}

void VarianceDeal::deal_as_first(std::int64_t pass, unsigned halves) { give_out(pass, first_counts_, halves); }

double VarianceDeal::gain() const { return last_variance_ > 0 ? first_variance_ / last_variance_ : 1; }

void VarianceDeal::give_out(std::int64_t pass, const std::vector<unsigned>& counts, unsigned halves)
{
  for (std::size_t e = 0; e < emitters_.size(); ++e) {
    shared::DeviceEmitter& emitter = emitters_[e];
    advance_sequence(emitter, static_cast<std::uint64_t>(pass - first_pass_) / halves * emitter.light_photon_count);
    emitter.photon_count = counts[e];
  }
  number_photons(emitters_);
  first_pass_ = pass;
}

void VarianceDeal::state(tracing::State& state)
{
  state.value(first_pass_);
  state.value(first_variance_);
  state.value(last_variance_);
  state.items(std::span(emitters_));
  state.items(std::span(squares_));
  state.items(std::span(photons_));
}

} // namespace nephroid::spectral
