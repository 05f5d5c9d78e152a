// SPDX-License-Identifier: Apache-2.0
// What is written reads back equal: shipped presets, random presets, every number to its last bit, file names from any folder.
#include "tests/support/random_preset.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

namespace nephroid::preset_write_test {

using preset::Preset;

TEST(PresetWriting, EveryShippedPresetReadsBackEqual)
{
  const auto shipped = preset::shipped_presets();
  ASSERT_GE(shipped.size(), 5u);
  for (const preset::ShippedPreset& s : shipped)
    for (const Preset& p : preset::read_presets(s.name)) {
      EXPECT_TRUE(preset::parse_preset(preset::to_json(p), p.source) == p) << s.name;
      EXPECT_FALSE(p.description.empty()) << s.name;
    }
}

TEST(PresetWriting, RandomPresetsReadBackEqual)
{
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Preset p = test::random_preset(seed);
    const std::string text = preset::to_json(p);
    const Preset back = preset::parse_preset(text, p.source);
    ASSERT_TRUE(back == p) << "seed " << seed << "\n" << text;
    ASSERT_EQ(preset::to_json(back), text) << "seed " << seed;
  }
}

TEST(PresetWriting, NumbersKeepTheirLastBit)
{
  Preset p = preset::parse_preset(R"({"engine":"spectral"})", "a.json");
  for (const double white : {0.1, 1.0 / 3, 2.0 / 3, 1e-12, 0x1.fffffffffffffp-5, 123456789.123456789, 1e12})
    EXPECT_EQ(preset::parse_preset(preset::to_json((p.white = white, p)), "a.json").white, white);
  for (const std::uint64_t seed : {0ull, (1ull << 53) + 1, ~0ull})
    EXPECT_EQ(preset::parse_preset(preset::to_json((p.seed = seed, p)), "a.json").seed, seed);
}

TEST(PresetWriting, IsCompleteAndInTheOrderOfTheDescription)
{
  const auto json = nlohmann::ordered_json::parse(preset::to_json(preset::read_preset("first-light")));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, testing::ElementsAre("name", "description", "engine", "unit", "seed", "white", "scene", "spectral", "stop", "reference",
                                         "measure", "animation", "leave_out"));
  EXPECT_TRUE(json["scene"]["objects"][0]["shape"].is_null());
  EXPECT_EQ(json["scene"]["materials"]["glass"]["dispersion"]["outside"], "automatic");
}

TEST(PresetWriting, ListsOfNumbersStayOnOneLine)
{
  EXPECT_THAT(preset::to_json(preset::read_preset("first-light")), testing::HasSubstr("\"resolution\": [512, 512]\n"));
}

TEST(PresetWriting, AnotherFolderFindsTheSameFiles)
{
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "out");
  write_file_whole(folder.path() / "own.yml", "");
  const std::string text = R"({"engine":"spectral","scene":{"materials":{
      "own":{"type":"dielectric","dispersion":"own.yml"},
      "shipped":{"type":"dielectric","dispersion":"materials/N-BK7.yml"},
      "missing":{"type":"dielectric","dispersion":"missing.yml"}}}})";
  const Preset p = preset::parse_preset(text, (folder.path() / "a.json").string());
  const auto there = nlohmann::json::parse(preset::to_json(p, folder.path() / "out"))["scene"]["materials"];
  EXPECT_EQ(there["own"]["dispersion"]["file"], fs::canonical(folder.path() / "own.yml").string()); // only beside the preset
  EXPECT_EQ(there["shipped"]["dispersion"]["file"], "materials/N-BK7.yml");                         // found from anywhere
  EXPECT_EQ(there["missing"]["dispersion"]["file"], "missing.yml");                                 // the loader's to report
  const auto here = nlohmann::json::parse(preset::to_json(p, folder.path()))["scene"]["materials"];
  EXPECT_EQ(here["own"]["dispersion"]["file"], "own.yml");
}

} // namespace nephroid::preset_write_test
