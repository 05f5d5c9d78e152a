// SPDX-License-Identifier: Apache-2.0
#include "environment/view/renderer.h"

#include "base/parallel.h"
#include "environment/colours.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace nephroid::environment {
namespace {

constexpr int block_of_coarse = 4;                          ///< pixels across and down a block that has one path
constexpr int coarse_receivers = 128, fine_receivers = 512; ///< texels along an edge of a face
constexpr std::array<const char*, 4> layer_names{"background", "direct", "caustic", "smooth"};

std::size_t ends_of_pixel(const RenderTask& task) { return task.coloured ? 4 : 2; } // ENDS_OF_PIXEL

/// The map side of spheres compiled for a medium, for the bake's: light added up along a path is soft.
int fine_side(int side) { return std::max(side / 2, 8); }
int coarse_side(int side) { return std::max(side / 4, 8); }

/// What shade.cl has of surfaces: reflected_primaries, then lit_colours.
std::vector<shared::float4> colours_of(const tracing::WavelengthTables& tables) {
  std::vector<shared::float4> all = reflected_primaries(tables);
  const std::vector<shared::float4> lit = lit_colours(tables);
  all.insert(all.end(), lit.begin(), lit.end());
  return all;
}

} // namespace

std::uint64_t Renderer::bytes_a_pixel(const RenderTask& task) {
  return ends_of_pixel(task) * sizeof(shared::DeviceEnd) +
         std::uint64_t{3} * sizeof(float) * (layer_names.size() + (task.has_medium ? 1 : 0));
}

std::uint64_t Renderer::receiver_bytes() {
  return Receivers::bytes(coarse_receivers) + Receivers::bytes(fine_receivers);
}

std::uint64_t Renderer::medium_bytes(const Bake& bake) {
  return Receivers::bytes(coarse_receivers) + Caustics::air_bytes(bake, fine_side(bake.map.side));
}

Renderer::Renderer(RenderTask task, double white, std::uint64_t seed, const mpi::RankContext& context)
    : task_(std::move(task)), white_(white), rotate_deg_(backdrop(*task_.scene).rotate_deg), context_(context),
      world_(tracing::make_world(context, *task_.scene, *task_.bvh, task_.tables, task_.defines, seed)),
      channel_cdf_(compute::Buffer(context, "wavelengths of channels", channel_cdf())),
      colours_(compute::Buffer(context, "colours of surfaces", colours_of(task_.tables.wavelengths))),
      texels_(compute::Buffer(context, "environment", backdrop(*task_.scene).rgb)),
      texels_size_(tracing::picture_size(backdrop(*task_.scene))),
      ends_(context, "ends of paths", ends_of_pixel(task_) * static_cast<std::size_t>(pixels())),
      sums_(context, "picture", 3 * layer_names.size() * static_cast<std::size_t>(pixels())),
      coarse_(context, coarse_receivers), fine_(context, fine_receivers), see_slices_(pixels(), 8192),
      shade_slices_(pixels(), 8192), volume_slices_(pixels(), 8192) {
  make_occlusion();
  make_kernels();
  if (task_.has_medium) {
    volume_sums_ = compute::zeroed<float>(context, "light in the air", 3 * static_cast<std::size_t>(pixels()));
    around_.emplace(context, coarse_receivers);
  }
  if (task_.has_surroundings) make_surroundings();
  find_around();
  light_up();
  begin_anew();
}

void Renderer::set_caustics(Caustics& caustics) {
  caustics_ = &caustics;
  light_up();
  begin_anew();
}

void Renderer::make_occlusion() {
  occlusion_.reset();
  if (!task_.segmentation.lights.empty()) occlusion_.emplace(context_, task_.segmentation, task_.cube);
}

