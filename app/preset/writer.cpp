// SPDX-License-Identifier: Apache-2.0
#include "preset/walks.h"

#include <nlohmann/json.hpp>

namespace nephroid::preset {
namespace {

Json list_of(const Value& list)
{
  Json items = Json::array();
  for (std::size_t i = 0; i < list.count(); ++i) items.push_back(as_json(list[i]));
  return items;
}

Json map_of(const Value& map)
{
  Json items = Json::object();
  for (std::size_t i = 0; i < map.count(); ++i) items[map.key(i)] = as_json(map[i]);
  return items;
}

Json object_of(const Value& value)
{
  Json object = Json::object();
  for (const Member& member : value.members()) {
    const bool absent = !member.value.exists() || (member.role == Role::recipe && member.value.count() == 0);
    if (!absent) object[std::string(member.field.name)] = as_json(member.value);
  }
  return object;
}

void visit_files(const Value& value, const Field& field, const std::function<void(std::string&)>& visit)
{
  if (value.kind() == Kind::text && field.text == Text::file) visit(value.as<std::string>());
  if (value.kind() == Kind::object) {
    for (const Member& member : value.members())
      if (member.value.exists()) visit_files(member.value, member.field, visit);
  } else if (value.type().item && value.type().item->kind != Kind::number)
    for (std::size_t i = 0; i < value.count(); ++i) visit_files(value[i], field, visit);
}

} // namespace

Json as_json(const Value& value)
{
  switch (value.kind()) {
  case Kind::boolean:
    return value.as<bool>();
  case Kind::integer:
    return value.is<int>() ? Json(value.as<int>()) : Json(value.as<std::uint64_t>());
  case Kind::number:
    return value.as<double>();
  case Kind::text:
    return value.as<std::string>();
  case Kind::word:
    return std::string(value.word().name);
  case Kind::map:
    return map_of(value);
  case Kind::object:
    return object_of(value);
  case Kind::optional:
    return value.count() > 0 ? as_json(value[0]) : Json();
  default:
    return list_of(value);
  }
}

void for_each_file(const Value& value, const std::function<void(std::string&)>& visit) { visit_files(value, {}, visit); }

} // namespace nephroid::preset
