// SPDX-License-Identifier: Apache-2.0
// The files of a run. What the same preset and seed always give (image.exr, preset.json, plan.json) holds no time, no
// date and no thread count, so that equal runs are equal files; what differs from run to run is in run.json.
#include "run/write_run.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/json_output.h"
#include "measure/read_picture.h"
#include "measure/run_files.h"
#include "preset/choices.h"
#include "preset/read.h"
#include "report/report.h"
#include "run/display.h"
#include "run/folder.h"
#include "run/meter_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// {"GROUP": {"NAME": value}}, a number in the group's path being a place in a list; whole numbers as such, what is no
/// number as null.
void add_scalars(Json& run, const std::vector<job::Scalar>& scalars) {
  for (const job::Scalar& s : scalars) {
    const bool whole = std::abs(s.value) < 0x1p53 && s.value == std::trunc(s.value);
    run[Json::json_pointer("/" + s.group)][s.name] = std::isnan(s.value) ? Json()
                                                     : whole             ? Json(static_cast<std::int64_t>(s.value))
                                                                         : Json(s.value);
  }
}

std::string to_csv(const job::Curve& curve) {
  std::string text = fmt::format("{}\n", fmt::join(curve.columns, ","));
  for (const std::vector<double>& row : curve.rows) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

Json device_json(const compute::DeviceInfo& device) {
  return {{"name", device.name},     {"type", device.type},       {"platform", device.platform},
          {"driver", device.driver}, {"version", device.version}, {"compute_units", device.compute_units}};
}

/// As a report reads it.
Json display_json(const image::Display& display) {
  return {{"gamut", preset::word(display.gamut)},
          {"tone", preset::word(display.tone)},
          {"white_balance", display.white_balance}};
}

/// The run's error, "errors", with what they were measured against and what the measuring cost.
void add_errors(Json& run, const job::History& history, const measure::Reference* reference) {
  run["measuring_seconds"] = history.measuring_seconds;
  run["error_column"] = history.error_column;
  if (!history.rows.empty()) {
    run["wall_seconds"] = history.rows.back().wall_seconds;
    run["errors"] = by_column(history.columns, history.rows.back().errors);
  }
  if (!reference) return;
  Json floors = by_column(history.columns, history.noise_floor);
  for (auto floor = floors.begin(); floor != floors.end();)
    floor = floor->is_null() ? floors.erase(floor) : std::next(floor);
  run["reference"] = {{"origin", reference->origin}, {"noise_floor", floors}};
}

std::string run_json(const Prepared& prepared, const compute::DeviceInfo& device, const job::Snapshot& snapshot,
                     const measure::Reference* reference, const Json& pictures, const std::vector<std::string>& files,
                     bool finished) {
  const job::Progress& progress = snapshot.progress;
  Json phases = Json::object();
  for (const auto& [name, seconds] : snapshot.phases) phases[name] = seconds;
  Json all{{"name", prepared.preset.name},
           {"engine", prepared.plan->engine},
           {"seed", prepared.preset.seed},
           {"white", prepared.preset.white.value_or(1)},
           {"display", display_json(display_of(prepared.preset))},
           {"version", version()},
           {"commit", commit()},
           {"compiler", compiler()},
           {"device", device_json(device)},
           {"finished", finished},
           {std::string(progress.units.steps), progress.step},
           {"fraction", progress.fraction},
           {std::string(progress.units.works), progress.work},
           {"units", {{"step", progress.units.step}, {"steps", progress.units.steps}, {"work", progress.units.works}}},
           {"work_seconds", progress.work_seconds},
           {"phase_seconds", phases},
           {"notes", prepared.plan->notes}};
  add_scalars(all, snapshot.scalars);
  if (snapshot.history) add_errors(all, *snapshot.history, reference);
  if (!pictures.empty()) all["pictures"] = pictures;
  all["files"] = files;
  return json_text(all, 2) + "\n";
}

void write_list(const fs::path& folder, const Json& list) {
  write_file_whole(folder / pictures_file, json_text(list, 2) + "\n");
}

/// "at-0010s", "at-0002.5s": in the order of time as a folder lists them.
std::string stem_at(double seconds) {
  std::string number = fmt::format("{:08.3f}", seconds);
  number.erase(number.find_last_not_of('0') + 1);
  if (number.ends_with('.')) number.pop_back();
  return "at-" + number + "s";
}

} // namespace

image::Image with_layers(const job::Picture& picture) {
  image::Image image;
  image.width = picture.width;
  image.height = picture.height;
  std::vector<const float*> sources;
  const auto add = [&](const std::string& prefix, const std::vector<float>& rgb) {
    for (const char* channel : {"R", "G", "B"}) image.channels.push_back(prefix + channel);
    sources.push_back(rgb.data());
  };
  add("", picture.rgb);
  for (const job::Layer& layer : picture.layers) add(layer.name + ".", layer.rgb);
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  image.data.reserve(pixels * image.channels.size());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    for (const float* source : sources) image.data.insert(image.data.end(), source + 3 * pixel, source + 3 * pixel + 3);
  return image;
}

