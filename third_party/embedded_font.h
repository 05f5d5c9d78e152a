// SPDX-License-Identifier: Apache-2.0
// The window's font (Roboto Regular, Apache-2.0) as a TrueType file in memory, so that no system font is needed.
#pragma once
#include <span>

namespace nephroid {

std::span<const unsigned char> embedded_font();

} // namespace nephroid
