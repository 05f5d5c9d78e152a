// SPDX-License-Identifier: Apache-2.0
// Keys inside JSON pointers: RFC 6901's own examples, and what another library makes of the same keys.
#include "base/json_pointer.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using nephroid::pointer_key;

TEST(JsonPointer, EscapesAsTheStandardSays)
{
  EXPECT_EQ(pointer_key(""), ""); // RFC 6901, section 5
  EXPECT_EQ(pointer_key("a/b"), "a~1b");
  EXPECT_EQ(pointer_key("m~n"), "m~0n");
  EXPECT_EQ(pointer_key("c%d"), "c%d");
  EXPECT_EQ(pointer_key("~1"), "~01"); // section 4: not to be read back as "/"
}

TEST(JsonPointer, AgreesWithNlohmannJson)
{
  for (const char* key : {"glass", "N-SF66 (Schott)", "a/b~c", "~~//", "n\xc3\xa4her"})
    EXPECT_EQ(pointer_key(key), (nlohmann::json::json_pointer() / key).to_string().substr(1)); // without its "/"
}

} // namespace
