// SPDX-License-Identifier: Apache-2.0
// A page to print in real size: the object's outline, and each receiver with what is cast there.
#pragma once
#include "inverse/layout.h"
#include "job/job.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::inverse {

/// SVG whose unit is the millimetre. cast: a picture of each receiver. Seen along the light, with the object's outline over each receiver.
std::string print_page(const Layout& layout, const std::vector<std::shared_ptr<const job::Picture>>& cast, const std::string& name);

} // namespace nephroid::inverse
