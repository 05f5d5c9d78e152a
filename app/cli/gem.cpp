// SPDX-License-Identifier: Apache-2.0
// `nephroid gem`: what a cutter asks of a stone: light return by tilt, windows, fire and scintillation.
#include "base/interrupts.h"
#include "base/json_output.h"
#include "base/numbers.h"
#include "cli/progress.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "formats/import/description.h"
#include "formats/import/import.h"
#include "gems/pictures.h"
#include "meters/intervals.h"
#include "preset/origins.h"
#include "preset/read.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;
using gems::GemLight;
using gems::Stone;
namespace fs = std::filesystem;

struct GemOptions {
  std::string file, object, material;
  fs::path folder;
  std::vector<std::string> overrides;
  gems::LightOptions light;
  compute::DeviceOptions device;
  bool json = false;
};

/// A mesh as the only object of a preset, its lengths in millimetres, of a material that takes the place of n = 1.
preset::Preset preset_of_mesh(const GemOptions& options) {
  if (options.material.empty())
    throw bad_input(options.file, "a mesh has no index of refraction", {},
                    "say what it is of: --material 1.54, or a dispersion file");
  preset::Preset preset;
  preset.source = options.file;
  preset.unit = preset::Preset::Unit::mm;
  preset::Material& glass = preset.scene.materials["stone"];
  glass.type = preset::Material::Type::dielectric;
  glass.dispersion.n = 1;
  preset::Object& stone = preset.scene.objects.emplace_back();
  stone.name = stone.material = "stone";
  stone.mesh = fs::absolute(options.file).string();
  return preset::with_overrides(preset, options.overrides);
}

preset::Preset read_stone_file(const GemOptions& options, const fs::path& temporary) {
  const fs::path file = options.file;
  const std::string ending = formats::ending_of(file);
  if (ending == ".obj" || ending == ".ply" || ending == ".stl") return preset_of_mesh(options);
  if (ending != ".asc" && ending != ".gltf" && ending != ".glb" && ending != ".xml" && ending != ".pbrt")
    return preset::read_preset(options.file, options.overrides);
  const formats::Imported imported = formats::import_scene(file, temporary / "stone.json");
  for (const std::string& note : imported.notes) fmt::print(stderr, "note: {}\n", note);
  return preset::read_preset(imported.preset.string(), options.overrides);
}

/// A file that stands in the current folder, or a name that the preset finds; or an index of refraction.
preset::Dispersion dispersion_of(const std::string& material) {
  preset::Dispersion dispersion;
  if (const auto n = typed_number<double>(material)) {
    if (!(*n >= 1 && *n <= 10))
      throw bad_input("--material", fmt::format("an index of {}", material), "expected 1 to 10");
    dispersion.n = *n;
    return dispersion;
  }
  dispersion.type = preset::Dispersion::Type::file;
  dispersion.file = fs::exists(material) ? fs::absolute(material).string() : material;
  return dispersion;
}

std::string percent(const meters::Interval& share) {
  return fmt::format("{:.2f} +- {:.2f}", 100 * share.value, 100 * share.half());
}

std::string tiers_text(const std::vector<gems::Tier>& tiers) {
  std::string text;
  for (const gems::Tier& tier : tiers)
    text += fmt::format("{}{:.4g} x {}", text.empty() ? "" : ", ", tier.angle_deg, tier.facets);
  return text;
}

