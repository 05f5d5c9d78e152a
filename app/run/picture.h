// SPDX-License-Identifier: Apache-2.0
// A job's picture as a file holds it.
#pragma once
#include "image/image.h"
#include "job/job.h"

namespace nephroid::run {

/// Channels R, G, B (the sum), then NAME.R, NAME.G, NAME.B of each layer; no attributes yet.
image::Image with_layers(const job::Picture& picture);

} // namespace nephroid::run
