// SPDX-License-Identifier: Apache-2.0
// The kernel sources that the build embedded (cmake/EmbedFiles.cmake writes the definition).
#pragma once
#include <string>
#include <vector>

namespace nephroid::compute {

struct EmbeddedSource {
  std::string name; ///< path in kernels/, e.g. "tracing/trace.cl"
  std::string text;
};
const std::vector<EmbeddedSource>& embedded_sources();

} // namespace nephroid::compute
