// SPDX-License-Identifier: Apache-2.0
// The schema is the committed one, is a valid schema, and agrees with the reader: checked by python3-jsonschema, an independent
// validator; without it those tests are skipped.
#include "base/error.h"
#include "base/files.h"
#include "preset/read.h"
#include "tests/support/random_preset.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using namespace nephroid;

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

  void SetUp() override
  {
    if (std::system("python3 -W ignore -c 'from jsonschema import Draft202012Validator' 2>/dev/null") != 0)
      GTEST_SKIP() << "needs the package python3-jsonschema";
    write_file_whole(folder.path() / "validate.py", validator);
    write_file_whole(folder.path() / "schema.json", preset::schema());
  }

  fs::path add(const std::string& json)
  {
    files_.push_back(folder.path() / (std::to_string(files_.size()) + ".json"));
    write_file_whole(files_.back(), json);
    return files_.back();
  }
  void add_file(const fs::path& file) { files_.push_back(file); }

  /// A line for each of the added files that does not conform.
  std::vector<std::string> refused() const
  {
    const fs::path script = folder.path() / "validate.py", out = folder.path() / "out.txt";
    std::string command = "python3 -W ignore '" + script.string() + "' '" + (folder.path() / "schema.json").string() + "'";
    for (const fs::path& file : files_) command += " '" + file.string() + "'";
    EXPECT_EQ(std::system((command + " >'" + out.string() + "' 2>&1").c_str()), 0) << read_file(out);
    std::vector<std::string> lines;
    std::istringstream text(read_file(out));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  std::vector<fs::path> files_;
};

TEST(PresetSchema, TheCommittedFileIsCurrent)
{
  EXPECT_EQ(read_file(fs::path(NEPHROID_SOURCE_DIR) / "presets/schema.json"), preset::schema() + "\n")
      << "make it anew: nephroid schema > presets/schema.json";
}

TEST_F(Schema, TakesEveryShippedPresetAndWhateverIsWritten)
{
  for (const preset::ShippedPreset& s : preset::shipped_presets()) {
    add_file(s.file);
    for (const preset::Preset& p : preset::read_presets(s.name)) add(preset::to_json(p));
  }
  for (std::uint64_t seed = 0; seed < 30; ++seed) add(preset::to_json(test::random_preset(seed)));
  add(R"({"parent":"first-light","scene":{"materials":{"glass":{"absorption":false},"red":null}},"stop":{"seconds":null}})");
  add(R"({"parent":"first-light","sweep":{"seed":[1,2]}})");
  EXPECT_THAT(refused(), testing::IsEmpty());
}

/// What the schema can know, the reader and the schema refuse alike.
TEST_F(Schema, RefusesWhatTheReaderRefuses)
{
  const std::vector<std::string> fields = {
      R"("sceen":{})",
      R"("seed":-1)",
      R"("seed":1.5)",
      R"("seed":18446744073709551616)",
      R"("unit":"inch")",
      R"("white":0)",
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

} // namespace
