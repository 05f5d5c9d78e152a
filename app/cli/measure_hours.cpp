// SPDX-License-Identifier: Apache-2.0
#include "cli/measure_hours.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json_output.h"
#include "cli/progress.h"
#include "image/image.h"
#include "meters/intervals.h"
#include "meters/map.h"
#include "preset/choices.h"
#include "run/animation.h"
#include "run/hours.h"
#include "run/map_film.h"
#include "run/meters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;
using meters::Interval;
using meters::Reading;
using run::Hour;
using run::MeterInHand;
namespace fs = std::filesystem;

/// What a meter shows in an hour, in the quantity of its unit.
struct Line {
  Hour hour;
  scene::SunPlace sun;
  Interval mean, peak; ///< W/m^2 or lx
  glm::dvec3 place{0}; ///< of the peak, as the preset counts
};

/// The hours in which the peak is above the threshold, of the time that the series is of. value: those whose
/// highest mean is above; low, high: those in which the peak surely is, and may be.
Interval hours_above(const std::vector<Line>& lines, double threshold, double weight_h) {
  Interval hours;
  for (const Line& line : lines) {
    hours.value += line.peak.value > threshold ? weight_h : 0;
    hours.low += line.peak.low > threshold ? weight_h : 0;
    hours.high += line.peak.high > threshold ? weight_h : 0;
  }
  return hours;
}

/// What the cells of a meter have in all, and how often.
struct CellSums {
  std::vector<double> light, square_half, hours_above; ///< [cell]; W h/m^2 or lx h, the square of its interval's half

  void add(const std::vector<Interval>& cells, double weight_h, std::optional<double> threshold) {
    light.resize(cells.size()), square_half.resize(cells.size()), hours_above.resize(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      light[i] += weight_h * cells[i].value;
      square_half[i] += std::pow(weight_h * (cells[i].high - cells[i].value), 2);
      if (threshold && cells[i].value > *threshold) hours_above[i] += weight_h;
    }
  }
};

/// A meter over all hours.
struct Series {
  preset::Meter meter;
  std::vector<Line> lines;
  CellSums sums;
  std::optional<double> threshold;        ///< W/m^2 or lx; nothing where it is of the other quantity than the unit
  std::shared_ptr<const Reading> highest; ///< of the hour with the highest peak; nothing: none has light
  scene::MeterSurface surface;            ///< of all hours
  double lost_share = 0;                  ///< the largest of an hour (photons::MeterRun)
  std::uint64_t refused = 0;              ///< in all hours
  glm::dvec3 origin{0};                   ///< preset coordinates of the scene's (0, 0, 0)
  run::MapFilm film;                      ///< of all hours, where files are written

  explicit Series(const preset::Meter& of)
      : meter(of), threshold(preset::threshold_in(of, preset::is_luminous(of.unit) ? preset::Meter::Unit::lux
                                                                                   : preset::Meter::Unit::watts)) {}
  /// The line of the highest peak. There is one.
  const Line& top() const {
    return *std::ranges::max_element(lines, {}, [](const Line& line) { return line.peak.value; });
  }
};

run::Hours hours_of(const HoursOptions& options, const preset::Preset& preset) {
  const auto& sky = preset.scene.environment;
  if (!sky || sky->type != preset::Environment::Type::sky || !sky->place)
    throw bad_input(Location(preset.source) / "scene", "has no sky of a place, and so no hours",
                    "expected a sky with \"place\"", "docs/sky.md has one");
  constexpr int usual_days = 7;
  const int every = options.every.value_or(usual_days);
  if (options.which == "day" && options.every)
    throw bad_input("--every", "is of days, and there is one", "expected --hours year or FILE.epw beside it");
  if (options.which == "day") return run::hours_of_day(*sky->place);
  if (options.which == "year") return run::hours_of_year(*sky->place, every);
  if (!options.which.ends_with(".epw") && !options.which.ends_with(".EPW"))
    throw bad_input("--hours", fmt::format("is {}", options.which), "expected day, year, or a weather file FILE.epw");
  return run::hours_of_weather(scene::read_weather(options.which), *sky->place, every);
}

