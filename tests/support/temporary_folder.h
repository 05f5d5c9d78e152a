// SPDX-License-Identifier: Apache-2.0
// A folder of a test's own, gone when the test ends.
#pragma once
#include "base/files.h"
#include "tests/support/test.h"

#include <unistd.h>

namespace nephroid::test {

class TemporaryFolder {
public:
  TemporaryFolder()
  {
    static int count = 0;
    path_ = std::filesystem::path(testing::TempDir()) / ("nephroid-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file into it and hands back the file's path.
  std::string write(const std::string& name, std::string_view bytes) const
  {
    write_file_whole(path_ / name, bytes);
    return (path_ / name).string();
  }

private:
  std::filesystem::path path_;
};

} // namespace nephroid::test
