// SPDX-License-Identifier: Apache-2.0
#include "photons/spread_kernels.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace nephroid::photons {
namespace {

/// How far a kernel may reach, in pixels.
constexpr int reach = 6;

/// Pixels that do the same at once, in a vector register that every machine has.
constexpr std::size_t lanes = 4;
using Floats = float __attribute__((vector_size(lanes * sizeof(float))));
using Words = std::int32_t __attribute__((vector_size(lanes * sizeof(std::int32_t))));

/// So many of these registers go through the pixels within reach together.
constexpr std::size_t vectors = 2, group = vectors * lanes;

/// Pixels of which SpreadKernels knows the largest kernel, and those that a core takes at a time: whole runs.
constexpr std::size_t run = 16, block_pixels = 1 << 12;

constexpr std::size_t word_bits = 32;

struct Offset {
  int x, y;
  int distance2() const { return x * x + y * y; }
};

/// The pixels within reach, nearest first. The one across has the same distance, so it is in the same ring.
struct Reach {
  std::vector<Offset> offsets;
  std::vector<std::uint32_t> ring_ends; ///< for each ring of pixels equally far away, one past its last
};

const Reach& within_reach() {
  static const Reach sorted = [] {
    Reach within;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if (x * x + y * y <= reach * reach) within.offsets.push_back({x, y});
    std::ranges::stable_sort(within.offsets, {}, &Offset::distance2);
    for (std::size_t end = 1; end <= within.offsets.size(); ++end)
      if (end == within.offsets.size() || within.offsets[end].distance2() > within.offsets[end - 1].distance2())
        within.ring_ends.push_back(static_cast<std::uint32_t>(end));
    return within;
  }();
  return sorted;
}

std::size_t words() { return (within_reach().offsets.size() + word_bits - 1) / word_bits; }

/// What to add to a pixel's number.
std::vector<std::ptrdiff_t> steps(int width) {
  std::vector<std::ptrdiff_t> steps;
  for (const Offset& o : within_reach().offsets) steps.push_back(std::ptrdiff_t{o.y} * width + o.x);
  return steps;
}

template <class Vector, class Value>
Vector load(const Value* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof(vector));
  return vector;
}

void store(const Floats& of, std::size_t first, std::size_t end, Plane& in) {
  for (std::size_t lane = 0; lane < lanes && first + lane < end; ++lane) in[first + lane] = of[lane];
}

bool any(Words of) {
  return std::ranges::any_of(std::bit_cast<std::array<std::int32_t, lanes>>(of), [](int word) { return word != 0; });
}

/// The values where may_give has the bit of the pixel `number` of those within reach, else 0.
Floats where(Words may_give, std::uint32_t number, Floats values) {
  const Words is_set = (may_give & static_cast<std::int32_t>(std::uint32_t{1} << number % word_bits)) != 0;
  return is_set ? values : Floats{};
}

} // namespace

Plane::Plane(std::size_t pixels, std::size_t margin) : margin_(margin), values_(pixels + 2 * margin + group) {}

SpreadDomain::SpreadDomain(int width, int height, const std::function<bool(std::size_t, std::size_t)>& may_give)
    : width_(width), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      margin_(static_cast<std::size_t>(reach) * static_cast<std::size_t>(width + 1)) {
  const std::size_t plane = pixels_ + group;
  may_give_.resize(words() * plane);
  for_ranges(pixels_, block_pixels, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t number = 0; number < within_reach().offsets.size(); ++number) {
        const Offset& o = within_reach().offsets[number];
        const int x = static_cast<int>(i) % width + o.x, y = static_cast<int>(i) / width + o.y;
        if (x < 0 || x >= width || y < 0 || y >= height) continue;
        const std::size_t j =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        if (j == i || may_give(i, j))
          may_give_[number / word_bits * plane + i] |= std::uint32_t{1} << (number % word_bits);
      }
  });
}

std::uint64_t SpreadDomain::bytes_per_pixel() { return words() * sizeof(std::uint32_t); }

std::vector<const std::uint32_t*> SpreadDomain::words_of_pixels() const {
  std::vector<const std::uint32_t*> words;
  for (std::size_t begin = 0; begin < may_give_.size(); begin += pixels_ + group) words.push_back(&may_give_[begin]);
  return words;
}

SpreadKernels SpreadDomain::kernels_of(const Plane& light, const Plane& wanted) const {
  SpreadKernels kernels{zeros(), zeros(), zeros(), zeros(), zeros(), std::vector<float>((pixels_ + run - 1) / run)};
  const std::vector<std::ptrdiff_t> step = steps(width_);
  const std::vector<const std::uint32_t*> may_give = words_of_pixels();
  for_ranges(pixels_, block_pixels, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lanes) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      const auto want = load<Floats>(wanted.at(at));
      const float* const light_at = light.at(at);
      Floats held{}, ring{}, inside{}, end{};
      Words grows = Words{} == 0;
      std::uint32_t number = 0;
      for (const std::uint32_t ring_end : within_reach().ring_ends) {
        if (number > 0) grows &= held + ring < want;
        if (!any(grows)) break;
        held += grows ? ring : Floats{};
        ring = grows ? Floats{} : ring;
        inside = grows ? end : inside;
        end = grows ? Floats{} + static_cast<float>(ring_end) : end;
        for (; number < ring_end; ++number)
          ring += where(grows & load<Words>(may_give[number / word_bits] + i), number,
                        load<Floats>(light_at + step[number]));
      }
      Floats weight = (want - held) / ring;
      weight = weight < 0 ? Floats{} : weight > 1 ? Floats{} + 1 : weight;
      weight = ((inside > 0) & (ring > 0)) ? weight : Floats{} + 1;
      store(inside, i, range.end, kernels.inside);
      store(end, i, range.end, kernels.end);
      store(weight, i, range.end, kernels.ring_weight);
    }
    for (std::size_t i = range.begin; i < range.end; ++i)
      kernels.largest[i / run] = std::max(kernels.largest[i / run], kernels.end[i]);
  });
  return kernels;
}

