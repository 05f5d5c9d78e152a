// SPDX-License-Identifier: Apache-2.0
// Places and how they read. Keys inside JSON pointers: RFC 6901's own examples, and what another library makes of the same keys.
#include "base/error.h"
#include "base/place.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::place_test {

using nephroid::bad_input;
using nephroid::Error;
using nephroid::Place;
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

TEST(Place, ReadsAsItsPartsSay)
{
  EXPECT_EQ(Place().text(), "");
  EXPECT_EQ(Place("--device 3").text(), "--device 3");
  EXPECT_EQ(Place("a.yml", 7).text(), "a.yml:7");
  EXPECT_EQ(Place("a.yml", 0).text(), "a.yml") << "no line is known";
  EXPECT_EQ(Place("a.json", 7, 2).text(), "a.json:7:2");
  EXPECT_EQ(Place("a.json", "").text(), "a.json#");
  EXPECT_EQ((Place("a.json") / "scene" / "lights" / 0 / "a/b").text(), "a.json#/scene/lights/0/a~1b");
}

TEST(Place, OfAnErrorIsDataWhateverItsNameHolds)
{
  const Place place = Place("a#/sweep/b: c") / "seed";
  const Error error = bad_input(place, "is 3", "expected 4");
  EXPECT_EQ(error.place(), place);
  EXPECT_EQ(error.text(), "is 3; expected 4");
  EXPECT_EQ(error.line(), "a#/sweep/b: c#/seed: is 3; expected 4");
  EXPECT_EQ(error.noting("in run 1").place(), place);
  EXPECT_EQ(error.at("--set seed=3").line(), "--set seed=3: is 3; expected 4");
}

} // namespace nephroid::place_test
