// SPDX-License-Identifier: Apache-2.0
// Tracks of an animation at a frame against figures by hand, a frame's preset against the same fields given by --set,
// and lines for what cannot be.
#include "preset/animation.h"
#include "preset/read.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::animation_test {

using preset::Preset;

constexpr const char* scene = R"("scene": {
  "camera": {"position": [0, 1, 4], "fov_deg": 40},
  "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "paper": {"type": "diffuse"}},
  "objects": [{"name": "ball", "shape": {"type": "cylinder", "segments": 16}, "material": "glass"}],
  "lights": [{"type": "directional", "direction": [0, -1, 0]}, {"type": "point", "position": [0, 3, 0]}]
})";

std::string with(const std::string& animation) {
  return R"({"engine": "spectral", )" + std::string(scene) + R"(, "animation": )" + animation + "}";
}
std::string tracks(const std::string& list) { return with(R"({"frames": 11, "tracks": [)" + list + "]}"); }
Preset read(const std::string& animation, const preset::Overrides& overrides = {}) {
  return preset::parse_preset(animation, "a.json", overrides);
}

preset::Track track(preset::Track::Interpolation interpolation, std::vector<preset::Key> keys) {
  return {"seed", interpolation, std::move(keys)};
}

TEST(Animation, IsLinearBetweenKeysAndHeldOutside) {
  const preset::Track t = track(preset::Track::Interpolation::linear, {{2, {1, 10}}, {6, {3, 30}}, {7, {0, 0}}});
  EXPECT_THAT(preset::value_at(t, 0), ElementsAre(1, 10));
  EXPECT_THAT(preset::value_at(t, 2), ElementsAre(1, 10));
  EXPECT_THAT(preset::value_at(t, 3), ElementsAre(1.5, 15));
  EXPECT_THAT(preset::value_at(t, 6), ElementsAre(3, 30));
  EXPECT_THAT(preset::value_at(t, 7), ElementsAre(0, 0));
  EXPECT_THAT(preset::value_at(t, 500), ElementsAre(0, 0));
}

// Keys (0, 0), (4, 4), (8, 4), (12, 8): secants 1, 0, 1, so the slopes are 1, 0, 0, 1. Half way through the first
// interval of width w = 4 a Hermite cubic is (y0 + y1) / 2 + w (m0 - m1) / 8 = 2 + 4 (1 - 0) / 8 = 2.5, flat in the
// second, and 6 - .5 = 5.5 in the third.
TEST(Animation, IsSmoothThroughKeysAndNeverBeyondThem) {
  const preset::Track t = track(preset::Track::Interpolation::smooth, {{0, {0}}, {4, {4}}, {8, {4}}, {12, {8}}});
  for (const auto& [frame, value] :
       {std::pair(0, 0.0), {2, 2.5}, {4, 4.0}, {6, 4.0}, {8, 4.0}, {10, 5.5}, {12, 8.0}, {90, 8.0}})
    EXPECT_THAT(preset::value_at(t, frame), ElementsAre(testing::DoubleEq(value))) << frame;
  const preset::Track line = track(preset::Track::Interpolation::smooth, {{0, {0}}, {10, {360}}});
  EXPECT_THAT(preset::value_at(line, 3), ElementsAre(testing::DoubleEq(108))) << "two keys are a straight line";
}

