// SPDX-License-Identifier: Apache-2.0
#include "photons/maps/photon_map.h"

#include "photons/maps/eye_paths.h"
#include "photons/pixel_surfaces.h"
#include "tracing/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace nephroid::photons {
namespace {

/// The number of work items of a scan in kernels/photons/grid.cl.
constexpr unsigned scan_blocks = 256;

/// There is at least one bucket a photon, so that few cells share one.
std::uint32_t bucket_mask(std::uint32_t slots) { return std::bit_ceil(std::max(slots, 1024u)) - 1; }

/// Kernels read eight photons at a time, up to seven beyond the last, where eight stand that match no search.
std::uint32_t stride(std::uint32_t slots) { return (slots + 15) / 8 * 8; }

/// The fraction of the pixels that show glass or a mirror first, estimated from some four thousand of them.
double bent_share(const scene::Scene& scene, const scene::Bvh& bvh) {
  if (!scene.camera.inside.empty()) return 1;
  const int width = scene.camera.width, height = scene.camera.height,
            step = std::max(1, static_cast<int>(std::sqrt(width * 1.0 * height) / 64));
  int bent = 0, rays = 0;
  for (int row = step / 2; row < height; row += step)
    for (int column = step / 2; column < width; column += step, ++rays) {
      const int object = surfaces_of_pixel(scene, bvh, scene.camera, column, row, 1).first.object;
      bent += object >= 0 && is_specular(material_of(scene, scene.objects[static_cast<std::size_t>(object)]).type);
    }
  return static_cast<double>(bent) / rays;
}

/// The width of a pixel at the distance of the scene's middle.
double pixel_width(const scene::Camera& camera, const scene::Sphere& bounds) {
  const double distance =
      camera.orthographic ? 1 : std::max<double>(glm::length(camera.position - bounds.centre), 0.25 * bounds.radius);
  return 2 * distance * camera.tan_y / camera.height;
}

/// The plan's warning about a spectral.sppm.radius that loses the caustics, or an empty string. Such a radius is wider
/// than 32 pixels or than the whole scene, or below 1/16 pixel, where a pass with as many photons as pixels finds one
/// in some hundred pixels. It also warns of an alpha that shrinks the radius so far at a pixel's first photons.
std::string map_radius_note(const Settings& settings, const scene::Scene& scene) {
  const double radius = first_map_radius(settings, scene), alpha = settings.sppm.alpha,
               shrunk = radius * std::sqrt(alpha);
  const scene::Sphere bounds = tracing::scene_bounds(scene);
  const double pixel = pixel_width(scene.camera, bounds), least = pixel / 16;
  if (settings.estimator == Settings::Estimator::sppm && radius >= least && shrunk < least)
    return fmt::format("spectral.sppm.alpha: {:.3g} shrinks a radius from {:.3g} to {:.3g} pixels at its first "
                       "photons, and hardly another one "
                       "lies so near: caustics grow darker from pass to pass; choose 0.667 or so",
                       alpha, radius / pixel, shrunk / pixel);
  if (!settings.sppm.radius) return "";
  const auto note = [&](const char* consequence) {
    return fmt::format(
        "spectral.sppm.radius: {} units are {:.3g} pixels: {}; choose about {:.3g}, two pixels, or leave it out",
        radius, radius / pixel, consequence, 2 * pixel);
  };
  if (radius > 32 * pixel || (radius > bounds.radius && radius > 2 * pixel))
    return note("caustics are blurred away, and gathering is slow");
  return radius < least ? note("hardly a photon lies so near, and caustics are black but for rare bright dots") : "";
}

} // namespace

double photon_scale(std::uint32_t photons, double watts) {
  return tracing::power_of_two_below(std::exp2(12) * photons / watts);
}

PhotonMap::PhotonMap(const mpi::RankContext& context, std::uint32_t slots, const compute::Defines& defines)
    : context_(context), stored_(context, "photons", slots),
      starts_(context, "photon grid", bucket_mask(slots) + GRID_BLOCK + 1),
      block_sums_(context, "photon grid blocks", scan_blocks),
      positions_(context, "sorted photon positions", 3 * std::size_t{stride(slots)}),
      values_(context, "sorted photons", 4 * std::size_t{stride(slots)}) {
  grid_.bucket_mask = bucket_mask(slots);
  grid_.stride = stride(slots);
  stored_.fill_zero();
  // What is read beyond the last photon does not count, but it has to be numbers.
  positions_.fill_zero();
  values_.fill_zero();
  compute::Defines grid_defines = defines;
  grid_defines["NEPHROID_SCAN_BLOCKS"] = std::to_string(scan_blocks);
  const compute::Program program(context, "photons/grid.cl", grid_defines);
  count_ = program.kernel("count_photons");
  sum_ = program.kernel("sum_blocks");
  scan_ = program.kernel("scan_blocks");
  scatter_ = program.kernel("scatter_photons");
}

