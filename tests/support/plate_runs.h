// SPDX-License-Identifier: Apache-2.0
// A test that runs the program on a small preset, into folders of a folder of its own.
#pragma once
#include "tests/support/child.h"

#include <nlohmann/json.hpp>

namespace nephroid::test {

class PlateRuns : public testing::Test {
protected:
  TemporaryFolder scratch;
  fs::path logs = scratch.path();

  /// The command line of a run into the folder `name`: a plate of glass, which needs no mesh file, in passes of a few
  /// milliseconds.
  std::vector<std::string> into(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run",   "spectral/plate",
                                       "--set", "scene.camera.resolution=[48,40]",
                                       "--set", "spectral.photons_per_pass=20000",
                                       "--set", "spectral.estimator=points", // a round of tiles is several passes
                                       "-o",    file(name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Ended run(const std::string& name, const std::vector<std::string>& more, const Environment& environment = {}) const {
    return nephroid(into(name, more), scratch.path(), logs, environment);
  }
  fs::path file(const std::string& name) const { return scratch.path() / name; }
  nlohmann::json run_json(const std::string& name) const {
    return nlohmann::json::parse(read_file(file(name) / "run.json"));
  }
};

} // namespace nephroid::test
