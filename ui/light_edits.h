// SPDX-License-Identifier: Apache-2.0
// Edits of a light's spectrum as pure functions from one to the next: its type, and the rows of a table or of lines. No Dear ImGui.
#pragma once
#include "preset/preset.h"

#include <array>
#include <cstddef>
#include <optional>

namespace nephroid::ui {

/// (nm, relative power)
using PowerRow = std::array<double, 2>;

/// Whether its rows can be dragged: lines and tables.
bool has_rows(const preset::LightSpectrum& spectrum);
/// Its largest power; 1 where that is 0 or there are no rows.
double largest_power(const preset::LightSpectrum& spectrum);

/// The spectrum as another type, as near to what it was as that type can be: a table has a row every 20 nm of 380..780, lines are the
/// rows of a table, or three of 450, 550 and 650 nm; lines become a table with these rows. Powers are relative to the largest. A black
/// body or an illuminant cannot be near to anything: 6500 K and D65. What has no power, or is wrong, becomes rows of power 1.
preset::LightSpectrum as_type(const preset::LightSpectrum& spectrum, preset::LightSpectrum::Type type);

/// The rows by rising wavelength, as every function below expects them.
preset::LightSpectrum sorted(preset::LightSpectrum spectrum);
/// Row `index` at another place: between its neighbours, to 0.1 nm, and 0 or more, to 4 figures. It stays where there is no room.
void move_row(preset::LightSpectrum& spectrum, std::size_t index, const PowerRow& to);
/// One more row; nothing where there is one within 0.2 nm already. Returns its index.
std::optional<std::size_t> add_row(preset::LightSpectrum& spectrum, const PowerRow& row);
/// A row between those that are farthest apart within 380..780 nm, with the power that a table has there; a line with half the largest.
std::optional<std::size_t> add_in_widest_gap(preset::LightSpectrum& spectrum);
/// False where so few are left that none may go: a table has two rows, lines one.
bool can_remove_row(const preset::LightSpectrum& spectrum);
void remove_row(preset::LightSpectrum& spectrum, std::size_t index);

} // namespace nephroid::ui
