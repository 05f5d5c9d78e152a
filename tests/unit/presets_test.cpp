// SPDX-License-Identifier: Apache-2.0
// Reading presets: defaults, shorthands, parents, overrides, sweeps, the names of shipped presets. What is written
// reads back equal. Which edits are another light on the same scene, and which no run takes on.
#include "preset/read.h"
#include "preset/settings_type.h"
#include "spectral/engine.h"
#include "tests/support/presets.h"
#include "tests/support/random_preset.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace nephroid::presets_test {

using preset::Preset;

Preset parse(const std::string& fields, const preset::Overrides& overrides = {}) {
  return preset::parse_preset(R"({"engine":"spectral",)" + fields + "}", "a.json", overrides);
}

TEST(PresetReading, WhatIsNotGivenHasItsDefault) {
  Preset expected;
  expected.name = "a"; // from the file's name
  expected.source = "a.json";
  EXPECT_TRUE(preset::parse_preset(R"({"engine":"spectral"})", "a.json") == expected);
}

TEST(PresetReading, AValueReadsAsItsTextDoes) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Preset p = test::random_preset(seed);
    EXPECT_EQ(preset::as_json(p), preset::Json::parse(preset::to_json(p))) << seed;
    EXPECT_TRUE(preset::read_json(preset::as_json(p), p.source) == preset::parse_preset(preset::to_json(p), p.source))
        << seed;
  }
  Preset endless = parse(R"("name":"endless")");
  endless.scene.camera.position[0] = std::numeric_limits<double>::infinity(); // which no text has
  EXPECT_THROW(preset::with_overrides(endless, {}), Error);
  EXPECT_EQ(preset::with_overrides(parse(R"("white":3)"), {"white=4"}).white, 4);
}

TEST(PresetReading, AWordStandsForAWhiteThatIsFitted) {
  const Preset p = parse(R"("white":"auto")");
  EXPECT_EQ(p.white, std::nullopt);
  EXPECT_EQ(nlohmann::json::parse(preset::to_json(p))["white"], "auto");
  EXPECT_TRUE(preset::parse_preset(preset::to_json(p), "a.json") == p);
  EXPECT_EQ(parse(R"("white":3)", {"white=auto"}).white, std::nullopt);
  EXPECT_THROW(parse(R"("white":"auto","reference":"a.exr")"), Error) << "whose white is not known";
  const Preset relit = parse(R"("white":1,"spectral":{"relight":true})");
  Preset brighter = relit;
  brighter.white = 2;
  EXPECT_TRUE(engine::adoptable(relit, brighter));
  brighter.white.reset();
  EXPECT_FALSE(engine::adoptable(relit, brighter)) << "it is fitted to a first picture";
}

TEST(PresetReading, BareValuesStandForObjects) {
  const Preset p = parse(R"("scene":{"materials":{
      "n":{"type":"dielectric","dispersion":1.33},
      "file":{"type":"dielectric","dispersion":"N-BK7.yml"},
      "grey":{"type":"diffuse","reflectance":0.18},
      "red":{"type":"mirror","reflectance":"red"}},
      "lights":[{"type":"point","spectrum":"F10"}]})");
  const auto& m = p.scene.materials;
  EXPECT_EQ(m.at("n").dispersion.type, preset::Dispersion::Type::constant);
  EXPECT_EQ(m.at("n").dispersion.n, 1.33);
  EXPECT_EQ(m.at("file").dispersion.type, preset::Dispersion::Type::file);
  EXPECT_EQ(m.at("file").dispersion.file, "N-BK7.yml");
  EXPECT_EQ(m.at("grey").reflectance.value, 0.18);
  EXPECT_EQ(m.at("red").reflectance.type, preset::Reflectance::Type::patch);
  EXPECT_EQ(m.at("red").reflectance.patch, "red");
  EXPECT_EQ(p.scene.lights.at(0).spectrum.illuminant, "F10");
}