void Renderer::make_kernels() {
  see_ = compute::Program(context_, "environment/see.cl", world_.defines).kernel("see");
  shadows_ = compute::Program(context_, "environment/shadows.cl", world_.defines).kernel("shadows");
  shade_ = compute::Program(context_, "environment/shade.cl", world_.defines).kernel("shade");
  compute::Defines coarse = world_.defines;
  coarse["NEPHROID_COARSE"] = std::to_string(1);
  coarse_shade_ = compute::Program(context_, "environment/shade.cl", coarse).kernel("shade");
  if (task_.has_medium) volume_ = compute::Program(context_, "environment/volume.cl", world_.defines).kernel("volume");
}

void Renderer::make_surroundings() {
  tracing::World world = surroundings_world(context_, task_.surroundings);
  const compute::Program program(context_, "environment/receivers.cl", world.defines);
  surroundings_ = Surroundings{std::move(world), program.kernel("receivers")};
}

void Renderer::find_around() {
  if (around_) around_->find_all(surroundings_, task_.placement.middle);
}

void Renderer::light_up() {
  world_.scene.sky_size.turns = texels_size_.turns = static_cast<float>(rotate_deg_ / 360);
  visible_ = occlusion_ && surroundings_
                 ? occlusion_->visible_lights(surroundings_->world, rotate_deg_, task_.viewpoints)
                 : whole_lights(task_.segmentation);
  if (task_.settings.occlusion == Settings::Occlusion::thesis)
    for (std::size_t i = 0; i < visible_.size(); ++i) visible_[i].direction = task_.segmentation.lights[i].direction;
  std::vector<shared::float4> sky_lights;
  for (const DistantLight& light : environment_lights(whole_lights(task_.segmentation), rotate_deg_))
    sky_lights.insert(sky_lights.end(), {tracing::to_float4(-light.direction), tracing::to_float4(light.irradiance)});
  sky_lights_ = compute::Buffer(context_, "lights of the environment", sky_lights);
  std::vector<DistantLight> lights = environment_lights(visible_, rotate_deg_);
  const std::vector<DistantLight> lamps =
      surroundings_ ? seen_lights(task_.lamps, surroundings_->world, task_.viewpoints) : task_.lamps;
  lights.insert(lights.end(), lamps.begin(), lamps.end());
  if (caustics_) caustics_->set_lights(lights, task_.placement.turn);
  air_side_ = 0;
  coarse_.forget(); // drops what other cameras have seen
  fine_.forget();
}

void Renderer::begin_anew() {
  pass_ = 0;
  stage_ = Stage::see;
  shaded_ = false;
  see_slices_ = shade_slices_ = volume_slices_ = tracing::PixelSlices(pixels(), 8192);
  const auto across = [](int n) { return (n + block_of_coarse - 1) / block_of_coarse; };
  const auto blocks =
      static_cast<std::uint32_t>(across(task_.tables.camera.width) * across(task_.tables.camera.height));
  see(coarse_, block_of_coarse, 0, blocks);
  coarse_.find_wanted(surroundings_, task_.placement.middle);
  while (!cast(coarse_)) {
  }
  shade(coarse_, block_of_coarse, 0, blocks);
  if (!scatters()) return;
  if (air_side_ == 0) compile_air(coarse_side(caustics_->side()));
  scatter(block_of_coarse, 0, blocks);
}

void Renderer::compile_air(int side) {
  caustics_->compile_air(side);
  air_side_ = side;
}

bool Renderer::cast(Receivers& receivers) {
  return receivers.cast([&](const CastTexels& texels) {
    if (task_.settings.cast && caustics_) caustics_->cast(texels); // otherwise they stay 0
    const shared::DeviceTexels slice{tracing::to_float4(task_.placement.middle), texels.first, texels.count,
                                     texels.size, static_cast<int>(sky_lights_.size() / 2)};
    world_.run(shadows_, texels.count, 32,
               {{"list", *texels.list},
                {"slice", slice},
                {"distances", *texels.distances},
                {"facing", *texels.normals},
                {"sky_lights", sky_lights_},
                {"parts_seen", receivers.parts_seen()}});
  });
}

