// SPDX-License-Identifier: Apache-2.0
// Writes the picture that is on the screen. Slow (a second and more for big pictures): call it away from the window's thread.
#pragma once
#include "job/job.h"

#include <filesystem>

namespace nephroid::ui {

/// By the extension of file: .png as shown with this exposure, .exr linear with every layer. Written whole.
/// Throws bad_input for another extension, failed where it cannot be written.
void save_picture(const std::filesystem::path& file, const job::Picture& picture, double exposure_stops);

} // namespace nephroid::ui
