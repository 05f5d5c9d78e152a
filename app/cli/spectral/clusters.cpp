// SPDX-License-Identifier: Apache-2.0
// `nephroid clusters`: the wavelength clusters of a preset's glass or of a dispersion file.
#include "photons/clusters/clusters.h"
#include "base/counted.h"
#include "base/json_output.h"
#include "cli/dispersion_input.h"
#include "cli/spectral/wavelength_runs.h"
#include "cli/verb.h"
#include "photons/describe_settings.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "spectral/engine.h"
#include "spectral/settings.h"

#include <nlohmann/json.hpp>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;

using photons::Clustering;
using photons::ClusterMethod;

struct ClusterOptions {
  std::string preset, ior, material, outside;
  std::optional<double> threshold_deg;
  std::optional<std::string> method;
  preset::Overrides overrides;
  bool json = false;
};

/// A curve, and how to cluster it unless the command line says otherwise.
struct Task {
  optics::DispersionCurve curve;
  optics::Extrapolation outside = optics::Extrapolation::automatic;
  double threshold_deg = photons::Settings{}.threshold_deg;
  ClusterMethod method = ClusterMethod::optimal;
};

/// The dielectric to cluster: `wanted`, or the only one that objects use.
std::string chosen_material(const preset::Preset& preset, const std::string& wanted) {
  std::set<std::string> dielectrics;
  for (const preset::Object& object : preset.scene.objects) {
    const auto found = preset.scene.materials.find(object.material);
    if (found != preset.scene.materials.end() && is_refractive(found->second.type)) dielectrics.insert(found->first);
  }
  const std::string names = fmt::format("{}", fmt::join(dielectrics, ", "));
  if (dielectrics.empty())
    throw bad_input(preset.source, "no object is made of a dielectric", "expected a material with dispersion");
  if (wanted.empty() && dielectrics.size() == 1) return *dielectrics.begin();
  if (wanted.empty())
    throw bad_input(preset.source, "objects are made of several dielectrics: " + names,
                    "expected one of them with --material");
  if (!dielectrics.contains(wanted))
    throw bad_input("--material", fmt::format("no object is made of a dielectric \"{}\"", wanted),
                    "expected one of " + names);
  return wanted;
}

Task preset_task(const ClusterOptions& options) {
  const preset::Preset preset = preset::read_preset(options.preset, options.overrides);
  preset::at_origins(preset, [&] { engine::require_engine(preset, spectral::engine, "clusters no wavelengths"); });
  const std::string name = chosen_material(preset, options.material);
  const preset::Dispersion& dispersion = preset.scene.materials.at(name).dispersion;
  const Location where = Location(preset.source) / "scene" / "materials" / name / "dispersion";
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  return {preset::at_origins(preset, [&] { return scatter::make_curve(dispersion, finder, where); }),
          scatter::outside_policy(dispersion.outside), spectral::settings(preset).threshold_deg,
          spectral::settings(preset).method};
}

Task make_task(const ClusterOptions& options) {
  if (options.preset.empty() == options.ior.empty())
    throw bad_input("clusters", options.ior.empty() ? "nothing to cluster" : "both a preset and --ior are given",
                    "expected a PRESET or --ior FILE");
  const bool is_dispersion = options.preset.ends_with(".yml") || scatter::shipped_materials().contains(options.preset);
  if (is_dispersion && !is_there(options.preset + ".json"))
    throw bad_input("clusters", fmt::format("'{}' is a dispersion file, not a preset", options.preset), {},
                    fmt::format("take it with --ior {}", options.preset));
  Task task = options.ior.empty() ? preset_task(options) : Task{.curve = scatter::load_dispersion(options.ior)};
  if (options.outside != "automatic") task.outside = outside_policy(options.outside);
  if (options.threshold_deg) task.threshold_deg = *options.threshold_deg;
  if (options.method) task.method = chosen_of<ClusterMethod>(*options.method);
  return task;
}

void print_json(const Clustering& clustering) {
  Json clusters = Json::array();
  for (const photons::Cluster& c : clustering.clusters)
    clusters.push_back(
        {{"wavelengths_nm", wavelengths_nm(c.wavelengths)}, {"n_mean", c.n_mean}, {"theta_deg2", c.theta_deg2}});
  const Json all{{"method", preset::word(clustering.method)},
                 {"threshold_deg", clustering.threshold_deg},
                 {"total_theta_deg2", clustering.total_theta_deg2},
                 {"count", clustering.clusters.size()},
                 {"clusters", std::move(clusters)}};
  fmt::print("{}\n", json_text(all));
}

void print_text(const std::string& name, const Clustering& clustering) {
  fmt::print("{}: {} by the method {} at a threshold of {} deg; the angle changes by {:.3f} square degrees in all\n",
             name, counted(clustering.clusters.size(), "cluster"), preset::word(clustering.method),
             clustering.threshold_deg, clustering.total_theta_deg2);
  fmt::print("{:>5} {:>10} {:>10}  {}\n", "count", "mean n", "deg^2", "wavelengths");
  for (const photons::Cluster& c : clustering.clusters)
    fmt::print("{:>5} {:>10.6f} {:>10.4f}  {}\n", c.wavelengths.size(), c.n_mean, c.theta_deg2,
               wavelength_runs(c.wavelengths));
}

void print_clusters(const ClusterOptions& options) {
  const Task task = make_task(options);
  const optics::Spectrum n = optics::sample_n(task.curve, task.outside);
  if (const std::string note = optics::outside_note(task.curve, task.outside); !note.empty())
    fmt::print(stderr, "nephroid: {}\n", note);
  const Clustering clustering = photons::cluster_wavelengths(n, task.threshold_deg, task.method);
  options.json ? print_json(clustering) : print_text(task.curve.name, clustering);
}

} // namespace

void add_clusters(CLI::App& program, Session&) {
  const auto options = std::make_shared<ClusterOptions>();
  Verb verb(program, "clusters", "Which wavelengths share one path through a glass",
            {{"nephroid clusters first-light", ""},
             {"nephroid clusters --ior N-SF66 --threshold 0.1", "of a glass, without a scene"}});
  verb.option("PRESET", options->preset, {.says = "A preset file or the name of a shipped preset"});
  verb.option(
      "--ior", options->ior,
      {.type = "FILE", .says = "A refractiveindex.info file or a shipped material (N-SF66) instead of a preset"});
  verb.option("--material", options->material,
              {.type = "NAME", .says = "Which dielectric of the preset, where it has several"});
  verb.option("--threshold", options->threshold_deg,
              {.type = "DEG",
               .says = "The largest change of the refraction angle inside a cluster, in degrees; default: the "
                       "preset's, else 0.05"});
  verb.option("--method", options->method,
              {.type = "METHOD",
               .says = "optimal, thesis (Algorithm 4.1) or brute_force; default: the preset's, else optimal",
               .words = words_of<ClusterMethod>()});
  verb.overrides(options->overrides, "Change a setting of the preset, as for run; may be repeated");
  add_outside_option(verb, options->outside);
  verb.flag("--json", options->json, "One JSON object instead of text");
  verb.work([options] { print_clusters(*options); });
}

} // namespace nephroid::cli