void Renderer::advance() {
  switch (stage_) {
  case Stage::see:
    if (!see_slices_.advance(context_.communicator(),
                             [&](std::uint32_t first, std::uint32_t count) { see(fine_, 1, first, count); }))
      return;
    fine_.find_wanted(surroundings_, task_.placement.middle);
    stage_ = Stage::cast;
    return;
  case Stage::cast:
    if (cast(fine_)) stage_ = Stage::shade;
    return;
  case Stage::shade:
    if (!shade_slices_.advance(context_.communicator(),
                               [&](std::uint32_t first, std::uint32_t count) { shade(fine_, 1, first, count); }))
      return;
    shaded_ = true;
    if (scatters())
      stage_ = Stage::compile_air;
    else
      end_pass();
    return;
  case Stage::compile_air:
    if (const int side = fine_side(caustics_->side()); air_side_ != side) compile_air(side);
    stage_ = Stage::volume;
    return;
  case Stage::volume:
    if (volume_slices_.advance(context_.communicator(),
                               [&](std::uint32_t first, std::uint32_t count) { scatter(1, first, count); }))
      end_pass();
  }
}

void Renderer::end_pass() {
  stage_ = Stage::see;
  shaded_ = false;
  ++pass_;
}

double Renderer::fraction_done() const {
  const double done = (stage_ == Stage::see ? see_slices_.fraction_done() : 1) +
                      (shaded_ ? 1 : shade_slices_.fraction_done()) + volume_slices_.fraction_done();
  return done / (scatters() ? 3 : 2);
}

void Renderer::see(Receivers& receivers, int block, std::uint32_t first, std::uint32_t count) {
  world_.run(see_, count, 32,
             {{"channel_cdf", channel_cdf_},
              {"ends", ends_},
              {"states", receivers.states()},
              {"size", receivers.size()},
              {"middle", tracing::to_float4(task_.placement.middle)},
              {"camera", task_.tables.camera},
              {"blocks", blocks(block, first, count)}});
}

void Renderer::shade(const Receivers& receivers, int block, std::uint32_t first, std::uint32_t count) {
  shared::DeviceShading shading{};
  shading.middle = tracing::to_float4(task_.placement.middle);
  shading.background = texels_size_;
  shading.blocks = blocks(block, first, count);
  shading.size = receivers.size();
  shading.width = task_.tables.camera.width;
  shading.height = task_.tables.camera.height;
  shading.anew = pass_ == 0 ? 1 : 0;
  shading.radiance = static_cast<float>(backdrop(*task_.scene).radiance);
  shading.power_unit = static_cast<float>(task_.tables.power_unit);
  shading.sky_light_count = static_cast<int>(sky_lights_.size() / 2);
  world_.run(block == 1 ? shade_ : coarse_shade_, count, 32,
             {{"ends", ends_},
              {"texels", texels_},
              {"colours", colours_},
              {"sky_lights", sky_lights_},
              {"distances", receivers.distances()},
              {"caustics", receivers.caustics()},
              {"parts_seen", receivers.parts_seen()},
              {"sums", sums_},
              {"shading", shading}});
}

void Renderer::scatter(int block, std::uint32_t first, std::uint32_t count) {
  const Caustics::Air& air = caustics_->air();
  const Settings& s = task_.settings;
  shared::DeviceMedium medium{};
  medium.middle = tracing::to_float4(task_.placement.middle);
  medium.object = air.object;
  medium.spheres = air.spheres;
  medium.blocks = blocks(block, first, count);
  medium.extinction = static_cast<float>(s.extinction);
  medium.albedo = static_cast<float>(s.albedo);
  medium.anisotropy = static_cast<float>(s.anisotropy);
  medium.rayleigh = s.phase == Settings::Phase::rayleigh ? 1 : 0;
  medium.size = around_->size();
  medium.anew = pass_ == 0 ? 1 : 0;
  world_.run(volume_, count, 32,
             {{"air", air.light},
              {"radii", caustics_->radii()},
              {"distances", around_->distances()},
              {"sums", volume_sums_},
              {"camera", task_.tables.camera},
              {"medium", medium}});
}

