// SPDX-License-Identifier: Apache-2.0
// The view of a run's scene: a renderer that goes from one preset to the next, and begins again only where it must.
#pragma once
#include "environment/view/renderer.h"
#include "mpi/rank_context.h"

#include <memory>
#include <optional>
#include <utility>

namespace nephroid::environment {

// The ways in which a preset may differ from another for a run to go on.

/// The preset with another's values that a renderer can adopt: camera, turn of the environment, segmentation, white.
preset::Preset with_view_of(const preset::Preset& preset, const preset::Preset& other);

/// The preset with objects turned and moved as in another preset.
preset::Preset with_places_of(const preset::Preset& preset, const preset::Preset& other);

/// The preset with weights of states as in another preset, which has as many objects.
preset::Preset with_weights_of(const preset::Preset& preset, const preset::Preset& other);

class SceneView {
public:
  /// task: the preset's.
  SceneView(const preset::Preset& preset, std::shared_ptr<const RenderTask> task, const mpi::RankContext& context)
      : shown_(preset), loaded_(preset), task_(std::move(task)), context_(context) {}

  bool has_medium() const { return task_->has_medium; }
  /// Null before begin() and after a show() that failed.
  Renderer* renderer() { return renderer_ ? &*renderer_ : nullptr; }
  const Renderer* renderer() const { return renderer_ ? &*renderer_ : nullptr; }
  /// caster: the preset's, as for show().
  void begin(const preset::Preset& preset, const Caster& caster);
  /// Drops the renderer and the caustics until begin().
  void end();

  /// Goes on with an adoptable preset. True: another picture begins. After anything but bad_input there is no renderer.
  /// Where states have other weights there are no caustics before the next set_bake().
  bool show(const preset::Preset& preset, const Caster& caster);
  const preset::Preset& shown() const { return shown_; }
  double backdrop_rotate_deg() const { return shown_.scene.environment ? shown_.scene.environment->rotate_deg : 0; }

  /// bake: complete; it outlives the view.
  void set_bake(const Bake& bake);
  bool has_caustics() const { return caustics_.has_value(); }
  /// The time that caustics took since the picture began.
  double caustics_seconds() const { return caustics_ ? caustics_->seconds() - caustics_seconds_before_ : 0; }

  void serialize(tracing::Archive& archive) { renderer_->serialize(archive); }
  void set_caustics_seconds(double seconds);

private:
  bool show_anew(const preset::Preset& preset, const Caster& caster);
  bool go_on_with(const preset::Preset& preset, const Caster& caster);
  void make_renderer(const preset::Preset& preset);

  preset::Preset shown_;  ///< the preset that the renderer shows
  preset::Preset loaded_; ///< the preset that task_ was made for
  std::shared_ptr<const RenderTask> task_;
  mpi::RankContext context_;
  std::optional<Caustics> caustics_;
  double caustics_seconds_before_ = 0; ///< Caustics::seconds() when the picture began
  std::optional<Renderer> renderer_;
};

} // namespace nephroid::environment
