// SPDX-License-Identifier: Apache-2.0
// A job's picture as files hold it.
#pragma once
#include "compute/compute.h"
#include "image/image.h"
#include "job/job.h"
#include "preset/preset.h"

#include <filesystem>

namespace nephroid::run {

/// Channels R, G, B (the sum), then NAME.R, NAME.G, NAME.B of each layer; no attributes yet.
image::Image with_layers(const job::Picture& picture);

/// STEM.exr with its layers, and as attributes the preset, its seed, the device and the program's version; and STEM.png as shown.
void write_picture(const std::filesystem::path& stem, const preset::Preset& preset, const compute::DeviceInfo& device,
                   const job::Picture& picture);

} // namespace nephroid::run
