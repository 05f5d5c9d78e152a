// SPDX-License-Identifier: Apache-2.0
// Bakes on disk whose sum is right and whose header makes no sense: refused in one line, before anything is allocated for them.
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "environment/bake/bake.h"
#include "environment/bake/bake_file.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace nephroid::bake_file_test {

using environment::Bake;
using testing::HasSubstr;

class BakeFile : public testing::Test {
protected:
  static constexpr environment::BakeIdentity identity{.key = 7, .kernels = 9};

  BakeFile()
  {
    Bake bake;
    bake.map.side = 2;
    bake.radii = {1, 2};
    bake.directions = environment::light_directions(26);
    bake.baked.resize(26);
    bake.halves.resize(26 * bake.direction_items());
    bake.ways.resize(26 * bake.direction_texels());
    environment::write_bake(file, identity, bake);
    bytes = read_file(file);
  }

  /// Number `at` of the header's counts (directions, spheres, side, channels) is another one, and `length` bytes follow the header.
  std::string refusal(std::size_t at, std::uint64_t count, std::size_t length) const
  {
    constexpr std::size_t counts = 40, header = 80;
    std::string changed = bytes.substr(0, header);
    std::memcpy(changed.data() + counts + 8 * at, &count, sizeof count);
    changed.resize(header + length);
    PieceHash hash;
    hash.add(std::as_bytes(std::span(changed)));
    const std::uint64_t value = hash.value();
    changed.append(reinterpret_cast<const char*>(&value), sizeof value);
    write_file_whole(file, changed);
    return test::refusal_of([&] { environment::read_bake(file, identity); });
  }

  test::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "a.bake";
  std::string bytes;
};

TEST_F(BakeFile, IsReadAsItWasWritten) { EXPECT_EQ(environment::read_bake(file, identity).baked.size(), 26u); }

TEST_F(BakeFile, HasCountsThatABakeCanHave)
{
  EXPECT_THAT(refusal(0, 0, 16), HasSubstr("a.bake: says that it has 0 directions, 2 spheres, 2 x 2 texels and 1 channels"));
  EXPECT_THAT(refusal(0, 27, 16 + 27 * 32 + 27 * 2 * 4 * 4), HasSubstr("27 directions"));
  EXPECT_THAT(refusal(1, 0, 26 * 32), HasSubstr("0 spheres"));
  EXPECT_THAT(refusal(2, 0, 16 + 26 * 32), HasSubstr("0 x 0 texels"));
  // 2^32 x 2^32 texels are 0 of them modulo 2^64, so that the length is right.
  EXPECT_THAT(refusal(2, std::uint64_t{1} << 32, 16 + 26 * 32), HasSubstr("4294967296 x 4294967296 texels"));
  EXPECT_THAT(refusal(3, 2, 16 + 26 * 32 + 26 * 2 * 4 * 6), HasSubstr("2 channels"));
}

} // namespace nephroid::bake_file_test
