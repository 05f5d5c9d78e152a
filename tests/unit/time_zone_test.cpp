// SPDX-License-Identifier: Apache-2.0
// Clocks of time zones about their changes. The offsets are known: GMT and British Summer Time, which begins and ends
// at 1:00 UTC on the last Sundays of March and October; India's half hour; Lord Howe's change of half an hour.
#include "base/time_zone.h"

#include "preset/place.h"
#include "tests/support/test.h"

namespace nephroid::time_zone_test {

using preset::PlaceAndTime;

PlaceAndTime at(const std::string& zone, const std::string& date, double hour) {
  return {.latitude_deg = 0, .longitude_deg = 0, .date = date, .hour = hour, .time_zone = zone};
}

TEST(TimeZones, AreAheadOfUtcAsTheirSummerTimeSays) {
  EXPECT_EQ(preset::offset_h(at("Europe/London", "2026-01-15", 12)), 0);
  EXPECT_EQ(preset::offset_h(at("Europe/London", "2026-06-21", 12)), 1);
  EXPECT_EQ(preset::offset_h(at("Europe/London", "1970-01-15", 12)), 1) << "summer time was kept that winter";
  EXPECT_EQ(preset::offset_h(at("America/New_York", "2026-06-21", 12)), -4);
  EXPECT_EQ(preset::offset_h(at("Australia/Sydney", "2026-01-15", 12)), 11);
  EXPECT_EQ(preset::offset_h(at("Asia/Kolkata", "2026-06-21", 12)), 5.5);
  EXPECT_EQ(preset::offset_h(at("Australia/Lord_Howe", "2026-06-21", 12)), 10.5);
  EXPECT_EQ(preset::offset_h({.date = "2026-06-21", .utc_offset_h = 2}), 2);
  EXPECT_EQ(preset::offset_h({.date = "2026-06-21"}), 0);
}

TEST(TimeZones, SkipAnHourAndShowAnotherTwice) {
  const auto offsets = [](const char* date, double hour) { return preset::offsets_h(at("Europe/London", date, hour)); };
  EXPECT_THAT(offsets("2026-03-29", 0.99), ElementsAre(0));
  EXPECT_THAT(offsets("2026-03-29", 1), IsEmpty());
  EXPECT_THAT(offsets("2026-03-29", 2), ElementsAre(1));
  EXPECT_THAT(offsets("2026-10-25", 1), ElementsAre(1, 0));
  EXPECT_THAT(offsets("2026-10-25", 2), ElementsAre(0));
  EXPECT_EQ(preset::offset_h(at("Europe/London", "2026-03-29", 1.5)), 0) << "as before the change";
  EXPECT_EQ(preset::offset_h(at("Europe/London", "2026-10-25", 1.5)), 1);
}

} // namespace nephroid::time_zone_test
