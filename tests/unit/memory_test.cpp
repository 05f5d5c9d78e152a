// SPDX-License-Identifier: Apache-2.0
// A run that does not fit is refused with what it needs and what there is.
#include "run/memory.h"
#include "tests/support/errors.h"

namespace nephroid::memory_test {

constexpr std::uint64_t gib = std::uint64_t{1} << 30;

compute::DeviceInfo device(const char* type, std::uint64_t memory_bytes, std::uint64_t max_buffer_bytes)
{
  compute::DeviceInfo info;
  info.name = "abacus";
  info.type = type;
  info.memory_bytes = memory_bytes;
  info.max_buffer_bytes = max_buffer_bytes;
  return info;
}

/// 16384 x 16384 pixels with two layers: two films of 6 GiB, of one image each, and 48 GiB on the host.
plan::Plan large_plan()
{
  plan::Plan plan;
  plan.passes = {{"direct", true, ""}, {"photons", true, ""}};
  plan.layers = 2;
  plan.picture_bytes_a_pixel = 48;
  plan.buffers = {{"tree", gib / 2}, {"film direct", 6 * gib}, {"film caustic", 6 * gib}, {"picture (host)", 48 * gib, true}};
  return plan;
}

void require(const compute::DeviceInfo& info, std::optional<std::uint64_t> available)
{
  run::require_memory(large_plan(), 16384, 16384, info, available);
}

TEST(Memory, TheHostHoldsThePictureAndTheEncodedFile)
{
  // 48 bytes a pixel for the sum, its error's draw and two layers; the EXR's 36, interleaved and encoded: 120 a pixel, 30 GiB.
  EXPECT_EQ(run::picture_and_files(large_plan(), 16384, 16384).bytes, 30 * gib);
  EXPECT_TRUE(run::picture_and_files(large_plan(), 16384, 16384).on_host);
  // One layer: 36 and a film read back, 48. Photon maps add to the photons' layer.
  plan::Plan one = large_plan();
  one.layers = 1;
  EXPECT_EQ(run::picture_and_files(one, 16384, 16384).bytes, 21 * gib);
  // 36 and the error's draw, 84.
  one.estimates_error = true;
  EXPECT_EQ(run::picture_and_files(one, 16384, 16384).bytes, 30 * gib);
}

TEST(Memory, WhatFitsPasses)
{
  EXPECT_NO_THROW(require(device("gpu", 13 * gib, 6 * gib), 48 * gib));
  EXPECT_NO_THROW(require(device("cpu", 13 * gib, 6 * gib), 60 * gib + gib / 2));
  EXPECT_NO_THROW(require(device("cpu", 13 * gib, 6 * gib), std::nullopt));
}

TEST(Memory, WhatDoesNotFitIsRefusedWithBothFigures)
{
  const Error small_device = error_of([] { require(device("gpu", 12 * gib, 6 * gib), 64 * gib); });
  EXPECT_EQ(small_device.exit_code(), 1);
  EXPECT_EQ(small_device.line(),
            "memory: the run needs 12.5 GiB on the device; abacus has 12.0 GiB; choose a smaller scene.camera.resolution");
  EXPECT_THAT(error_of([] { require(device("gpu", 13 * gib, 5 * gib), 64 * gib); }).line(),
              HasSubstr("the buffer 'film direct' needs 6.00 GiB; abacus has at most 5.00 GiB for one buffer"));
  EXPECT_THAT(error_of([] { require(device("gpu", 13 * gib, 6 * gib), 48 * gib - 1); }).line(),
              HasSubstr("a picture of 16384 x 16384 pixels needs about 48.0 GiB; 48.0 GiB of this machine's memory are free"));
  EXPECT_THAT(error_of([] { require(device("cpu", 13 * gib, 6 * gib), 60 * gib); }).line(), HasSubstr("needs about 60.5 GiB"))
      << "a cpu device's buffers lie in the same memory";
}

TEST(Memory, ThisMachineSaysWhatItHas)
{
  const auto available = run::available_memory_bytes();
  ASSERT_TRUE(available.has_value());
  EXPECT_GT(*available, std::uint64_t{64} << 20);
  EXPECT_LT(*available, std::uint64_t{1} << 50);
}

} // namespace nephroid::memory_test
