// SPDX-License-Identifier: Apache-2.0
// What a test changes of its process, which other tests share: put back when the object goes.
#pragma once
#include "tests/support/test.h"

namespace nephroid::test {

/// An environment variable, set or (nullopt) unset.
class Variable {
public:
  Variable(std::string name, const std::optional<std::string>& value) : name_(std::move(name)) {
    if (const char* const before = std::getenv(name_.c_str())) before_ = before;
    set(value);
  }
  ~Variable() { set(before_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

private:
  void set(const std::optional<std::string>& value) const {
    value ? ::setenv(name_.c_str(), value->c_str(), 1) : ::unsetenv(name_.c_str());
  }

  std::string name_;
  std::optional<std::string> before_;
};

/// The current folder.
class CurrentFolder {
public:
  explicit CurrentFolder(const fs::path& folder) { fs::current_path(folder); }
  ~CurrentFolder() { fs::current_path(before_); }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;

private:
  fs::path before_ = fs::current_path();
};

/// Where PoCL keeps compiled kernels for all tests: a test that compiles them anew takes seconds more.
inline std::string kernel_cache() {
  if (const char* const folder = std::getenv("POCL_CACHE_DIR")) return folder;
  if (const char* const folder = std::getenv("XDG_CACHE_HOME")) return std::string(folder) + "/pocl/kcache";
  const char* const home = std::getenv("HOME");
  return std::string(home ? home : "/tmp") + "/.cache/pocl/kcache";
}

/// Where bakes, references and thumbnails are kept.
class CacheHome {
public:
  explicit CacheHome(const fs::path& folder) : home_("XDG_CACHE_HOME", folder.string()) {}

private:
  Variable kernels_{"POCL_CACHE_DIR", kernel_cache()}, home_;
};

} // namespace nephroid::test
