// SPDX-License-Identifier: Apache-2.0
// Error against time of several runs: curves, slopes, the time to an error, speed-ups at equal error.
#pragma once
#include "report/run_folder.h"

namespace nephroid::report {

/// Every metric that a run has a value of: first the one that most runs are judged by, then errors in the order of the files, then what
/// does not fall. Runs are counted from 0.
///
///     [{"metric", "label", "unit", "law": number or null, "falls", "larger_is_better",
///       "lines": [{"run", "estimate", "slope": number or null, "floor": number or 0, "points": [[seconds, error], ...]}], a run's own estimate
///                behind its error,
///       "biased": [run, ...],
///       "levels": [error, ...], "times": [{"run", "estimate", "cells": [a level each: null: never; {"seconds", "earlier", "near_floor"}]}],
///       "pairs": [{"faster", "slower", "error", "estimate", "faster_seconds", "slower_seconds", "speed_up", "remark"}],
///       "not_compared": ["1 and 2 (why)", ...]}]
///
/// The last four are about errors only. reference_of_run: equal numbers are equal pictures.
Json metrics_json(std::span<const RunFolder> runs, const std::vector<std::optional<std::size_t>>& reference_of_run);

} // namespace nephroid::report
