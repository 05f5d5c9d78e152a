// SPDX-License-Identifier: Apache-2.0
// Every field of the schema is edited through the panel "Parameters" by an injected mouse and keys: each type of each
// object, each word of each choice. An edit changes its own field and nothing else; undo gives the same bytes.
#include "image/image.h"
#include "parameters_fixture.h"
#include "preset/read.h"

namespace nephroid::ui::parameters_schema_test {

const std::map<std::string, std::vector<std::string>> names{{"material", {"glass", "wall"}},
                                                            {"object", {"wall", "floor"}},
                                                            {"illuminant", {"A", "F7"}},
                                                            {"patch", {"red", "blue"}}};

/// What a property may be besides null.
const Json& given(const Json& node) { return node.contains("anyOf") ? node["anyOf"][0] : node; }

bool is_optional(const Json& node) {
  return node.contains("anyOf") && node["anyOf"].back().value("type", "") == "null";
}

class ParametersSchemaTest : public test::ParametersFixture {
protected:
  ParametersSchemaTest() : schema(Json::parse(preset::schema())) {}

  const Json schema;
  std::set<std::string> edited;  ///< "LightItem.spot.half_angle_deg"
  std::set<std::string> visited; ///< structs with their types

  /// The name of the struct that a property is, or has items of; empty for a leaf.
  static std::string struct_of(const Json& property) {
    const Json& node = given(property);
    if (node.contains("$ref")) return node["$ref"].get<std::string>().substr(8);
    for (const char* inner : {"items", "additionalProperties"})
      if (node.contains(inner) && node[inner].is_object() &&
          (node[inner].contains("$ref") || node[inner].contains("anyOf")))
        return struct_of(node[inner]);
    return {};
  }
  std::set<std::string> leaves() const {
    std::set<std::string> all;
    const auto add = [&](const std::string& owner, const Json& properties) {
      for (const auto& [name, property] : properties.items())
        if (struct_of(property).empty()) all.insert(owner + "." + name);
    };
    Json own = schema["properties"];
    for (const char* of_file : {"$schema", "parent", "sweep"}) own.erase(of_file);
    add("Preset", own);
    for (const auto& [name, definition] : schema["$defs"].items()) {
      if (definition.contains("properties")) add(name, definition["properties"]);
      for (const Json& type : types(definition)) add(name + "." + type["title"].get<std::string>(), type["properties"]);
    }
    return all;
  }
  static std::vector<Json> types(const Json& definition) {
    std::vector<Json> all;
    for (const Json& one : definition.value("oneOf", definition.value("anyOf", Json::array())))
      if (one.contains("properties") && one["properties"].contains("type") &&
          one["properties"]["type"].contains("const"))
        all.push_back(one);
    return all;
  }

  /// Nothing waits, and the preset is what it was.
  void restore(const std::string& before) {
    while (!problems().empty() && !HasFatalFailure()) click(problems().begin()->first + ":drop");
    for (int i = 0; i < 100 && text() != before; ++i) undo();
    ASSERT_EQ(text(), before);
  }
  bool is_engine(const std::string& name) const {
    const Json& words = schema["properties"]["engine"]["oneOf"];
    return std::any_of(words.begin(), words.end(), [&](const Json& word) { return word["const"] == name; });
  }
  /// null where there is none: settings that are not given.
  Json drafted(const std::string& pointer) const {
    return panel().draft().value().value(Json::json_pointer(pointer), Json());
  }
  static std::set<std::string> differences(const std::string& before, const std::string& after) {
    const Json a = Json::parse(before).flatten(), b = Json::parse(after).flatten();
    std::set<std::string> found;
    for (const auto& [key, value] : a.items())
      if (!b.contains(key) || b[key] != value) found.insert(key);
    for (const auto& [key, value] : b.items())
      if (!a.contains(key)) found.insert(key);
    return found;
  }