TEST(PresetReading, WholeNumbersMayHaveAPoint) { EXPECT_EQ(parse(R"("seed":1e3)").seed, 1000u); }

TEST(PresetReading, UnitsInMetres) {
  EXPECT_EQ(preset::metres(parse(R"("unit":"mm")").unit), 1e-3);
  EXPECT_EQ(preset::metres(parse(R"("unit":"cm")").unit), 1e-2);
  EXPECT_EQ(preset::metres(parse(R"("unit":"m")").unit), 1);
}

TEST(PresetOverrides, ReachEveryKindOfValue) {
  const Preset p = parse(
      R"("scene":{"lights":[{"type":"point"},{"type":"point"}],"materials":{"g":{"type":"dielectric","dispersion":1.5}}})",
      {"scene.lights.1.power_w=2.5", "unit=cm", "stop.passes=3", "scene.materials.g.dispersion=materials/N-BK7.yml",
       "name=1 and 2", "spectral.direct=false", "scene.camera.position=[1,2,3]", "scene.camera.position.2=4", "seed=1",
       "seed=9"});
  EXPECT_EQ(p.scene.lights[0].power_w, 1);
  EXPECT_EQ(p.scene.lights[1].power_w, 2.5);
  EXPECT_EQ(p.unit, Preset::Unit::cm);
  EXPECT_EQ(p.stop.passes, 3);
  EXPECT_EQ(p.scene.materials.at("g").dispersion.file, "materials/N-BK7.yml");
  EXPECT_EQ(p.name, "1 and 2");
  EXPECT_FALSE(spectral::settings(p).direct);
  EXPECT_THAT(p.scene.camera.position, ElementsAre(1, 2, 4));
  EXPECT_EQ(p.seed, 9u); // the last one wins
  EXPECT_FALSE(parse(R"("stop":{"seconds":5})", {"stop.seconds=null"}).stop.seconds);
}

TEST(PresetOverrides, TakeNumbersAsPeopleTypeThem) {
  const std::string some = R"("unit":"cm")";
  const auto white = [&](const std::string& number) { return parse(some, {"white=" + number}).white; };
  EXPECT_EQ(white(".02"), 0.02);
  EXPECT_EQ(white("+3"), 3);
  EXPECT_EQ(white("5."), 5);
  EXPECT_EQ(white("+.5e+1"), 5);
  EXPECT_EQ(white("1E-5"), 1e-5);
  EXPECT_EQ(parse(some, {"seed=+7"}).seed, 7u);
  EXPECT_EQ(parse(some, {"seed=1e5"}).seed, 100000u);
  const Preset p = parse(some, {"scene.camera.position=[.5,+1, -.25]", R"(description="[.5, +1]")", "name=.5 or +3"});
  EXPECT_THAT(p.scene.camera.position, ElementsAre(0.5, 1, -0.25));
  EXPECT_EQ(p.description, "[.5, +1]") << "inside quotation marks text stays as it is";
  EXPECT_EQ(p.name, ".5 or +3") << "and so does what is no number as a whole";
}

class PresetFiles : public testing::Test {
protected:
  test::TemporaryFolder folder;
  std::string write(const std::string& name, const std::string& text) const { return folder.write(name, text); }
};

