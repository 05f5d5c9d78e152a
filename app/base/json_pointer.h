// SPDX-License-Identifier: Apache-2.0
// JSON pointers (RFC 6901), by which messages name a place in a preset: FILE#/scene/materials/glass.
#pragma once
#include <string>
#include <string_view>

namespace nephroid {

/// A key as it stands between the slashes of a pointer: '~' becomes "~0" and '/' becomes "~1".
std::string pointer_key(std::string_view key);

} // namespace nephroid
