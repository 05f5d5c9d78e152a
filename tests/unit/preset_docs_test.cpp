// SPDX-License-Identifier: Apache-2.0
// docs/presets.md and docs/sweeps.md tell the truth: their presets are read, their commands mean something, their counts are right.
#include "preset/read.h"
#include "tests/support/temporary_folder.h"

#include <regex>

namespace nephroid::preset_docs_test {

struct Block {
  std::string file, text; ///< file: the name that a comment before the block gives it
};

std::vector<Block> blocks(const std::string& page, const std::string& language)
{
  const std::regex pattern("(?:<!-- file: (\\S+) -->\n)?```" + language + "\n([^`]*)```");
  std::vector<Block> found;
  for (std::sregex_iterator match(page.begin(), page.end(), pattern), end; match != end; ++match)
    found.push_back({(*match)[1], (*match)[2]});
  return found;
}

/// The words of a shell line; single quotes hold words together.
std::vector<std::string> words(const std::string& line)
{
  std::vector<std::string> all(1);
  bool inside = false;
  for (const char c : line)
    if (c == '\'')
      inside = !inside;
    else if (c == ' ' && !inside)
      all.emplace_back();
    else
      all.back() += c;
  return all;
}

class PresetDocs : public testing::Test {
protected:
  test::TemporaryFolder folder;
  std::string page = of_docs("presets.md") + of_docs("sweeps.md");

  static std::string of_docs(const char* name) { return read_file(fs::path(NEPHROID_SOURCE_DIR) / "docs" / name); }

  void SetUp() override
  {
    for (const Block& block : blocks(page, "json"))
      if (!block.file.empty()) write_file_whole(folder.path() / block.file, block.text);
  }

  std::vector<preset::Preset> read(const std::string& name, const preset::Overrides& overrides = {}) const
  {
    const fs::path own = folder.path() / (name + ".json");
    return preset::read_presets(fs::exists(own) ? own.string() : name, overrides);
  }
};

TEST_F(PresetDocs, EveryPresetIsRead)
{
  const std::vector<Block> all = blocks(page, "json");
  EXPECT_EQ(all.size(), 7u);
  for (const Block& block : all) {
    const fs::path file = folder.path() / (block.file.empty() ? "unnamed.json" : block.file);
    write_file_whole(file, block.text);
    EXPECT_FALSE(preset::read_presets(file.string()).empty()) << block.text;
  }
}

TEST_F(PresetDocs, EveryCommandMeansSomething)
{
  std::vector<std::size_t> runs;
  for (const Block& block : blocks(page, "sh")) {
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) {
      const std::vector<std::string> w = words(line);
      ASSERT_GE(w.size(), 3u) << line;
      preset::Overrides overrides;
      for (std::size_t i = 4; i < w.size(); ++i)
        if (w[i - 1] == "--set") overrides.push_back(w[i]);
      runs.push_back(read(w[2], overrides).size());
    }
  }
  EXPECT_THAT(runs, testing::ElementsAre(1, 1, 1, 1, 1, 3, 1, 4, 1, 1, 1, 1, 1));
}

TEST_F(PresetDocs, InheritanceIsAsThePageSays)
{
  const preset::Preset blue = read("blue").front();
  EXPECT_EQ(blue.name, "blue");
  EXPECT_EQ(blue.scene.materials.at("glass").dispersion.file, "materials/N-BK7.yml");
  EXPECT_FALSE(blue.scene.materials.contains("wall"));
  EXPECT_EQ(blue.scene.objects.size(), 2u);
  EXPECT_FALSE(blue.stop.seconds);
  const std::vector<preset::Preset> swept = read("thresholds");
  ASSERT_EQ(swept.size(), 6u);
  EXPECT_EQ(swept[0].name, "thresholds,threshold_deg=0.5,seed=1");
  EXPECT_EQ(swept[1].name, "thresholds,threshold_deg=0.5,seed=2");
}

} // namespace nephroid::preset_docs_test
