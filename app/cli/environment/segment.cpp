// SPDX-License-Identifier: Apache-2.0
// `nephroid segment`: the directional lights that an environment is cut into.
#include "base/counted.h"
#include "base/files.h"
#include "base/json_output.h"
#include "cli/verb.h"
#include "environment/segment/irradiance.h"
#include "environment/segment/picture.h"
#include "image/image.h"
#include "preset/origins.h"
#include "preset/read.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::cli {
namespace {

namespace fs = std::filesystem;
using environment::Region;
using environment::Segmentation;
using environment::SegmentMethod;
using environment::SegmentWeights;
using Json = nlohmann::ordered_json;

constexpr int most_lights = 65536; ///< more lights than any renderer can use

struct SegmentOptions {
  std::string environment, picture;
  std::string method = "variance", weights = "solid-angle";
  int lights = 0;
  bool json = false;
};

/// A preset ends in ".json" or is a shipped preset's name, which has no ending.
bool is_preset(const std::string& name) {
  const fs::path path(name);
  std::error_code ignored;
  return path.extension() == ".json" || (!path.has_extension() && !fs::is_regular_file(path, ignored));
}

scene::Environment preset_environment(const std::string& name, std::vector<std::string>& warnings) {
  const preset::Preset preset = preset::read_preset(name);
  const Location where = Location(preset.source, "/scene/environment");
  return preset::at_origins(preset, [&] {
    if (!preset.scene.environment)
      throw bad_input(where, "the preset has no environment", "expected a picture or a colour there",
                      "or give a picture in place of the preset");
    return scene::make_environment(*preset.scene.environment, FileFinder(fs::path(preset.source).parent_path()), where,
                                   warnings);
  });
}

scene::Environment file_environment(const std::string& file, std::vector<std::string>& warnings) {
  if (!is_there(file)) throw bad_input(file, "no such file", "expected a picture (EXR, HDR, PNG, ...) or a preset");
  preset::Environment picture;
  picture.file = fs::absolute(file).string();
  try {
    return scene::make_environment(picture, FileFinder(), file, warnings);
  } catch (const Error& error) { // names the picture as the user typed it
    throw error.at(file);
  }
}

Json three(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

struct Result {
  Segmentation segmentation;
  double rotate_deg = 0, irradiance_error = 0;
};

void print_json(const SegmentOptions& options, const Result& result) {
  const Segmentation& segmentation = result.segmentation;
  Json regions = Json::array();
  for (const Region& region : segmentation.lights)
    regions.push_back({{"face", environment::face_names.at(static_cast<std::size_t>(region.face))},
                       {"rect", {region.rect.x0, region.rect.y0, region.rect.x1, region.rect.y1}},
                       {"direction", three(environment::turned(region.direction, result.rotate_deg))},
                       {"flux", three(region.flux)},
                       {"solid_angle_sr", region.solid_angle_sr}});
  const Json all{{"method", options.method},
                 {"weights", options.weights},
                 {"cube_size", segmentation.cube_size},
                 {"rotate_deg", result.rotate_deg},
                 {"total_flux", three(segmentation.total_flux)},
                 {"irradiance_error", result.irradiance_error},
                 {"regions", std::move(regions)}};
  fmt::print("{}\n", json_text(all));
}

void print_text(const SegmentOptions& options, const Result& result) {
  const Segmentation& segmentation = result.segmentation;
  const double all = glm::dot(segmentation.total_flux, glm::dvec3(1));
  fmt::print("{}: {} by the method {}, weights {}; faces of {} x {} texels; irradiance is wrong by {:.2f} % over all "
             "normals\n",
             options.environment, counted(segmentation.lights.size(), "light"), options.method, options.weights,
             segmentation.cube_size, segmentation.cube_size, 100 * result.irradiance_error);
  fmt::print("{:>4} {:>19}  {:>23}  {:>32}  {:>8} {:>8}\n", "face", "x, y of texels", "direction",
             "flux (red, green, blue)", "of all", "sr");
  for (const Region& region : segmentation.lights) {
    const glm::dvec3 d = environment::turned(region.direction, result.rotate_deg);
    fmt::print("{:>4} {:>4}-{:<4} {:>4}-{:<4}  {:>7.4f} {:>7.4f} {:>7.4f}  {:>10.4g} {:>10.4g} {:>10.4g}  {:>6.2f} % "
               "{:>8.5f}\n",
               environment::face_names.at(static_cast<std::size_t>(region.face)), region.rect.x0, region.rect.x1,
               region.rect.y0, region.rect.y1, d.x, d.y, d.z, region.flux.x, region.flux.y, region.flux.z,
               100 * glm::dot(region.flux, glm::dvec3(1)) / all, region.solid_angle_sr);
  }
}

void print_segments(const SegmentOptions& options) {
  if (!options.picture.empty() && fs::path(options.picture).extension() != ".png")
    throw bad_input("-o", fmt::format("the picture is a PNG, not '{}'", options.picture), "expected FILE.png");
  std::vector<std::string> warnings;
  const scene::Environment map = is_preset(options.environment) ? preset_environment(options.environment, warnings)
                                                                : file_environment(options.environment, warnings);
  for (const std::string& warning : warnings) fmt::print(stderr, "nephroid: {}\n", warning);
  const environment::CubeMap cube = environment::make_cube_map(map);
  const environment::SegmentSettings settings{
      .lights = options.lights,
      .method = options.method == "thesis" ? SegmentMethod::thesis : SegmentMethod::variance,
      .weights = options.weights == "texel" ? SegmentWeights::texel : SegmentWeights::solid_angle};
  Result result{environment::segment(cube, settings), map.rotate_deg};
  result.irradiance_error = environment::irradiance_error(environment::irradiances(cube), result.segmentation);
  if (!options.picture.empty()) {
    const environment::SegmentPicture picture = environment::segment_picture(map, result.segmentation);
    image::write_png_bytes(options.picture, picture.width, picture.height, picture.rgba);
  }
  options.json ? print_json(options, result) : print_text(options, result);
}

} // namespace

void add_segment(CLI::App& program, Session&) {
  const auto options = std::make_shared<SegmentOptions>();
  Verb verb(
      program, "segment", "The directional lights that an environment is cut into",
      {{"nephroid segment spectral/three-lamps -q 24 -o lights.png", "24 lights, and where they are on the map"}});
  verb.option("ENVIRONMENT", options->environment,
              {.says = "A latitude-longitude picture (EXR, HDR, PNG, ...), or a preset with scene.environment",
               .required = true});
  verb.option("-q", options->lights,
              {.type = "N",
               .says = "How many lights, at least 6",
               .required = true,
               .from = environment::face_count,
               .to = most_lights});
  verb.option(
      "--method", options->method,
      {.type = "METHOD",
       .says = "variance (default): cut where most is left out; thesis (Algorithm 3.3): halves of equal radiance",
       .words = {"variance", "thesis"}});
  verb.option(
      "--weights", options->weights,
      {.type = "WEIGHTS",
       .says =
           "A texel of the cube counts as much as its solid angle (default) or as every other texel (as in the thesis)",
       .words = {"solid-angle", "texel"}});
  verb.option("-o,--output", options->picture,
              {.type = "FILE", .says = "Write a PNG of the map with the regions' borders and directions"});
  verb.flag("--json", options->json, "One JSON object instead of text");
  verb.work([options] { print_segments(*options); });
}

} // namespace nephroid::cli
