// SPDX-License-Identifier: Apache-2.0
// Edits of a light's spectrum as pure functions from one to the next: the rows of a table or of lines. No Dear ImGui.
#pragma once
#include "preset/preset.h"
#include "ui/widgets/rows.h"

namespace nephroid::ui {

/// (nm, relative power)
using PowerRow = Row;

/// Whether its rows can be dragged: lines and tables.
bool has_rows(const preset::LightSpectrum& spectrum);
/// Its largest power; 1 where that is 0 or there are no rows.
double largest_power(const preset::LightSpectrum& spectrum);

/// The spectrum as a table with a row every 20 nm of 380..780, relative to the largest. What has no power, or is wrong, becomes rows of
/// power 1.
preset::LightSpectrum as_table(const preset::LightSpectrum& spectrum);

/// The rows by rising wavelength, as ui/widgets/rows.h expects them.
preset::LightSpectrum sorted(preset::LightSpectrum spectrum);
/// A table has two rows at least, lines one.
RowRules row_rules(const preset::LightSpectrum& spectrum);
/// A row in figures that a person reads: to 0.1 nm, the power to 4 figures.
PowerRow readable(const PowerRow& row);
/// Between those rows that are farthest apart within 380..780 nm, with the power that a table has there; a line with half the largest.
PowerRow in_widest_gap(const preset::LightSpectrum& spectrum);

} // namespace nephroid::ui
