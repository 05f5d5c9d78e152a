// SPDX-License-Identifier: Apache-2.0
// The visitor that writes a struct as JSON: complete, in the order of describe. Private to preset/.
#pragma once
#include "preset/describe.h"
#include "preset/json_text.h"

#include <optional>

namespace nephroid::preset {

class Writer {
public:
  template <class T>
  static Json json(const T& value)
  {
    if constexpr (Described<T>) {
      Writer writer;
      describe(writer, value);
      return std::move(writer.object_);
    } else if constexpr (Enumeration<T>)
      return std::string(word(value));
    else
      return plain(value);
  }

  template <class E>
  void type(const Field& f, const E& value)
  {
    field(f, value);
  }
  void engine(const Field& f, const Settings& settings);
  void settings(const Settings& settings);
  void settings(const std::optional<Settings>& settings);
  template <class T>
  void field(const Field& f, const T& value)
  {
    object_[std::string(f.name)] = json(value);
  }

private:
  template <class T>
  static Json plain(const T& value)
  {
    return value;
  }
  template <class T>
  static Json plain(const std::optional<T>& value)
  {
    return value ? json(*value) : Json(nullptr);
  }
  template <Described S>
  static Json plain(const std::vector<S>& list)
  {
    Json items = Json::array();
    for (const S& s : list) items.push_back(json(s));
    return items;
  }
  template <Described S>
  static Json plain(const std::map<std::string, S>& map)
  {
    Json object = Json::object();
    for (const auto& [name, s] : map) object[name] = json(s);
    return object;
  }

  Json object_ = Json::object();
};

} // namespace nephroid::preset
