// SPDX-License-Identifier: Apache-2.0
// What differs from a file, as a command line and as a file with a parent: read back, it is the preset, over random
// edits of every shipped preset.
#include "preset/differences.h"
#include "tests/support/child.h"

#include <nlohmann/json.hpp>

namespace nephroid::preset_differences_test {

using preset::Preset;
using Json = nlohmann::ordered_json;

Json json_of(const Preset& preset) { return Json::parse(preset::to_json(preset)); }

bool same(Preset a, const Preset& b) {
  a.source = b.source;
  return a == b;
}

/// Presets that are edited, and others whose values are taken.
class Edits {
public:
  explicit Edits(std::uint64_t seed) : random_(seed) {}

  /// The preset after some edits; nothing where they made none that is possible.
  std::optional<Preset> edited(const Preset& preset, const Preset& other) {
    Json json = json_of(preset);
    const Json from = json_of(other);
    for (std::size_t i = 0; i < 1 + random_() % 4; ++i) {
      Json tried = json;
      edit(tried, from);
      try {
        preset::parse_preset(tried.dump(), preset.source);
        json = std::move(tried);
      } catch (const Error&) {
        // impossible: another one
      }
    }
    Preset made = preset::parse_preset(json.dump(), preset.source);
    if (made == preset) return std::nullopt;
    return made;
  }

private:
  void edit(Json& json, const Json& from) {
    const Json leaves = json.flatten();
    auto leaf = leaves.begin();
    std::advance(leaf, static_cast<std::ptrdiff_t>(random_() % leaves.size()));
    Json::json_pointer at(leaf.key());
    for (std::size_t up = random_() % 4; up > 0 && !at.parent_pointer().empty(); --up) at = at.parent_pointer();
    Json& value = json.at(at);
    const auto kind = random_() % 6;
    if (kind == 0 && from.contains(at))
      value = from.at(at); // another type, another number of items, given or not
    else if (value.is_boolean())
      value = !value.get<bool>();
    else if (value.is_number_integer())
      value = value.get<std::int64_t>() + 1 + static_cast<std::int64_t>(random_() % 3);
    else if (value.is_number())
      value = value.get<double>() * 0.9 + 0.01;
    else if (value.is_array() && !value.empty() && kind < 3)
      value.erase(random_() % value.size());
    else if (value.is_array() && !value.empty())
      value.push_back(value.at(random_() % value.size()));
    else if (at.back() == "materials" && !value.empty())
      value[odd_names[random_() % std::size(odd_names)]] = value.front();
    else if (value.is_string() && at.back() == "name")
      value = odd_names[random_() % std::size(odd_names)];
    else if (value.is_object() && kind == 1)
      value = nullptr; // of an optional one, and of a material that nothing uses
  }

  static constexpr const char* odd_names[] = {"a.b",  "x=1",     "it's",  "1.5",       "[0]", "{",
                                              "true", "glass 2", "\"q\"", "$HOME `x`", "grün"};
  std::mt19937_64 random_;
};

/// The words as the shell hands them to a program.
std::vector<std::string> shell_words(const std::string& line) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("words.sh", "printf '%s\\0' " + line);
  const test::Ended result = test::Child({file}, folder.path(), folder.path(), {}, "/bin/sh").wait();
  std::vector<std::string> words;
  std::string word;
  for (const char c : result.out)
    if (c == '\0')
      words.push_back(std::exchange(word, {}));
    else
      word += c;
  return words;
}

std::string refusal(const Preset& preset) {
  return test::refusal_of([&] { preset::command_line(preset); });
}

