// SPDX-License-Identifier: Apache-2.0
// Small parts of base/ and preset/: counts in words, numbers as people type them, places and how they read (RFC 6901),
// which field an error is about, and the memory that a run is refused for.
#include "base/counted.h"
#include "base/location.h"
#include "base/numbers.h"
#include "cli/verb.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "run/memory.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::base_test {

using nephroid::bad_input;
using nephroid::counted;
using nephroid::Error;
using nephroid::Location;
using nephroid::pointer_key;
using nephroid::typed_number;
using preset::field_of;

TEST(Counted, OneAndMany) {
  EXPECT_EQ(counted(0, "light"), "0 lights");
  EXPECT_EQ(counted(1, "light"), "1 light");
  EXPECT_EQ(counted(2u, "light"), "2 lights");
  EXPECT_EQ(counted(1, "pass", "passes"), "1 pass");
  EXPECT_EQ(counted(2, "pass", "passes"), "2 passes");
  EXPECT_EQ(counted(~std::uint64_t{0}, "photon"), "18446744073709551615 photons");
  EXPECT_EQ(counted(std::int64_t{-1}, "photon"), "-1 photons");
}

TEST(TypedNumber, AsPeopleTypeThem) {
  EXPECT_EQ(typed_number<double>(".02"), 0.02);
  EXPECT_EQ(typed_number<double>("+3"), 3);
  EXPECT_EQ(typed_number<double>("5."), 5);
  EXPECT_EQ(typed_number<double>("1e5"), 1e5);
  EXPECT_EQ(typed_number<double>("-.5"), -0.5);
  EXPECT_EQ(typed_number<int>("1e5"), 100000);
  EXPECT_EQ(typed_number<int>("2."), 2);
  EXPECT_EQ(typed_number<std::uint64_t>("+18446744073709551615"), 18446744073709551615u);
}

