// SPDX-License-Identifier: Apache-2.0
// `nephroid pictures`: what the receivers of a preset of engine 3 shall show, and how close to that an object comes at
// best. Designs nothing.
#include "cli/verb.h"
#include "image/image.h"
#include "inverse/assign/cost.h"
#include "inverse/engine.h"
#include "inverse/plan.h"
#include "inverse/sheet.h"
#include "preset/origins.h"
#include "preset/read.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::cli {
namespace {

using namespace inverse;

struct PicturesOptions {
  std::string preset;
  std::vector<std::string> overrides;
  std::filesystem::path picture;
};

void show_pictures(const PicturesOptions& options) {
  const preset::Preset preset = preset::read_preset(options.preset, options.overrides);
  const InversePlan plan = preset::at_origins(preset, [&] {
    engine::require_engine(preset, inverse::engine, "casts no pictures");
    return make_plan(preset);
  });
  const Design& design = *plan.design;
  std::vector<std::vector<Captioned>> columns;
  for (std::size_t j = 0; j < design.targets.size(); ++j) {
    const std::string where = design.layout.far ? "far away" : fmt::format("at {} mm", design.layout.distances[j]);
    const inverse::Target &target = design.targets[j], &best = design.best()[j];
    const double most = *std::max_element(target.begin(), target.end()), off = cost_of(target, best, 1).rel_l2;
    const auto wanted = grey_picture(target, 1 / most, design.layout.cells),
               at_best = grey_picture(best, 1 / most, design.layout.cells);
    columns.push_back({{wanted, "wanted " + where},
                       {at_best, fmt::format("at best: {:.3f} off", off)},
                       {difference_picture(*wanted, *at_best), "red: too much, blue: too little"}});
    fmt::print("picture {} {}: at best {:.3f} off (rel_l2), brightest {:.1f} times an even picture\n", j + 1, where,
               off, most * static_cast<double>(target.size()));
  }
  for (const std::string& note : notes_of(preset, design)) fmt::print(stderr, "note: {}\n", note);
  if (options.picture.empty()) return;
  const auto [width, height] = preset.scene.camera.resolution;
  image::write_png(options.picture, width, height, sheet(columns, design.layout.receiver, width, height)->rgb);
}

} // namespace

void add_pictures(CLI::App& program, Session&) {
  const auto options = std::make_shared<PicturesOptions>();
  Verb verb(program, "pictures", "What an object of the engine 'inverse' shall cast, and how close it can come at best",
            {{"nephroid pictures inverse/faces -o faces.png", "before a run: wanted, at best, and the difference"}});
  verb.option("PRESET", options->preset, {.says = "A preset file or the name of a shipped preset", .required = true});
  verb.overrides(options->overrides);
  verb.option("-o,--output", options->picture, {.type = "FILE", .says = "Write a PNG of the pictures"});
  verb.work([options] { show_pictures(*options); });
}

} // namespace nephroid::cli
