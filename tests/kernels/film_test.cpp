// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/film.h: sums are exact, whatever the order and whichever atomics the device has.
#include "kernels/tracing/shared_types.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"

namespace nephroid::film_test {

using Float4 = shared::float4;

TEST(Film, BothKindsOfAtomicsGiveTheExactSum)
{
  constexpr std::size_t count = 200000, sums = 7;
  std::mt19937_64 random(5);
  std::vector<std::int64_t> values(count), truth(sums, 0);
  std::vector<std::int32_t> places(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<std::int64_t>(random()) >> 20; // both signs, 44 bits
    places[i] = static_cast<std::int32_t>(random() % sums);
    truth[static_cast<std::size_t>(places[i])] += values[i];
  }
  const compute::Context context = compute::Context::open(test::device_options());
  const compute::Buffer<std::int64_t> from(context, "values", std::span<const std::int64_t>(values));
  const compute::Buffer<std::int32_t> where(context, "places", std::span<const std::int32_t>(places));
  for (const compute::Defines& defines : {compute::Defines{}, compute::Defines{{"NEPHROID_CHECK_HALVES", "1"}}}) {
    compute::Buffer<std::int64_t> to(context, "sums", sums);
    to.fill_zero();
    compute::Program(context, "check/check_sums.cl", defines)
        .kernel("add_all")
        .run(count, 64, {{"values", from}, {"places", where}, {"sums", to}, {"count", static_cast<std::uint32_t>(count)}});
    EXPECT_EQ(to.read(), truth) << (defines.empty() ? "the device's own" : "32-bit halves");
  }
}

TEST(Film, RefusesWhatDoesNotFit)
{
  const float limit = std::exp2(42.0f), nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const std::vector<Float4> in{{1, 2, 3, 4},   {limit, 0, 0, 1},    {0, -limit, 0, 1},      {0, 0, limit * 1.0001f, 1},
                               {nan, 0, 0, 1}, {0, infinity, 0, 1}, {-0.4f, 0.5f, 1.5f, 1}, {1, 1, 1, 0}};
  const std::vector<int> truth{1, 1, 1, 0, 0, 0, 1, 1};
  const compute::Context context = compute::Context::open(test::device_options());
  const compute::Buffer<Float4> from(context, "in", std::span<const Float4>(in));
  compute::Buffer<std::int64_t> film(context, "film", 3 * in.size());
  film.fill_zero();
  compute::Buffer<std::int32_t> accepted(context, "accepted", in.size());
  compute::Program(context, "check/check_sums.cl")
      .kernel("add_to_film")
      .run(in.size(), 64, {{"xyz_scale", from}, {"film", film}, {"accepted", accepted}, {"count", static_cast<std::uint32_t>(in.size())}});
  EXPECT_EQ(accepted.read(), truth);
  const std::vector<std::int64_t> sums = film.read();
  EXPECT_EQ(std::vector<std::int64_t>(sums.begin(), sums.begin() + 3), (std::vector<std::int64_t>{4, 8, 12}));
  EXPECT_EQ(sums[3], std::int64_t{1} << 42);
  EXPECT_EQ(sums[11], 0);
  EXPECT_EQ(std::vector<std::int64_t>(sums.begin() + 18, sums.begin() + 21), (std::vector<std::int64_t>{0, 0, 2})); // ties to even
}

} // namespace nephroid::film_test
