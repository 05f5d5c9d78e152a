// SPDX-License-Identifier: Apache-2.0
#include "photons/tiles/lattices.h"

#include "lights/lights.h"
#include "tracing/lamp_tables.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace nephroid::photons {
namespace {

using std::numbers::pi;

/// The random numbers of a round and a half.
class Uniform {
public:
  Uniform(shared::uint2 seed, std::int64_t round, unsigned half) {
    std::seed_seq words{seed.x, seed.y, static_cast<std::uint32_t>(round), half};
    engine_.seed(words);
  }
  std::uint32_t bits() { return engine_(); }
  double operator()() { return engine_() * 0x1p-32; }

private:
  std::mt19937 engine_;
};

using lights::vector;

/// As a float, which rounding could make 1.
float below_1(double number) { return std::min(static_cast<float>(number), 0x1.fffffep-1f); }

/// A target of a light, or the cone of a spot, and its part of the photons.
struct Disc {
  int target;
  double part;
};

/// one_minus_cos_of in kernels/lights/targets.h.
double one_minus_cos(const shared::float4& sphere, const glm::dvec3& from) {
  const double distance2 = glm::dot(vector(sphere) - from, vector(sphere) - from),
               radius2 = double{sphere.w} * sphere.w;
  if (distance2 <= radius2) return 2;
  return radius2 / distance2 / (1 + std::sqrt(1 - radius2 / distance2));
}

std::vector<Disc> discs_of(const RunTables& tables, int light_index, std::array<double, 2> place) {
  const shared::DeviceLight& light = tables.lights[static_cast<std::size_t>(light_index)];
  const glm::dvec3 from = tracing::lamp_place(tables, light_index, below_1(place[0]), below_1(place[1]));
  std::vector<Disc> discs;
  double sum = 0;
  for (int t = 0; t < light.target_count; ++t) {
    const int target = light.first_target + t;
    const shared::float4& sphere = tables.targets[static_cast<std::size_t>(target)].centre_radius;
    discs.push_back({t, lights::is_parallel(light) ? double{sphere.w} * sphere.w : one_minus_cos(sphere, from)});
    sum += discs.back().part;
  }
  if (light.type == LIGHT_SPOT && light.as.spot.solid_angle <= 2 * pi * sum) return {{-1, 1}};
  double photons = 0; // make_densities in kernels/lights/targets.h
  for (Disc& disc : discs) {
    const double by_size = disc.part / sum;
    photons += disc.part = std::min(1 / static_cast<double>(discs.size()), double{MOST_CROWDED} * by_size) + by_size;
  }
  for (Disc& disc : discs) disc.part /= photons;
  return discs;
}

/// How many places of a lamp of a size, or directions of a sky, have a lattice: few show copies of the caustic, with
/// many a lattice is coarse.
double places_of(const shared::DeviceLight& light, double photons) {
  if (!lights::has_places(light)) return 1;
  return std::max(1.0, std::round(std::pow(photons, 0.4)));
}

/// Into how many parts the wavelengths of a cluster are cut where glass parts them, each with a lattice: a footprint is
/// swept along its part's.
double parts_of(double photons) { return std::clamp(std::round(std::sqrt(photons / 65536)), 1.0, 64.0); }

/// The widest footprint in pixels: some 80 times the mean one, so that it shrinks as photons grow, and at most a
/// quarter of the picture.
double widest_of(const shared::DeviceCamera& camera, double photons) {
  const double pixels = static_cast<double>(camera.width) * camera.height;
  return std::min(80 * std::sqrt(pixels / photons), 0.25 * std::max(camera.width, camera.height));
}

} // namespace

Lattices make_lattices(const RunTables& tables, unsigned halves, double batches, shared::uint2 seed,
                       std::int64_t round) {
  Lattices result;
  const auto in_all = [batches](unsigned photons) { return static_cast<double>(photons) * batches; };
  for (unsigned half = 0; half < halves; ++half) {
    Uniform uniform(seed, round, half);
    for (const shared::DeviceEmitter& emitter : tables.emitters) {
      const shared::DeviceLight& light = tables.lights[static_cast<std::size_t>(emitter.light)];
      const double photons = in_all(emitter.photon_count), places = places_of(light, photons),
                   parts = places == 1 && tables.wavelengths.clusters_spread ? parts_of(photons) : 1;
      const std::array<double, 3> start{uniform(), uniform(), uniform()};
      const int count = static_cast<int>(places * parts);
      for (int k = 0; k < count; ++k) {
        // A place has all wavelengths, and then one of its own, or a part of the wavelengths has its middle one.
        const double part = places > 1 ? 0 : k;
        const auto step_on = [k](double from, double step) { return std::fmod(from + k * step, 1.0); };
        const std::array<double, 2> place{step_on(start[0], 0.7548776662466927), step_on(start[1], 0.5698402909980532)};
        const double wavelength = places > 1 ? step_on(start[2], std::numbers::phi - 1) : (part + 0.5) / parts;
        for (const Disc& disc : discs_of(tables, emitter.light, place)) {
          const double step = std::sqrt(pi * places * parts / (photons * disc.part));
          shared::DeviceLattice lattice{};
          lattice.first_photon = result.points;
          lattice.side = static_cast<std::uint32_t>(std::ceil(2 / step)) + 1;
          lattice.light = emitter.light;
          lattice.cluster = emitter.cluster;
          lattice.target = disc.target;
          lattice.film_half = half;
          lattice.step = static_cast<float>(step);
          lattice.shift_x = below_1(uniform());
          lattice.shift_y = below_1(uniform());
          lattice.place_x = below_1(place[0]);
          lattice.place_y = below_1(place[1]);
          lattice.wavelength = below_1(wavelength);
          lattice.is_drawn = places > 1;
          lattice.low = static_cast<float>(part / parts);
          lattice.high = static_cast<float>((part + 1) / parts);
          lattice.photons = static_cast<float>(photons / parts);
          lattice.share = emitter.share;
          lattice.widest = static_cast<float>(widest_of(tables.camera, in_all(tables.photons_per_batch)));
          lattice.phase = uniform.bits();
          result.points += lattice.side * lattice.side;
          result.lattices.push_back(lattice);
        }
      }
    }
  }
  return result;
}

} // namespace nephroid::photons
