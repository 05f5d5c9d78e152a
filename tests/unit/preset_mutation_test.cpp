// SPDX-License-Identifier: Apache-2.0
// Every kind of value in the shipped presets replaced by one of a wrong type, and every preset cut off at any place: always one
// Error of bad input at the place, never a crash and never another exception.
#include "base/error.h"
#include "base/files.h"
#include "preset/read.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

#include <regex>

namespace nephroid::preset_mutation_test {

using Json = nlohmann::ordered_json;

/// Everything that differs in type from what stands there and from every shorthand of it.
std::vector<Json> wrong_types(const Json& value)
{
  // null is not among them: it takes optional fields and materials away.
  if (value.is_structured()) return {true, -17.5, value.is_object() ? Json::array({1, "x"}) : Json{{"x", 1}}};
  std::vector<Json> wrong = {Json::array({1, "x"}), Json{{"x", 1}}};
  if (!value.is_boolean()) wrong.push_back(true);
  if (!value.is_number()) wrong.push_back(-17.5); // outside of every shorthand's range, too
  if (!value.is_string()) wrong.push_back("x\ny");
  return wrong;
}

/// What describes a value: the way to it without numbers of items and names of materials, its type and that of what it is in.
std::string field_of(const Json& json, const Json::json_pointer& at)
{
  const Json& around = json.at(at.parent_pointer());
  const std::string way = std::regex_replace(at.to_string(), std::regex("/[0-9]+|(/materials)/[^/]+"), "$1/*");
  return fmt::format("{} {} {} {}", json.at("engine").dump(), way, json.at(at).type_name(),
                     around.is_object() && around.contains("type") ? around.at("type").dump() : "");
}

TEST(PresetMutation, AnyValueOfAWrongTypeIsRefusedWhereItStands)
{
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
          if (wrong.is_number() && before.is_array() && at.back() == "value") continue; // of a key: one number is a list of one
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

TEST(PresetMutation, APresetThatIsCutOffIsRefused)
{
  const std::string text = read_file(std::filesystem::path(NEPHROID_SOURCE_DIR) / "presets/first-light.json");
  const std::size_t end = text.rfind('}');
  for (std::size_t length = 0; length <= end; ++length)
    EXPECT_THROW(preset::parse_preset(text.substr(0, length), "x.json"), Error) << "after " << length << " bytes";
}

TEST(PresetMutation, AnyByteReplacedGivesAPresetOrAnError)
{
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

} // namespace nephroid::preset_mutation_test
