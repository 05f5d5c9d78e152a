// SPDX-License-Identifier: Apache-2.0
// What a person may drop on the window beside presets, and what can be done with it.
#pragma once
#include <string>

namespace nephroid::ui {

/// Throws bad_input in one line where `name` is a file of a kind that is no preset: a mesh, dispersion data, a picture, a kernel,
/// anything that does not begin as a JSON object. Presets, broken ones too, and names of no file pass: reading them says the rest.
void refuse_other_kinds(const std::string& name);

} // namespace nephroid::ui
