// SPDX-License-Identifier: Apache-2.0
// The settings of one engine in a preset: a value of whatever struct that engine describes. The preset knows no engine:
// what can be done with settings of a type is in the type, which settings_type.h makes from the struct's description.
#pragma once
#include <any>
#include <string_view>
#include <vector>

namespace nephroid::preset {

struct SettingsType;

class Settings {
public:
  /// The defaults of the first engine there is.
  Settings();
  explicit Settings(const SettingsType& type);

  const SettingsType& type() const { return *type_; }
  /// The name of the engine whose settings they are.
  std::string_view engine() const;
  /// S: the struct of the type. Throws std::bad_any_cast for another one.
  template <class S>
  S& as() {
    return std::any_cast<S&>(value_);
  }
  template <class S>
  const S& as() const {
    return std::any_cast<const S&>(value_);
  }
  std::any& value() { return value_; }
  const std::any& value() const { return value_; }
  bool operator==(const Settings& other) const;

private:
  const SettingsType* type_;
  std::any value_;
};

/// Every type of settings there is, one an engine; engine/engine.h has the engines.
const std::vector<const SettingsType*>& settings_types();

} // namespace nephroid::preset
