// SPDX-License-Identifier: Apache-2.0
// A cached reference is an EXR file named by the hash of all that it depends on. Beside the mean of its two seeds it
// holds the first of the two as further channels: their distance is the noise floor, also of a mask that is given
// later.
#include "run/reference.h"

#include "base/build_info.h"
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "engine/engine.h"
#include "image/image.h"
#include "measure/error_estimate.h"
#include "measure/read_picture.h"
#include "preset/read.h"
#include "preset/settings_type.h"
#include "run/content.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

constexpr const char* first_seed = "first_seed"; ///< the further channels' layer

Location place(const Prepared& prepared, const char* field) {
  return Location(prepared.preset.source) / "reference" / field;
}

/// The preset of one seed of the recipe.
preset::Preset recipe_preset(const preset::Preset& preset, std::uint64_t seed) {
  const preset::Reference& recipe = *preset.reference;
  preset::Preset rendered = preset;
  rendered.seed = seed;
  rendered.reference.reset();
  rendered.measure = {};
  rendered.measure.estimate = false;
  rendered.stop = {};
  rendered.stop.passes = recipe.passes;
  rendered.settings = engine::engine_of(preset).reference(preset, recipe.passes);
  return rendered;
}

fs::path cache_file(const Prepared& prepared, const compute::Context& context) {
  const preset::Preset recipe = recipe_preset(prepared.preset, prepared.preset.reference->seed);
  std::uint64_t hash = content_hash(recipe, prepared.plan->inputs);
  hash = hash_of(fmt::format("{} passes {}", version(), recipe.stop.passes.value()), hash);
  for (const std::string_view folder : {prepared.preset.settings.engine(), std::string_view("photons")})
    hash = hash_of(compute::kernel_sources(context, folder), hash);
  const fs::path folder = cache_folder("references");
  if (folder.empty())
    throw failed("reference", "there is no folder to keep it in: HOME is not set", "",
                 "set XDG_CACHE_HOME to a folder that can be written to");
  return folder / fmt::format("{:016x}.exr", hash);
}

/// What a mean of two seeds is off by: half of their difference is a draw of its error, as halves of a film are. The
/// perceptual metrics have no estimate: there it is the distance of one seed from the mean.
measure::Metrics noise_floor(const measure::Reference& mean, const std::vector<float>& first, measure::Mask mask,
                             bool perceptual) {
  job::Picture picture;
  picture.width = mean.width;
  picture.height = mean.height;
  picture.rgb = mean.rgb;
  for (std::size_t i = 0; i < first.size(); ++i) picture.error_draw.push_back(first[i] - mean.rgb[i]);
  measure::Metrics floor = measure::estimate_error(picture, mask);
  if (!perceptual) return floor;
  const measure::Metrics distance =
      compare({mean.width, mean.height, first, mean.origin + " (its first seed)"}, mean.pixels(), mask);
  floor.iw_ssim = distance.iw_ssim;
  floor.flip = distance.flip;
  floor.hdr_flip = distance.hdr_flip;
  return floor;
}

std::shared_ptr<const measure::Reference> read_reference(const fs::path& file, const Prepared& prepared) {
  std::vector<job::Layer> layers;
  const measure::LinearPicture picture = measure::read_linear_rgb(file, layers);
  measure::Reference reference{picture.width, picture.height, picture.rgb, file.string(), {}, {}, {}};
  const auto [width, height] = prepared.preset.scene.camera.resolution;
  if (reference.width != width || reference.height != height)
    throw bad_input(
        file.string(), fmt::format("the reference has {} x {} pixels", reference.width, reference.height),
        fmt::format("expected {} x {}, as scene.camera.resolution of {} says", width, height, prepared.preset.source));
  // A run's picture has its seed: the same random numbers make the same noise, and comparing would call it right.
  const auto seed = picture.attributes.find("nephroid:seed");
  if (seed != picture.attributes.end() && seed->second == std::to_string(prepared.preset.seed))
    throw bad_input(file.string(), fmt::format("the reference was rendered with seed {}, as this run is", seed->second),
                    "expected another seed", "run with another --seed");
  if (const auto& mask = prepared.preset.measure.mask) {
    const FileFinder finder(fs::path(prepared.preset.source).parent_path());
    reference.mask =
        measure::read_mask(finder.find(*mask, Location(prepared.preset.source) / "measure" / "mask"), width, height);
  }
  const auto is_first_seed = [](const job::Layer& layer) { return layer.name == first_seed; };
  if (const auto found = std::ranges::find_if(layers, is_first_seed); found != layers.end()) {
    const std::vector<float> first = std::move(found->rgb);
    layers.erase(found);
    for (std::size_t i = 0; i < first.size(); ++i) reference.error_draw.push_back(first[i] - reference.rgb[i]);
    reference.noise_floor = noise_floor(reference, first, {}, prepared.preset.measure.perceptual);
    if (!reference.mask.empty())
      reference.masked_noise_floor = noise_floor(reference, first, reference.mask, prepared.preset.measure.perceptual);
  }
  reference.layers = std::move(layers);
  return std::make_shared<const measure::Reference>(std::move(reference));
}