std::vector<Renderer::Layer> Renderer::layers() const {
  const std::size_t values = 3 * static_cast<std::size_t>(pixels());
  const Communicator& communicator = context_.communicator();
  const auto layer = [&](const char* name, const compute::Buffer<float>& sums, std::size_t first, std::size_t ahead) {
    Layer result{name, std::vector<float>(values)};
    sums.RawBuffer::read(result.rgb.data(), values * sizeof(float), first * sizeof(float));
    own_pixels().clear_others(std::span(result.rgb), 3);
    communicator.all_reduce_or(std::as_writable_bytes(std::span(result.rgb)));
    for_ranges(values, 1 << 14, [&](std::size_t, const Range& range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        // The first `ahead` pixels have the pass in hand as well. The coarse picture is one sample.
        const auto samples = static_cast<double>(pass_ + (i < 3 * ahead || pass_ == 0 ? 1 : 0));
        result.rgb[i] = static_cast<float>(result.rgb[i] / (white_ * samples));
      }
    });
    return result;
  };
  const std::size_t shaded = shaded_ ? values / 3 : static_cast<std::size_t>(shade_slices_.done());
  std::vector<Layer> result;
  for (std::size_t l = 0; l < layer_names.size(); ++l)
    result.push_back(layer(layer_names[l], sums_, values * l, shaded));
  if (task_.has_medium)
    result.push_back(layer("volume", volume_sums_, 0, static_cast<std::size_t>(volume_slices_.done())));
  return result;
}

void Renderer::set_camera(const scene::Camera& camera, const Location& where) {
  task_.tables.camera = tracing::device_camera(camera, where);
  begin_anew();
}

void Renderer::move_objects(MovedObjects moved) {
  task_.scene = std::move(moved.scene);
  task_.placement = moved.placement;
  task_.viewpoints = std::move(moved.viewpoints);
  task_.tables.camera = moved.camera;
  scene::Bvh bvh = *task_.bvh;
  scene::refit(bvh, task_.scene->geometry);
  set_tree(std::move(bvh));
  is_refitted_ = true;
  if (moved.surroundings) {
    task_.surroundings = std::move(*moved.surroundings);
    make_surroundings();
  }
  if (around_) around_->forget();
  find_around();
  light_up();
  begin_anew();
}

void Renderer::set_tree(scene::Bvh bvh) {
  task_.bvh = std::make_shared<const scene::Bvh>(std::move(bvh));
  tracing::upload_surfaces(context_, *task_.scene, *task_.bvh, world_.buffers);
}

void Renderer::renew_tree() {
  if (!is_refitted_) return;
  set_tree(scene::build_bvh(task_.scene->geometry));

  world_.scene.root = task_.bvh->root;
  for (const auto& [name, value] : scene::tree_defines(*task_.bvh)) world_.defines[name] = value;
  make_kernels();
  is_refitted_ = false;
}

void Renderer::turn_environment(double rotate_deg) {
  rotate_deg_ = rotate_deg;
  light_up();
  begin_anew();
}

void Renderer::set_segmentation(Segmentation segmentation) {
  task_.segmentation = std::move(segmentation);
  make_occlusion();
  light_up();
  begin_anew();
}

void Renderer::serialize(tracing::Archive& archive) {
  archive.value(pass_);
  archive.value(shaded_);
  shade_slices_.serialize(archive);
  volume_slices_.serialize(archive);
  archive.owned(sums_, own_pixels(), 3);
  if (task_.has_medium) archive.owned(volume_sums_, own_pixels(), 3);
  if (!archive.is_read()) return;
  // The ends of the pass in hand are found again. Pixels that are already shaded are not shaded again.
  stage_ = shaded_ ? Stage::compile_air : Stage::see;
  see_slices_ = tracing::PixelSlices(pixels(), 8192);
}

} // namespace nephroid::environment