void print_shape(const Stone& stone) {
  const gems::Shape& shape = stone.shape;
  fmt::print("{}: n {:.4f} at 588 nm, critical angle {:.2f} degrees{}\n", stone.name, stone.n_d, stone.critical_deg(),
             stone.disperses() ? fmt::format(", n_F - n_C {:.5f}", stone.n_f - stone.n_c) : "");
  fmt::print("  {:.4g} x {:.4g} mm, {:.4g} mm high ({:.1f} % of the width), {:.4g} mm^3, {} facets\n", shape.width_mm,
             shape.depth_mm, shape.height_mm, 100 * shape.height_mm / shape.width_mm, shape.volume_mm3, shape.facets);
  if (shape.table_share) fmt::print("  table {:.1f} % of the width\n", 100 * *shape.table_share);
  for (const auto& [name, tiers] :
       {std::pair("crown", &shape.crown), std::pair("girdle", &shape.girdle), std::pair("pavilion", &shape.pavilion)})
    if (!tiers->empty()) fmt::print("  {:<9} {}\n", name, tiers_text(*tiers));
}

void print_returns(const GemLight& light) {
  const auto cells = [](const gems::Returns& r) {
    return fmt::format("{:>15} {:>15} {:>15}", percent(r.iso), percent(r.cosine), percent(r.head));
  };
  fmt::print("  light return, % {:>13} {:>15} {:>15}\n  face up        {}\n", "ISO", "COS", "HEAD",
             cells(light.returns));
  const std::size_t half = light.tilts.size() / 2;
  for (std::size_t i = 0; i < half; ++i)
    fmt::print("  {:+3.0f} degrees: x {}, z {}\n", light.tilts[i].angle_deg, cells(light.tilts[i].returns),
               cells(light.tilts[half + i].returns));
}

void print_light(const GemLight& light, double head_deg) {
  print_returns(light);
  fmt::print("  windows {} % of the outline, dark under a head of {:g} degrees {} %\n", percent(light.window), head_deg,
             percent(light.dark));
  fmt::print("  light from below the horizon {} %\n", percent(light.below));
  if (light.fire_deg)
    fmt::print("  fire {:.4f} +- {:.4f} degrees between C and F\n", light.fire_deg->value, light.fire_deg->half());
  else
    fmt::print("  fire: none, the index is the same at every wavelength; --material names one that disperses\n");
  fmt::print("  scintillation {} % a degree\n", percent(light.scintillation));
  if (light.lost > 1e-5)
    fmt::print("  up to {:.2g} % of the light goes round for ever and is not in these numbers\n", 100 * light.lost);
}

Json to_json(const gems::Returns& returns) {
  return {{"iso", json_of(returns.iso)}, {"cos", json_of(returns.cosine)}, {"head", json_of(returns.head)}};
}

Json to_json(const std::vector<gems::Tier>& tiers) {
  Json list = Json::array();
  for (const gems::Tier& tier : tiers) list.push_back({{"angle_deg", tier.angle_deg}, {"facets", tier.facets}});
  return list;
}

Json to_json(const GemOptions& options, const Stone& stone, const GemLight& light) {
  const gems::Shape& shape = stone.shape;
  Json tilts = Json::array();
  for (const gems::Tilt& tilt : light.tilts) {
    tilts.push_back({{"axis", std::string(1, tilt.axis)}, {"angle_deg", tilt.angle_deg}});
    tilts.back().update(to_json(tilt.returns));
  }
  return {{"stone", stone.name},
          {"material", stone.material},
          {"n", {{"d", stone.n_d}, {"C", stone.n_c}, {"F", stone.n_f}}},
          {"critical_angle_deg", stone.critical_deg()},
          {"size_mm", {shape.width_mm, shape.depth_mm, shape.height_mm}},
          {"volume_mm3", shape.volume_mm3},
          {"facets", shape.facets},
          {"table_share", shape.table_share ? Json(*shape.table_share) : Json()},
          {"crown", to_json(shape.crown)},
          {"girdle", to_json(shape.girdle)},
          {"pavilion", to_json(shape.pavilion)},
          {"confidence", 0.95},
          {"head_deg", options.light.head_deg},
          {"rays", options.light.rays},
          {"seed", options.light.seed},
          {"face_up", to_json(light.returns)},
          {"tilts", tilts},
          {"outline_mm2", light.area_mm2},
          {"window_share", json_of(light.window)},
          {"dark_share", json_of(light.dark)},
          {"below_share", json_of(light.below)},
          {"fire_deg", light.fire_deg ? json_of(*light.fire_deg) : Json()},
          {"scintillation_per_deg", json_of(light.scintillation)},
          {"lost_share", light.lost}};
}

