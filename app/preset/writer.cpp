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

} // namespace nephroid::preset
