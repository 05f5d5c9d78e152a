// SPDX-License-Identifier: Apache-2.0
// One pass, two passes.
#include "base/counted.h"
#include "tests/support/test.h"

namespace nephroid::counted_test {

using nephroid::counted;

TEST(Counted, OneAndMany)
{
  EXPECT_EQ(counted(0, "light"), "0 lights");
  EXPECT_EQ(counted(1, "light"), "1 light");
  EXPECT_EQ(counted(2u, "light"), "2 lights");
  EXPECT_EQ(counted(1, "pass", "passes"), "1 pass");
  EXPECT_EQ(counted(2, "pass", "passes"), "2 passes");
  EXPECT_EQ(counted(~std::uint64_t{0}, "photon"), "18446744073709551615 photons");
  EXPECT_EQ(counted(std::int64_t{-1}, "photon"), "-1 photons");
}

} // namespace nephroid::counted_test
