// SPDX-License-Identifier: Apache-2.0
// Lengths with units, by themselves and in a preset.
#include "preset/length.h"

#include "inverse/settings.h"
#include "preset/read.h"
#include "tests/support/test.h"

namespace nephroid::length_test {

using preset::millimetres_of;

TEST(Length, HasItsUnit) {
  for (const auto& [text, mm] : std::map<std::string, double>{{"1 in", 25.4},
                                                              {"1in", 25.4},
                                                              {" 25.4 mm ", 25.4},
                                                              {"1/4 in", 6.35},
                                                              {"1 1/2 in", 38.1},
                                                              {".5in", 12.7},
                                                              {"2 ft", 609.6},
                                                              {"1e1 cm", 100},
                                                              {"0.1 m", 100},
                                                              {"250 um", 0.25},
                                                              {"-3 mm", -3}}) {
    ASSERT_TRUE(millimetres_of(text)) << text;
    EXPECT_NEAR(*millimetres_of(text), mm, 1e-12 * std::abs(mm)) << text;
  }
  for (const std::string text : {"", "1", "in", "1 inch", "1/0 in", "1/ in", "1 2 in", "1..2 mm", "1e999 mm", "nan mm",
                                 "0x10 mm", "1 mm 2", "1,5 mm", "1/2/3 in"})
    EXPECT_FALSE(millimetres_of(text)) << text;
  EXPECT_FALSE(millimetres_of(std::string(1'000'000, '1') + " mm"));
}

preset::Preset inverse_with(const std::string& fields) {
  return preset::parse_preset(
      R"({"engine": "inverse", "inverse": {"receivers": [{"distance_mm": "1 ft", "picture": {"type": "disc"}}])" +
          fields + "}}",
      "inches.json");
}

TEST(Length, StandsForMillimetresInAPreset) {
  const preset::Preset p = inverse_with(R"(, "stock_mm": "1/2 in", "size_mm": ["4 in", 50])");
  const inverse::Settings& s = inverse::settings(p);
  EXPECT_DOUBLE_EQ(s.receivers[0].distance_mm, 304.8);
  EXPECT_DOUBLE_EQ(*s.stock_mm, 12.7);
  EXPECT_DOUBLE_EQ(s.size_mm[0], 101.6);
  EXPECT_DOUBLE_EQ(s.size_mm[1], 50);
}

TEST(Length, IsRefusedByItsField) {
  EXPECT_THAT(test::refusal_of([] { inverse_with(R"(, "stock_mm": "1 inch")"); }),
              AllOf(HasSubstr("inches.json#/inverse/stock_mm: is the string '1 inch'"),
                    HasSubstr("write a number, or a length with its unit: um, mm, cm, m, in or ft")));
  EXPECT_THAT(test::refusal_of([] { inverse_with(R"(, "size_mm": ["4 in", "9999 ft"])"); }),
              HasSubstr("/inverse/size_mm/1: is the string '9999 ft'; expected a number from 0.1 to 100000 mm"));
  EXPECT_THAT(test::refusal_of([] { inverse_with(R"(, "max_slope_deg": "1 in")"); }), HasSubstr("expected a number"));
}

} // namespace nephroid::length_test
