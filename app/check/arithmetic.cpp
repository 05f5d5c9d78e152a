// SPDX-License-Identifier: Apache-2.0
// The device's own functions against double precision. Tolerances: OpenCL 1.2, 7.4, table "ULP values for single
// precision built-in math functions", full profile. A compiler's fast mathematics shows here first.
#include "check/check.h"
#include "check/device_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace nephroid::check {
namespace {

/// In the order of check.cl's built_ins.
enum class Function { exp, log, sqrt, rsqrt, sin, cos, divide, fma, difference };

constexpr std::size_t sample_count = 1 << 16;

/// The distance from the truth in spacings of floats there.
double ulps(float got, double truth) {
  if (!std::isfinite(got)) return std::numeric_limits<double>::infinity();
  int exponent = 0;
  std::frexp(truth, &exponent);
  return std::abs(got - truth) / std::ldexp(1.0, exponent - 24);
}

struct BuiltIn {
  const char* name;
  Function function;
  double tolerance;
  const char* range; ///< range of the arguments, in words
  float4 (*arguments)(std::mt19937_64&);
  double (*truth)(const float4&);
};

float uniform(std::mt19937_64& random, double low, double high) {
  return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
}
/// A float of either sign if `negative`, with its exponent evenly spread over -e to e: results stay normal numbers.
float any_size(std::mt19937_64& random, double e, bool negative = false) {
  const double size = std::exp2(std::uniform_real_distribution<double>(-e, e)(random));
  return static_cast<float>(negative && random() % 2 ? -size : size);
}
/// In half of all cases x y is close to z w, where one fused rounding would show.
float4 products(std::mt19937_64& random) {
  const float x = any_size(random, 4, true), y = any_size(random, 4, true), z = any_size(random, 4, true);
  return {x, y, z, random() % 2 ? any_size(random, 4, true) : x * y / z};
}
double rounded(double x) { return static_cast<float>(x); }

float4 argument(float x) { return {x, 0, 0, 0}; }

const BuiltIn built_ins[] = {
    {"exp", Function::exp, 3, "-87 to 88", [](auto& r) { return argument(uniform(r, -87, 88)); },
     [](const float4& a) { return std::exp(double(a.x)); }},
    {"log", Function::log, 3, "2^-100 to 2^100",
     [](auto& r) { return argument(r() % 2 ? any_size(r, 100) : uniform(r, 0.5, 2)); },
     [](const float4& a) { return std::log(double(a.x)); }},
    {"sqrt", Function::sqrt, 3, "2^-100 to 2^100", [](auto& r) { return argument(any_size(r, 100)); },
     [](const float4& a) { return std::sqrt(double(a.x)); }},
    {"rsqrt", Function::rsqrt, 2, "2^-100 to 2^100", [](auto& r) { return argument(any_size(r, 100)); },
     [](const float4& a) { return 1 / std::sqrt(double(a.x)); }},
    {"sine", Function::sin, 4, "-100 to 100", [](auto& r) { return argument(uniform(r, -100, 100)); },
     [](const float4& a) { return std::sin(double(a.x)); }},
    {"cosine", Function::cos, 4, "-100 to 100", [](auto& r) { return argument(uniform(r, -100, 100)); },
     [](const float4& a) { return std::cos(double(a.x)); }},
    {"division", Function::divide, 2.5, "2^-60 to 2^60, either sign",
     [](auto& r) {
       return float4{any_size(r, 60, true), any_size(r, 60, true), 0, 0};
     },
     [](const float4& a) { return double(a.x) / a.y; }},
    {"fma rounds once", Function::fma, 0, "2^-4 to 2^4, either sign",
     [](auto& r) {
       return float4{any_size(r, 4, true), any_size(r, 4, true), any_size(r, 4, true), 0};
     },
     [](const float4& a) { return double(std::fma(a.x, a.y, a.z)); }},
};

Check built_in_check(const BuiltIn& b) {
  return {fmt::format("built-in: {}", b.name), [&b](const compute::Context& context, std::uint64_t seed) {
            std::mt19937_64 random(seed);
            std::vector<float4> in(sample_count);
            for (float4& a : in) a = b.arguments(random);
            const compute::Buffer<float> out(context, "out", in.size());
            run_kernel(
                context, "built_ins", in.size(),
                {{"function", static_cast<int>(b.function)}, {"in", compute::Buffer(context, "in", in)}, {"out", out}});
            const std::vector<float> got = out.read();
            double worst = 0;
            for (std::size_t i = 0; i < in.size(); ++i) worst = std::max(worst, ulps(got[i], b.truth(in[i])));
            return judged(worst, b.tolerance, "ulp",
                          fmt::format("worst of {} arguments, {}, against double precision", in.size(), b.range));
          }};
}

/// The signs of a ray's edge functions are exact only where no compiler fuses a product (kernels/tracing/bvh.h).
Result products_round_apart(const compute::Context& context, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<float4> in(sample_count);
  for (float4& a : in) a = products(random);
  const compute::Buffer<float> out(context, "out", in.size());
  run_kernel(
      context, "built_ins", in.size(),
      {{"function", static_cast<int>(Function::difference)}, {"in", compute::Buffer(context, "in", in)}, {"out", out}});
  const std::vector<float> got = out.read();
  double fused = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    // Products of floats are exact in double precision, so rounding them there rounds once.
    const double truth = rounded(rounded(double(in[i].x) * in[i].y) - rounded(double(in[i].z) * in[i].w));
    fused += got[i] != truth;
  }
  return judged(
      fused, 0, "results",
      fmt::format("of {} differences of two products, those that FP_CONTRACT OFF did not keep apart", in.size()));
}

Result quanta_round_to_even(const compute::Context& context, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<float> in{0.5f, 1.5f, 2.5f, -0.5f, -1.5f, -2.5f, 8388607.5f, -8388607.5f, 0x1p42f, -0x1p42f};
  while (in.size() < sample_count) in.push_back(any_size(random, 42, true));
  const compute::Buffer<std::int64_t> out(context, "out", in.size());
  run_kernel(context, "to_quanta", in.size(), {{"in", compute::Buffer(context, "in", in)}, {"out", out}});
  const std::vector<std::int64_t> got = out.read();
  double wrong = 0;
  for (std::size_t i = 0; i < in.size(); ++i) wrong += got[i] != std::llrint(in[i]);
  return judged(
      wrong, 0, "results",
      fmt::format("of {} floats up to 2^42, those not rounded to the nearest, even, 64-bit integer", in.size()));
}

} // namespace

Checks arithmetic_checks() {
  Checks list;
  for (const BuiltIn& b : built_ins) list.push_back(built_in_check(b));
  list.push_back({"built-in: products round apart", products_round_apart});
  list.push_back({"built-in: quanta round to even", quanta_round_to_even});
  return list;
}

} // namespace nephroid::check
