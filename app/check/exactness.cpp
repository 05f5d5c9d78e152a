// SPDX-License-Identifier: Apache-2.0
// What is the same bits on every device: random numbers (kernels/tracing/random.h) and sums (kernels/tracing/film.h).
#include "check/check.h"
#include "check/device_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace nephroid::check {
namespace {

using Block = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

/// Philox4x32-10 (Salmon et al. 2011): ten rounds of two products; the key steps by the golden ratio and sqrt(3) - 1.
Block philox(Block counter, Key key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t first = std::uint64_t{0xD2511F53} * counter[0], second = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(second >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(second),
               static_cast<std::uint32_t>(first >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(first)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

Result published_vectors(const compute::Context& context, std::uint64_t) {
  // Random123's tests/kat_vectors, the lines "philox4x32 10": counter, key, result.
  const std::vector<Block> counters{
      {0, 0, 0, 0}, {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}};
  const std::vector<Key> keys{{0, 0}, {0xffffffff, 0xffffffff}, {0xa4093822, 0x299f31d0}};
  const std::vector<Block> published{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
                                     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
                                     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}};
  const compute::Buffer<Block> out(context, "results", counters.size());
  run_kernel(context, "philox", counters.size(),
             {{"counters", compute::Buffer(context, "counters", counters)},
              {"keys", compute::Buffer(context, "keys", keys)},
              {"results", out}});
  const std::vector<Block> got = out.read();
  double wrong = 0;
  for (std::size_t i = 0; i < got.size(); ++i)
    for (std::size_t word = 0; word < 4; ++word) wrong += got[i][word] != published[i][word];
  return judged(wrong, 0, "words", "of the 12 words of Random123's known answers for Philox4x32-10, those that differ");
}

Result uniforms(const compute::Context& context, std::uint64_t seed) {
  constexpr std::size_t count = 1 << 16;
  const Key key{device_seed(seed).x, device_seed(seed).y};
  const compute::Buffer<std::array<float, 4>> out(context, "uniforms", count);
  run_kernel(context, "uniforms", count,
             {{"seed", key},
              {"pass", std::uint32_t{3}},
              {"block", std::uint32_t{4}},
              {"stream", std::uint32_t{5}},
              {"results", out}});
  const auto got = out.read();
  double wrong = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Block bits = philox({i, 3, 4, 5}, key);
    for (std::size_t d = 0; d < 4; ++d) {
      const double truth = std::ldexp(static_cast<double>(bits[d] >> 8), -24);
      wrong += got[i][d] != truth || !(got[i][d] >= 0 && got[i][d] < 1);
    }
  }
  return judged(wrong, 0, "numbers",
                fmt::format("of {} uniforms, those outside [0, 1) or other than the host's", 4 * count));
}

/// The first 2^k points of a scrambled Sobol sequence have one in each of 2^k equal intervals, in every dimension.
Result low_discrepancy(const compute::Context& context, std::uint64_t seed) {
  constexpr std::size_t count = 1 << 12;
  const compute::Buffer<std::array<float, 4>> out(context, "points", count);
  run_kernel(context, "sobol_points", count,
             {{"seed", Key{device_seed(seed).x, device_seed(seed).y}}, {"results", out}});
  std::array<std::array<bool, count>, 4> has_point{};
  for (const std::array<float, 4>& point : out.read())
    for (std::size_t d = 0; d < 4; ++d)
      if (point[d] >= 0 && point[d] < 1) has_point[d][static_cast<std::size_t>(point[d] * count)] = true;
  double empty = 0;
  for (const auto& intervals : has_point) empty += static_cast<double>(std::ranges::count(intervals, false));
  return judged(empty, 0, "intervals",
                fmt::format("{} points of a Sobol sequence: of as many equal intervals in each of 4 dimensions, those "
                            "without a point",
                            count));
}

/// Sums of integers are the same in any order. `halves` adds with two 32-bit atomics and a carry.
Result sums(const compute::Context& context, std::uint64_t seed, bool halves) {
  constexpr std::size_t count = 1 << 17, places = 7;
  std::mt19937_64 random(seed);
  std::vector<std::int64_t> values(count), truth(places, 0);
  std::vector<std::int32_t> where(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<std::int64_t>(random()) >>
                (i % 4 == 0 ? 56 : 20); // both signs, 44 bits, and some values that only carry
    where[i] = static_cast<std::int32_t>(random() % places);
    truth[static_cast<std::size_t>(where[i])] += values[i];
  }
  const compute::Defines defines = halves ? compute::Defines{{"NEPHROID_CHECK_HALVES", "1"}} : compute::Defines{};
  const compute::Buffer<std::int64_t> out = compute::zeroed<std::int64_t>(context, "sums", places);
  run_kernel(context, "add_all", count,
             {{"values", compute::Buffer(context, "values", values)},
              {"places", compute::Buffer(context, "places", where)},
              {"sums", out}},
             "check/check_sums.cl", defines);
  const std::vector<std::int64_t> got = out.read();
  double worst = 0;
  for (std::size_t i = 0; i < places; ++i)
    worst = std::max(worst, std::abs(static_cast<double>(got[i]) - static_cast<double>(truth[i])));
  const char* by = halves                           ? "by two 32-bit halves"
                   : context.device().int64_atomics ? "by 64-bit atomics"
                                                    : "by two 32-bit halves, having no others";
  return judged(worst, 0, "quanta",
                fmt::format("{} integers of 44 bits added into {} sums {}, against the host's", count, places, by));
}

Result film_limit(const compute::Context& context, std::uint64_t) {
  constexpr float limit = 0x1p42f, nan = std::numeric_limits<float>::quiet_NaN(),
                  infinity = std::numeric_limits<float>::infinity();
  struct Case {
    float4 xyz_scale;
    int accepted;
    std::array<std::int64_t, 3> quanta;
  };
  const Case cases[] = {{{1, 2, 3, 4}, 1, {4, 8, 12}},
                        {{limit, 0, 0, 1}, 1, {std::int64_t{1} << 42, 0, 0}},
                        {{0, -limit, 0, 1}, 1, {0, -(std::int64_t{1} << 42), 0}},
                        {{0, 0, limit * 1.0001f, 1}, 0, {}},
                        {{nan, 0, 0, 1}, 0, {}},
                        {{0, infinity, 0, 1}, 0, {}},
                        {{-0.6f, 1.5f, 3.5f, 1}, 1, {-1, 2, 4}},
                        {{-0.4f, 0.5f, 2.5f, 1}, 1, {0, 0, 2}}};
  std::vector<float4> in;
  for (const Case& c : cases) in.push_back(c.xyz_scale);
  const compute::Buffer<std::int64_t> film = compute::zeroed<std::int64_t>(context, "film", 3 * in.size());
  const compute::Buffer<std::int32_t> accepted(context, "accepted", in.size());
  run_kernel(context, "add_to_film", in.size(),
             {{"xyz_scale", compute::Buffer(context, "in", in)}, {"film", film}, {"accepted", accepted}},
             "check/check_sums.cl");
  const auto sums = film.read();
  const auto answers = accepted.read();
  double wrong = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    wrong += answers[i] != cases[i].accepted;
    for (std::size_t c = 0; c < 3; ++c) wrong += sums[3 * i + c] != cases[i].quanta[c];
  }
  return judged(
      wrong, 0, "answers",
      "contributions at, above and below the film's limit, infinite and NaN ones: what is taken and what is refused");
}

} // namespace

Checks exactness_checks() {
  return {{"random numbers: published vectors", published_vectors},
          {"random numbers: uniforms bit for bit", uniforms},
          {"random numbers: low discrepancy", low_discrepancy},
          {"sums: the device's own atomics",
           [](const compute::Context& c, std::uint64_t seed) { return sums(c, seed, false); }},
          {"sums: 32-bit halves with carry",
           [](const compute::Context& c, std::uint64_t seed) { return sums(c, seed, true); }},
          {"film: takes what fits, refuses the rest", film_limit}};
}

} // namespace nephroid::check