/// After half a second the rate is known well enough to refuse.
void require_time(const Prepared& prepared, const job::Progress& now) {
  const auto& limit = prepared.preset.reference->seconds;
  const double expected = now.fraction > 0 ? 2 * now.work_seconds / now.fraction : 0;
  if (!limit || now.work_seconds < 0.5 || expected <= *limit) return;
  throw failed(place(prepared, "seconds"), fmt::format("making the reference would take about {:.0f} s", expected),
               fmt::format("{} s are allowed", *limit), "allow more, lower reference.passes, or name a file");
}

/// Renders one of the recipe's two seeds. seconds: of the seeds before this one; this one's are added.
std::vector<float> rendered_seed(const Prepared& prepared, const compute::Context& context, std::uint64_t seed,
                                 double& seconds, const std::stop_token& stop, const ReferenceProgress& report) {
  const Prepared recipe = prepare(recipe_preset(prepared.preset, seed), &prepared);
  if (const std::string changed = changed_input(prepared.plan->inputs, recipe.plan->inputs); !changed.empty())
    throw failed(Location(prepared.preset.source) / "reference", "cannot be rendered: " + changed, "", "start again");
  const job::Snapshot last = render_picture(recipe, context, [&](const job::Progress& now) {
    if (stop.stop_requested())
      throw Error(ErrorKind::interrupted, prepared.preset.source,
                  "interrupted while the reference was rendered; nothing of it is kept");
    if (seconds == 0) require_time(prepared, now);
    report((seconds > 0 ? 0.5 : 0) + 0.5 * now.fraction, seconds + now.work_seconds);
    return true;
  });
  seconds += last.progress.work_seconds;
  return last.picture->rgb;
}

void write_reference(const fs::path& file, const Prepared& prepared, const std::vector<float>& first,
                     const std::vector<float>& second) {
  const auto [width, height] = prepared.preset.scene.camera.resolution;
  image::Image image;
  image.width = width;
  image.height = height;
  image.channels = {"R", "G", "B"};
  for (const char* channel : {".R", ".G", ".B"}) image.channels.push_back(first_seed + std::string(channel));
  for (std::size_t i = 0; i < first.size(); i += 3) {
    for (std::size_t c = i; c < i + 3; ++c) image.data.push_back(0.5f * first[c] + 0.5f * second[c]);
    for (std::size_t c = i; c < i + 3; ++c) image.data.push_back(first[c]);
  }
  const preset::Preset recipe = recipe_preset(prepared.preset, prepared.preset.reference->seed);
  image.attributes = {{"nephroid:preset", preset::to_json(recipe, file.parent_path())},
                      {"nephroid:version", version()}};
  image::write_exr(file, image);
}

} // namespace

std::shared_ptr<const measure::Reference> find_reference(const Prepared& prepared, const compute::Context& context) {
  if (!prepared.preset.reference) {
    if (prepared.preset.measure.mask)
      throw bad_input(Location(prepared.preset.source) / "measure" / "mask",
                      "there is no reference to compare the mask's pixels with", "expected a 'reference'");
    return nullptr;
  }
  const preset::Reference& reference = *prepared.preset.reference;
  if (reference.type == preset::Reference::Type::file) {
    const FileFinder finder(fs::path(prepared.preset.source).parent_path());
    return read_reference(finder.find(reference.file, place(prepared, "file")), prepared);
  }
  const fs::path file = cache_file(prepared, context);
  if (!is_there(file)) return nullptr;
  try {
    image::read_image(file);
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(file, ignored); // a damaged file of the cache is as good as none
    return nullptr;
  }
  return read_reference(file, prepared);
}

std::shared_ptr<const measure::Reference> make_reference(const Prepared& prepared, const compute::Context& context,
                                                         const std::stop_token& stop,
                                                         const ReferenceProgress& progress) {
  const fs::path file = cache_file(prepared, context);
  std::error_code error;
  fs::create_directories(file.parent_path(), error); // before hours of work
  if (error)
    throw failed(file.parent_path(), "the reference cannot be kept here: " + error.message(), "",
                 "set XDG_CACHE_HOME to another folder");
  std::vector<float> pictures[2];
  double seconds = 0;
  for (std::size_t i = 0; i < 2; ++i)
    pictures[i] = rendered_seed(prepared, context, prepared.preset.reference->seed + i, seconds, stop, progress);
  write_reference(file, prepared, pictures[0], pictures[1]);
  return read_reference(file, prepared);
}

} // namespace nephroid::run