void write_picture(const fs::path& stem, const preset::Preset& preset, const compute::DeviceInfo& device,
                   const job::Picture& picture) {
  image::Image exr = with_layers(picture);
  preset::Preset maker = preset;
  maker.display = {}; // which changes nothing of it
  exr.attributes = {{"nephroid:preset", preset::to_json(maker, stem.parent_path())},
                    {"nephroid:seed", std::to_string(preset.seed)},
                    {"nephroid:device", device.name},
                    {"nephroid:version", version()}};
  image::write_exr(stem.string() + ".exr", exr);
  image::write_png(stem.string() + ".png", picture.width, picture.height, picture.rgb,
                   image::showing_of(display_of(preset), 0, picture.rgb));
}

Json pictures_at(const fs::path& folder) {
  Json list = Json::array();
  if (!is_there(folder / pictures_file)) return list;
  try {
    for (const Json& picture : Json::parse(read_file(folder / pictures_file)))
      list.push_back({{"seconds", picture.at("seconds").get<double>()},
                      {"work_seconds", picture.at("work_seconds").get<double>()},
                      {"picture", fs::path(picture.at("picture").get<std::string>()).filename().string()},
                      {"errors", picture.at("errors")}});
  } catch (const Json::exception&) {
    // Written by something else: the pictures are there all the same.
  }
  return list;
}

Json by_column(const std::vector<std::string>& columns, const std::vector<double>& values) {
  Json all = Json::object();
  for (std::size_t i = 0; i < columns.size() && i < values.size(); ++i)
    all[columns[i]] = std::isnan(values[i]) ? Json() : Json(values[i]);
  return all;
}

Json write_picture_at(const fs::path& folder, double seconds, const Prepared& prepared,
                      const compute::DeviceInfo& device, const job::Snapshot& snapshot) {
  const std::string stem = stem_at(seconds);
  write_picture(folder / stem, prepared.preset, device, *snapshot.picture);
  Json errors = Json::object();
  if (const auto& history = snapshot.history;
      history && !history->rows.empty() && history->rows.back().seconds >= seconds)
    errors = by_column(history->columns, history->rows.back().errors);
  const Json written{{"seconds", seconds},
                     {"work_seconds", snapshot.progress.work_seconds},
                     {"picture", stem + ".png"},
                     {"errors", errors}};
  Json list = pictures_at(folder);
  list.push_back(written);
  write_list(folder, list);
  return written;
}

void remove_pictures_after(const fs::path& folder, double work_seconds) {
  Json kept = Json::array();
  std::error_code ignored;
  for (const Json& picture : pictures_at(folder)) {
    if (picture["work_seconds"] <= work_seconds) {
      kept.push_back(picture);
      continue;
    }
    const fs::path file = folder / picture["picture"].get<std::string>();
    fs::remove(file, ignored);
    fs::remove(fs::path(file).replace_extension(".exr"), ignored);
  }
  if (kept.empty())
    fs::remove(folder / pictures_file, ignored);
  else
    write_list(folder, kept);
}

void show_anew(const fs::path& folder, const preset::Preset& preset) {
  const image::Display display = display_of(preset);
  std::vector<fs::path> pictures{folder / "image.exr"};
  for (const Json& picture : pictures_at(folder))
    pictures.push_back((folder / picture["picture"].get<std::string>()).replace_extension(".exr"));
  for (const fs::path& exr : pictures) {
    if (!is_there(exr)) continue;
    const measure::LinearPicture picture = measure::read_linear_rgb(exr);
    image::write_png(fs::path(exr).replace_extension(".png"), picture.width, picture.height, picture.rgb,
                     image::showing_of(display, 0, picture.rgb));
  }
  Json run = Json::parse(read_file(folder / "run.json"));
  run["display"] = display_json(display);
  write_file_whole(folder / "run.json", json_text(run, 2) + "\n");
  if (is_there(folder / "report.html")) write_report(folder);
  write_file_whole(folder / "preset.json", preset::to_json(preset, folder) + "\n"); // last: it says that all is done
}

void write_report(const fs::path& folder) {
  write_file_whole(folder / "report.html", report::report_html(std::span(&folder, 1)));
}

void write_history(const fs::path& folder, const job::History& history) {
  write_file_whole(folder / "history.csv", measure::to_csv(history));
}

void write_run(const fs::path& folder, const Prepared& prepared, const compute::DeviceInfo& device,
               const job::Snapshot& snapshot, const measure::Reference* reference, bool finished) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw failed(folder.string(), "cannot be made: " + error.message());
  std::vector<std::string> files;
  const auto picture = [&](const std::string& name, const job::Picture& pixels) {
    write_picture(folder / name, prepared.preset, device, pixels);
    files.insert(files.end(), {name + ".exr", name + ".png"});
  };
  if (!snapshot.stands_in) picture("image", *snapshot.picture);
  for (const job::NamedPicture& further : snapshot.pictures) picture(further.name, *further.picture);
  for (const job::Curve& curve : snapshot.curves)
    write_file_whole(folder / files.emplace_back(curve.name + ".csv"), to_csv(curve));
  for (const job::ExtraFile& file : snapshot.files)
    write_file_whole(folder / files.emplace_back(file.name), file.write);
  if (snapshot.meters)
    for (const std::string& file : write_meters(folder / "meters", prepared.preset.name, *snapshot.meters))
      files.push_back("meters/" + file);
  if (snapshot.history) write_history(folder, *snapshot.history);
  write_settings(folder, prepared);
  write_file_whole(folder / "run.json", run_json(prepared, device, snapshot, reference, pictures_at(folder), files,
                                                 finished)); // last: its "finished" speaks for all
}

} // namespace nephroid::run