  /// Other values that a plain field may be given, as they are typed or chosen; of a box that is clicked, nothing.
  std::vector<std::string> candidates(const Json& node, const std::string& pointer, const std::string& owner) const {
    const Json now = drafted(pointer);
    std::vector<std::string> all;
    if (node.contains("oneOf"))
      for (const Json& word : node["oneOf"]) all.push_back(word["const"]);
    else if (const auto named = names.find(pointer.substr(pointer.rfind('/') + 1)); named != names.end())
      all = named->second;
    else if (node.value("minLength", 0) > 0)
      all = owner.starts_with("Dispersion") ? std::vector<std::string>{"N-BK7", "N-SF66"}
            : owner.starts_with("Material") ? std::vector<std::string>{"silver", "brass"}
            : owner.starts_with("Pane")     ? std::vector<std::string>{"a.txt", "b.txt"}
                                            : std::vector<std::string>{"a.exr", "b.exr"};
    else if (pointer == "/environment/directions")
      all = {"98", "386"};
    else if (pointer.ends_with("/place/date"))
      all = {"2026-06-21", "2000-02-29"};
    else if (pointer.ends_with("/place/time_zone"))
      all = {"Europe/London", "Asia/Kolkata"};
    else if (pointer.ends_with("/meters/0/threshold"))
      all = owner.ends_with("goniometer") ? std::vector<std::string>{"20 cd", "5 W/sr"}
                                          : std::vector<std::string>{"2500 W/m^2", "5 lx"};
    else if (pointer == "/animation/tracks/0/path")
      all = {"white"};
    else if (node["type"] == "string")
      all = {owner.starts_with("InversePicture") ? "A \"quoted\" \\ ~/" : "Grüße, \"quoted\" \\ ~/", "other"};
    else {
      const double x = now.is_number() ? now.get<double>() : 1;
      for (const double to : {x + 1, x - 1, x / 2, x + 0.5, x + 90, x + 0.01}) // a file turns by quarters
        if (to != x) all.push_back(Json(to).dump());
      if (node["type"] == "integer")
        for (std::string& number : all) number = number.substr(0, number.find('.'));
    }
    std::erase_if(all, [&](const std::string& candidate) { return now == candidate; });
    return all;
  }
  void set(const Json& node, const std::string& pointer, const std::string& to) {
    const bool named = names.contains(pointer.substr(pointer.rfind('/') + 1));
    search(dotted(pointer));
    if (node.value("type", "") == "boolean")
      click(pointer);
    else if (node.contains("oneOf") || named)
      choose(pointer, to);
    else
      enter(pointer, to);
  }
  /// One plain value is edited, and the edit taken back.
  void edit_plain(const Json& node, const std::string& pointer, const std::string& owner) {
    SCOPED_TRACE(pointer);
    const std::string before = text();
    ASSERT_TRUE(problems().empty()) << problems().begin()->second.text;
    std::vector<std::string> to =
        node.value("type", "") == "boolean" ? std::vector<std::string>{""} : candidates(node, pointer, owner);
    bool once = false;
    for (const std::string& candidate : to) {
      if (once && !node.contains("oneOf")) break; // of a choice every word
      set(node, pointer, candidate);
      if (HasFatalFailure()) return;
      if (problems().empty()) {
        std::set<std::string> changed = differences(before, text());
        if (pointer == "/engine") // takes away what the other engine does not know
          std::erase_if(changed, [&](const std::string& at) { return at != pointer; });
        if (pointer.starts_with("/animation/")) changed.erase("/seed"); // its track sets it
        EXPECT_EQ(changed, (std::set<std::string>{pointer})) << candidate;
        once = true;
      } else
        EXPECT_EQ(text(), before) << "the run's preset is as it was";
      restore(before);
    }
    if (pointer == "/inverse/outline") once = true; // a round one is for a lens, which has one receiver
    EXPECT_TRUE(once) << "none of its other values was taken";
  }
  /// A plain value, or each of the numbers in a list or table, which is given items first.
  void edit_leaf(const Json& node, const std::string& pointer, const std::string& owner) {
    if (node.value("type", "") != "array") return edit_plain(node, pointer, owner);
    if (pointer == "/environment/objects" || pointer == "/not_imported") { // none is what it has without
      search(dotted(pointer));
      click(pointer + ":add");
      if (!problems().empty()) enter(child_of(pointer, "0"), "wall");
      ASSERT_TRUE(problems().empty()) << problems().begin()->second.text;
    }
    const Json now = drafted(pointer);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now[i].is_array())
        for (std::size_t c = 0; c < 2; ++c)
          edit_plain(node["items"]["prefixItems"][c], child_of(child_of(pointer, std::to_string(i)), std::to_string(c)),
                     owner);
      else
        edit_plain(node["items"], child_of(pointer, std::to_string(i)), owner);
    EXPECT_FALSE(now.empty()) << pointer;
  }
  /// Of an object that was given a type or given at all: what it cannot do without.
  void fill(const Json& properties, const std::string& pointer, const std::string& owner) {
    for (const auto& [name, node] : properties.items()) {
      const std::string at = child_of(pointer, name);
      if (problems().empty() || node.contains("const") || !struct_of(node).empty() || is_optional(node)) continue;
      const Json now = drafted(at);
      if (now == "")
        set(node, at, candidates(node, at, owner).front());
      else if (now.is_array() && now.empty()) {
        search(dotted(at));
        for (std::size_t i = 0; i < node.value("minItems", 1u); ++i) click(at + ":add");
        if (name == "coefficients") set(node["items"], at + "/0", "1.5"); // n is 0 without
      }
    }
    ASSERT_TRUE(problems().empty()) << pointer << ": " << problems().begin()->second.text;
  }