TEST_F(PresetFiles, AChildTakesOverItsParent) {
  write("base/parent.json",
        R"({"engine":"spectral","name":"P","description":"of the parent","seed":5,"stop":{"seconds":3,"passes":7},
      "scene":{"materials":{"a":{"type":"dielectric","dispersion":1.5,"absorption":false},"b":{"type":"diffuse"},"c":{"type":"mirror"}},
               "lights":[{"type":"point"},{"type":"point"}]}})");
  const Preset p =
      preset::read_preset(write("child.json", R"({"$schema":"x","parent":"base/parent","stop":{"seconds":null},
      "scene":{"materials":{"a":{"dispersion":1.7},"b":null,"c":{"type":"diffuse","reflectance":0.5}},"lights":[{"type":"spot"}]}})"));
  EXPECT_EQ(p.name, "child");
  EXPECT_EQ(p.description, "");
  EXPECT_EQ(p.seed, 5u);
  EXPECT_FALSE(p.stop.seconds);
  EXPECT_EQ(p.stop.passes, 7);
  ASSERT_EQ(p.scene.materials.size(), 2u);                // null took b away
  EXPECT_EQ(p.scene.materials.at("a").dispersion.n, 1.7); // objects merge
  EXPECT_FALSE(p.scene.materials.at("a").absorption);
  EXPECT_EQ(p.scene.materials.at("c").reflectance.value, 0.5); // a new type starts anew
  ASSERT_EQ(p.scene.lights.size(), 1u);                        // lists replace
  EXPECT_EQ(p.scene.lights[0].type, preset::Light::Type::spot);
  EXPECT_EQ(p.source, (folder.path() / "child.json").string());
}

TEST_F(PresetFiles, InheritedFileNamesMeanTheSameFile) {
  const std::string own = write("base/own.yml", "");
  write("base/both.yml", "the parent's");
  write("both.yml", "the child's");
  write("base/parent.json", R"({"engine":"spectral","scene":{"materials":{
      "own":{"type":"dielectric","dispersion":"own.yml"},
      "both":{"type":"dielectric","dispersion":{"type":"file","file":"both.yml"}},
      "shipped":{"type":"dielectric","dispersion":"materials/N-BK7.yml"}}}})");
  const std::string child = write("child.json", R"({"parent":"base/parent.json","scene":{"materials":{
      "mine":{"type":"dielectric","dispersion":"both.yml"}}}})");
  const auto materials = preset::read_preset(child).scene.materials;
  EXPECT_EQ(materials.at("own").dispersion.file, fs::canonical(own));
  EXPECT_EQ(materials.at("both").dispersion.file, fs::canonical(folder.path() / "base/both.yml"));
  EXPECT_EQ(materials.at("shipped").dispersion.file, "materials/N-BK7.yml");
  EXPECT_EQ(materials.at("mine").dispersion.file, "both.yml");
}

TEST_F(PresetFiles, AnotherEngineTakesAwayWhatItDoesNotKnow) {
  const std::string parent =
      write("parent.json", R"({"engine": "spectral", "white": 3, "spectral": {"threshold_deg": 1},
    "scene": {"camera": {"fov_deg": 30}, "lights": [{"type": "point"}]},
    "reference": {"type": "recipe", "spectral": {"step_nm": 2}, "passes": 9}, "sweep": {"spectral.threshold_deg": [1, 2]},
    "animation": {"frames": 4, "tracks": [{"path": "spectral.threshold_deg", "keys": [{"frame": 0, "value": 1}]},
                                          {"path": "scene.camera.fov_deg", "keys": [{"frame": 0, "value": 20}]}]}})");
  const auto expect_environment = [](const Preset& p, const std::string& note) {
    EXPECT_EQ(p.settings.engine(), "environment");
    EXPECT_EQ(p.white, 3);
    ASSERT_EQ(p.scene.lights.size(), 1u);
    ASSERT_TRUE(p.reference);
    EXPECT_EQ(p.reference->passes, 9);
    EXPECT_FALSE(p.reference->settings) << "the run's own";
    ASSERT_EQ(p.animation->tracks.size(), 1u);
    EXPECT_EQ(p.scene.camera.fov_deg, 20);
    EXPECT_THAT(p.provenance.notes,
                testing::ElementsAre(note + ": left out what the engine 'environment' does not know: spectral, "
                                            "reference.spectral, sweep: spectral.threshold_deg, animation: "
                                            "spectral.threshold_deg"));
  };
  expect_environment(preset::read_preset(parent, {"engine=environment"}), "--set engine=environment");
  const std::string child =
      write("child.json", R"({"parent": "parent", "engine": "environment", "environment": {"directions": 98}})");
  expect_environment(preset::read_preset(child), child + "#/engine");
  EXPECT_TRUE(preset::read_preset(child, {"engine=environment"}).provenance.notes.size() == 1)
      << "it has that engine already";

  // What is said for the new engine is not forgiven, and null is nothing.
  EXPECT_THROW(preset::read_preset(parent, {"engine=environment", "spectral.threshold_deg=1"}), Error);
  EXPECT_NO_THROW(preset::read_preset(parent, {"engine=environment", "spectral=null"}));

  // An engine may have no use for parts of a scene either.
  const Preset inverse = preset::read_preset(parent, {"engine=inverse"});
  EXPECT_TRUE(inverse.scene.lights.empty());
  EXPECT_EQ(inverse.scene.camera.fov_deg, 20);
  EXPECT_FALSE(inverse.reference);
  EXPECT_THAT(inverse.provenance.notes, testing::ElementsAre(testing::HasSubstr("scene.lights, white, reference")));
}

