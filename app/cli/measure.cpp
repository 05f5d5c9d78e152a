// SPDX-License-Identifier: Apache-2.0
// `nephroid measure`: what the meters of a preset show, as a table and as files.
#include "base/counted.h"
#include "base/interrupts.h"
#include "base/json_output.h"
#include "cli/measure_hours.h"
#include "cli/progress.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "meters/intervals.h"
#include "preset/choices.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "run/meter_files.h"
#include "run/meters.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace nephroid::cli {
namespace {

using meters::Interval;
using meters::LayerReading;
using meters::Numbers;
using meters::Quantity;
using meters::Reading;
using run::MeterInHand;
namespace fs = std::filesystem;

struct MeasureOptions {
  std::string preset, meter;
  fs::path folder;
  std::vector<std::string> overrides;
  std::optional<double> seconds, until_percent;
  std::optional<std::uint64_t> seed;
  std::string hours;
  std::optional<int> every;
  compute::DeviceOptions device;
  bool json = false;
};

std::string percent_of(const Interval& share) {
  if (share.high - share.low < 5e-4) return fmt::format("{:.1f} %", 100 * share.value);
  return fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100 * share.value, 100 * share.low, 100 * share.high);
}

void print_numbers(const MeterInHand& meter, const Reading& reading, Quantity quantity) {
  fmt::print("  {:<9} {:>22} {:>26} {:>24}\n", run::unit_of(*meter.surface, quantity), "mean", "peak", "least");
  for (const LayerReading& layer : reading.layers) {
    const Numbers& n = layer.numbers(quantity);
    fmt::print("  {:<9} {:>22} {:>26} {:>24}\n", layer.name, text_of(n.mean),
               meter.surface->count() > 1 ? text_of(n.peak) : "", meter.surface->count() > 1 ? text_of(n.least) : "");
  }
}

void print_text(const MeterInHand& meter, const preset::Preset& preset, optics::SpectralRange range) {
  const Reading& reading = *meter.reading;
  const Numbers &watts = reading.all().numbers(Quantity::irradiance),
                &lux = reading.all().numbers(Quantity::illuminance);
  fmt::print("{}: {}, {:.4g} {}, light of {}; {:.1f} s", meter.meter.name, counted(meter.surface->count(), "cell"),
             reading.extent, meter.surface->is_goniometer() ? "sr" : "m^2", text_of(range), meter.seconds);
  if (meter.photons > 0) fmt::print(", {:.3g} million photons", 1e-6 * static_cast<double>(meter.photons));
  fmt::print("\n");
  print_numbers(meter, reading, Quantity::irradiance);
  print_numbers(meter, reading, Quantity::illuminance);
  fmt::print("  total {} W, {} lm\n", text_of(watts.total), text_of(lux.total));
  if (meter.surface->is_goniometer()) {
    const scene::GammaC way =
        scene::direction_of(*meter.surface, reading.all().numbers(meters::quantity_of(meter.meter.unit)).peak_cell);
    fmt::print("  peak at gamma {:.1f}, C {:.1f} degrees\n", way.gamma_deg, way.c_deg);
  } else if (meter.surface->count() > 1) {
    const Numbers& shown = reading.all().numbers(meters::quantity_of(meter.meter.unit));
    const glm::dvec3 p = meter.surface->centres[shown.peak_cell] + meter.origin;
    fmt::print("  peak at ({:.4g}, {:.4g}, {:.4g}) {}; uniformity (least / mean) {}\n", p.x, p.y, p.z,
               preset::word(preset.unit), text_of(shown.uniformity));
  }
  if (reading.share_above)
    fmt::print("  above {}: {} of the {}\n", *meter.meter.threshold, percent_of(*reading.share_above),
               meter.surface->is_goniometer() ? "directions" : "area");
  if (!(reading.all().numbers(Quantity::irradiance).mean.value > 0))
    fmt::print("  no light was found: it is dark, or light is rare here and wants more time\n");
  if (const std::uint64_t refused = meter.run->refused(); refused > 0)
    fmt::print("  {} were too bright for the film and are not in these numbers\n", counted(refused, "contribution"));
  if (const double lost = meter.run->lost_share(); lost > 1e-4)
    fmt::print("  {:.2g} % of the photons' power met more than {} surfaces and is not in these numbers\n", 100 * lost,
               meter.plan.settings.max_surfaces);
}

void report(const MeasureOptions& options, const run::Metering& metering) {
  const meters::Readings readings = metering.readings();
  const std::string& name = metering.prepared().preset.name;
  if (options.json)
    fmt::print("{}\n", json_text(run::to_json(name, readings)));
  else
    for (const MeterInHand& meter : metering.meters()) print_text(meter, metering.prepared().preset, metering.range());
  if (!options.folder.empty()) run::write_meters(options.folder, name, readings);
}

