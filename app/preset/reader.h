// SPDX-License-Identifier: Apache-2.0
// The visitor that reads a struct from JSON, strictly: every key must be known, of the right type and in range. Private to preset/.
#pragma once
#include "preset/document.h"
#include "preset/preset.h"

namespace nephroid::preset {

/// Reads every field of the preset; leaves `source` alone. Throws bad_input at the value's own place.
/// file names that came from another folder than the document's are made absolute where they would else mean another file.
Preset read_fields(const Document& document);

} // namespace nephroid::preset
