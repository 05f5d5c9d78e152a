// SPDX-License-Identifier: Apache-2.0
// `nephroid presets` and `nephroid schema`: the program prints what the library knows.
#include "preset/read.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace nephroid::preset_verbs_test {

std::string output_of(const std::string& arguments)
{
  std::FILE* pipe = ::popen((std::string(NEPHROID_PROGRAM) + " " + arguments).c_str(), "r");
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  EXPECT_EQ(::pclose(pipe), 0) << arguments;
  return text;
}

TEST(PresetVerbs, SchemaPrintsTheSchema) { EXPECT_EQ(output_of("schema"), preset::schema() + "\n"); }

TEST(PresetVerbs, PresetsListsNameAndDescription)
{
  const std::string text = output_of("presets");
  for (const preset::ShippedPreset& p : preset::shipped_presets()) {
    const std::size_t line = text.find(p.name + " ");
    ASSERT_NE(line, std::string::npos) << p.name;
    EXPECT_THAT(text.substr(line, text.find('\n', line) - line), testing::HasSubstr(p.description.substr(0, 9)));
  }
}

TEST(PresetVerbs, PresetsAsJson)
{
  const auto list = nlohmann::json::parse(output_of("presets --json"));
  const auto shipped = preset::shipped_presets();
  ASSERT_EQ(list.size(), shipped.size());
  for (std::size_t i = 0; i < shipped.size(); ++i) {
    EXPECT_EQ(list[i].size(), 3u);
    EXPECT_EQ(list[i]["name"], shipped[i].name);
    EXPECT_EQ(list[i]["description"], shipped[i].description);
    EXPECT_TRUE(std::filesystem::equivalent(list[i]["file"].get<std::string>(), shipped[i].file));
  }
}

} // namespace nephroid::preset_verbs_test