/// Works until every meter has a reading, and then enough of one.
void drive(const MeasureOptions& options, run::Metering& metering, const std::stop_token& interrupted) {
  constexpr double usual_percent = 1, usual_seconds = 60;
  const double percent = options.until_percent.value_or(usual_percent),
               usual = options.until_percent ? std::numeric_limits<double>::infinity()
                                             : usual_seconds * static_cast<double>(metering.meters().size()),
               seconds = options.seconds.value_or(usual);
  LiveLine line;
  const bool shows = progress_style(options.json) == ProgressStyle::live;
  while (!interrupted.stop_requested()) {
    if (metering.advance() && shows) {
      std::string text;
      for (const MeterInHand& meter : metering.meters())
        text += fmt::format("{}{} +- {:.2g} %", text.empty() ? "" : ", ", meter.meter.name,
                            100 * std::min(meter.relative_half_width(), 1.0));
      line.show(fmt::format("{:.1f} s: {}", metering.work_seconds(), text));
    }
    if (!metering.all_read()) continue;
    const bool is_enough = !(options.seconds && !options.until_percent) && metering.is_enough(percent);
    if (is_enough || metering.work_seconds() >= seconds) return;
  }
  if (!metering.all_read())
    throw Error(ErrorKind::interrupted, options.preset, "interrupted before there was anything to tell");
}

void measure(const MeasureOptions& options) {
  preset::Preset preset = preset::read_preset(options.preset, options.overrides);
  if (options.seed) preset.seed = *options.seed;
  const Interrupts interrupts; // before OpenCL starts its threads
  preset::at_origins(preset, [&] {
    run::DeviceOnDemand device(device_opener(options.device));
    const run::Prepared prepared = run::prepare(preset);
    const HoursOptions series{options.hours,   options.meter,         options.folder, options.every,
                              options.seconds, options.until_percent, options.json};
    if (!options.hours.empty())
      return measure_hours(series, prepared, {device.context(), Communicator(nullptr)}, interrupts.token());
    run::Metering metering(prepared, {device.context(), Communicator(nullptr)}, options.meter);
    for (const std::string& note : metering.notes()) fmt::print(stderr, "note: {}\n", note);
    if (!options.folder.empty()) fs::create_directories(options.folder);
    drive(options, metering, interrupts.token());
    report(options, metering);
    if (interrupts.token().stop_requested())
      throw Error(ErrorKind::interrupted, options.preset, "interrupted: the numbers are of the work until then");
  });
}

} // namespace

void add_measure(CLI::App& program, Session&) {
  const auto options = std::make_shared<MeasureOptions>();
  Verb verb(program, "measure", "Irradiance and illuminance on the meters of a preset, with 95 % intervals",
            {{"nephroid measure measuring/concave-facade --seconds 2", "a table"},
             {"nephroid measure measuring/concave-facade --until 20 -o out/facade", "to 20 %, and as files"},
             {"nephroid measure measuring/concave-facade --hours day --until 50", "hour by hour"}},
            "Files: for each meter NAME.csv (a row a cell), NAME.exr (a channel a quantity) and NAME.png (false "
            "colours), of a goniometer NAME.ies and NAME.ldt; measure.json. With --hours NAME-hours.csv,\n"
            "NAME-cells.csv (sums over the hours) and NAME-highest.png; hours.json.");
  verb.option("PRESET", options->preset, {.says = "A preset file or the name of a shipped preset", .required = true});
  verb.option("-o,--output", options->folder, {.type = "DIR", .says = "Also write files into this folder"});
  verb.overrides(options->overrides);
  verb.option("--meter", options->meter, {.type = "NAME", .says = "Only this one (default: all)"});
  verb.option("--until", options->until_percent,
              {.type = "PERCENT",
               .says = "Stop where the intervals of mean and peak are this narrow each way (default 1), but where a "
                       "meter has until_percent",
               .from = 0.001,
               .to = 100});
  verb.option(
      "--seconds", options->seconds,
      {.type = "S",
       .says = "Stop after this much work, whatever the intervals (default: 60 for each meter, or none with --until)",
       .from = 0.001,
       .to = 1e9});
  verb.option("--hours", options->hours,
              {.type = "WHICH",
               .says = "Measure each hour of light: day: of the sky's date; year: of its year; FILE.epw: of a weather "
                       "file. Then --until is 5 unless said, and --seconds, for each hour and meter, 10"});
  verb.option("--every", options->every,
              {.type = "DAYS",
               .says = "Of a year or weather, each hour of every so many days (default 7)",
               .from = 1,
               .to = 365,
               .needs = "--hours"});
  verb.option("--seed", options->seed,
              {.type = "N", .says = "Of the random numbers, instead of the preset's", .from = 0});
  verb.device(options->device.selector, options->device.kernels);
  verb.flag("--json", options->json, "One JSON object instead of text");
  verb.work([options] { measure(*options); });
}

} // namespace nephroid::cli
