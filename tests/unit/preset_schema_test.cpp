// SPDX-License-Identifier: Apache-2.0
// The schema is the committed one, is a valid schema, and agrees with the reader: checked by python3-jsonschema, an
// independent validator; without it those tests are skipped. docs/presets.md and docs/sweeps.md tell the truth. Every
// value of the shipped presets replaced by one of a wrong type, and every preset cut off: one Error of bad input at the
// place. `nephroid presets` and `nephroid schema`.
#include "preset/read.h"
#include "tests/support/random_preset.h"

#include <nlohmann/json.hpp>
#include <regex>

namespace nephroid::preset_schema_test {

using Json = nlohmann::ordered_json;

/// Validates every file named on its command line against the first; prints those that do not conform.
constexpr const char* validator = R"(
import json, sys
from jsonschema import Draft202012Validator as V
schema = json.load(open(sys.argv[1]))
V.check_schema(schema)
v = V(schema)
for f in sys.argv[2:]:
    for e in v.iter_errors(json.load(open(f))):
        print(f, e.json_path, e.message[:200])
        break
)";

class Schema : public testing::Test {
protected:
  test::TemporaryFolder folder;

  void SetUp() override {
    if (std::system("python3 -W ignore -c 'from jsonschema import Draft202012Validator' 2>/dev/null") != 0)
      GTEST_SKIP() << "needs the package python3-jsonschema";
    write_file_whole(folder.path() / "validate.py", validator);
    write_file_whole(folder.path() / "schema.json", preset::schema());
  }

  fs::path add(const std::string& json) {
    files_.push_back(folder.path() / (std::to_string(files_.size()) + ".json"));
    write_file_whole(files_.back(), json);
    return files_.back();
  }
  void add_file(const fs::path& file) { files_.push_back(file); }

