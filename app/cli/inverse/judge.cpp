// SPDX-License-Identifier: Apache-2.0
// `nephroid judge`: what a finished object casts, in the light, on the screens and of the index that are asked, without
// a new design.
#include "inverse/judge.h"
#include "base/files.h"
#include "base/interrupts.h"
#include "base/json_output.h"
#include "cli/progress.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "inverse/engine.h"
#include "inverse/finished.h"
#include "inverse/plan.h"
#include "inverse/sheet.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "run/animation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <numeric>

namespace nephroid::cli {
namespace {

using namespace inverse;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int focus_steps = 11;

struct JudgeOptions {
  fs::path object, design, folder;
  std::vector<std::string> overrides;
  double focus = 10;
  compute::DeviceOptions device;
  bool json = false;
};

/// What an object casts on some screens.
struct Cast {
  std::vector<Cost> costs, noise;
  std::vector<std::shared_ptr<const job::Picture>> pictures;
  RayOutcomes outcomes;
};

/// An object in one light, and what it shall cast there.
struct Scene {
  preset::Preset preset;
  std::shared_ptr<const Design> design;
  Solid solid;

  Layout layout() const {
    Layout layout = design->layout;
    layout.frames.clear();
    layout.thickness = top_of(solid);
    return layout;
  }
};

Scene scene_of(const fs::path& preset_file, const std::vector<std::string>& overrides) {
  Scene scene;
  scene.preset = preset::read_preset(preset_file.string(), overrides);
  engine::require_engine(scene.preset, inverse::engine, "casts no pictures");
  scene.design = preset::at_origins(scene.preset, [&] { return std::make_shared<const Design>(scene.preset); });
  return scene;
}

class Judging {
public:
  explicit Judging(const JudgeOptions& options)
      : options_(options), context_(device_opener(options.device)()),
        shows_(progress_style(options.json) == ProgressStyle::live) {}

