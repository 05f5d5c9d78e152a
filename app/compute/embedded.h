// SPDX-License-Identifier: Apache-2.0
// The kernel sources that the build embedded (cmake/EmbedFiles.cmake writes the definition).
#pragma once
#include <string>
#include <vector>

namespace nephroid::compute {

struct EmbeddedSource {
  std::string name; ///< file name, e.g. "trace.cl" or "random.h"
  std::string text;
};
const std::vector<EmbeddedSource>& embedded_sources();

} // namespace nephroid::compute