  /// A line for each of the added files that does not conform.
  std::vector<std::string> refused() const {
    const fs::path script = folder.path() / "validate.py", out = folder.path() / "out.txt";
    std::string command =
        "python3 -W ignore '" + script.string() + "' '" + (folder.path() / "schema.json").string() + "'";
    for (const fs::path& file : files_) command += " '" + file.string() + "'";
    EXPECT_EQ(std::system((command + " >'" + out.string() + "' 2>&1").c_str()), 0) << read_file(out);
    std::vector<std::string> lines;
    std::istringstream text(read_file(out));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  std::vector<fs::path> files_;
};

TEST(PresetSchema, TheCommittedFileIsCurrent) {
  EXPECT_EQ(read_file(fs::path(NEPHROID_SOURCE_DIR) / "presets/schema.json"), preset::schema() + "\n")
      << "make it anew: nephroid schema > presets/schema.json";
}

TEST_F(Schema, TakesEveryShippedPresetAndWhateverIsWritten) {
  for (const preset::ShippedPreset& s : preset::shipped_presets()) {
    add_file(s.file);
    for (const preset::Preset& p : preset::read_presets(s.name)) add(preset::to_json(p));
  }
  for (std::uint64_t seed = 0; seed < 30; ++seed) add(preset::to_json(test::random_preset(seed)));
  add(R"({"parent":"first-light","scene":{"materials":{"glass":{"absorption":false},"red":null}},"stop":{"seconds":null}})");
  add(R"({"parent":"first-light","sweep":{"seed":[1,2]}})");
  EXPECT_THAT(refused(), IsEmpty());
}

/// What the schema can know, the reader and the schema refuse alike.
TEST_F(Schema, RefusesWhatTheReaderRefuses) {
  const std::vector<std::string> fields = {
      R"("sceen":{})",
      R"("seed":-1)",
      R"("seed":1.5)",
      R"("seed":18446744073709551616)",
      R"("unit":"inch")",
      R"("white":0)",
      R"("display":{"tone":"soft"})",
      R"("spectral":{"threshold_deg":0})",
      R"("spectral":{"threshold_deg":90})",
      R"("spectral":{"photons_per_pass":16777217})",
      R"("scene":{"camera":{"resolution":[512]}})",
      R"("scene":{"camera":{"position":[0,"1",2]}})",
      R"("scene":{"materials":{"a":{"type":"glas"}}})",
      R"("scene":{"materials":{"a":{"type":"mirror","dispersion":1.5}}})",
      R"("scene":{"materials":{"a":{"type":"diffuse","reflectance":1.5}}})",
      R"("scene":{"lights":[{"power_w":1}]})",
      R"("scene":{"lights":[{"type":"directional","power_w":1}]})",
      R"("scene":{"lights":[{"type":"point","spectrum":7}]})",
      R"("scene":{"objects":[{"shape":{"type":"sphere"}}]})",
      R"("scene":{"materials":{"g":{"type":"dielectric","dispersion":{"type":"points","table":[[400,1.5]]}}}})",
      R"("stop":{"passes":0})",
      R"("sweep":{"seed":[]})",
      R"("description":"a\nb")"};
  for (const std::string& f : fields) {
    const fs::path file = add(R"({"engine":"spectral",)" + f + "}");
    EXPECT_THROW(preset::read_presets(file.string()), Error) << f;
  }
  add(R"({"seed":1})"); // neither engine nor parent
  EXPECT_EQ(refused().size(), fields.size() + 1) << testing::PrintToString(refused());
}

struct Block {
  std::string file, text; ///< file: the name that a comment before the block gives it
};

std::vector<Block> blocks(const std::string& page, const std::string& language) {
  const std::regex pattern("(?:<!-- file: (\\S+) -->\n)?```" + language + "\n([^`]*)```");
  std::vector<Block> found;
  for (std::sregex_iterator match(page.begin(), page.end(), pattern), end; match != end; ++match)
    found.push_back({(*match)[1], (*match)[2]});
  return found;
}

/// The words of a shell line; single quotes hold words together.
std::vector<std::string> words(const std::string& line) {
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

  void SetUp() override {
    for (const Block& block : blocks(page, "json"))
      if (!block.file.empty()) write_file_whole(folder.path() / block.file, block.text);
  }

  std::vector<preset::Preset> read(const std::string& name, const preset::Overrides& overrides = {}) const {
    const fs::path own = folder.path() / (name + ".json");
    return preset::read_presets(fs::exists(own) ? own.string() : name, overrides);
  }
};

TEST_F(PresetDocs, EveryPresetIsRead) {
  const std::vector<Block> all = blocks(page, "json");
  EXPECT_EQ(all.size(), 8u);
  for (const Block& block : all) {
    const fs::path file = folder.path() / (block.file.empty() ? "unnamed.json" : block.file);
    write_file_whole(file, block.text);
    EXPECT_FALSE(preset::read_presets(file.string()).empty()) << block.text;
  }
}

TEST_F(PresetDocs, EveryCommandMeansSomething) {
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
  EXPECT_THAT(runs, ElementsAre(1, 1, 1, 1, 1, 3, 1, 4, 1, 1, 1, 1, 1, 1));
}

TEST_F(PresetDocs, InheritanceIsAsThePageSays) {
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

/// Everything that differs in type from what stands there and from every shorthand of it.
std::vector<Json> wrong_types(const Json& value) {
  // null is not among them: it takes optional fields and materials away.
  if (value.is_structured()) return {true, -17.5, value.is_object() ? Json::array({1, "x"}) : Json{{"x", 1}}};
  std::vector<Json> wrong = {Json::array({1, "x"}), Json{{"x", 1}}};
  if (!value.is_boolean()) wrong.push_back(true);
  if (!value.is_number()) wrong.push_back(-17.5); // outside of every shorthand's range, too
  if (!value.is_string()) wrong.push_back("x\ny");
  return wrong;
}

/// What describes a value: the way to it without numbers of items and names of materials, its type and that of what it
/// is in.
std::string field_of(const Json& json, const Json::json_pointer& at) {
  const Json& around = json.at(at.parent_pointer());
  const std::string way = std::regex_replace(at.to_string(), std::regex("/[0-9]+|(/materials)/[^/]+"), "$1/*");
  return fmt::format("{} {} {} {}", json.at("engine").dump(), way, json.at(at).type_name(),
                     around.is_object() && around.contains("type") ? around.at("type").dump() : "");
}

TEST(PresetMutation, AnyValueOfAWrongTypeIsRefusedWhereItStands) {
  int tried = 0;
  std::set<std::string> fields;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets()) {
    Json json = Json::parse(preset::to_json(preset::read_presets(shipped.name).front()));
    const Json leaves = json.flatten();
    for (const auto& [pointer, leaf] : leaves.items()) {
      // The value itself and everything around it.
      for (Json::json_pointer at(pointer); !at.empty(); at = at.parent_pointer()) {
        const Json before = json[at];
        if (before.is_null()) continue; // an optional field is tried where it has a value
        if (!fields.insert(field_of(json, at)).second) continue;
        for (const Json& wrong : wrong_types(before)) {
          if (wrong.is_number() && before.is_array() && at.back() == "value")
            continue; // of a key: one number is a list of one
          json[at] = wrong;
          ++tried;
          try {
            preset::parse_preset(json.dump(), "x.json");
            ADD_FAILURE() << shipped.name << at.to_string() << " = " << wrong << " was accepted";
          } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), 2);
            EXPECT_TRUE(error.line().starts_with("x.json#" + at.to_string())) << error.line();
          }
        }
        json[at] = before;
      }
    }
  }
  EXPECT_GT(tried, 1500);
}