void report_gem(const GemOptions& options) {
  const Interrupts interrupts; // before OpenCL starts its threads
  const formats::TemporaryFolder temporary;
  preset::Preset preset = read_stone_file(options, temporary.path());
  preset::at_origins(preset, [&] {
    if (!options.material.empty())
      for (auto& [name, material] : preset.scene.materials)
        if (preset::is_body(material)) material.dispersion = dispersion_of(options.material);
    const Stone stone = gems::load_stone(preset, options.object);
    for (const std::string& warning : stone.scene.warnings) fmt::print(stderr, "note: {}\n", warning);
    const compute::Context context = device_opener(options.device)();
    LiveLine line;
    const bool shows = progress_style(options.json) == ProgressStyle::live;
    const GemLight light = gems::measure_light(stone, options.light, context, [&](double part) {
      if (interrupts.token().stop_requested())
        throw Error(ErrorKind::interrupted, options.file, "interrupted before there was anything to tell");
      if (shows) line.show(fmt::format("{:.0f} %", 100 * part));
    });
    line.clear();
    const Json report = to_json(options, stone, light);
    if (options.json)
      fmt::print("{}\n", json_text(report));
    else {
      print_shape(stone);
      print_light(light, options.light.head_deg);
    }
    if (options.folder.empty()) return;
    std::error_code error;
    fs::create_directories(options.folder, error);
    if (error) throw failed(options.folder, error.message(), "expected a folder that can be made");
    write_file_whole(options.folder / "report.json", report.dump(2) + "\n");
    gems::write_pictures(options.folder, light.pictures, stone.disperses());
  });
}

} // namespace

void add_gem(CLI::App& program, Session&) {
  const auto options = std::make_shared<GemOptions>();
  Verb verb(program, "gem", "The light return, windows, fire and scintillation of a cut stone, with 95 % intervals",
            {{"nephroid gem spectral/thesis/diamond-arbitrary-1", "a table"},
             {"nephroid gem spectral/thesis/diamond-arbitrary-1 --material materials/diamond-Peter.yml -o out/gem",
              "of diamond, and as files"}},
            "FILE: a stone of GemCad (.asc), a mesh in millimetres with its table up, along +y (.obj, .ply, .stl), a "
            "preset or another scene that `nephroid import` takes. Its lights do not count.\n"
            "Files: report.json; iso.png, cos.png, head.png, colour.png and fire.png, the stone from above.");
  verb.option("FILE", options->file, {.says = "The stone", .required = true});
  verb.option("-o,--output", options->folder, {.type = "DIR", .says = "Also write files into this folder"});
  verb.overrides(options->overrides);
  verb.option("--object", options->object,
              {.type = "NAME", .says = "The stone, where there are several objects of glass"});
  verb.option("--material", options->material,
              {.type = "MATERIAL",
               .says = "Of what it is, instead of the file's: an index of refraction, or a file of "
                       "refractiveindex.info (materials/diamond-Peter.yml is shipped)"});
  verb.option("--head", options->light.head_deg,
              {.type = "DEG", .says = "Half angle of the head's shadow (default 20)", .from = 0, .to = 90});
  verb.option("--rays", options->light.rays,
              {.type = "N", .says = "Rays from the eye, of each tilt (default 100000)", .from = 32768, .to = 1e8});
  verb.option("--seed", options->light.seed, {.type = "N", .says = "Of the random numbers (default 1)", .from = 0});
  verb.device(options->device.selector, options->device.kernels);
  verb.flag("--json", options->json, "One JSON object instead of text");
  verb.work([options] { report_gem(*options); });
}

} // namespace nephroid::cli
