// SPDX-License-Identifier: Apache-2.0
#include "base/build_info.h"

#include "git_commit.h" // written by cmake/GitCommit.cmake at every build in which the commit changed

namespace nephroid {

std::string version() { return NEPHROID_VERSION; }

std::string commit() { return NEPHROID_COMMIT; }

std::string compiler() {
#if defined(__clang__)
  const std::string name = "clang " __clang_version__;
#else
  const std::string name = "g++ " __VERSION__;
#endif
  return name + " (" NEPHROID_BUILD_TYPE ")";
}

std::string program_name() {
  const std::string name = "nephroid " + version();
  return commit().empty() ? name : name + " (" + commit() + ")";
}

} // namespace nephroid