std::string clock(double hour) {
  const int minutes = static_cast<int>(std::lround(60 * hour));
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

Line line_of(const MeterInHand& meter, const Hour& hour, const scene::SunPlace& sun) {
  const meters::Numbers& numbers = meter.reading->all().numbers(meters::quantity_of(meter.meter.unit));
  return {hour, sun, numbers.mean, numbers.peak, meter.surface->centres[numbers.peak_cell] + meter.origin};
}

void print_line(const Line& line, double unit, const char* before = "") {
  fmt::print("{}  {} {}  sun {:4.1f}  mean {:>18}  peak {:>24} at ({:.4g}, {:.4g}, {:.4g})\n", before, line.hour.date,
             clock(line.hour.hour), line.sun.elevation_deg, text_of(line.mean, unit), text_of(line.peak, unit),
             line.place.x, line.place.y, line.place.z);
}

/// Each hour of a day, of longer times the highest one of each month.
void print_text(const Series& series, const run::Hours& hours, optics::SpectralRange range) {
  const double unit = preset::size_of(preset::unit_of(series.meter));
  fmt::print("{}: {}, {} with light; {} of {}\n", series.meter.name, hours.about, counted(series.lines.size(), "hour"),
             preset::word(preset::unit_of(series.meter)), text_of(range));
  if (series.lines.empty()) return;
  const bool is_day = series.lines.front().hour.date == series.lines.back().hour.date;
  std::map<std::string, const Line*> highest; // of each month
  for (const Line& line : series.lines) {
    if (is_day) print_line(line, unit);
    const Line*& best = highest[line.hour.date.substr(0, 7)];
    if (!best || line.peak.value > best->peak.value) best = &line;
  }
  if (!is_day)
    for (const auto& [month, line] : highest) print_line(*line, unit);
  print_line(series.top(), unit, "  highest:");
  if (series.refused > 0)
    fmt::print("  {} were too bright for the film and are not in these numbers\n",
               counted(series.refused, "contribution"));
  if (series.lost_share > 1e-4)
    fmt::print("  up to {:.2g} % of the photons' power met too many surfaces and is not in these numbers\n",
               100 * series.lost_share);
  if (series.threshold) {
    const Interval above = hours_above(series.lines, *series.threshold, hours.weight_h);
    fmt::print("  above {}: {:.0f} h ({:.0f} to {:.0f}){}\n", *series.meter.threshold, above.value, above.low,
               above.high,
               hours.weight_h == 1 ? ""
                                   : fmt::format("; {} were measured, each for {:.3g}",
                                                 counted(series.lines.size(), "hour"), hours.weight_h));
  } else if (series.meter.threshold)
    fmt::print("  above {}: not counted, for the meter's unit is {}\n", *series.meter.threshold,
               preset::word(preset::unit_of(series.meter)));
}

Json to_json(const Line& line) {
  return {{"date", line.hour.date},
          {"hour", line.hour.hour},
          {"utc_offset_h", line.hour.utc_offset_h},
          {"sun_elevation_deg", line.sun.elevation_deg},
          {"sun_azimuth_deg", line.sun.azimuth_deg},
          {"mean", json_of(line.mean)},
          {"peak", json_of(line.peak)},
          {"peak_at", {line.place.x, line.place.y, line.place.z}}};
}

Json to_json(const Series& series, const run::Hours& hours) {
  Json object{{"name", series.meter.name},
              {"quantity", preset::is_luminous(series.meter.unit) ? "lx" : "W/m^2"},
              {"lost_share", series.lost_share},
              {"refused", series.refused},
              {"hours", Json::array()}};
  for (const Line& line : series.lines) object["hours"].push_back(to_json(line));
  if (!series.lines.empty()) object["highest"] = to_json(series.top());
  if (series.threshold)
    object["hours_above"] = {{"threshold", *series.meter.threshold},
                             {"hours", json_of(hours_above(series.lines, *series.threshold, hours.weight_h))}};
  return object;
}

std::string cells_csv(const Series& series) {
  const bool is_luminous = preset::is_luminous(series.meter.unit);
  std::string text = fmt::format("cell,x,y,z,{0},{0}_half,hours_above\n", is_luminous ? "lx_h" : "W_h_m-2");
  for (std::size_t i = 0; i < series.sums.light.size(); ++i) {
    const glm::dvec3 p = series.surface.centres[i] + series.origin;
    text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:g}\n", i, p.x, p.y, p.z, series.sums.light[i],
                        std::sqrt(series.sums.square_half[i]), series.sums.hours_above[i]);
  }
  return text;
}

