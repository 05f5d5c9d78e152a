// SPDX-License-Identifier: Apache-2.0
// The visitor that finds every name of a file in a preset. Private to preset/.
#pragma once
#include "preset/describe.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::preset {

class FileNames {
public:
  using Rename = std::function<void(std::string& name)>;
  explicit FileNames(const Rename& rename) : rename_(rename) {}

  template <class E>
  void type(const Field&, E&)
  {
  }
  void engine(const Field&, Settings&) {}
  void settings(Settings& settings);
  void settings(std::optional<Settings>& recipe)
  {
    if (recipe) settings(*recipe);
  }
  template <class T>
  void field(const Field& f, T& value)
  {
    visit(f, value);
  }

private:
  void visit(const Field& f, std::string& name)
  {
    if (f.text == Text::file) rename_(name);
  }
  template <Described S>
  void visit(const Field&, S& s)
  {
    describe(*this, s);
  }
  template <class T>
  void visit(const Field& f, std::optional<T>& value)
  {
    if (value) visit(f, *value);
  }
  template <Described S>
  void visit(const Field& f, std::vector<S>& list)
  {
    for (S& s : list) visit(f, s);
  }
  template <Described S>
  void visit(const Field& f, std::map<std::string, S>& map)
  {
    for (auto& [name, s] : map) visit(f, s);
  }
  template <class T>
  void visit(const Field&, T&)
  {
  } // numbers and words name no files

  const Rename& rename_;
};

} // namespace nephroid::preset