TEST(PresetMutation, APresetThatIsCutOffIsRefused) {
  const std::string text = read_file(fs::path(NEPHROID_SOURCE_DIR) / "presets/first-light.json");
  const std::size_t end = text.rfind('}');
  for (std::size_t length = 0; length <= end; ++length)
    EXPECT_THROW(preset::parse_preset(text.substr(0, length), "x.json"), Error) << "after " << length << " bytes";
}

TEST(PresetMutation, AnyByteReplacedGivesAPresetOrAnError) {
  const std::string text = preset::to_json(preset::read_preset("spectral/prism"));
  int refused = 0;
  for (std::size_t at = 0; at < text.size(); at += 7)
    for (const char byte : {'\0', '"', '{', ']', '-', '9', '\xff'}) {
      std::string changed = text;
      changed[at] = byte;
      try {
        preset::parse_preset(changed, "x.json");
      } catch (const Error&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, 500);
}

std::string output_of(const std::string& arguments) {
  std::FILE* pipe = ::popen((std::string(NEPHROID_PROGRAM) + " " + arguments).c_str(), "r");
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  EXPECT_EQ(::pclose(pipe), 0) << arguments;
  return text;
}

TEST(PresetVerbs, SchemaPrintsTheSchema) { EXPECT_EQ(output_of("schema"), preset::schema() + "\n"); }

TEST(PresetVerbs, PresetsListsNameAndDescription) {
  const std::string text = output_of("presets");
  for (const preset::ShippedPreset& p : preset::shipped_presets()) {
    const std::size_t line = text.find(p.name + " ");
    ASSERT_NE(line, std::string::npos) << p.name;
    EXPECT_THAT(text.substr(line, text.find('\n', line) - line), HasSubstr(p.description.substr(0, 9)));
  }
}

TEST(PresetVerbs, PresetsAsJson) {
  const auto list = nlohmann::json::parse(output_of("presets --json"));
  const auto shipped = preset::shipped_presets();
  ASSERT_EQ(list.size(), shipped.size());
  for (std::size_t i = 0; i < shipped.size(); ++i) {
    EXPECT_EQ(list[i].size(), 3u);
    EXPECT_EQ(list[i]["name"], shipped[i].name);
    EXPECT_EQ(list[i]["description"], shipped[i].description);
    EXPECT_TRUE(fs::equivalent(list[i]["file"].get<std::string>(), shipped[i].file));
  }
}

} // namespace nephroid::preset_schema_test
