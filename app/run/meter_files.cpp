// SPDX-License-Identifier: Apache-2.0
#include "run/meter_files.h"

#include "base/files.h"
#include "image/image.h"
#include "meters/intervals.h"
#include "meters/luminaire.h"
#include "meters/map.h"
#include "preset/choices.h"
#include "preset/meters.h"

#include <fmt/format.h>

namespace nephroid::run {
namespace {

using Json = nlohmann::ordered_json;
using meters::Numbers;
using meters::Quantity;
using meters::Shown;
namespace fs = std::filesystem;

Json numbers_json(const Numbers& numbers, const char* total) {
  return {{"mean", json_of(numbers.mean)},
          {total, json_of(numbers.total)},
          {"peak", json_of(numbers.peak)},
          {"least", json_of(numbers.least)},
          {"uniformity", json_of(numbers.uniformity)}};
}

Json meter_json(const Shown& shown) {
  const meters::Reading& reading = *shown.reading;
  const scene::MeterSurface& surface = *shown.surface;
  Json object{{"name", shown.meter.name},
              {"cells", surface.count()},
              {surface.is_goniometer() ? "steradians" : "area_m2", reading.extent},
              {"seconds", shown.seconds},
              {"photons", shown.photons},
              {"lost_share", shown.lost_share}};
  for (const meters::LayerReading& layer : reading.layers)
    object["layers"][layer.name] = {
        {unit_of(surface, Quantity::irradiance), numbers_json(layer.numbers(Quantity::irradiance), "total_w")},
        {unit_of(surface, Quantity::illuminance), numbers_json(layer.numbers(Quantity::illuminance), "total_lm")}};
  const std::size_t peak = reading.all().numbers(meters::quantity_of(shown.meter.unit)).peak_cell;
  const glm::dvec3 p = surface.centres[peak] + shown.origin;
  if (surface.is_goniometer()) {
    const scene::GammaC way = scene::direction_of(surface, peak);
    object["peak_at"] = {{"gamma_deg", way.gamma_deg}, {"c_deg", way.c_deg}};
  } else
    object["peak_at"] = {p.x, p.y, p.z};
  if (reading.share_above)
    object["above"] = {{"threshold", *shown.meter.threshold}, {"share", json_of(*reading.share_above)}};
  return object;
}

} // namespace

const char* unit_of(const scene::MeterSurface& surface, Quantity quantity) {
  if (surface.is_goniometer()) return quantity == Quantity::irradiance ? "W/sr" : "cd";
  return quantity == Quantity::irradiance ? "W/m^2" : "lx";
}

Json to_json(const std::string& preset_name, const meters::Readings& readings) {
  Json list = Json::array();
  for (const Shown& shown : readings.meters)
    if (shown.reading) list.push_back(meter_json(shown));
  return {{"preset", preset_name}, {"wavelengths", text_of(readings.range)}, {"confidence", 0.95}, {"meters", list}};
}

std::vector<std::string> write_meters(const fs::path& folder, const std::string& preset_name,
                                      const meters::Readings& readings) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw failed(folder.string(), "cannot be made: " + error.message());
  std::vector<std::string> files;
  const auto file = [&](const Shown& shown, const char* extension) {
    return folder / files.emplace_back(preset::file_stem(shown.meter) + extension);
  };
  for (const Shown& shown : readings.meters) {
    if (!shown.reading) continue;
    const scene::MeterSurface& surface = *shown.surface;
    write_file_whole(file(shown, ".csv"), meters::csv(surface, shown.origin, shown.metres_per_unit, *shown.reading));
    if (surface.is_goniometer()) {
      const std::string stem = preset::file_stem(shown.meter);
      const scene::LuminaireGrid grid = meters::luminaire(shown.meter, surface, *shown.reading);
      write_file_whole(file(shown, ".ies"), scene::ies(grid, shown.meter.name, stem));
      write_file_whole(file(shown, ".ldt"), scene::eulumdat(grid, shown.meter.name, stem));
    }
    image::write_exr(file(shown, ".exr"), meters::picture(surface, shown.metres_per_unit, *shown.reading));
    const measure::Bitmap map = meters::false_colours(shown.meter, surface, shown.metres_per_unit, *shown.reading);
    image::write_png_bytes(file(shown, ".png"), map.width, map.height, map.rgba);
  }
  write_file_whole(folder / files.emplace_back("measure.json"), to_json(preset_name, readings).dump(2) + "\n");
  return files;
}

std::vector<std::string> summary(const meters::Readings& readings) {
  std::vector<std::string> lines;
  for (const Shown& shown : readings.meters) {
    if (!shown.reading) {
      lines.push_back(fmt::format("{}: no reading yet", shown.meter.name));
      continue;
    }
    const Numbers& numbers = shown.reading->all().numbers(meters::quantity_of(shown.meter.unit));
    const preset::Meter::Unit unit = preset::unit_of(shown.meter);
    lines.push_back(fmt::format("{}: mean {}, peak {} {}", shown.meter.name,
                                text_of(numbers.mean, preset::size_of(unit)),
                                text_of(numbers.peak, preset::size_of(unit)), preset::word(unit)));
  }
  return lines;
}

} // namespace nephroid::run