std::string hours_csv(const Series& series) {
  const char* const unit = preset::is_luminous(series.meter.unit) ? "lx" : "W/m^2";
  std::string text = fmt::format("date,hour,sun_elevation_deg,sun_azimuth_deg,mean {0},mean {0} half,peak {0},peak {0} "
                                 "low,peak {0} high,x,y,z,utc_offset_h\n",
                                 unit);
  for (const Line& l : series.lines)
    text += fmt::format("{},{:g},{:.3f},{:.3f},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:g}\n",
                        l.hour.date, l.hour.hour, l.sun.elevation_deg, l.sun.azimuth_deg, l.mean.value, l.mean.half(),
                        l.peak.value, l.peak.low, l.peak.high, l.place.x, l.place.y, l.place.z, l.hour.utc_offset_h);
  return text;
}

void report(const HoursOptions& options, const run::Hours& hours, const std::vector<Series>& by_meter,
            optics::SpectralRange range, const std::string& preset, double metres_per_unit) {
  Json object{{"preset", preset},       {"wavelengths", text_of(range)},  {"confidence", 0.95},
              {"series", hours.about},  {"missing_hours", hours.missing}, {"hours_each", hours.weight_h},
              {"meters", Json::array()}};
  for (const Series& series : by_meter) {
    object["meters"].push_back(to_json(series, hours));
    if (!options.json) print_text(series, hours, range);
  }
  if (options.json) fmt::print("{}\n", json_text(object));
  if (options.folder.empty()) return;
  write_file_whole(options.folder / "hours.json", object.dump(2) + "\n"); // first: films are large
  for (const Series& series : by_meter) {
    const std::string stem = preset::file_stem(series.meter);
    std::error_code ignored;
    run::remove_frames(options.folder / (stem + "-hours"), 0);
    for (const char* name : {"-hours.csv", "-cells.csv", "-highest.png", "-hours.mp4", "-hours"}) // an older series'
      fs::remove(options.folder / (stem + name), ignored);
    if (!series.highest) continue;
    write_file_whole(options.folder / (stem + "-hours.csv"), hours_csv(series));
    write_file_whole(options.folder / (stem + "-cells.csv"), cells_csv(series));
    const measure::Bitmap map = meters::false_colours(series.meter, series.surface, metres_per_unit, *series.highest);
    image::write_png_bytes(options.folder / (stem + "-highest.png"), map.width, map.height, map.rgba);
    if (const auto why_not =
            series.film.write(options.folder / (stem + "-hours"), options.folder / (stem + "-hours.mp4"), series.meter,
                              series.surface, metres_per_unit))
      fmt::print(stderr, "note: {}: there is no video: {}\n", series.meter.name, *why_not);
  }
}

