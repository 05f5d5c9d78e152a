// SPDX-License-Identifier: Apache-2.0
// What was built: the project's version, the commit, the compiler. Costs nothing at start.
#pragma once
#include <string>

namespace nephroid {

std::string version();      ///< the project's version, e.g. "0.1.0"
std::string commit();       ///< `git describe --always --dirty` of the build; "" outside a git checkout
std::string compiler();     ///< name, version and build type
std::string program_name(); ///< "nephroid 0.1.0", with the commit if there is one

} // namespace nephroid
