// SPDX-License-Identifier: Apache-2.0
// A preset's sweep as data, for who edits it: which fields take which values. `nephroid run` reads presets with their sweeps by
// read_presets (read.h), which gives the runs at once.
#pragma once
#include "preset/read.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::preset {

struct SweptField {
  std::string key;                 ///< as for --set: "spectral.threshold_deg"
  std::vector<std::string> values; ///< at least one, each as JSON
  bool operator==(const SweptField&) const = default;
};

/// Every combination is one run, the first field outermost. Empty: there is no sweep.
using Sweep = std::vector<SweptField>;

/// A preset, and the sweep of its file.
struct WithSweep {
  Preset
      preset; ///< what the file says of a swept field; where the file would be refused without the sweep, its first run, named as the file
  Sweep sweep;
};

/// As read_preset and parse_preset. A swept field that an override sets is not swept.
WithSweep read_with_sweep(const std::string& name, const Overrides& overrides = {});
WithSweep parse_with_sweep(const std::string& json, const std::string& source);

/// The first run of a file's sweep, named as the file; the preset itself where it has none.
Preset parse_first_run(const std::string& json, const std::string& source);

/// How many runs it gives, also where they are too many to be made; 1 without a sweep. A double, because it may be any number.
double count_runs(const Sweep& sweep);

/// One of a sweep's runs.
struct SweptRun {
  std::string name;             ///< the preset's with this run's values: "lens,threshold_deg=0.1,seed=2"
  std::optional<Preset> preset; ///< nothing where it is refused
  std::string why_not;          ///< the line that says why
};
/// As read_presets gives them, but that each run is refused alone. Throws bad_input as read_presets for a sweep that gives no runs: a
/// field's name that is none, one field inside of another, no value, more than 10000 runs.
std::vector<SweptRun> swept_runs(const Preset& preset, const Sweep& sweep);

} // namespace nephroid::preset