  Cast cast(const Layout& layout, const std::vector<inverse::Target>& targets, const Solid& solid, const char* what) {
    Judge judge(mpi::RankContext(context_), layout, solid, 1, targets);
    while (!judge.finished()) {
      if (interrupts_.token().stop_requested())
        throw Error(ErrorKind::interrupted, options_.object.string(), "interrupted before there was anything to tell");
      judge.advance();
      if (shows_) line_.show(fmt::format("{}: {:.0f} %", what, 100 * judge.fraction_done()));
    }
    line_.clear();
    Cast cast{judge.costs(targets), judge.noise(targets), {}, judge.outcomes()};
    for (std::size_t j = 0; j < targets.size(); ++j) {
      const double most = *std::ranges::max_element(targets[j]);
      cast.pictures.push_back(layout.coloured() ? coloured_picture(judge.colours(j), most, layout)
                                                : received_picture(judge.light(j), most, layout));
    }
    return cast;
  }

private:
  Interrupts interrupts_; // before OpenCL starts its threads
  const JudgeOptions& options_;
  compute::Context context_;
  LiveLine line_;
  bool shows_;
};

/// All that is told.
struct Verdict {
  Layout layout, focus;
  double part = 0; ///< how much nearer and farther the screens of `focus` are; 0: there are none
  std::vector<inverse::Target> targets;
  std::optional<Cast> designed; ///< where something else is judged than the design in its own light
  Cast now, through;
  std::vector<Deviation> deviations; ///< of a made object from its design, for each receiver
};

/// Where rel_l2 is half as much again as at its best, in parts of the distance; to either side.
std::string depth_of_focus(const Verdict& v, std::size_t receiver) {
  const auto rel_l2 = [&](int k) {
    return v.through.costs[receiver * focus_steps + static_cast<std::size_t>(k)].rel_l2;
  };
  int best = 0;
  for (int k = 1; k < focus_steps; ++k)
    if (rel_l2(k) < rel_l2(best)) best = k;
  const auto percent = [&](double k) { return 100 * v.part * (2 * k / (focus_steps - 1) - 1); };
  const double limit = 1.5 * rel_l2(best);
  const auto end = [&](int step) {
    for (int k = best; k + step >= 0 && k + step < focus_steps; k += step)
      if (const double here = rel_l2(k), next = rel_l2(k + step); next > limit)
        return fmt::format("{:+.2g}", percent(k + step * (limit - here) / (next - here)));
    return fmt::format("beyond {:+.2g}", percent(step > 0 ? focus_steps - 1 : 0));
  };
  return fmt::format("best at {:.4g} mm; rel_l2 is half as much again at {} and {} %",
                     v.focus.distances[receiver * focus_steps + static_cast<std::size_t>(best)], end(-1), end(1));
}

std::string distance_of(const Layout& layout, std::size_t receiver) {
  return layout.far ? "far" : fmt::format("{:.6g}", layout.distances[receiver]);
}

void print(const Verdict& v) {
  fmt::print("{:>8} {:>9} {:>7} {:>7} {:>7} {:>7}{}\n", "picture", "at mm", "cost", "rel_l2", "noise", "missed",
             v.designed ? "   designed: cost, rel_l2" : "");
  for (std::size_t j = 0; j < v.targets.size(); ++j) {
    const Cost& c = v.now.costs[j];
    fmt::print("{:>8} {:>9} {:>7.4f} {:>7.4f} {:>7.4f} {:>7.4f}", j + 1, distance_of(v.layout, j), c.cost, c.rel_l2,
               v.now.noise[j].rel_l2, c.missed);
    if (v.designed) fmt::print("{:>17.4f} {:>7.4f}", v.designed->costs[j].cost, v.designed->costs[j].rel_l2);
    fmt::print("\n");
  }
  const RayOutcomes& f = v.now.outcomes;
  fmt::print("light: {:.1f} % sent, {:.1f} % reflected, {:.1f} % lost, {:.1f} % by walls\n", 100 * f.sent,
             100 * f.reflected, 100 * f.lost, 100 * f.by_walls);
  if (v.part > 0)
    for (std::size_t j = 0; j < v.targets.size(); ++j)
      fmt::print("through focus, picture {}: {}\n", j + 1, depth_of_focus(v, j));
  for (std::size_t j = 0; j < v.deviations.size(); ++j)
    fmt::print(
        "surface, picture {}: half of it sends light within {:.3f} cells of its place, {:.1f} % more than a cell "
        "off\n",
        j + 1, v.deviations[j].median_cells, 100 * v.deviations[j].part_off);
}

Json to_json(const std::vector<Cost>& costs, std::size_t i) {
  return {{"cost", costs[i].cost},
          {"cost_all", costs[i].cost_all},
          {"rel_l2", costs[i].rel_l2},
          {"missed", costs[i].missed}};
}

Json to_json(const Verdict& v) {
  Json receivers = Json::array();
  for (std::size_t j = 0; j < v.targets.size(); ++j) {
    Json receiver{{"distance_mm", v.layout.distances[j]},
                  {"judged", to_json(v.now.costs, j)},
                  {"noise_rel_l2", v.now.noise[j].rel_l2}};
    if (v.designed) receiver["designed"] = to_json(v.designed->costs, j);
    for (std::size_t k = 0; v.part > 0 && k < focus_steps; ++k) {
      const std::size_t screen = j * focus_steps + k;
      Json row{{"distance_mm", v.focus.distances[screen]}};
      row.update(to_json(v.through.costs, screen));
      receiver["through_focus"].push_back(row);
    }
    if (!v.deviations.empty())
      receiver["surface"] = {{"median_cells", v.deviations[j].median_cells}, {"part_off", v.deviations[j].part_off}};
    receivers.push_back(receiver);
  }
  const RayOutcomes& f = v.now.outcomes;
  return {{"receivers", receivers},
          {"light", {{"sent", f.sent}, {"reflected", f.reflected}, {"lost", f.lost}, {"by_walls", f.by_walls}}}};
}

void write_picture(const fs::path& stem, const job::Picture& picture) {
  image::write_png(fs::path(stem) += ".png", picture.width, picture.height, picture.rgb);
  write_file_whole(fs::path(stem) += ".exr", [&](ByteSink& to) {
    image::write_exr(to, {picture.width, picture.height, {"R", "G", "B"}, picture.rgb});
  });
}

/// The screens from the nearest on, each as large as fits, as frames and where ffmpeg is installed as a film.
void write_film(const fs::path& folder, const Verdict& v) {
  std::vector<std::size_t> order(v.focus.distances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return v.focus.distances[i]; });
  constexpr int edge = 512;
  const glm::dvec2 shape = v.layout.receiver / std::max(v.layout.receiver.x, v.layout.receiver.y);
  const int width = static_cast<int>(edge * shape.x), height = static_cast<int>(edge * shape.y);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Cost& cost = v.through.costs[order[i]];
    const auto frame = sheet({{{v.through.pictures[order[i]],
                                fmt::format("{:.4g} mm: rel_l2 {:.3f}", v.focus.distances[order[i]], cost.rel_l2)}}},
                             v.layout.receiver, width, height);
    image::write_png(folder / fmt::format("frame_{:04}.png", i), frame->width, frame->height, frame->rgb);
  }
  constexpr double fps = 4;
  if (const auto why = run::make_video(folder, static_cast<int>(order.size()), fps))
    fmt::print(stderr, "note: frames without a film: {}\n", *why);
}