TEST(Animation, SetsItsFieldsAsAnOverrideWould) {
  const Preset p = read(tracks(
      R"({"path": "scene.objects.0.transform.rotate_deg", "keys": [{"frame": 0, "value": [0, 0, 0]}, {"frame": 10, "value": [0, 360, 30]}]},
    {"path": "scene.camera.position.1", "keys": [{"frame": 4, "value": 2}, {"frame": 6, "value": 3}]},
    {"path": "scene.objects.0.shape.segments", "keys": [{"frame": 0, "value": 16}, {"frame": 10, "value": [20]}]},
    {"path": "scene.materials.glass.dispersion.n", "keys": [{"frame": 0, "value": 1.5}, {"frame": 10, "value": 2}]},
    {"path": "stop.seconds", "keys": [{"frame": 0, "value": 1}, {"frame": 10, "value": 11}]},
    {"path": "spectral.threshold_deg", "keys": [{"frame": 0, "value": 0.5}, {"frame": 10, "value": 0.25}]})"));
  // 1/2 of the way: 180 degrees and 15; half way from 2 to 3; 16 + 4/2; 1.75; 6 s; .375.
  Preset expected =
      read(with("null"), {"scene.objects.0.transform.rotate_deg=[0,180,15]", "scene.camera.position=[0,2.5,4]",
                          "scene.objects.0.shape.segments=18", "scene.materials.glass.dispersion=1.75",
                          "stop.seconds=6", "spectral.threshold_deg=0.375"});
  expected.name = "a,frame=5";
  const Preset frame = preset::at_frame(p, 5);
  EXPECT_EQ(preset::to_json(frame), preset::to_json(expected));
  EXPECT_TRUE(frame == expected);
}

TEST(Animation, IsReadAsItsFrame0) {
  const Preset p = read(
      tracks(R"({"path": "scene.camera.fov_deg", "keys": [{"frame": 0, "value": 20}, {"frame": 10, "value": 30}]})"));
  EXPECT_EQ(p.scene.camera.fov_deg, 20);
  ASSERT_TRUE(p.animation);
  EXPECT_EQ(p.animation->tracks.size(), 1u);
  EXPECT_TRUE(preset::parse_preset(preset::to_json(p), "a.json") == p) << "it reads back";
  Preset still = p;
  still.animation.reset();
  still.name += ",frame=0";
  EXPECT_TRUE(preset::at_frame(p, 0) == still);
}

TEST(Animation, RoundsWholeNumbers) {
  const Preset p = read(tracks(R"({"path": "seed", "keys": [{"frame": 0, "value": 1}, {"frame": 10, "value": 4}]})"));
  std::vector<std::uint64_t> seeds;
  for (int frame = 0; frame <= 10; ++frame) seeds.push_back(preset::at_frame(p, frame).seed); // 1 + .3 frame
  EXPECT_THAT(seeds, ElementsAre(1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4));
}

TEST(Animation, IsRefusedInOneLine) {
  const std::string key = R"("keys": [{"frame": 0, "value": 1}])";
  const std::string at = "a.json#/animation/tracks/0/",
                    a_number = "; expected a field with a number or a list of numbers",
                    no_path =
                        " is no path; expected keys joined by dots, for instance scene.objects.0.transform.translate";
  const auto expect_refused = [](const std::string& track, const std::string& says) {
    const std::string line = refusal_of([&] { read(tracks(track)); });
    EXPECT_THAT(line, AllOf(StartsWith(says), Not(HasSubstr("\n")))) << track;
  };
  const std::pair<const char*, std::string> paths[] = {
      {"scene.objects.0.transform.trnslate",
       "unknown key 'trnslate'; the keys here are scale, rotate_deg, translate; did you mean 'translate'?"},
      {"scene.objects.1.transform.translate", "'scene.objects' is a list and has no item '1'; its items are 0 to 0"},
      {"scene.objects.ball.transform.translate",
       "'scene.objects' is a list and has no item 'ball'; its items are 0 to 0"},
      {"scene.lights.1.half_angle_deg",
       "'half_angle_deg' has no meaning for the type 'point'; it belongs to 'spot'; remove it or change the type"},
      {"scene.environment.rotate_deg", "'scene.environment' is null and has no fields; set the whole value instead"},
      {"scene.lights.0.type", "'scene.lights.0.type' is a word" + a_number},
      {"leave_out", "'leave_out' is true or false" + a_number},
      {"scene.camera", "'scene.camera' is a section" + a_number},
      {"scene.camera.resolution.0", "'scene.camera.resolution.0' cannot be animated; frames of one size make a video"},
      {"animation.fps", "'animation.fps' cannot be animated; expected a field outside of the animation"},
      {"/seed", "'/seed'" + no_path},
      {"scene..camera", "'scene..camera'" + no_path}};
  for (const auto& [path, says] : paths)
    expect_refused(fmt::format(R"({{"path": "{}", {}}})", path, key), at + "path: " + says);
  const std::array<std::string, 3> keys[] = {
      {"seed", R"([])", "keys: is an empty list; expected a list of 1 to 10000 items, each an object"},
      {"seed", R"([{"frame": 5, "value": 1}, {"frame": 5, "value": 2}])",
       "keys/1/frame: is 5, and the key before it is at 5; expected keys by rising frame"},
      {"seed", R"([{"frame": 5, "value": 1}, {"frame": 2, "value": 2}])",
       "keys/1/frame: is 2, and the key before it is at 5; expected keys by rising frame"},
      {"seed", R"([{"frame": -1, "value": 1}])", "keys/0/frame: is -1; expected a whole number from 0 to 1000000"},
      {"seed", R"([{"frame": 0, "value": 1.5}])",
       "keys/0/value: is 1.5; expected a whole number from 0 to 18446744073709551615"},
      {"scene.camera.fov_deg", R"([{"frame": 0, "value": 30}, {"frame": 9, "value": 200}])",
       "keys/1/value: is 200; expected a number from 0.001 to 179.9 degrees"},
      {"scene.camera.position", R"([{"frame": 0, "value": [1, 2]}])",
       "keys/0/value: is a list of 2 items; expected a list of 3 items, each a number from -10000000 to 10000000 "
       "length units"},
      {"scene.camera.position", R"([{"frame": 0, "value": 1}])",
       "keys/0/value: is a list of 1 item; expected a list of 3 items"},
      {"scene.camera.position", R"([{"frame": 0, "value": [1, 2, 3]}, {"frame": 1, "value": [1, 2]}])",
       "keys/1/value: has 2 numbers, and the first key has 3; expected as many in each key"},
      {"scene.camera.position", R"([{"frame": 0, "value": "here"}])",
       "keys/0/value: is the string 'here'; expected a list of 1 to 100 items, each a number"}};
  for (const auto& [path, list, says] : keys)
    expect_refused(fmt::format(R"({{"path": "{}", "keys": {}}})", path, list), at + says);
  expect_refused(R"({"path": "seed"})", "a.json#/animation/tracks/0: has no 'keys'; this key is required");
  expect_refused(R"({"path": "seed", )" + key + R"(}, {"path": "seed", )" + key + "}",
                 "a.json#/animation/tracks/1/path: 'seed' has a track already, 'seed'; expected one track for a field");
  expect_refused(
      R"({"path": "scene.camera.position", "keys": [{"frame": 0, "value": [1, 2, 3]}]}, {"path": "scene.camera.position.1", )" +
          key + "}",
      "a.json#/animation/tracks/1/path: 'scene.camera.position.1' has a track already, 'scene.camera.position'; "
      "expected one "
      "track for a field");
  for (const char* frames : {"0", "10001", "-3", "2.5", "1e9"})
    EXPECT_THAT(
        refusal_of([&] { read(with(std::string(R"({"frames": )") + frames + "}")); }),
        AllOf(StartsWith("a.json#/animation/frames: is "), HasSubstr("expected a whole number from 1 to 10000")));
  EXPECT_THAT(refusal_of([&] { read(with(R"({"fps": 0})")); }),
              StartsWith("a.json#/animation/fps: is 0; expected a number from 0.1 to 1000"));
  EXPECT_THAT(refusal_of([&] {
                read(with("{}"), {"white=1", "reference=a.exr"});
              }),
              StartsWith("--set reference=a.exr: is one picture for all frames"));
}

// The light turns over by way of no direction at all, half way: frame 5 of 11.
TEST(Animation, SaysWhichFrameCannotBe) {
  const Preset p = read(tracks(
      R"({"path": "scene.lights.0.direction", "keys": [{"frame": 0, "value": [0, -1, 0]}, {"frame": 10, "value": [0, 1, 0]}]})"));
  EXPECT_NO_THROW(preset::at_frame(p, 4));
  EXPECT_EQ(refusal_of([&] { preset::at_frame(p, 5); }),
            "a.json#/animation/tracks/0: has no length; expected a direction; in frame 5");
}

/// The JSON of the preset after an edit in frame 5.
preset::Json keyed(const Preset& before, const std::function<void(preset::Json&)>& edit) {
  preset::Json edited = preset::as_json(before);
  edit(edited);
  return preset::with_keys(preset::as_json(before), edited, 5, "a.json");
}

TEST(AnimationEdits, AreKeysOfTheFieldsThatMove) {
  const Preset p = preset::shown_at(
      read(tracks(
          R"({"path": "scene.objects.0.transform.translate", "keys": [{"frame": 0, "value": [0, 0, 0]}, {"frame": 10, "value": [10, 0, 0]}]},
        {"path": "scene.materials.glass.dispersion.n", "keys": [{"frame": 8, "value": 1.5}]})")),
      5);
  EXPECT_EQ(p.scene.objects[0].transform.translate, (preset::Vec3{5, 0, 0}));
  const preset::Json same = keyed(p, [](preset::Json& json) { json["seed"] = 7; });
  EXPECT_EQ(same["animation"], preset::as_json(p)["animation"]);
  const preset::Json moved = keyed(p, [](preset::Json& json) {
    json["scene"]["objects"][0]["transform"]["translate"] = {5, 1, 0};
    json["scene"]["materials"]["glass"]["dispersion"]["n"] = 1.6;
  });
  const Preset now = preset::shown_at(preset::read_json(moved, "a.json"), 5);
  EXPECT_EQ(now.animation->tracks[0].keys,
            (std::vector<preset::Key>{{0, {0, 0, 0}}, {5, {5, 1, 0}}, {10, {10, 0, 0}}}));
  EXPECT_EQ(now.animation->tracks[1].keys, (std::vector<preset::Key>{{5, {1.6}}, {8, {1.5}}}));
  EXPECT_EQ(now.scene.objects[0].transform.translate, (preset::Vec3{5, 1, 0}));
  EXPECT_THAT(refusal_of([&] {
                keyed(p, [](preset::Json& json) { json["scene"]["objects"][0]["transform"]["translate"] = nullptr; });
              }),
              HasSubstr("a.json#/scene/objects/0/transform/translate: changes with the frames"));
}

TEST(AnimationEdits, TracksGoWithTheirItems) {
  const Preset p = read(tracks(R"({"path": "scene.lights.1.position", "keys": [{"frame": 0, "value": [0, 3, 0]}]},
    {"path": "scene.materials.glass.dispersion.n", "keys": [{"frame": 0, "value": 1.5}]})"));
  const auto paths = [&](const std::function<void(preset::Json&)>& edit) {
    std::vector<std::string> all;
    const preset::Json now = keyed(p, edit);
    for (const preset::Json& track : now["animation"]["tracks"]) {
      all.push_back(track["path"]);
      EXPECT_THAT(track["keys"], SizeIs(1)) << "no key of another item's value";
    }
    return all;
  };
  const std::string index = "scene.materials.glass.dispersion.n";
  const auto lights = [](preset::Json& json) -> preset::Json& { return json["scene"]["lights"]; };
  EXPECT_THAT(paths([&](preset::Json& json) { lights(json).erase(0); }), ElementsAre("scene.lights.0.position", index));
  EXPECT_THAT(paths([&](preset::Json& json) { lights(json).erase(1); }), ElementsAre(index));
  EXPECT_THAT(paths([&](preset::Json& json) { std::swap(lights(json)[0], lights(json)[1]); }),
              ElementsAre("scene.lights.0.position", index));
  EXPECT_THAT(paths([](preset::Json& json) {
                preset::Json& materials = json["scene"]["materials"];
                const preset::Json glass = materials["glass"];
                materials.erase("glass");
                materials["crown"] = glass;
              }),
              ElementsAre("scene.lights.1.position", "scene.materials.crown.dispersion.n"));
}

} // namespace nephroid::animation_test
