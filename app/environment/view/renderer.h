// SPDX-License-Identifier: Apache-2.0
// Pictures of a scene with a baked object under an environment: a coarse one at once, then pass after pass of one
// sample a pixel (kernels/environment/see.cl, shade.cl, volume.cl). A change keeps what it does not affect.
#pragma once
#include "environment/light/caustics.h"
#include "environment/occlusion/occlusion.h"
#include "environment/view/receivers.h"
#include "environment/view/render_task.h"
#include "job/job.h"
#include "mpi/rank_context.h"
#include "tracing/archive.h"
#include "tracing/slices.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::environment {

class Renderer {
public:
  static int layers(const RenderTask& task) { return task.has_medium ? 4 : 3; }
  /// Memory of its buffers on the device for one pixel, and for the cubes of receivers.
  static std::uint64_t bytes_a_pixel(const RenderTask& task);
  static std::uint64_t receiver_bytes();
  /// Memory that a medium takes: the compiled spheres, and the cube of what hides them.
  static std::uint64_t medium_bytes(const Bake& bake);

  /// white: as preset::Preset has it. Throws failed where the device has not enough memory.
  Renderer(RenderTask task, double white, std::uint64_t seed, const mpi::RankContext& context);

  /// Begins anew with the caustics of the task's caster, which outlive the renderer. Before this call there are none.
  void set_caustics(Caustics& caustics);

  /// Builds the tree again where objects have moved: it pays for many passes, not for a coarse picture.
  void renew_tree();
  void advance();
  std::int64_t passes() const { return pass_; } ///< complete passes
  double fraction_done() const;                 ///< the part of the pass in hand, 0..1
  /// Means of all samples so far, linear sRGB over white, [pixel][3].
  struct Layer {
    const char* name = "";
    std::vector<float> rgb;
  };
  /// Places in layers(). smooth: direct without noise, with the shadows of a few lights. volume: only in a medium.
  enum : std::size_t { background, direct, caustic, smooth, volume };
  std::vector<Layer> layers() const;

  /// As the next three, begins anew with a coarse picture. where: FILE#/scene/camera.
  void set_camera(const scene::Camera& camera, const Location& where);
  void turn_environment(double rotate_deg);
  /// moved: the objects of the task's scene.
  void move_objects(MovedObjects moved);
  void set_segmentation(Segmentation segmentation);
  /// white: for the next picture.
  void set_white(double white) { white_ = white; }

  const Segmentation& segmentation() const { return task_.segmentation; }
  /// What is left of each of the segmentation's lights where the object is.
  const std::vector<VisibleLight>& visible() const { return visible_; }
  /// The loaded scene with its objects where they are now.
  const scene::Scene& scene() const { return *task_.scene; }
  const scene::Bvh& bvh() const { return *task_.bvh; }

  void serialize(tracing::Archive& archive);

private:
  enum class Stage { see, cast, compile_air, shade, volume };

  void make_kernels();
  void set_tree(scene::Bvh bvh);
  void make_occlusion();
  void make_surroundings();
  void find_around();
  void light_up(); ///< called after a change of lights
  void end_pass();
  void begin_anew();
  shared::DeviceBlocks blocks(int block, std::uint32_t first, std::uint32_t count) const {
    return {world_.seed, static_cast<std::uint32_t>(pass_), block, first, count};
  }
  void see(Receivers& receivers, int block, std::uint32_t first, std::uint32_t count);
  void shade(const Receivers& receivers, int block, std::uint32_t first, std::uint32_t count);
  void scatter(int block, std::uint32_t first, std::uint32_t count);
  void compile_air(int side);
  bool cast(Receivers& receivers); ///< as Receivers::cast
  bool scatters() const { return task_.has_medium && caustics_; }
  std::int64_t pixels() const { return std::int64_t{task_.tables.camera.width} * task_.tables.camera.height; }
  Partition own_pixels() const { return {context_.communicator(), pixels()}; }

  RenderTask task_;
  double white_, rotate_deg_;
  mpi::RankContext context_;
  tracing::World world_;
  bool is_refitted_ = false; ///< whether the tree was refitted since it was built
  std::optional<Surroundings> surroundings_;
  std::optional<Occlusion> occlusion_; ///< what hides the segmentation's lights
  compute::Kernel see_, shadows_, shade_, coarse_shade_, volume_;
  compute::Buffer<float> channel_cdf_;
  compute::Buffer<shared::float4> colours_;
  compute::Buffer<shared::float4> sky_lights_; ///< the segmentation's, as shade.cl has them
  compute::Buffer<float> texels_;
  shared::DeviceBackground texels_size_{};
  compute::Buffer<shared::DeviceEnd> ends_;
  compute::Buffer<float> sums_;        ///< [layer][pixel][3]
  compute::Buffer<float> volume_sums_; ///< [pixel][3]
  Caustics* caustics_ = nullptr;
  Receivers coarse_, fine_;
  std::optional<Receivers> around_; ///< known in all directions, for what hides the medium
  int air_side_ = 0;                ///< side of the maps compiled for the present lights; 0: none
  std::vector<VisibleLight> visible_;

  std::int64_t pass_ = 0;
  Stage stage_ = Stage::see;
  bool shaded_ = false; ///< whether all pixels are shaded in the pass in hand
  tracing::PixelSlices see_slices_, shade_slices_, volume_slices_;
};

} // namespace nephroid::environment
