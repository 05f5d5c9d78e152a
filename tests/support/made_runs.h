// SPDX-License-Identifier: Apache-2.0
// Folders of finished runs, made without rendering: what `nephroid run` leaves, with an error history whose slope,
// floor and times are known. tests/hostile/report_test.cpp makes real ones.
#pragma once
#include "image/image.h"
#include "measure/run_files.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::test {

/// Rows at first_second * 1.25^i. Every column's error is factor * t^exponent, joined by noise floor at a right angle.
struct MadeColumn {
  std::string name;
  double factor = 1, exponent = -0.5, floor = 0;
};
inline job::History made_history(const std::vector<MadeColumn>& columns, int rows = 30, double first_second = 0.5) {
  job::History history;
  for (const MadeColumn& column : columns) history.columns.push_back(column.name);
  for (int i = 0; i < rows; ++i) {
    const double t = first_second * std::pow(1.25, i);
    job::HistoryRow row{t, t + 1, i + 1, 1000u * static_cast<unsigned>(i + 1), {}};
    for (const MadeColumn& column : columns)
      row.errors.push_back(std::hypot(column.factor * std::pow(t, column.exponent), column.floor));
    history.rows.push_back(row);
  }
  return history;
}

/// What run.json says; change it before write_made_run as a test needs.
inline nlohmann::ordered_json made_run_json(const std::string& name) {
  return {{"name", name},
          {"engine", "spectral"},
          {"seed", 1},
          {"version", "0.1.0"},
          {"commit", "abcdef0"},
          {"compiler", "g++"},
          {"device", {{"name", "some CPU"}, {"type", "cpu"}, {"driver", "1"}, {"compute_units", 2}}},
          {"finished", true},
          {"passes", 30},
          {"fraction", 1.0},
          {"photons", 30000},
          {"work_seconds", 323.0},
          {"phase_seconds", {{"direct", 100.0}, {"photons", 223.0}}},
          {"energy", {{"emitted_w", 1.0}, {"deposited_w", 0.75}, {"lost_w", 0.25}, {"refused_contributions", 0}}},
          {"notes", nlohmann::ordered_json::array()},
          {"measuring_seconds", 17.0},
          {"wall_seconds", 341.0},
          {"error_column", "lab_mean"}};
}

/// The run's files but history.csv and a reference; every pixel has the same value.
inline void write_made_run(const fs::path& folder, const nlohmann::ordered_json& run_json,
                           const nlohmann::ordered_json& preset = {{"seed", 1}}, int width = 4, int height = 3,
                           float value = 0.5f) {
  fs::create_directories(folder);
  const auto values = static_cast<std::size_t>(3 * width * height);
  image::write_exr(folder / "image.exr", {width, height, {"R", "G", "B"}, std::vector<float>(values, value), {}});
  write_file_whole(folder / "preset.json", preset.dump());
  write_file_whole(
      folder / "plan.json",
      R"({"engine": "spectral", "passes": [{"name": "mirrors", "runs": false, "reason": "no object is a mirror"}],
                       "buffers": [{"name": "tree", "bytes": 2048}], "defines": {}, "notes": []})");
  write_file_whole(folder / "run.json", run_json.dump());
}

/// A run with an error of factor / sqrt(t) against the reference `origin`, whose noise floor is `floor`.
inline void write_measured_run(const fs::path& folder, const std::string& name, double factor, double floor = 0,
                               const std::string& origin = "reference.exr") {
  nlohmann::ordered_json run_json = made_run_json(name);
  run_json["reference"] = {{"origin", origin}, {"noise_floor", {{"lab_mean", floor}}}};
  const job::History history = made_history({{"lab_mean", factor, -0.5, floor}});
  run_json["errors"] = {{"lab_mean", history.rows.back().errors[0]}};
  write_made_run(folder, run_json);
  write_file_whole(folder / "history.csv", measure::to_csv(history));
}

} // namespace nephroid::test