void SpreadDomain::scale(SpreadKernels& kernels, const Plane& favour) const {
  const std::vector<std::ptrdiff_t> step = steps(width_);
  const std::vector<const std::uint32_t*> may_give = words_of_pixels();
  for_ranges(pixels_, block_pixels, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lanes) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      const auto inside = load<Floats>(kernels.inside.at(at)), end = load<Floats>(kernels.end.at(at)),
                 weight = load<Floats>(kernels.ring_weight.at(at));
      const auto past = static_cast<std::uint32_t>(*std::max_element(kernels.end.at(at), kernels.end.at(at) + lanes));
      const float* const favour_at = favour.at(at);
      Floats sum{};
      for (std::uint32_t number = 0; number < past; ++number) {
        const Floats k = Floats{} + static_cast<float>(number);
        const Floats part = k < inside ? Floats{} + 1 : k < end ? weight : Floats{};
        sum +=
            where(load<Words>(may_give[number / word_bits] + i), number, part * load<Floats>(favour_at + step[number]));
      }
      store(1 / sum, i, range.end, kernels.scale);
      store(weight / sum, i, range.end, kernels.ring_scale);
    }
  });
}

template <std::size_t channels>
std::array<Plane, channels> SpreadDomain::collect(const SpreadKernels& kernels,
                                                  const std::array<Plane, channels>& given) const {
  std::array<Plane, channels> collected;
  collected.fill(zeros());
  const std::vector<std::ptrdiff_t> step = steps(width_);
  const std::vector<const std::uint32_t*> may_give = words_of_pixels();
  const std::vector<float>& largest = kernels.largest; // few are large where photons are many
  const auto largest_about = [&](std::size_t first) {
    float most = 0;
    for (int y = -reach; y <= reach; ++y) {
      const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(first) + std::ptrdiff_t{y} * width_ - reach,
                           to = from + static_cast<std::ptrdiff_t>(run + 2 * std::size_t{reach}); // one past the last
      const auto begin = static_cast<std::size_t>(std::max<std::ptrdiff_t>(from, 0)) / run;
      for (std::size_t r = begin; r < largest.size() && static_cast<std::ptrdiff_t>(r * run) < to; ++r)
        most = std::max(most, largest[r]);
    }
    return most;
  };
  for_ranges(pixels_, block_pixels, [&](std::size_t, Range range) {
    const std::ptrdiff_t* const from = step.data(); // plain pointers: nothing is looked up again for each pixel
    const std::uint32_t* const* const bit_words = may_give.data();
    float most = 0;
    for (std::size_t j = range.begin; j < range.end; j += group) {
      if (j % run == 0) most = largest_about(j);
      const auto at = static_cast<std::ptrdiff_t>(j);
      const float *const inside = kernels.inside.at(at), *const end = kernels.end.at(at),
                         *const scale = kernels.scale.at(at), *const ring_scale = kernels.ring_scale.at(at);
      std::array<const float*, channels> value;
      for (std::size_t c = 0; c < channels; ++c) value[c] = given[c].at(at);
      Floats sum[channels][vectors]{};
      const auto past = static_cast<std::uint32_t>(most);
      for (std::uint32_t number = 0; number < past; ++number) {
        const Floats k = Floats{} + static_cast<float>(number);
        for (std::size_t v = 0; v < vectors; ++v) {
          const std::ptrdiff_t i = from[number] + static_cast<std::ptrdiff_t>(v * lanes);
          const Floats within = k < load<Floats>(end + i) ? load<Floats>(ring_scale + i) : Floats{},
                       weight = k < load<Floats>(inside + i) ? load<Floats>(scale + i) : within;
          const Floats part = where(load<Words>(bit_words[number / word_bits] + j + v * lanes), number, weight);
          for (std::size_t c = 0; c < channels; ++c) sum[c][v] += part * load<Floats>(value[c] + i);
        }
      }
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t v = 0; v < vectors; ++v) store(sum[c][v], j + v * lanes, range.end, collected[c]);
    }
  });
  return collected;
}

template std::array<Plane, 1> SpreadDomain::collect(const SpreadKernels&, const std::array<Plane, 1>&) const;
template std::array<Plane, 3> SpreadDomain::collect(const SpreadKernels&, const std::array<Plane, 3>&) const;

} // namespace nephroid::photons
