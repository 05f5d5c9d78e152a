// SPDX-License-Identifier: Apache-2.0
#include "preset/read.h"
#include "preset/schema_visitor.h"

namespace nephroid::preset {
namespace {

/// Keys of a preset file that are not the preset's: they are gone before its fields are read.
Json file_keys()
{
  return {{"$schema", {{"description", "Where this schema is, for editors."}, {"type", "string"}}},
          {"parent",
           {{"description", "A preset whose values this one takes over: a path beside this file, or a shipped preset's name."},
            {"type", "string"},
            {"minLength", 1}}},
          {"sweep",
           {{"description", "Values for several runs, by path: every combination is one run."},
            {"type", {"object", "null"}},
            {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}}}};
}

} // namespace

std::string schema()
{
  Json definitions = Json::object();
  Properties properties(definitions, Presence::part);
  const Preset defaults{};
  describe(properties, defaults);
  Json all = file_keys();
  all.update(properties.properties());
  const Json whole{{"if", {{"not", {{"required", {"parent"}}}}}}, {"then", {{"required", properties.required()}}}};
  Json document{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", About<Preset>::name},
                {"description", About<Preset>::sentence},
                {"type", "object"},
                {"properties", all},
                {"additionalProperties", false}};
  document.update(whole);
  document["$defs"] = definitions;
  return pretty(document);
}

} // namespace nephroid::preset