  void visit_properties(const Json& properties, const std::string& pointer, const std::string& owner) {
    for (const auto& [name, property] : properties.items()) {
      if (HasFatalFailure()) return;
      if (pointer.empty() && !panel().draft().value().contains(name)) continue; // of the file, not of the preset
      // A preset and its reference have settings of the run's engine only; a scene's environment is no settings.
      if (owner != "Scene" && is_engine(name) && name != drafted("/engine").get<std::string>()) continue;
      if (name == "far" && drafted(child_of(pointer, name)).is_null()) continue;  // in place of receivers
      if (name == "states" && drafted(child_of(pointer, name)).empty()) continue; // of a mesh
      visit(property, child_of(pointer, name), owner, owner + "." + name);
    }
  }
  void visit(const Json& property, const std::string& pointer, const std::string& owner, const std::string& leaf) {
    SCOPED_TRACE(pointer);
    const std::string before = text(), type = struct_of(property);
    if (property.contains("const") ||
        property.value("oneOf", Json()).size() == 1) { // edited by whoever chose it, or the only one
      search(dotted(pointer));
      EXPECT_TRUE(panel().place_of(pointer)) << "a choice of types";
    } else {
      if (is_optional(property) && drafted(pointer).is_null()) {
        if (pointer.ends_with("/mesh")) { // one of both
          search("scene.objects.0.shape");
          click("/scene/objects/0/shape:given");
        }
        if (pointer == "/scene/camera/height") { // of an orthographic camera only
          search("scene.camera.projection");
          choose("/scene/camera/projection", "orthographic");
        }
        if (pointer.ends_with("/sun_direction")) { // one of both
          search("scene.environment.place");
          click("/scene/environment/place:given");
        }
        search(dotted(pointer));
        click(pointer + ":given");
        EXPECT_FALSE(drafted(pointer).is_null());
        if (pointer.ends_with("/sun_direction") || pointer.ends_with("/facing")) enter(pointer + "/1", "1");
        if (type.empty() && drafted(pointer) == "")
          set(given(property), pointer, candidates(given(property), pointer, owner).front());
      }
      if (!type.empty() && given(property).value("type", "") == "array" && drafted(pointer).empty()) {
        search(dotted(pointer));
        click(pointer + ":add");
      }
      if (type.empty())
        edit_leaf(given(property), pointer, owner);
      else
        visit_struct(type, given(property).value("type", "") == "array" ? pointer + "/0"
                           : given(property).contains("$ref")
                               ? pointer
                               : child_of(pointer, drafted(pointer).items().begin().key()));
      restore(before);
    }
    if (type.empty()) edited.insert(leaf);
  }
  void visit_struct(const std::string& name, const std::string& pointer) {
    const Json& definition = schema["$defs"][name];
    if (definition.contains("properties") && visited.insert(name).second)
      visit_properties(definition["properties"], pointer, name);
    for (const Json& type : types(definition)) {
      const std::string word = type["title"], owner = name + "." + word;
      if (!visited.insert(owner).second) continue;
      SCOPED_TRACE(owner);
      const std::string before = text();
      search(dotted(pointer));
      if (drafted(pointer).is_null()) click(pointer + ":given");
      if (HasFatalFailure()) return;
      if (drafted(pointer).value("type", "") != word) choose(pointer + "/type", word);
      if (owner == "Environment.sky") { // which takes a place or a direction
        search(dotted(pointer) + ".place");
        click(pointer + "/place:given");
      }
      if (owner == "Environment.sky" || (owner.starts_with("InverseLight") && word == "sun"))
        enter(pointer + "/place/date", "2026-06-21");
      if (!problems().empty()) fill(type["properties"], pointer, owner);
      if (HasFatalFailure()) return;
      EXPECT_EQ(at(pointer + "/type"), word);
      visit_properties(type["properties"], pointer, owner);
      if (HasFatalFailure()) return;
      restore(before);
    }
  }
};