void write_files(const JudgeOptions& options, const Verdict& v) {
  std::error_code error;
  const fs::path film = options.folder / "focus";
  fs::create_directories(v.part > 0 ? film : options.folder, error);
  if (error) throw failed(options.folder, error.message(), "expected a folder that can be made");
  write_file_whole(options.folder / "judge.json", to_json(v).dump(2) + "\n");
  std::vector<std::vector<Captioned>> columns;
  for (std::size_t j = 0; j < v.targets.size(); ++j) {
    const double most = *std::ranges::max_element(v.targets[j]);
    const auto wanted = grey_picture(v.targets[j], 1 / most, v.layout.cells);
    columns.push_back({{wanted, v.layout.far ? "wanted, over tangents of angles"
                                             : fmt::format("wanted at {} mm", distance_of(v.layout, j))}});
    if (v.designed)
      columns.back().push_back({v.designed->pictures[j], fmt::format("designed: {:.3f}", v.designed->costs[j].rel_l2)});
    columns.back().push_back({v.now.pictures[j], fmt::format("judged: rel_l2 {:.3f}", v.now.costs[j].rel_l2)});
    columns.back().push_back({difference_picture(*wanted, *v.now.pictures[j]), "red: too much, blue: too little"});
    write_picture(options.folder / fmt::format("receiver_{}", j + 1), *v.now.pictures[j]);
  }
  for (std::size_t j = 0; j < v.deviations.size(); ++j)
    write_picture(options.folder / fmt::format("surface_{}", j + 1),
                  *grey_picture(v.deviations[j].off, 1, v.layout.facets));
  const auto whole = sheet(columns, v.layout.receiver, 1280, 960);
  image::write_png(options.folder / "judge.png", whole->width, whole->height, whole->rgb);
  if (v.part == 0) return;
  std::string csv = "receiver,distance_mm,cost,rel_l2,missed\n";
  for (std::size_t i = 0; i < v.focus.distances.size(); ++i) {
    const Cost& cost = v.through.costs[i];
    csv +=
        fmt::format("{},{},{},{},{}\n", i / focus_steps + 1, v.focus.distances[i], cost.cost, cost.rel_l2, cost.missed);
  }
  write_file_whole(options.folder / "focus.csv", csv);
  write_film(film, v);
}

fs::path file_of_run(const fs::path& run, const char* name) {
  if (!is_there(run / name))
    throw bad_input((run / name).string(), "is not there",
                    "expected the folder of a finished run of the engine "
                    "'inverse'");
  return run / name;
}

