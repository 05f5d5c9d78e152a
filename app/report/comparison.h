// SPDX-License-Identifier: Apache-2.0
// Error curves of runs held against each other.
#pragma once
#include "report/report.h"

#include <optional>
#include <span>
#include <vector>

namespace nephroid::report {

/// Every metric that a run has a value of: first the one that most runs are judged by, then errors in the order of the
/// files, then what does not fall. Runs are counted from 0.
///     [{"metric", "label", "unit", "law": number or null, "falls", "larger_is_better",
///       "lines": [{"run", "estimate", "slope": number or null, "floor": 0: not known, "points": [[seconds, error],
///       ...]}], "biased": [run, ...]; and of errors only: "levels": [error, ...], "times": [{"run", "estimate",
///       "cells": [a level each: null: never; {"seconds", "earlier", "near_floor"}]}], "pairs": [{"faster", "slower",
///       "error", "estimate", "faster_seconds", "slower_seconds", "speed_up", "remark"}], "not_compared": ["1 and 2
///       (why)", ...]}]
/// reference_of_run: as Pictures has it.
Json metrics_json(std::span<const RunFolder> runs, const std::vector<std::optional<std::size_t>>& reference_of_run);

} // namespace nephroid::report