TEST_F(PresetFiles, EveryShippedPresetTakesEveryEngine) {
  for (const preset::ShippedPreset& shipped : preset::shipped_presets())
    for (const preset::SettingsType* type : preset::settings_types())
      for (const Preset& p : preset::read_presets(shipped.file.string(), {"engine=" + std::string(type->name)}))
        EXPECT_EQ(p.settings.engine(), type->name) << shipped.name;
}

TEST_F(PresetFiles, AShippedPresetCanBeAParent) {
  const Preset parent = preset::read_preset("spectral/ball-lens.json");
  Preset child = preset::read_preset(
      write("mine.json", R"({"parent":"spectral/ball-lens","description":")" + parent.description + R"("})"));
  child.name = parent.name;
  child.source = parent.source;
  EXPECT_TRUE(child == parent);
}

TEST_F(PresetFiles, SweepsAreNestedLoopsInTheOrderOfTheirKeys) {
  const std::string file =
      write("s.json", R"({"engine":"spectral","sweep":{"spectral.threshold_deg":[0.5,0.1],"seed":[3,1,2]}})");
  std::vector<std::string> names;
  std::vector<std::pair<double, std::uint64_t>> values;
  for (const Preset& p : preset::read_presets(file)) {
    names.push_back(p.name);
    values.emplace_back(spectral::settings(p).threshold_deg, p.seed);
  }
  using P = std::pair<double, std::uint64_t>;
  EXPECT_THAT(values, ElementsAre(P(.5, 3), P(.5, 1), P(.5, 2), P(.1, 3), P(.1, 1), P(.1, 2)));
  EXPECT_THAT(names,
              ElementsAre("s,threshold_deg=0.5,seed=3", "s,threshold_deg=0.5,seed=1", "s,threshold_deg=0.5,seed=2",
                          "s,threshold_deg=0.1,seed=3", "s,threshold_deg=0.1,seed=1", "s,threshold_deg=0.1,seed=2"));
  EXPECT_EQ(preset::read_presets(file, {"seed=8"}).size(), 2u); // an override fixes what was swept
  EXPECT_EQ(preset::read_presets(file, {"sweep=null"}).size(), 1u);
  EXPECT_EQ(preset::read_presets(file, {R"(sweep={"seed":[1,2,3,4]})"}).size(), 4u);
}