/// Calls check(name, edited) for shipped presets after random edits.
void for_edited_presets(std::uint64_t seed,
                        const std::function<void(const std::string& name, const Preset& edited)>& check) {
  const auto shipped = preset::shipped_presets();
  Edits edits(seed);
  for (std::size_t i = 0; i < 2 * shipped.size(); ++i) {
    const std::string& name = shipped[i % shipped.size()].name;
    const Preset opened = preset::read_presets(name, {"sweep=null"}).front();
    const Preset other =
        preset::read_presets(shipped[(i + 7 * (i / shipped.size()) + 1) % shipped.size()].name).front();
    if (const auto edited = edits.edited(opened, other)) check(name, *edited);
  }
}

TEST(PresetDifferences, TheCommandLineMakesTheEditedPreset) {
  int said = 0, refused = 0;
  for_edited_presets(1, [&](const std::string& name, const Preset& wanted) {
    try {
      const preset::Recipe recipe = preset::recipe_of(wanted);
      EXPECT_EQ(recipe.name, name);
      ASSERT_TRUE(same(preset::read_preset(recipe.name, recipe.overrides), wanted)) << preset::to_json(wanted);
      ++said;
    } catch (const Error& error) {
      EXPECT_THAT(error.line(), HasSubstr("save the preset first"));
      ++refused;
    }
  });
  EXPECT_GT(said, 50);
  EXPECT_LT(refused, said / 20) << "only another engine cannot be said";
}

TEST(PresetDifferences, EachChangedFieldIsOneOverride) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write(
      "a.json", R"({"engine":"spectral","scene":{"materials":{"glass":{"type":"dielectric","dispersion":1.5}},
    "lights":[{"type":"point","spectrum":"D65"}],"objects":[{"name":"ball","shape":{"type":"sphere"},"material":"glass"}]}})");
  Preset p = preset::read_preset(file);
  EXPECT_THAT(preset::recipe_of(p).overrides, IsEmpty());
  p.scene.lights[0].power_w = 2.5;
  p.scene.camera.position = {0, 1, 9};
  p.stop.passes = 8;
  p.scene.materials["glass"].dispersion.n = 1.6;
  p.scene.lights[0].spectrum.illuminant = "A";
  p.scene.objects[0].name = "it's 1";
  EXPECT_THAT(preset::recipe_of(p).overrides,
              UnorderedElementsAre("scene.lights.0.power_w=2.5", "scene.camera.position=[0.0,1.0,9.0]", "stop.passes=8",
                                   R"(scene.materials.glass.dispersion={"type":"constant","n":1.6})",
                                   R"(scene.lights.0.spectrum={"type":"illuminant","illuminant":"A"})",
                                   "scene.objects.0.name=it's 1"));
  const std::vector<std::string> words = shell_words(preset::command_line(p));
  ASSERT_GT(words.size(), 4u);
  EXPECT_EQ(words[0] + " " + words[1] + " " + words[2], "nephroid run " + file);
  preset::Overrides overrides;
  for (std::size_t i = 3; i < words.size(); i += 2) {
    EXPECT_EQ(words[i], "--set");
    overrides.push_back(words.at(i + 1));
  }
  EXPECT_TRUE(same(preset::read_preset(words[2], overrides), p));
}

TEST(PresetDifferences, WhatNoCommandLineCanSayIsRefusedWithTheWayOn) {
  const test::TemporaryFolder folder;
  Preset p = preset::parse_preset(R"({"engine":"spectral"})", "untitled");
  EXPECT_EQ(refusal(p), "untitled: the preset is in no file; save the preset first, then copy the command line");
  p = preset::read_preset(folder.write("a.json", R"({"engine":"spectral","spectral":{"photons_per_pass":1000}})"));
  p.settings = preset::read_preset("inverse/shapes").settings;
  EXPECT_TRUE(same(preset::read_preset(p.source, preset::recipe_of(p).overrides), p)) << "another engine can be said";
  p = preset::read_preset((folder.path() / "a.json").string());
  for (int i = 0; i < 60; ++i) p.scene.lights.emplace_back();
  EXPECT_THAT(refusal(p), HasSubstr("expected at most 4000; save the preset first"));
  fs::remove(folder.path() / "a.json");
  EXPECT_THAT(refusal(p), HasSubstr("the preset is in no file"));
}

