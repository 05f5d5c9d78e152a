// SPDX-License-Identifier: Apache-2.0
// A sweep: several runs from one preset, one for each combination of the listed values. Private to preset/.
#pragma once
#include "preset/document.h"

#include <string>
#include <vector>

namespace nephroid::preset {

inline constexpr std::size_t max_runs = 10000;

/// One run: the document with this run's values in place, and the part of its name that says which they are.
struct SweptDocument {
  Document document;
  std::string suffix; ///< ",threshold_deg=0.1,seed=2", unique within the sweep; empty where there is no sweep
};

/// Takes "sweep" out of the document. Runs come in the order of nested loops, the first key outermost. A key that an override
/// sets is not swept. Throws bad_input where it is no object of non-empty lists, has over max_runs runs, or one key holds another.
std::vector<SweptDocument> expand_sweep(Document document, const std::vector<std::string>& overrides);

} // namespace nephroid::preset
