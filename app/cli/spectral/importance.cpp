// SPDX-License-Identifier: Apache-2.0
// `nephroid importance`: how much each wavelength matters in a preset's scene, and the iterations that its clusters get
// for it.
#include "photons/effort/importance.h"
#include "base/counted.h"
#include "base/json_output.h"
#include "cli/spectral/wavelength_runs.h"
#include "cli/verb.h"
#include "photons/capabilities.h"
#include "photons/clusters/scene_clusters.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "spectral/engine.h"
#include "spectral/settings.h"
#include "tracing/omissions.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;

using Method = photons::Settings::Effort;

struct ImportanceOptions {
  std::string preset, method;
  std::vector<std::string> overrides;
  bool json = false;
};

struct Row {
  std::vector<int> wavelengths; ///< indices
  double importance = 0;
  std::int64_t iterations = 0;
};

struct Answer {
  std::string name;
  Method method = Method::importance;
  std::int64_t passes = 0;
  photons::WavelengthImportance importance;
  std::vector<std::string> materials; ///< names of importance.surroundings
  std::vector<Row> rows;              ///< one row per cluster
};

/// The wavelengths of a cluster that are rendered.
std::vector<int> rendered(const std::vector<int>& cluster, const std::vector<bool>& lit) {
  std::vector<int> result;
  std::copy_if(cluster.begin(), cluster.end(), std::back_inserter(result),
               [&](int w) { return lit[static_cast<std::size_t>(w)]; });
  return result;
}

std::vector<Row> make_rows(const preset::Preset& preset, const scene::Scene& scene, const Answer& answer) {
  std::vector<bool> lit(optics::wavelength_count, true);
  const photons::Settings settings = photons::agree(spectral::settings(preset), scene).settings;
  if (preset.leave_out) lit = tracing::lit_wavelengths(scene);
  std::vector<Row> rows;
  for (const std::vector<int>& cluster : photons::scene_clusters(settings, scene)) {
    const std::vector<std::vector<int>> counted{rendered(cluster, lit)};
    const double importance =
        counted[0].empty() ? 0
                           : photons::cluster_importance(answer.importance.u, counted, settings.importance.cluster)[0];
    rows.push_back({cluster, importance, photons::iterations(importance, answer.passes)});
  }
  return rows;
}

Answer answer_for(preset::Preset preset, const std::string& method) {
  Method& effort = spectral::settings(preset).effort;
  if (method.empty() ? effort != Method::radziszewski : method == "thesis") effort = Method::importance;
  if (method == "radziszewski") effort = Method::radziszewski;
  const scene::Scene scene = scene::load_scene(preset);
  Answer answer{preset.name,
                effort,
                preset.stop.passes.value_or(preset::default_passes),
                photons::wavelength_importance(spectral::settings(preset), scene, scene::build_bvh(scene.geometry)),
                {},
                {}};
  for (const photons::Surrounding& s : answer.importance.surroundings)
    answer.materials.push_back(scene.materials[static_cast<std::size_t>(s.material)].name);
  answer.rows = make_rows(preset, scene, answer);
  return answer;
}

std::string word(Method method) { return method == Method::importance ? "thesis" : "radziszewski"; }

void print_json(const Answer& answer) {
  std::vector<int> all;
  for (int w = 0; w < optics::wavelength_count; ++w) all.push_back(w);
  Json iterations = Json::array(), surroundings = Json::array();
  for (const Row& row : answer.rows)
    iterations.push_back({{"wavelengths_nm", wavelengths_nm(row.wavelengths)},
                          {"importance", row.importance},
                          {"iterations", row.iterations}});
  for (std::size_t i = 0; i < answer.materials.size(); ++i) {
    const photons::Surrounding& s = answer.importance.surroundings[i];
    surroundings.push_back({{"material", answer.materials[i]}, {"share", s.share}, {"lightness", s.lightness}});
  }
  const Json object{{"name", answer.name},
                    {"method", word(answer.method)},
                    {"passes", answer.passes},
                    {"wavelengths_nm", wavelengths_nm(all)},
                    {"importance", answer.importance.u},
                    {"iterations", std::move(iterations)},
                    {"surroundings", std::move(surroundings)}};
  fmt::print("{}\n", json_text(object));
}

double ratio(std::int64_t a, std::int64_t b) {
  return static_cast<double>(a) / static_cast<double>(std::max<std::int64_t>(b, 1));
}

void print_text(const Answer& answer) {
  fmt::print("{}: importance by {}\n", answer.name,
             answer.method == Method::importance ? "light, luminosity and surroundings (4.15)"
                                                 : "1 / cosh^2(0.0072 (lambda - 538))");
  if (!answer.materials.empty()) fmt::print("{:>7} {:>6}  {}\n", "share", "L*", "surrounding material");
  for (std::size_t i = 0; i < answer.materials.size(); ++i) {
    const photons::Surrounding& s = answer.importance.surroundings[i];
    fmt::print("{:>7.4f} {:>6.1f}  {}\n", s.share, s.lightness, answer.materials[i]);
  }
  fmt::print("{:>5} {:>10} {:>10}  {}\n", "count", "importance", "iterations", "wavelengths");
  std::int64_t sum = 0;
  for (const Row& row : answer.rows) {
    sum += row.iterations;
    fmt::print("{:>5} {:>10.3g} {:>10}  {}\n", row.wavelengths.size(), row.importance, row.iterations,
               wavelength_runs(row.wavelengths));
  }
  const auto clusters = static_cast<std::int64_t>(answer.rows.size());
  const std::int64_t equal = clusters * answer.passes, brute_force = optics::wavelength_count * answer.passes;
  fmt::print("{} for {}; {} alike: {}, {:.1f} times as many; {} wavelengths one by one: {}, {:.1f} times\n",
             counted(sum, "iteration"), counted(answer.passes, "pass", "passes"), counted(clusters, "cluster"), equal,
             ratio(equal, sum), optics::wavelength_count, brute_force, ratio(brute_force, sum));
}

void print_importance(const ImportanceOptions& options) {
  std::vector<Answer> answers; // all before the first is printed: one run of a sweep may be refused
  for (const preset::Preset& preset : preset::read_presets(options.preset, options.overrides))
    answers.push_back(preset::at_origins(preset, [&] {
      engine::require_engine(preset, spectral::engine, "weighs no wavelengths");
      return answer_for(preset, options.method);
    }));
  for (const Answer& answer : answers) options.json ? print_json(answer) : print_text(answer);
}

} // namespace

void add_importance(CLI::App& program, Session&) {
  const auto options = std::make_shared<ImportanceOptions>();
  Verb verb(program, "importance", "How much each wavelength matters, and the iterations its cluster gets",
            {{"nephroid importance spectral/prism", ""}});
  verb.option("PRESET", options->preset, {.says = "A preset file or the name of a shipped preset", .required = true});
  verb.overrides(options->overrides, "Change a setting: spectral.importance.geometry=false; may be repeated");
  verb.option("--method", options->method,
              {.type = "METHOD",
               .says = "thesis (4.15) or radziszewski; default: thesis, unless the preset's effort is radziszewski",
               .words = {"thesis", "radziszewski"}});
  verb.flag("--json", options->json, "One JSON object a run, a line each, instead of text");
  verb.work([options] { print_importance(*options); });
}

} // namespace nephroid::cli