TEST(PresetDifferences, AChildFileReadsBackEqualOverRandomEdits) {
  const test::TemporaryFolder folder;
  int children = 0, whole = 0;
  for_edited_presets(2, [&](const std::string& name, const Preset& wanted) {
    const fs::path file = folder.path() / "child.json";
    const preset::FileText text = preset::file_text(wanted, name, file);
    write_file_whole(file, text.json);
    const Preset back = preset::read_preset(file.string());
    ASSERT_TRUE(same(back, preset::moved_to_file(wanted, file))) << name << "\n" << text.json;
    EXPECT_EQ(text.note.empty(), text.has_parent);
    EXPECT_EQ(Json::parse(text.json).value("parent", ""), text.has_parent ? name : "");
    ++(text.has_parent ? children : whole);
    // And once more over the same parent, from the file that was written.
    if (text.has_parent) {
      EXPECT_EQ(preset::file_text(back, preset::own_parent(file), file).json, text.json);
    }
  });
  EXPECT_GT(children, 50);
  EXPECT_LT(whole, children / 20) << "only another engine cannot be said";
}

TEST(PresetDifferences, AChildHoldsOnlyWhatDiffers) {
  const test::TemporaryFolder folder;
  Preset p = preset::read_preset("first-light");
  p.seed = 7;
  p.scene.camera.fov_deg = 30;
  p.name = "mine";
  p.description.clear();
  const preset::FileText text = preset::file_text(p, "first-light", folder.path() / "mine.json");
  EXPECT_EQ(Json::parse(text.json),
            Json::parse(R"({"parent":"first-light","seed":7,"scene":{"camera":{"fov_deg":30.0}}})"));
}

// A track says of its field what it is: the list that the field is in stays the parent's.
TEST(PresetDifferences, AChildWithTracksHoldsNoFieldsOfThem) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("mine.json", R"({"parent":"first-light","animation":{"frames":4,"tracks":[
    {"path":"scene.objects.0.transform.translate.0","keys":[{"frame":0,"value":0.25},{"frame":4,"value":1}]}]}})");
  Preset p = preset::read_preset(file);
  p.seed = 7;
  const preset::FileText text = preset::file_text(p, "first-light", file);
  EXPECT_FALSE(Json::parse(text.json).contains("scene")) << text.json;
  EXPECT_TRUE(same(preset::parse_preset(text.json, file), p));
}

TEST(PresetDifferences, ListsThatTheParentHasOtherwiseAreWrittenWholeAndWhatIsTakenAwayIsNull) {
  const test::TemporaryFolder folder;
  folder.write("parent.json", R"({"engine":"spectral","stop":{"seconds":5},"sweep":{"seed":[1,2]},
    "scene":{"materials":{"a":{"type":"diffuse"},"b":{"type":"diffuse"}},"lights":[{"type":"point"},{"type":"point","power_w":3}]}})");
  const std::string file = folder.write("child.json", R"({"parent":"parent.json","sweep":null})");
  Preset p = preset::read_preset(file);
  p.scene.lights.erase(p.scene.lights.begin());
  p.scene.materials.erase("b");
  p.stop.seconds.reset();
  const preset::FileText text = preset::file_text(p, "parent.json", file);
  const Json json = Json::parse(text.json);
  EXPECT_EQ(json["parent"], "parent.json");
  EXPECT_EQ(json["scene"]["lights"].size(), 1u);
  EXPECT_TRUE(json["scene"]["materials"]["b"].is_null());
  EXPECT_TRUE(json["stop"]["seconds"].is_null());
  EXPECT_TRUE(json["sweep"].is_null());
  EXPECT_FALSE(json["scene"].contains("camera"));
  EXPECT_TRUE(same(preset::parse_preset(text.json, file), p));
}

