// SPDX-License-Identifier: Apache-2.0
// Numbers of options as people type them.
#include "cli/numbers.h"
#include "tests/support/test.h"

namespace nephroid::typed_number_test {

using nephroid::cli::typed_number;

TEST(TypedNumber, AsPeopleTypeThem)
{
  EXPECT_EQ(typed_number<double>(".02"), 0.02);
  EXPECT_EQ(typed_number<double>("+3"), 3);
  EXPECT_EQ(typed_number<double>("5."), 5);
  EXPECT_EQ(typed_number<double>("1e5"), 1e5);
  EXPECT_EQ(typed_number<double>("-.5"), -0.5);
  EXPECT_EQ(typed_number<int>("1e5"), 100000);
  EXPECT_EQ(typed_number<int>("2."), 2);
  EXPECT_EQ(typed_number<std::uint64_t>("+18446744073709551615"), 18446744073709551615u);
}

TEST(TypedNumber, OthersAreNone)
{
  for (const char* text : {"", "+", "+-3", "++3", "-", ".", "e5", "1,5", "3 ", " 3", "0x10", "many"}) {
    EXPECT_FALSE(typed_number<double>(text)) << text;
    EXPECT_FALSE(typed_number<int>(text)) << text;
  }
  EXPECT_FALSE(typed_number<int>("1.5"));
  EXPECT_FALSE(typed_number<int>("1e10")) << "beyond an int";
  EXPECT_FALSE(typed_number<int>("nan"));
  EXPECT_FALSE(typed_number<std::uint64_t>("-1"));
  EXPECT_FALSE(typed_number<std::uint64_t>("-1e3"));
  EXPECT_FALSE(typed_number<std::uint64_t>("1e17")) << "a double does not say exactly which";
}

} // namespace nephroid::typed_number_test