void judge(const JudgeOptions& options) {
  if (!fs::exists(options.object))
    throw bad_input(options.object.string(), "is not there", "expected the folder of a finished run, a mesh or a map");
  const bool is_run = fs::is_directory(options.object);
  if (is_run && !options.design.empty())
    throw bad_input("--design", "goes with a mesh or a height map; a run is its own design");
  if (!is_run && options.design.empty())
    throw bad_input(options.object.string(), "does not say what it shall cast", {},
                    "name a run of which it was made, or a preset: --design out/shapes");
  const fs::path run = is_run ? options.object : options.design;
  const bool has_design = fs::is_directory(run);
  const fs::path preset = has_design ? file_of_run(run, "preset.json") : run;
  Scene now = scene_of(preset, options.overrides);
  Scene designed;
  if (has_design) {
    designed = scene_of(preset, {});
    designed.solid = read_finished(designed.design->layout, file_of_run(run, "object.ply"));
  }
  if (is_run) {
    now.solid = designed.solid;
    move_top(now.solid, now.design->layout.thickness);
  } else
    now.solid = read_finished(now.design->layout, options.object);
  Judging judging(options);
  Verdict v;
  v.layout = now.layout();
  v.targets = now.design->targets;
  v.now = judging.cast(v.layout, v.targets, now.solid, "judged");
  if (has_design && (!is_run || !options.overrides.empty()) && designed.design->targets.size() == v.targets.size())
    v.designed = judging.cast(designed.layout(), designed.design->targets, designed.solid, "designed");
  v.part = v.layout.far ? 0 : options.focus / 100;
  if (v.part > 0) {
    v.focus = through_focus(v.layout, v.part, focus_steps);
    v.through = judging.cast(v.focus, through_focus(v.targets, focus_steps), now.solid, "through focus");
  }
  for (std::size_t j = 0; has_design && !is_run && j < v.targets.size(); ++j)
    v.deviations.push_back(deviation(v.layout, designed.solid, now.solid, j));
  if (options.json)
    fmt::print("{}\n", json_text(to_json(v)));
  else
    print(v);
  if (!options.folder.empty()) write_files(options, v);
}

} // namespace

void add_judge(CLI::App& program, Session&) {
  const auto options = std::make_shared<JudgeOptions>();
  Verb verb(program, "judge", "What a finished object of the engine 'inverse' casts: other light, screens or making",
            {{"nephroid run inverse/shapes -o out/shapes", ""},
             {"nephroid judge out/shapes --set inverse.index=1.51 -o out/judge", "of another glass, and as files"},
             {"nephroid judge out/shapes/heights.exr --design out/shapes", "a scan beside its design"}},
            "OBJECT: the folder of a finished run, or what was made of it: a closed mesh (.stl, .ply, .obj), or a "
            "map of its thickness (.exr, .tif),\n"
            "in the frame of the run's own object.stl and heights.exr.\n"
            "Files: judge.png and judge.json; receiver_1.png; surface_1.png, what part of each place of a scan sends "
            "light more than a cell off;\n"
            "focus.csv and focus/, screens nearer and farther as frames, and a film where ffmpeg is installed.");
  verb.option("OBJECT", options->object, {.says = "What is judged", .required = true});
  verb.option("-o,--output", options->folder, {.type = "DIR", .says = "Also write files into this folder"});
  verb.option("--design", options->design,
              {.type = "RUN", .says = "Of a mesh or a map: the run of which it was made, or a preset"});
  verb.overrides(options->overrides, "Change what it is seen in: inverse.receivers.0.distance_mm=210; may be repeated");
  verb.option("--focus", options->focus,
              {.type = "PERCENT",
               .says = "How much nearer and farther screens are looked at (default 10); 0: none",
               .from = 0,
               .to = 90});
  verb.device(options->device.selector, options->device.kernels);
  verb.flag("--json", options->json, "One JSON object instead of text");
  verb.work([options] { judge(*options); });
}

} // namespace nephroid::cli
