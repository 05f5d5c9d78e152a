// SPDX-License-Identifier: Apache-2.0
#include "spectral/effort/emitters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

} // namespace nephroid::spectral