TEST(TypedNumber, OthersAreNone) {
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

TEST(JsonPointer, EscapesAsTheStandardSays) {
  EXPECT_EQ(pointer_key(""), ""); // RFC 6901, section 5
  EXPECT_EQ(pointer_key("a/b"), "a~1b");
  EXPECT_EQ(pointer_key("m~n"), "m~0n");
  EXPECT_EQ(pointer_key("c%d"), "c%d");
  EXPECT_EQ(pointer_key("~1"), "~01"); // section 4: not to be read back as "/"
}

TEST(JsonPointer, AgreesWithNlohmannJson) {
  for (const char* key : {"glass", "N-SF66 (Schott)", "a/b~c", "~~//", "n\xc3\xa4her"})
    EXPECT_EQ(pointer_key(key), (nlohmann::json::json_pointer() / key).to_string().substr(1)); // without its "/"
}

TEST(Location, ReadsAsItsPartsSay) {
  EXPECT_EQ(Location().text(), "");
  EXPECT_EQ(Location("--device 3").text(), "--device 3");
  EXPECT_EQ(Location("a.yml", 7).text(), "a.yml:7");
  EXPECT_EQ(Location("a.yml", 0).text(), "a.yml") << "no line is known";
  EXPECT_EQ(Location("a.json", 7, 2).text(), "a.json:7:2");
  EXPECT_EQ(Location("a.json", "").text(), "a.json#");
  EXPECT_EQ((Location("a.json") / "scene" / "lights" / 0 / "a/b").text(), "a.json#/scene/lights/0/a~1b");
}

TEST(Location, OfAnErrorIsDataWhateverItsNameHolds) {
  const Location place = Location("a#/sweep/b: c") / "seed";
  const Error error = bad_input(place, "is 3", "expected 4");
  EXPECT_EQ(error.location(), place);
  EXPECT_EQ(error.text(), "is 3; expected 4");
  EXPECT_EQ(error.line(), "a#/sweep/b: c#/seed: is 3; expected 4");
  EXPECT_EQ(error.noting("in run 1").location(), place);
  EXPECT_EQ(error.at("--set seed=3").line(), "--set seed=3: is 3; expected 4");
}

preset::Preset parse(const std::string& fields, const preset::Overrides& overrides = {}) {
  return preset::parse_preset(R"({"engine":"spectral")" + fields + "}", "p.json", overrides);
}

TEST(ErrorPlace, OfAValueThatCannotBeRead) {
  const Location in_file = error_of([] { parse(R"(,"scene":{"camera":{"fov_deg":200}})"); }).location();
  EXPECT_EQ(in_file.name, "p.json");
  EXPECT_EQ(in_file.pointer, "/scene/camera/fov_deg");
  EXPECT_EQ(in_file.field, "/scene/camera/fov_deg");

  const Location typed = error_of([] { parse("", {"scene.camera.fov_deg=200"}); }).location();
  EXPECT_EQ(typed.name, "--set scene.camera.fov_deg=200");
  EXPECT_FALSE(typed.pointer);
  EXPECT_EQ(typed.field, "/scene/camera/fov_deg");

  const Location broken = error_of([] { parse(",\n \"white\": ]"); }).location();
  EXPECT_EQ(broken.line, 2u);
  EXPECT_EQ(broken.column, 11u);
  EXPECT_EQ(broken.field, "");
}

TEST(ErrorPlace, OfAValueThatTurnsOutWrongLater) {
  preset::Preset p = parse("", {"white=2"});
  const auto fail_at = [&](const Location& place) {
    return error_of([&] { preset::at_origins(p, [&] { throw bad_input(place, "is wrong"); }); });
  };
  const Error typed = fail_at(Location(p.source) / "white");
  EXPECT_EQ(typed.line(), "--set white=2: is wrong");
  EXPECT_EQ(field_of(p, typed.location()), "/white");
  const Error in_file = fail_at(Location(p.source) / "scene" / "lights" / 0);
  EXPECT_EQ(in_file.line(), "p.json#/scene/lights/0: is wrong");
  EXPECT_EQ(field_of(p, in_file.location()), "/scene/lights/0");
  EXPECT_EQ(field_of(p, fail_at(Location("bunny.obj", 3)).location()), "") << "no field of the preset";
  EXPECT_EQ(field_of(p, fail_at(Location(p.source)).location()), "");

  p.provenance = {}; // as an edit leaves it
  EXPECT_EQ(fail_at(Location(p.source) / "white").line(), "p.json#/white: is wrong")
      << "not the override's fault any more";
  EXPECT_EQ(field_of(p, fail_at(Location(p.source) / "white").location()), "/white");
}

constexpr std::uint64_t gib = std::uint64_t{1} << 30;

compute::DeviceInfo device(const char* type, std::uint64_t memory_bytes, std::uint64_t max_buffer_bytes) {
  return {.name = "abacus", .type = type, .memory_bytes = memory_bytes, .max_buffer_bytes = max_buffer_bytes};
}

/// 16384 x 16384 pixels with two layers: two films of 6 GiB, of one image each, and 48 GiB on the host.
plan::Plan large_plan() {
  plan::Plan plan;
  plan.decisions = {{"direct", true, ""}, {"photons", true, ""}};
  plan.layers = 2;
  plan.picture_bytes_a_pixel = 48;
  plan.buffers = {
      {"tree", gib / 2}, {"film direct", 6 * gib}, {"film caustic", 6 * gib}, {"picture (host)", 48 * gib, true}};
  return plan;
}

void require(const compute::DeviceInfo& info, std::optional<std::uint64_t> available) {
  run::require_memory(large_plan(), 16384, 16384, info, available);
}

TEST(Memory, TheHostHoldsThePictureAndTheEncodedFile) {
  // 48 bytes a pixel for the sum, its error's draw and two layers; the EXR's 36, interleaved and encoded: 120 a pixel,
  // 30 GiB.
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

TEST(Memory, WhatFitsPasses) {
  EXPECT_NO_THROW(require(device("gpu", 13 * gib, 6 * gib), 48 * gib));
  EXPECT_NO_THROW(require(device("cpu", 13 * gib, 6 * gib), 60 * gib + gib / 2));
  EXPECT_NO_THROW(require(device("cpu", 13 * gib, 6 * gib), std::nullopt));
}

TEST(Memory, WhatDoesNotFitIsRefusedWithBothFigures) {
  const Error small_device = error_of([] { require(device("gpu", 12 * gib, 6 * gib), 64 * gib); });
  EXPECT_EQ(small_device.exit_code(), 1);
  EXPECT_EQ(
      small_device.line(),
      "memory: the run needs 12.5 GiB on the device; abacus has 12.0 GiB; choose a smaller scene.camera.resolution");
  EXPECT_THAT(error_of([] { require(device("gpu", 13 * gib, 5 * gib), 64 * gib); }).line(),
              HasSubstr("the buffer 'film direct' needs 6.00 GiB; abacus has at most 5.00 GiB for one buffer"));
  EXPECT_THAT(
      error_of([] { require(device("gpu", 13 * gib, 6 * gib), 48 * gib - 1); }).line(),
      HasSubstr("a picture of 16384 x 16384 pixels needs about 48.0 GiB; 48.0 GiB of this machine's memory are free"));
  EXPECT_THAT(error_of([] { require(device("cpu", 13 * gib, 6 * gib), 60 * gib); }).line(),
              HasSubstr("needs about 60.5 GiB"))
      << "a cpu device's buffers lie in the same memory";
}

TEST(Memory, ThisMachineSaysWhatItHas) {
  const auto available = run::available_memory_bytes();
  ASSERT_TRUE(available.has_value());
  EXPECT_GT(*available, std::uint64_t{64} << 20);
  EXPECT_LT(*available, std::uint64_t{1} << 50);
}

} // namespace nephroid::base_test
