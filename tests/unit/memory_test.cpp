// SPDX-License-Identifier: Apache-2.0
// A run that does not fit is refused with what it needs and what there is.
#include "run/memory.h"
#include "tests/support/errors.h"

#include <gmock/gmock.h>

namespace {

using namespace nephroid;
using test::error_of;
using testing::HasSubstr;

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

/// 16384 x 16384 pixels with two layers: two films of 6 GiB, of one image each.
plan::Plan large_plan()
{
  plan::Plan plan;
  plan.buffers = {{"tree", gib / 2}, {"film direct", 6 * gib}, {"film caustic", 6 * gib}};
  return plan;
}

void require(const compute::DeviceInfo& info, std::optional<std::uint64_t> available)
{
  run::require_memory(large_plan(), 16384, 16384, info, available);
}

TEST(Memory, TheHostHoldsThePictureTheEncodedFilesAndTheCheckpoint)
{
  // 48 bytes a pixel for the sum, its error's draw and two layers, three times that for the EXR: 192 a pixel, 48 GiB. The two copies of
  // the films in the checkpoint, 24 GiB, are less; of films of 48 GiB they are more, 96 GiB, and 12 GiB of floats.
  EXPECT_EQ(run::host_bytes(large_plan(), 16384, 16384), 48 * gib);
  plan::Plan with_large_films = large_plan();
  with_large_films.buffers[1].bytes = 42 * gib;
  EXPECT_EQ(run::host_bytes(with_large_films, 16384, 16384), 108 * gib);
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

} // namespace