TEST_F(PresetFiles, NamesOfSweptRunsAreUniqueAndGoodForFolders) {
  const std::string file =
      write("s.json", R"({"engine":"spectral","scene":{"materials":{"g":{"type":"dielectric","dispersion":1.5}},
      "lights":[{"type":"point"},{"type":"point"}]},
      "sweep":{"scene.materials.g.dispersion":["a/b.yml",{"type":"constant","n":2}],"scene.lights.0.power_w":[1],"scene.lights.1.power_w":[2],
               "stop":[{"passes":1},{"passes":2}],"unit":["m","m"]}})");
  std::set<std::string> names;
  for (const Preset& p : preset::read_presets(file)) {
    names.insert(p.name);
    EXPECT_EQ(p.name.find('/'), std::string::npos) << p.name;
  }
  EXPECT_EQ(names.size(), 8u);
  const std::string glasses =
      write("g.json", R"({"engine":"spectral","scene":{"materials":{"g":{"type":"dielectric","dispersion":1.5}}},
      "sweep":{"scene.materials.g.dispersion":["materials/N-BK7.yml",1.7],"scene.camera.resolution":[[32,16]]}})");
  EXPECT_EQ(preset::read_presets(glasses).front().provenance.varies, "dispersion=N-BK7.yml,resolution=32_16");
  EXPECT_TRUE(names.contains("s,dispersion=0,scene.lights.0.power_w=1,scene.lights.1.power_w=2,stop=1,unit=0"));
}

TEST(PresetReading, AKeyOfAnotherPlaceIsNamedWithItsPath) {
  const auto refusal = [](const std::string& text) {
    return test::refusal_of([&] { parse(R"("scene":{"lights":[{"type":"point"}]})", {text}); });
  };
  EXPECT_THAT(refusal("threshold_deg=1"), testing::HasSubstr("did you mean 'spectral.threshold_deg'?"));
  EXPECT_THAT(refusal("power_w=1"), testing::HasSubstr("did you mean 'scene.lights.0.power_w'?"));
  EXPECT_THAT(refusal("passes=1"), testing::HasSubstr("did you mean 'stop.passes'?"));
}

TEST(ShippedPresets, AreListedByNameWithALineEach) {
  std::vector<std::string> names;
  for (const preset::ShippedPreset& s : preset::shipped_presets()) {
    names.push_back(s.name);
    EXPECT_FALSE(s.description.empty()) << s.name;
    EXPECT_TRUE(preset::read_presets(s.name) == preset::read_presets(s.file.string())) << s.name;
  }
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_THAT(names, IsSupersetOf({"first-light", "spectral/ball-lens", "spectral/brilliant", "spectral/plate",
                                   "spectral/prism"}));
}

TEST(PresetWriting, EveryShippedPresetReadsBackEqual) {
  const auto shipped = preset::shipped_presets();
  ASSERT_GE(shipped.size(), 5u);
  for (const preset::ShippedPreset& s : shipped)
    for (const Preset& p : preset::read_presets(s.name)) {
      EXPECT_TRUE(preset::parse_preset(preset::to_json(p), p.source) == p) << s.name;
      EXPECT_FALSE(p.description.empty()) << s.name;
    }
}

TEST(PresetWriting, RandomPresetsReadBackEqual) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Preset p = test::random_preset(seed);
    const std::string text = preset::to_json(p);
    const Preset back = preset::parse_preset(text, p.source);
    ASSERT_TRUE(back == p) << "seed " << seed << "\n" << text;
    ASSERT_EQ(preset::to_json(back), text) << "seed " << seed;
  }
}

TEST(PresetWriting, NumbersKeepTheirLastBit) {
  Preset p = preset::parse_preset(R"({"engine":"spectral"})", "a.json");
  for (const double white : {0.1, 1.0 / 3, 2.0 / 3, 1e-12, 0x1.fffffffffffffp-5, 123456789.123456789, 1e12})
    EXPECT_EQ(preset::parse_preset(preset::to_json((p.white = white, p)), "a.json").white, white);
  for (const std::uint64_t seed : {0ull, (1ull << 53) + 1, ~0ull})
    EXPECT_EQ(preset::parse_preset(preset::to_json((p.seed = seed, p)), "a.json").seed, seed);
}

TEST(PresetWriting, IsCompleteAndInTheOrderOfTheDescription) {
  const auto json = nlohmann::ordered_json::parse(preset::to_json(preset::read_preset("first-light")));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("name", "description", "not_imported", "engine", "unit", "seed", "white", "display",
                                "scene", "spectral", "stop", "reference", "measure", "animation", "leave_out"));
  EXPECT_TRUE(json["scene"]["objects"][0]["shape"].is_null());
  EXPECT_EQ(json["scene"]["materials"]["glass"]["dispersion"]["outside"], "automatic");
}

