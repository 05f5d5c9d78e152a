// SPDX-License-Identifier: Apache-2.0
// `nephroid compare`: every metric of a picture against a reference, and a picture of the difference.
#include "base/files.h"
#include "base/json_output.h"
#include "cli/verb.h"
#include "image/image.h"
#include "measure/difference.h"
#include "measure/read_picture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace nephroid::cli {
namespace {

using Json = nlohmann::ordered_json;
using measure::LinearPicture;
using measure::Metrics;

struct CompareOptions {
  std::string image, reference, mask, layer, difference;
  std::string metric = "lab";
  std::optional<double> scale;
  bool json = false;
};

Json to_json(const Metrics& metrics) {
  Json object;
  for (const auto& [name, value] : measure::named(metrics))
    object[name] = std::isfinite(value) ? Json(value) : Json(nullptr);
  object["pixels"] = metrics.pixels;
  return object;
}

/// of: the metrics of all pixels, then, if there is a mask, those of its pixels.
void print_json(const std::vector<Metrics>& of) {
  Json object = to_json(of.front());
  if (of.size() > 1) object["masked"] = to_json(of.back());
  fmt::print("{}\n", json_text(object));
}

void print_text(const std::vector<Metrics>& of) {
  const auto cell = [](double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string("-"); };
  const auto line = [&](std::string_view name, const std::string& all, const std::string& masked,
                        std::string_view meaning) {
    fmt::print("{:<9} {:>11}{}  {}\n", name, all, of.size() > 1 ? fmt::format(" {:>11}", masked) : "", meaning);
  };
  if (of.size() > 1) fmt::print("{:>21} {:>11}\n", "all", "mask");
  for (const measure::Metric& metric : measure::all_metrics())
    line(metric.name, cell(metric.of(of.front())), cell(metric.of(of.back())), metric.meaning);
  line("pixels", fmt::format("{}", of.front().pixels), fmt::format("{}", of.back().pixels), "that were compared");
}

const char* layout(const LinearPicture& picture) {
  return picture.grey ? "is grey (channel Y)" : "has colours (channels R, G, B)";
}

void refuse_other_channels(const LinearPicture& image, const LinearPicture& reference) {
  if (image.grey == reference.grey) return;
  throw bad_input(image.name, fmt::format("{}, but {} {}", layout(image), reference.name, layout(reference)),
                  "expected pictures with the same channels");
}

/// People may name a run's folder, which has several pictures.
void refuse_folder(const std::string& name) {
  const std::filesystem::path picture = std::filesystem::path(name) / "image.exr";
  std::error_code ignored;
  if (std::filesystem::is_directory(name, ignored))
    throw bad_input(name, "is a folder", "expected a picture",
                    is_there(picture) ? fmt::format("did you mean '{}'?", picture.string()) : std::string());
}

void check_difference_options(const CompareOptions& options) {
  if (options.scale && !(std::isfinite(*options.scale) && *options.scale > 0))
    throw bad_input("--scale", fmt::format("the colours cannot end at {}", *options.scale),
                    "expected a number above 0");
  if (options.difference.empty()) return;
  if (std::filesystem::path(options.difference).extension() != ".png")
    throw bad_input("-o", fmt::format("a difference picture is a PNG, not '{}'", options.difference),
                    "expected FILE.png");
}

void write_difference(const CompareOptions& options, const LinearPicture& image, const LinearPicture& reference) {
  const auto* const name =
      std::find(measure::difference_names.begin(), measure::difference_names.end(), options.metric);
  const auto metric = static_cast<measure::DifferenceMetric>(name - measure::difference_names.begin());
  const measure::ColouredDifference picture =
      measure::coloured_difference(image.pixels(), reference.pixels(), metric, options.scale.value_or(0));
  image::write_png_bytes(options.difference, picture.width, picture.height, picture.rgba);
  fmt::print(stderr, "nephroid: {}: {}, colours end at {:g}\n", options.difference, options.metric, picture.scale);
}

void print_comparison(const CompareOptions& options) {
  check_difference_options(options);
  for (const std::string* name : {&options.image, &options.reference}) refuse_folder(*name);
  const auto read = [&](const std::string& file) {
    return options.layer.empty() ? measure::read_linear_rgb(file) : measure::read_linear_layer(file, options.layer);
  };
  const LinearPicture image = read(options.image), reference = read(options.reference);
  refuse_other_channels(image, reference);
  std::vector<unsigned char> mask;
  if (!options.mask.empty()) mask = measure::read_mask(options.mask, reference.width, reference.height);
  std::vector<measure::Mask> masks(1);
  if (!mask.empty()) masks.emplace_back(mask);
  const std::vector<Metrics> metrics = measure::compare_each(image.pixels(), reference.pixels(), masks);
  if (!options.difference.empty()) write_difference(options, image, reference);
  options.json ? print_json(metrics) : print_text(metrics);
}

} // namespace

void add_compare(CLI::App& program, Session&) {
  const auto options = std::make_shared<CompareOptions>();
  Verb verb(program, "compare", "How far a picture is from a reference, by every metric",
            {{"nephroid run first-light --seed 1 --passes 4 -o out/quick", ""},
             {"nephroid run first-light --seed 2 --passes 8 -o out/better", ""},
             {"nephroid compare out/quick/image.exr out/better/image.exr -o difference.png", ""}});
  verb.option("IMAGE", options->image,
              {.says = "A picture: EXR, HDR, PFM (linear), PNG, JPEG, TIFF (sRGB-encoded)", .required = true});
  verb.option("REFERENCE", options->reference,
              {.says = "The picture that is right, of the same size", .required = true});
  verb.option("--mask", options->mask,
              {.type = "FILE", .says = "A picture of the same size: also compare where it is not black alone"});
  verb.option("--layer", options->layer,
              {.type = "NAME", .says = "Compare this layer of both, of image.exr of two runs: caustic, direct, ..."});
  verb.option("-o,--output", options->difference,
              {.type = "FILE", .says = "Write a PNG of the difference, with its colour scale"});
  verb.option("--metric", options->metric,
              {.type = "METRIC",
               .says = "What -o shows: lab (default), absolute, relative, square, luminance or flip",
               .words = {measure::difference_names.begin(), measure::difference_names.end()},
               .needs = "-o"});
  verb.option("--scale", options->scale,
              {.type = "X",
               .says = "Where the colours of -o end; default: a round number that 99 % of the pixels keep to",
               .needs = "-o"});
  verb.flag("--json", options->json, "One JSON object instead of text");
  verb.work([options] { print_comparison(*options); });
}

} // namespace nephroid::cli
