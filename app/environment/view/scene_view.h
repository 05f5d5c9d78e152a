// SPDX-License-Identifier: Apache-2.0
// What a run shows of its scene: a renderer that goes from one preset to the next, and begins again only where it must.
#pragma once
#include "environment/view/renderer.h"
#include "mpi/rank_context.h"

#include <memory>
#include <optional>
#include <utility>

namespace nephroid::environment {

// How a preset may differ from another for a run to go on, in parts.

/// The preset with what a renderer takes on as it goes: camera, turn of the environment, segmentation and white of
/// another.
preset::Preset with_view_of(const preset::Preset& preset, const preset::Preset& other);

/// The preset with objects turned and moved as in another.
preset::Preset with_places_of(const preset::Preset& preset, const preset::Preset& other);

class SceneView {
public:
  /// task: of the preset, with this caster, which outlives it.
  SceneView(const preset::Preset& preset, std::shared_ptr<const RenderTask> task, const Caster& caster,
            const mpi::RankContext& context)
      : shown_(preset), loaded_(preset), task_(std::move(task)), caster_(caster), context_(context) {}

  bool has_medium() const { return task_->has_medium; }
  /// Null before begin() and after a show() that failed.
  Renderer* renderer() { return renderer_ ? &*renderer_ : nullptr; }
  const Renderer* renderer() const { return renderer_ ? &*renderer_ : nullptr; }
  void begin(const preset::Preset& preset);
  /// Until begin() nothing is shown, and there are no caustics.
  void end();

  /// Goes on with a preset that is adoptable. Whether another picture begins. Throws bad_input where all stays as it
  /// was; after any other exception there is no renderer.
  bool show(const preset::Preset& preset);
  const preset::Preset& shown() const { return shown_; }
  double backdrop_rotate_deg() const { return shown_.scene.environment ? shown_.scene.environment->rotate_deg : 0; }

  /// Caustics of a complete bake, which outlives it.
  void set_bake(const Bake& bake);
  bool has_caustics() const { return caustics_.has_value(); }
  /// That caustics took since the picture began.
  double caustics_seconds() const { return caustics_ ? caustics_->seconds() - caustics_seconds_before_ : 0; }

  void state(tracing::State& state) { renderer_->state(state); }
  void set_caustics_seconds(double seconds);

private:
  bool show_anew(const preset::Preset& preset);
  bool go_on_with(const preset::Preset& preset);
  void make_renderer(const preset::Preset& preset);

  preset::Preset shown_;  ///< by the renderer
  preset::Preset loaded_; ///< what task_ is of
  std::shared_ptr<const RenderTask> task_;
  const Caster& caster_;
  mpi::RankContext context_;
  std::optional<Caustics> caustics_;
  double caustics_seconds_before_ = 0; ///< of Caustics::seconds(), before the picture began
  std::optional<Renderer> renderer_;
};

} // namespace nephroid::environment
