// SPDX-License-Identifier: Apache-2.0
#include "preset/outline.h"

#include "preset/describe.h"
#include "preset/walks.h"

#include <algorithm>

namespace nephroid::preset {
namespace {

Outline outline_of(const Member& member) {
  Outline o;
  o.field = member.field;
  o.chooses = member.chooses();
  o.is_engine_settings = member.role == Role::section || member.role == Role::recipe;
  const ValueType* type = &member.value.type();
  o.optional = type->kind == Kind::optional && o.field.none_word.empty();
  if (type->kind == Kind::optional) type = type->item;
  o.kind = type->kind;
  o.words = type->words;
  o.size = type->size;
  o.whole = type->kind == Kind::integer || (type->item && type->item->kind == Kind::integer);
  o.object = type->make ? type : type->item && type->item->make ? type->item : nullptr;
  if (member.value.exists()) o.standard = as_json(member);
  o.expected = o.kind == Kind::list || o.kind == Kind::map ? expected_count(o.field.count) : expected(o.field, *type);
  return o;
}

std::vector<Outline> outline_of(const ValueType& type, const Json& object) {
  const auto by_default = type.make();
  const Value value(by_default.get(), type);
  std::vector<Member> members = value.members();
  const auto chooser = std::ranges::find(members, Role::type, &Member::role);
  if (chooser != members.end()) {
    const std::vector<Word>& words = chooser->value.type().words;
    const auto chosen = std::ranges::find_if(
        words, [&](const Word& word) { return object.value(chooser->field.name, Json()) == word.name; });
    chooser->value.choose(chosen == words.end() ? 0 : static_cast<std::size_t>(chosen - words.begin()));
    members = value.members();
  }
  std::vector<Outline> fields;
  for (const Member& member : members) fields.push_back(outline_of(member));
  return fields;
}

} // namespace

Json Outline::fresh() const { return as_json(Value(object->make().get(), *object)); }

std::vector<Outline> Outline::fields(const Json& value) const { return outline_of(*object, value); }

std::vector<Outline> outline(const Json& preset) {
  std::vector<Outline> fields = outline_of(type_of<Preset>(), preset);
  std::erase_if(fields, [&](const Outline& o) { return o.is_engine_settings && preset.at("engine") != o.field.name; });
  return fields;
}

Json as_type(const Json& object, const OutlineOf& fields, const Outline& chooser, std::string_view type) {
  const std::string key(chooser.field.name);
  const std::vector<Outline> before = fields(object);
  Json changed = Json::object();
  changed[key] = type;
  for (const Outline& o : fields(Json(changed))) {
    const std::string name(o.field.name);
    const auto same = [&](const Outline& b) { return b.field.name == o.field.name && b.kind == o.kind; };
    if (name == key) continue;
    const bool stays = object.contains(name) && std::any_of(before.begin(), before.end(), same);
    if (stays)
      changed[name] = object[name];
    else if (!o.is_engine_settings || !o.optional) // the settings of another engine would be refused
      changed[name] = o.is_engine_settings && !o.optional ? o.fresh() : o.standard;
  }
  return changed;
}

} // namespace nephroid::preset