TEST(PresetDifferences, TheParentIsNamedAsFromTheNewFolder) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "a" / "deep");
  fs::create_directories(folder.path() / "b");
  folder.write("a/parent.json", R"({"engine":"spectral","white":2})");
  folder.write("a/own.yml", "");
  Preset p = preset::read_preset(folder.write("a/child.json", R"({"parent":"parent",
    "scene":{"materials":{"own":{"type":"dielectric","dispersion":"own.yml"}}}})"));
  p.seed = 3;
  const auto saved = [&](const char* name) {
    return Json::parse(preset::file_text(p, "parent", folder.path() / name).json);
  };
  EXPECT_EQ(saved("a/other.json")["parent"], "parent");
  EXPECT_EQ(saved("a/deep/other.json")["parent"], "../parent.json");
  EXPECT_EQ(saved("b/other.json")["parent"], "../a/parent.json");
  EXPECT_EQ(saved("b/other.json")["scene"]["materials"]["own"]["dispersion"]["file"],
            fs::canonical(folder.path() / "a/own.yml").string());
  const preset::FileText over = preset::file_text(p, "parent", folder.path() / "a/parent.json");
  EXPECT_FALSE(over.has_parent);
  EXPECT_THAT(over.note, HasSubstr("parents go round in a circle"));
  EXPECT_TRUE(preset::parse_preset(over.json, "x.json").white == 2);
  fs::remove(folder.path() / "a/parent.json");
  EXPECT_THAT(preset::file_text(p, "parent", folder.path() / "b/other.json").note,
              HasSubstr("there is no preset 'parent'"));
}

TEST(PresetDifferences, NamesAndParentsOfFilesAreRead) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(preset::shipped_name(presets_folder() / "spectral/prism.json"), "spectral/prism");
  EXPECT_EQ(preset::shipped_name(folder.path() / "x.json"), "");
  EXPECT_EQ(preset::own_parent(folder.path() / "missing.json"), "");
  EXPECT_EQ(preset::own_parent(folder.write("a.json", R"({"parent":"b"})")), "b");
  for (const char* text : {"", "[", "{}", R"({"parent":1})", "[1]"})
    EXPECT_EQ(preset::own_parent(folder.write("a.json", text)), "") << text;
  EXPECT_EQ(preset::shell_word("a=b"), "a=b");
  EXPECT_EQ(preset::shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(preset::shell_word(""), "''");
}

TEST(PresetDifferences, AreListedByFieldWithBothValues) {
  const std::string text = R"({"engine": "spectral", "stop": {"passes": 5}, "scene": {
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}},
    "lights": [{"type": "point", "power_w": 1}, {"type": "point", "power_w": 2}]}})";
  const Preset before = preset::parse_preset(text, "before.json");
  Preset after = before;
  after.name = "another";
  after.source = "after.json";
  EXPECT_THAT(preset::differences(before, after), IsEmpty()) << "what it is called is no difference";
  after.scene.lights[1].power_w = 3;
  after.stop.passes.reset();
  after.stop.seconds = 10;
  EXPECT_THAT(preset::differences(before, after),
              ElementsAre(preset::Difference{"scene.lights.1.power_w", "2.0", "3.0"},
                          preset::Difference{"stop.seconds", "null", "10.0"},
                          preset::Difference{"stop.passes", "5", "null"}));
  // Another type, and another number of items, are one difference each.
  after = before;
  after.scene.lights.pop_back();
  after.scene.materials["glass"].type = preset::Material::Type::mirror;
  const auto whole = preset::differences(before, after);
  ASSERT_EQ(whole.size(), 2u);
  EXPECT_EQ(whole[0].path, "scene.materials.glass");
  EXPECT_EQ(whole[1].path, "scene.lights");
  after = before;
  after.scene.materials["wall"] = {};
  EXPECT_EQ(preset::differences(before, after).at(0).before, "none");
}

} // namespace nephroid::preset_differences_test