TEST_F(ParametersSchemaTest, EveryFieldIsEditedAndUndoGivesTheSameBytes) {
  for (const char* file : {"a.exr", "b.exr"})
    image::write_exr(folder.path() / file,
                     {.width = 1, .height = 1, .channels = {"R", "G", "B"}, .data = {0.5f, 0.5f, 0.5f}});
  for (const char* file : {"a.txt", "b.txt"}) folder.write(file, "400 .5 .1 .1\n700 .5 .1 .1\n");
  Json preset = Json::parse(test::preset_text);
  preset["scene"]["materials"]["glass"] = {{"type", "dielectric"}, {"dispersion", 1.5}};
  preset["scene"]["objects"].push_back({{"name", "floor"}, {"material", "wall"}, {"shape", {{"type", "quad"}}}});
  preset["scene"]["meters"] = {{{"type", "plane"}, {"name", "meter"}}};
  open(preset.dump());
  ASSERT_FALSE(HasFatalFailure());
  const std::string before = text();
  Json properties = schema["properties"];
  properties.erase("animation"); // what it changes is not edited
  visit_properties(properties, "", "Preset");
  EXPECT_EQ(text(), before);
  if (HasFatalFailure()) return;
  preset["scene"]["objects"][0] = {{"mesh", "a.obj"}, {"states", {{{"mesh", "b.obj"}}}}, {"material", "wall"}};
  open(preset.dump());
  visit(schema["$defs"]["ObjectItem"]["properties"]["states"], "/scene/objects/0/states", "ObjectItem",
        "ObjectItem.states");
  if (HasFatalFailure()) return;
  runs.adopts = false; // fake jobs do so as engine 1 does
  open(R"({"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": {"facets": [8, 8], "receivers": [
    {"distance_mm": 100, "picture": {"type": "ring"}}, {"distance_mm": 200, "picture": {"type": "disc"}}]}})");
  visit(schema["properties"]["inverse"], "/inverse", "Preset", "Preset.inverse");
  open(R"({"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": {"facets": [8, 8],
    "far": {"type": "rectangle", "lumens": 1e6}}})");
  visit(schema["$defs"]["Inverse"]["properties"]["far"], "/inverse/far", "Inverse", "Inverse.far");
  open(R"({"engine": "environment", "scene": {"camera": {}}})");
  visit(schema["properties"]["environment"], "/environment", "Preset", "Preset.environment");
  open(
      R"({"engine": "environment", "white": 1, "scene": {"camera": {}}, "animation": {"tracks": [{"path": "seed", "keys": [{"frame": 0, "value": 1}]}]}})");
  visit(schema["properties"]["animation"], "/animation", "Preset", "Preset.animation");
  std::vector<std::string> left;
  std::ranges::set_symmetric_difference(edited, leaves(), std::back_inserter(left));
  EXPECT_THAT(left, IsEmpty());
  for (const Message& message : workbench.messages())
    if (message.error) ADD_FAILURE() << message.line; // another engine leaves a note of what it takes away
  RecordProperty("fields", static_cast<int>(edited.size()));
}

} // namespace nephroid::ui::parameters_schema_test
