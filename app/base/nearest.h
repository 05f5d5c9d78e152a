// SPDX-License-Identifier: Apache-2.0
// "Did you mean ...?": the known word that a mistyped one is closest to.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace nephroid {

/// The number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string
/// alignment distance).
int edit_distance(std::string_view a, std::string_view b);
/// The known word with the smallest distance to `word`, the first if several have it. "" if none is near: a near word
/// needs changes of at most a third of the letters, or two.
std::string nearest(std::string_view word, std::span<const std::string> known);

} // namespace nephroid
