// SPDX-License-Identifier: Apache-2.0
// What runs where a way to estimate light cannot do what a scene or a setting asks for: another way, with a note. And
// where the layer "indirect" is needed.
#include "photons/capabilities.h"

#include "preset/read.h"
#include "spectral/settings.h"
#include "tests/support/test.h"

namespace nephroid::capabilities_test {

using Estimator = photons::Settings::Estimator;
using Effort = photons::Settings::Effort;

/// A prism of glass over a white screen, with these overrides.
photons::Agreed agreed(const preset::Overrides& overrides) {
  const preset::Preset p = preset::read_preset("spectral/prism", overrides);
  return photons::agree(spectral::settings(p), scene::load_scene(p));
}

const char* const rough = "scene.materials.glass.roughness=0.2";
const char* const coated = R"(scene.materials.glass.coating={"dispersion": 1.38, "thickness_nm": 100})";
const char* const plastic = "scene.materials.screen.type=plastic";
const char* const lens = "scene.camera.aperture=0.01";
const char* const sky = R"(scene.environment={"type": "constant", "colour": [1, 1, 1], "lights": true})";
const char* const texture = R"(scene.materials.screen.texture={"type": "checkerboard", "colour0": [1, 1, 1]})";

TEST(Capabilities, WhatTilesCannotIsDoneByPointsWithANote) {
  EXPECT_THAT(agreed({"spectral.estimator=tiles"}).notes, IsEmpty());
  for (const auto& [asks, note] :
       {std::pair{rough, "spectral.estimator: tiles cannot be done here, so it is points: a rough surface scatters the "
                         "corners of a tile"},
        {coated, "spectral.estimator: tiles cannot be done here, so it is points: a coating reflects each wavelength "
                 "otherwise"},
        {plastic, "plastic reflects a part of the light, which tiles do not follow"},
        {texture, "a texture has many colours, and a tile has one"},
        {lens, "a camera with a lens, a shift or parallel rays sees points only"},
        {"spectral.relight=true", "spectral.relight: true cannot be done here, so it is false: the estimator tiles"},
        {"spectral.jitter=false", "spectral.jitter false sends a cluster one way"}}) {
    const photons::Agreed got = agreed({"spectral.estimator=tiles", asks});
    EXPECT_THAT(got.notes, Contains(HasSubstr(note))) << asks;
    EXPECT_THAT(got.notes, SizeIs(1)) << asks;
    EXPECT_TRUE(agreed({asks}).notes.empty()) << "an automatic choice needs no note: " << asks;
    EXPECT_EQ(got.settings.estimator == Estimator::tiles, got.tiles.runs) << asks;
  }
}

TEST(Capabilities, WhatLayersCannotIsRenderedWithoutThemWithANote) {
  EXPECT_TRUE(agreed({"spectral.relight=true", rough}).settings.relight);
  for (const std::string asks : {coated, plastic, texture, lens, sky, "spectral.indirect=true",
                                 "spectral.estimator=sppm", "spectral.effort=equal"}) {
    const photons::Agreed got = agreed({"spectral.relight=true", asks});
    EXPECT_FALSE(got.settings.relight) << asks;
    EXPECT_THAT(got.notes, ElementsAre(StartsWith("spectral.relight: true cannot be done here, so it is false: ")))
        << asks;
    EXPECT_FALSE(agreed({asks}).why_no_layers.empty()) << asks;
  }
  EXPECT_TRUE(agreed({}).why_no_layers.empty());
  EXPECT_THAT(agreed({"spectral.relight=true", coated, lens}).notes,
              ElementsAre(AllOf(HasSubstr("a coating splits"), HasSubstr("; a camera with a lens"))))
      << "all at once";
  for (const preset::Overrides& asks : {preset::Overrides{"spectral.effort=random", "spectral.estimator=points"},
                                        {"spectral.estimator=tiles", rough}}) {
    preset::Overrides with_layers = asks;
    with_layers.emplace_back("spectral.relight=true");
    EXPECT_TRUE(agreed(with_layers).settings.relight) << "what stands in its way is not done: " << asks[0];
  }
}

TEST(Capabilities, ACoatingHasAWavelengthForEachPath) {
  EXPECT_FALSE(agreed({"spectral.jitter=false"}).settings.jitter);
  const photons::Agreed got = agreed({"spectral.jitter=false", coated});
  EXPECT_TRUE(got.settings.jitter);
  EXPECT_THAT(got.notes, ElementsAre("spectral.jitter: false cannot be done here, so it is true: a coating "
                                     "reflects each wavelength otherwise"));
}

TEST(Capabilities, AnEffortIsOfTheEstimatorsThatMeasureIt) {
  for (const auto& [effort, estimator, keeps] : {std::tuple{"variance", "points", true},
                                                 {"variance", "sppm", false},
                                                 {"variance", "tiles", false},
                                                 {"random", "points", false},
                                                 {"random", "sppm", true}}) {
    const photons::Agreed got =
        agreed({std::string("spectral.effort=") + effort, std::string("spectral.estimator=") + estimator});
    EXPECT_EQ(got.settings.effort != Effort::automatic, keeps) << effort << ", " << estimator;
    EXPECT_EQ(got.notes.empty(), keeps) << effort << ", " << estimator;
  }
}

// Points of one plane do not see each other, but in a mirror.
TEST(Capabilities, WallsThatSeeEachOtherHaveIndirectLight) {
  const char *const body = "scene.objects.0.material=screen", *const mirror =
                                                                  R"(scene.materials.glass={"type": "mirror"})";
  const photons::Agreed flat = agreed({});
  EXPECT_FALSE(*flat.settings.indirect);
  EXPECT_THAT(flat.why_no_indirect, HasSubstr("diffuse surfaces are in one plane"));
  EXPECT_TRUE(*agreed({"spectral.indirect=true"}).settings.indirect);
  EXPECT_TRUE(*agreed({body}).settings.indirect);
  EXPECT_TRUE(*agreed({mirror}).settings.indirect);
  EXPECT_FALSE(*agreed({body, "spectral.indirect=false"}).settings.indirect);
  EXPECT_FALSE(*agreed({body, "spectral.relight=true"}).settings.indirect) << "layers are of one reflector";
  EXPECT_TRUE(agreed({body, "spectral.relight=true"}).settings.relight);
}

} // namespace nephroid::capabilities_test
