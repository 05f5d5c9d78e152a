// SPDX-License-Identifier: Apache-2.0
// "Did you mean ...?": the known word that a mistyped one is closest to.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace nephroid {

/// Insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);
/// The known word with the smallest distance to word (the first of equals), or "" where none is near: more than a third
/// of the word's letters, at least two, would have to change.
std::string nearest(std::string_view word, std::span<const std::string> known);

} // namespace nephroid