/// To the same interval in every hour, whatever the meters ask for when they are measured once. False: interrupted.
bool measure_hour(const HoursOptions& options, run::Metering& metering, const std::stop_token& interrupted) {
  constexpr double usual_percent = 5, usual_seconds = 10;
  const double percent = options.until_percent.value_or(usual_percent),
               seconds = options.seconds.value_or(usual_seconds) * static_cast<double>(metering.meters().size());
  while (!interrupted.stop_requested()) {
    metering.advance();
    if (!metering.all_read()) continue;
    const bool is_enough = std::ranges::all_of(
        metering.meters(), [&](const MeterInHand& m) { return m.relative_half_width() <= percent / 100; });
    if (is_enough || metering.work_seconds() >= seconds) return true;
  }
  return false;
}

} // namespace

void measure_hours(const HoursOptions& options, const run::Prepared& prepared, const mpi::RankContext& context,
                   const std::stop_token& interrupted) {
  const run::Hours hours = hours_of(options, prepared.preset);
  if (hours.missing > 0)
    fmt::print(stderr, "note: {} of the weather file have no data and are left out\n", counted(hours.missing, "hour"));
  if (hours.twilight > 0)
    fmt::print(stderr, "note: {} of the weather file have light and their sun below the horizon, and are left out\n",
               counted(hours.twilight, "hour"));
  if (hours.too_bright > 0)
    fmt::print(stderr, "note: in {} of the weather file the sun is brighter than above the air: are these W/m^2?\n",
               counted(hours.too_bright, "hour"));
  if (!options.folder.empty()) fs::create_directories(options.folder);
  std::vector<Series> by_meter;
  for (const preset::Meter& meter : prepared.preset.scene.meters)
    if (options.meter.empty() || meter.name == options.meter) by_meter.emplace_back(meter);
  optics::SpectralRange range = optics::SpectralRange::solar;
  std::set<std::string> told;
  LiveLine live;
  const bool shows = progress_style(options.json) == ProgressStyle::live;
  for (std::size_t i = 0; i < hours.hours.size() && !interrupted.stop_requested(); ++i) {
    const Hour& hour = hours.hours[i];
    run::Prepared now = prepared;
    now.preset.scene.environment = run::sky_of(*prepared.preset.scene.environment, hours.place, hour);
    now.preset.seed += i; // so that errors of the hours are independent
    const preset::Environment& sky = *now.preset.scene.environment;
    if (run::is_dark(sky) && now.preset.scene.lights.empty()) continue; // nothing to measure
    run::Metering metering(now, context, options.meter);
    for (const std::string& note : metering.notes())
      if (note != metering.sky() && told.insert(note).second) fmt::print(stderr, "note: {}\n", note);
    if (!measure_hour(options, metering, interrupted)) break;
    if (!run::is_dark(sky)) range = metering.range();
    for (std::size_t m = 0; m < metering.meters().size(); ++m) {
      const MeterInHand& meter = metering.meters()[m];
      Series& series = by_meter[m];
      const bool is_highest = series.lines.empty() || line_of(meter, hour, {}).peak.value > series.top().peak.value;
      series.lines.push_back(line_of(meter, hour, scene::sun_place(*sky.place)));
      series.sums.add(meter.reading->all().cells[static_cast<std::size_t>(meters::quantity_of(meter.meter.unit))],
                      hours.weight_h, series.threshold);
      if (is_highest) series.highest = meter.reading;
      if (!options.folder.empty())
        series.film.add(series.meter, *meter.reading, fmt::format("{}  {}", hour.date, clock(hour.hour)));
      series.lost_share = std::max(series.lost_share, meter.run->lost_share());
      series.refused += meter.run->refused();
      series.surface = *meter.surface, series.origin = meter.origin;
      if (shows)
        live.show(fmt::format("{} {}: {} {}", hour.date, clock(hour.hour), series.meter.name,
                              text_of(series.lines.back().peak, preset::size_of(preset::unit_of(series.meter)))));
    }
  }
  live.clear();
  report(options, hours, by_meter, range, prepared.preset.name, prepared.loaded->scene.metres_per_unit);
  if (interrupted.stop_requested())
    throw Error(ErrorKind::interrupted, prepared.preset.source, "interrupted: the numbers are of the hours until then");
}

} // namespace nephroid::cli
