// SPDX-License-Identifier: Apache-2.0
#include "run/picture.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/json_output.h"
#include "preset/read.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nephroid::run {

image::Image with_layers(const job::Picture& picture)
{
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

void write_picture(const std::filesystem::path& stem, const preset::Preset& preset, const compute::DeviceInfo& device,
                   const job::Picture& picture)
{
  image::Image exr = with_layers(picture);
  exr.attributes = {{"nephroid:preset", preset::to_json(preset, stem.parent_path())},
                    {"nephroid:seed", std::to_string(preset.seed)},
                    {"nephroid:device", device.name},
                    {"nephroid:version", version()}};
  image::write_exr(stem.string() + ".exr", exr);
  image::write_png(stem.string() + ".png", picture.width, picture.height, picture.rgb);
}

namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

void write_list(const fs::path& folder, const Json& list) { write_file_whole(folder / pictures_file, json_text(list, 2) + "\n"); }

/// "at-0010s", "at-0002.5s": in the order of time as a folder lists them.
std::string stem_at(double seconds)
{
  std::string number = fmt::format("{:08.3f}", seconds);
  number.erase(number.find_last_not_of('0') + 1);
  if (number.ends_with('.')) number.pop_back();
  return "at-" + number + "s";
}

} // namespace

Json pictures_at(const fs::path& folder)
{
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

Json by_column(const std::vector<std::string>& columns, const std::vector<double>& values)
{
  Json all = Json::object();
  for (std::size_t i = 0; i < columns.size() && i < values.size(); ++i) all[columns[i]] = std::isnan(values[i]) ? Json() : Json(values[i]);
  return all;
}

Json write_picture_at(const fs::path& folder, double seconds, const Prepared& prepared, const compute::DeviceInfo& device,
                      const job::Snapshot& snapshot)
{
  const std::string stem = stem_at(seconds);
  write_picture(folder / stem, prepared.preset, device, *snapshot.picture);
  Json errors = Json::object();
  if (const auto& history = snapshot.history; history && !history->rows.empty() && history->rows.back().seconds >= seconds)
    errors = by_column(history->columns, history->rows.back().errors);
  const Json written{
      {"seconds", seconds}, {"work_seconds", snapshot.progress.work_seconds}, {"picture", stem + ".png"}, {"errors", errors}};
  Json list = pictures_at(folder);
  list.push_back(written);
  write_list(folder, list);
  return written;
}

void remove_pictures_after(const fs::path& folder, double work_seconds)
{
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

} // namespace nephroid::run