std::uint64_t PhotonMap::bytes(std::uint32_t slots) {
  return std::uint64_t{slots} * sizeof(shared::StoredPhoton) +
         (std::uint64_t{bucket_mask(slots)} + GRID_BLOCK + 1 + scan_blocks) * 4 + std::uint64_t{stride(slots)} * 7 * 4;
}

void PhotonMap::build(double cell_edge, std::uint32_t slots) {
  grid_.inverse_cell = static_cast<float>(1 / cell_edge);
  if (!context_.communicator().is_alone()) stored_.write(context_.all_reduced_or(stored_));
  starts_.fill_zero();
  count_.run(std::max(slots, 1u), 64, {{"stored", stored_}, {"counts", starts_}, {"grid", grid_}, {"slots", slots}});
  sum_.run(scan_blocks, 16, {{"counts", starts_}, {"sums", block_sums_}, {"grid", grid_}});
  scan_.run(scan_blocks, 16, {{"counts", starts_}, {"sums", block_sums_}, {"grid", grid_}});
  scatter_.run(std::max(slots, 8u), 64,
               {{"stored", stored_},
                {"ends", starts_},
                {"positions", positions_},
                {"values", values_},
                {"grid", grid_},
                {"slots", slots}});
}

unsigned eye_paths_a_pass(const scene::Scene& scene, const scene::Bvh& bvh, unsigned photons_per_pass) {
  constexpr double most = 64, share_of_work = 1.0 / 3; // a path takes about twice as long as a photon
  if (!tracing::may_see_glass_or_mirror(scene)) return 1;
  const double pixels = static_cast<double>(scene.camera.pixels()) * bent_share(scene, bvh);
  return static_cast<unsigned>(std::clamp(share_of_work * photons_per_pass / std::max(pixels, 1.0), 1.0, most));
}

PlanPart plan_gathering(const PlanInput& input, plan::Decision pass, std::uint32_t photons) {
  PlanPart part{.decisions = {std::move(pass)}};
  if (!part.decisions[0].runs) return part;
  const std::size_t objects = input.scene.objects.size(), clusters = input.tables.wavelengths.clusters.size();
  if (2 * clusters * objects > MAX_PHOTON_GROUPS)
    throw bad_input(Location(input.scene.source) / "scene" / "objects",
                    fmt::format("{} objects in {} wavelength clusters", objects, clusters),
                    fmt::format("photon maps tell {} surfaces in clusters apart", int{MAX_PHOTON_GROUPS}),
                    input.preset.settings.engine() == "spectral"
                        ? "choose spectral.estimator splat, or a larger threshold_deg"
                        : "choose fewer objects, or environment.refine false");
  const std::uint64_t stored = photons * sizeof(shared::StoredPhoton);
  part.buffers = {{"photons on surfaces", stored},
                  {"photon grid", PhotonMap::bytes(photons) - stored},
                  {"visible points", EyePaths::bytes(input.tables.camera)}};
  if (const std::string note = map_radius_note(input.settings, input.scene); !note.empty()) part.notes = {note};
  return part;
}

double first_map_radius(const Settings& settings, const scene::Scene& scene) {
  return settings.sppm.radius ? *settings.sppm.radius : 2 * pixel_width(scene.camera, tracing::scene_bounds(scene));
}

std::string map_radius(const Settings& settings, const scene::Scene& scene) {
  return fmt::format("from {:.3g} units around a visible point", first_map_radius(settings, scene));
}

double map_radius_factor(std::int64_t pass, double alpha) {
  // The product of (k + alpha) / (k + 1) over k = 1 .. p is Gamma(p + 1 + alpha) / Gamma(1 + alpha) / Gamma(p + 2).
  const auto p = static_cast<double>(pass);
  return std::exp(0.5 * (std::lgamma(p + 1 + alpha) - std::lgamma(1 + alpha) - std::lgamma(p + 2)));
}

} // namespace nephroid::photons