TEST(PresetWriting, ListsOfNumbersStayOnOneLine) {
  EXPECT_THAT(preset::to_json(preset::read_preset("first-light")), HasSubstr("\"resolution\": [512, 512]\n"));
}

TEST(PresetWriting, AnotherFolderFindsTheSameFiles) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "out");
  write_file_whole(folder.path() / "own.yml", "");
  const std::string text = R"({"engine":"spectral","scene":{"materials":{
      "own":{"type":"dielectric","dispersion":"own.yml"},
      "shipped":{"type":"dielectric","dispersion":"materials/N-BK7.yml"},
      "missing":{"type":"dielectric","dispersion":"missing.yml"}}}})";
  const Preset p = preset::parse_preset(text, (folder.path() / "a.json").string());
  const auto there = nlohmann::json::parse(preset::to_json(p, folder.path() / "out"))["scene"]["materials"];
  EXPECT_EQ(there["own"]["dispersion"]["file"],
            fs::canonical(folder.path() / "own.yml").string());             // only beside the preset
  EXPECT_EQ(there["shipped"]["dispersion"]["file"], "materials/N-BK7.yml"); // found from anywhere
  EXPECT_EQ(there["missing"]["dispersion"]["file"], "missing.yml");         // the loader's to report
  const auto here = nlohmann::json::parse(preset::to_json(p, folder.path()))["scene"]["materials"];
  EXPECT_EQ(here["own"]["dispersion"]["file"], "own.yml");
}

preset::Preset layered() {
  preset::Preset p = test::empty_preset(8);
  spectral::settings(p).relight = true;
  p.scene.lights.resize(2);
  return p;
}

TEST(OnlyRelit, IsAnotherSpectrumPowerWhiteOrName) {
  const preset::Preset before = layered();
  preset::Preset now = before;
  EXPECT_TRUE(spectral::adoptable(before, now));
  now.scene.lights[1].spectrum.illuminant = "F10";
  now.scene.lights[1].power_w = 0;
  now.scene.lights[0].irradiance_w_m2 = 7;
  now.white = 3;
  now.name = "evening";
  EXPECT_TRUE(spectral::adoptable(before, now));
  now.display.tone = preset::Display::Tone::clip;
  EXPECT_TRUE(engine::adoptable(before, now)) << "how it is shown changes no light";
}

TEST(OnlyRelit, IsNothingElse) {
  const preset::Preset before = layered();
  const auto differs = [&](auto change) {
    preset::Preset now = before;
    change(now);
    return !spectral::adoptable(before, now);
  };
  EXPECT_TRUE(differs([](preset::Preset& p) { spectral::settings(p).relight = false; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.lights.pop_back(); }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.lights[0].position[0] += 1; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.lights[0].type = preset::Light::Type::spot; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.camera.fov_deg += 1; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.seed += 1; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { spectral::settings(p).threshold_deg *= 2; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.stop.passes = 3; }));
  preset::Preset without = before;
  spectral::settings(without).relight = false;
  EXPECT_FALSE(spectral::adoptable(without, without)) << "a run without layers has nothing to weigh";
}

// A preset is edited into one of another engine while its run goes on: Parameters do so.
TEST(Adoptable, NoEngineTakesOnAnothersPreset) {
  for (const engine::Engine* own : engine::engines()) {
    preset::Preset before{.settings = preset::Settings(own->settings())};
    for (const engine::Engine* other : engine::engines()) {
      if (other == own) continue;
      preset::Preset now = before;
      now.settings = preset::Settings(other->settings());
      EXPECT_FALSE(engine::adoptable(before, now)) << own->settings().name << " to " << other->settings().name;
    }
  }
}

} // namespace nephroid::presets_test
