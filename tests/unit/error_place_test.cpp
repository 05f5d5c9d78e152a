// SPDX-License-Identifier: Apache-2.0
// Which field of a preset an error is about, as data, whoever gave the field's value and wherever the error is found.
#include "preset/origins.h"
#include "preset/read.h"
#include "tests/support/errors.h"

namespace nephroid::error_place_test {

using preset::field_of;

preset::Preset parse(const std::string& fields, const preset::Overrides& overrides = {})
{
  return preset::parse_preset(R"({"engine":"spectral")" + fields + "}", "p.json", overrides);
}

TEST(ErrorPlace, OfAValueThatCannotBeRead)
{
  const Place in_file = error_of([] { parse(R"(,"scene":{"camera":{"fov_deg":200}})"); }).place();
  EXPECT_EQ(in_file.name, "p.json");
  EXPECT_EQ(in_file.pointer, "/scene/camera/fov_deg");
  EXPECT_EQ(in_file.field, "/scene/camera/fov_deg");

  const Place typed = error_of([] { parse("", {"scene.camera.fov_deg=200"}); }).place();
  EXPECT_EQ(typed.name, "--set scene.camera.fov_deg=200");
  EXPECT_FALSE(typed.pointer);
  EXPECT_EQ(typed.field, "/scene/camera/fov_deg");

  const Place broken = error_of([] { parse(",\n \"white\": ]"); }).place();
  EXPECT_EQ(broken.line, 2u);
  EXPECT_EQ(broken.column, 11u);
  EXPECT_EQ(broken.field, "");
}

TEST(ErrorPlace, OfAValueThatTurnsOutWrongLater)
{
  preset::Preset p = parse("", {"white=2"});
  const auto fail_at = [&](const Place& place) {
    return error_of([&] { preset::at_origins(p, [&] { throw bad_input(place, "is wrong"); }); });
  };
  const Error typed = fail_at(Place(p.source) / "white");
  EXPECT_EQ(typed.line(), "--set white=2: is wrong");
  EXPECT_EQ(field_of(p, typed.place()), "/white");
  const Error in_file = fail_at(Place(p.source) / "scene" / "lights" / 0);
  EXPECT_EQ(in_file.line(), "p.json#/scene/lights/0: is wrong");
  EXPECT_EQ(field_of(p, in_file.place()), "/scene/lights/0");
  EXPECT_EQ(field_of(p, fail_at(Place("bunny.obj", 3)).place()), "") << "no field of the preset";
  EXPECT_EQ(field_of(p, fail_at(Place(p.source)).place()), "");

  p.provenance = {}; // as an edit leaves it
  EXPECT_EQ(fail_at(Place(p.source) / "white").line(), "p.json#/white: is wrong") << "not the override's fault any more";
  EXPECT_EQ(field_of(p, fail_at(Place(p.source) / "white").place()), "/white");
}

} // namespace nephroid::error_place_test
