// SPDX-License-Identifier: Apache-2.0
#include "environment/job.h"

#include "base/error.h"
#include "base/hashed_bytes.h"
#include "environment/bake/bake.h"
#include "environment/bake/baker.h"
#include "environment/engine.h"
#include "environment/photons.h"
#include "environment/sheet.h"
#include "environment/view/renderer.h"
#include "scene/camera_and_lights.h"
#include "scene/move.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::environment {
namespace {

using Clock = std::chrono::steady_clock;

class EnvironmentJob final : public job::Job {
public:
  EnvironmentJob(const preset::Preset& preset, const EnvironmentPlan& plan, const mpi::RankContext& context)
      : preset_(preset), shown_(preset), loaded_(preset), task_(plan.task), render_(plan.render), context_(context),
        file_(plan.bake_file), identity_{plan.key, hash_of(compute::kernel_source(context, "environment/bake.cl"))},
        width_(preset.scene.camera.resolution[0]), height_(preset.scene.camera.resolution[1]),
        sphere_white_(plan.render ? 0.2 : preset.white), stop_(preset.stop)
  {
    if (render_ && (stop_.passes || !stop_.seconds)) passes_ = stop_.passes.value_or(preset::default_passes);
    if (context.communicator().broadcast(!plan.bakes)) read();
    if (!bake_) baker_.emplace(*task_, context_, wanted_directions());
    if (refines() || bake_) begin_rendering(plan.photons);
  }

  void advance() override
  {
    const auto begin = Clock::now();
    if (renderer_) renderer_->renew_tree();
    const bool photons_next = wants_photons(), rests = !renderer_ || (!photons_next && renderer_->passes() >= most_passes());
    bakes_next_ = baker_ && (rests || !bakes_next_); // else by turns
    double& seconds = bakes_next_ ? bake_seconds_ : photons_next ? photon_seconds_ : render_seconds_;
    if (bakes_next_)
      bake();
    else if (photons_next)
      send_photons();
    else
      renderer_->advance();
    seconds += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  bool finished() const override
  {
    if (stop_.seconds && work_seconds() >= *stop_.seconds) return true;
    if (render_) return bake_ && renderer_ && passes() >= most_passes();
    return bake_ || (stop_.passes && directions_done() >= *stop_.passes);
  }
  bool estimates_error() const override { return refines() && !render_->has_medium; }

  job::Progress progress() const override
  {
    job::Progress p;
    p.work_seconds = work_seconds();
    const auto directions = static_cast<std::int64_t>(task_->directions.size());
    if (render_) {
      p.step = passes();
      p.steps = passes_;
      const double seen = renderer_ ? static_cast<double>(renderer_->passes()) + renderer_->fraction_done() : 0;
      p.work = photons_ ? photons_->progress().work : static_cast<std::uint64_t>(seen * width_ * height_);
      if (!refines()) p.units = {.step = "pass", .steps = "passes", .work = "path", .works = "paths"};
      const double sent = photons_ ? photon_passes() : seen;
      const auto part = [&](double passes) { return passes_ > 0 ? std::min(passes / static_cast<double>(passes_), 1.0) : 0; };
      const double rendered = std::min((part(seen) + part(sent)) / 2, 0.999); // maps of photons come last
      // A bake takes about as long as all passes.
      p.fraction = baker_ ? 0.5 * baked_part() : bake_seconds_ > 0 ? 0.5 + 0.5 * rendered : rendered;
    } else {
      p.steps = stop_.passes ? std::min<std::int64_t>(directions, *stop_.passes) : directions;
      p.step = directions_done();
      p.work = bake_ ? baked_photons_ : baker_->photons();
      p.units = {.step = "direction", .steps = "directions", .work = "photon", .works = "photons"};
      p.fraction = baked_part() * static_cast<double>(directions) / static_cast<double>(p.steps);
    }
    p.fraction = finished() ? 1 : std::min(1.0, std::max(p.fraction, stop_.seconds ? work_seconds() / *stop_.seconds : 0));
    return p;
  }

  job::Snapshot snapshot() override
  {
    const Bake& bake = bake_ ? *bake_ : baker_->bake();
    job::Snapshot snapshot;
    if (!renderer_ || renderer_->passes() > 0 || finished()) draw_spheres(bake); // not before the first picture, which it would hold up
    snapshot.picture = renderer_ ? picture() : sheet_;
    snapshot.stands_in = render_ && !renderer_;
    if (!renderer_)
      snapshot.caption = render_ ? "The object is baked first: its caustic spheres, as far as they are"
                                 : "There is no light: the object's caustic spheres, as far as they are baked";
    else if (baker_)
      snapshot.caption = bake_caption();
    snapshot.pictures = spheres_;
    if (renderer_ && sheet_) snapshot.pictures.insert(snapshot.pictures.begin(), {"spheres", sheet_});
    snapshot.progress = progress();
    snapshot.warnings = warnings_;
    snapshot.phases = {{"bake", bake_seconds_}};
    if (render_) snapshot.phases.emplace_back("render", render_seconds_);
    if (refines()) snapshot.phases.emplace_back("photons", photon_seconds_);
    if (caustics_) snapshot.phases.emplace_back("caustics", caustics_->seconds() - caustics_seconds_before_);
    snapshot.scalars = {{"bake", "from_file", from_file_ ? 1.0 : 0.0}};
    add_figures(bake, snapshot);
    if (renderer_) add_lights(snapshot);
    return snapshot;
  }

  void save(ByteSink& sink) override
  {
    tracing::State state(sink, context_.communicator());
    bool complete = bake_.has_value();
    state.value(bake_seconds_);
    state.value(render_seconds_);
    state.value(complete);
    if (baker_) baker_->state(state);
    if (renderer_) state_of_picture(state);
  }

  /// A bake that was complete is in its file, or is baked again.
  void load(ByteSource& source) override
  {
    tracing::State state(source, context_.communicator());
    double bake_seconds = 0, render_seconds = 0;
    bool complete = false;
    state.value(bake_seconds);
    state.value(render_seconds);
    state.value(complete);
    if (complete && !bake_) return read_to_end(source);
    if (!complete) {
      if (bake_) { // another run has finished it since
        caustics_.reset();
        bake_.reset();
        renderer_.reset();
        if (refines()) begin_rendering(std::nullopt);
      }
      if (!baker_) baker_.emplace(*task_, context_, wanted_directions());
      baker_->state(state);
    }
    if (renderer_) state_of_picture(state);
    bake_seconds_ = bake_seconds;
    render_seconds_ = render_seconds;
  }

  /// While the object is baked, the change waits until it is rendered. After one that failed there is no renderer to go on with.
  bool adopt(const preset::Preset& preset) override
  {
    if (!render_ || ((bake_ || refines()) && !renderer_) || !engine::adoptable(preset_, preset)) return false;
    const preset::Preset turned = with_view_of(preset_, preset);
    const bool relit = turned.scene.environment != preset.scene.environment || turned.scene.lights != preset.scene.lights;
    if (relit && !has_light(scene::load_scene(preset))) return false; // then the bake alone is shown
    try {
      const double caustics_seconds = caustics_ ? caustics_->seconds() : 0;
      if (renderer_ && go_on_with(preset)) { // another picture begins
        photons_.reset();
        asked_for_photons_ = false;
        passes_ahead_ = 0;
        bake_seconds_ = render_seconds_ = photon_seconds_ = 0;
        caustics_seconds_before_ = caustics_seconds;
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::bad_input) renderer_.reset(); // it is neither as it was nor as it shall be
      throw;
    } catch (...) {
      renderer_.reset();
      throw;
    }
    preset_ = preset;
    return true;
  }

private:
  double work_seconds() const { return bake_seconds_ + render_seconds_ + photon_seconds_; }

  /// Whether photons join the spheres.
  bool refines() const { return render_ && settings(preset_).refine; }
  std::int64_t most_passes() const { return passes_ >= 0 ? passes_ : preset::max_passes; }

  /// Of the whole picture.
  std::int64_t passes() const
  {
    if (!renderer_) return 0;
    return photons_ ? std::min(renderer_->passes(), photons_->progress().step) : renderer_->passes();
  }

  /// Of photons, with the part of the one in hand.
  double photon_passes() const { return static_cast<double>(photons_->batches()) / static_cast<double>(photons_->batches_per_pass()); }

  /// A quarter of a pass of photons comes before each of the first two passes of paths from the eye, for a first picture of both soon: then
  /// there are two halves of each. A whole one follows each later one.
  bool wants_photons() const
  {
    if (!refines() || (asked_for_photons_ && !photons_)) return false;
    if (!photons_) return true;
    const auto passes = static_cast<double>(renderer_->passes());
    return photons_->progress().step < most_passes() &&
           (renderer_->passes() >= most_passes() || photon_passes() < std::max((passes + 1) / 4, passes - 0.75) + passes_ahead_);
  }

  void send_photons()
  {
    if (photons_) return photons_->advance();
    scene::Scene scene = renderer_->scene();
    scene.camera = scene::make_camera(shown_.scene.camera, scene);
    if (scene.environment) scene.environment->rotate_deg = backdrop_rotate_deg();
    begin_photons(scene, plan_photons(shown_, scene, renderer_->bvh()));
  }

  void begin_photons(const scene::Scene& scene, const photons::RunPlan& plan)
  {
    photons_ = make_photons(shown_, scene, renderer_->bvh(), plan, context_);
    asked_for_photons_ = true;
  }

  double backdrop_rotate_deg() const { return shown_.scene.environment ? shown_.scene.environment->rotate_deg : 0; }

  /// What the renderer sees. With photons: caustics by these and by spheres together, and no layer with the noise of a single sample.
  std::shared_ptr<const job::Picture> picture()
  {
    std::vector<Renderer::Layer> seen = renderer_->layers();
    Renderer::Layer &direct = seen[Renderer::direct], &caustic = seen[Renderer::caustic];
    const Renderer::Layer smooth = std::move(seen[Renderer::smooth]);
    seen.erase(seen.begin() + Renderer::smooth);
    if (refines() && direct.draw.empty()) direct.rgb = smooth.rgb;
    if (photons_ && photons_->batches() >= 2) {
      photons_->smooth(direct.rgb, direct.draw, smooth.rgb);
      photons_->set_estimate(caustics_ ? std::move(caustic.rgb) : std::vector<float>());
      const std::shared_ptr<const job::Picture> sent = photons_->snapshot().picture;
      caustic = {"caustic", sent->layers.front().rgb, sent->error_draw};
    }
    auto picture = std::make_shared<job::Picture>();
    picture->width = width_;
    picture->height = height_;
    picture->rgb.resize(caustic.rgb.size());
    if (estimates_error() && std::ranges::none_of(seen, [](const Renderer::Layer& layer) { return layer.draw.empty(); }))
      picture->error_draw.resize(caustic.rgb.size());
    for (Renderer::Layer& layer : seen) {
      std::ranges::transform(picture->rgb, layer.rgb, picture->rgb.begin(), std::plus());
      if (!picture->error_draw.empty()) std::ranges::transform(picture->error_draw, layer.draw, picture->error_draw.begin(), std::plus());
      picture->layers.push_back({layer.name, std::move(layer.rgb)});
    }
    return picture;
  }

  void state_of_picture(tracing::State& state)
  {
    double caustics_seconds = caustics_ ? caustics_->seconds() - caustics_seconds_before_ : 0;
    bool has_photons = photons_ != nullptr;
    state.value(caustics_seconds);
    state.value(photon_seconds_);
    state.value(passes_ahead_);
    state.value(has_photons);
    renderer_->state(state);
    if (caustics_) caustics_seconds_before_ = caustics_->seconds() - caustics_seconds;
    asked_for_photons_ = has_photons && asked_for_photons_;
    if (!has_photons) photons_.reset();
    if (has_photons && !photons_) send_photons(); // which makes them
    if (has_photons) photons_->state(state);
  }

  /// Of a picture without spheres, which come.
  std::string bake_caption() const
  {
    const std::optional<double> left = baker_->seconds_left();
    return fmt::format("Photons alone: the caustic spheres of {} join when they are baked, {:.0f} % are{}", task_->caster.name,
                       100 * baked_part(), left ? fmt::format("; {:.0f} s left", std::ceil(*left)) : "");
  }

  /// 0..1
  double baked_part() const
  {
    return bake_ ? 1.0 : (static_cast<double>(directions_done()) + baker_->fraction_done()) / static_cast<double>(task_->directions.size());
  }

  void bake()
  {
    baker_->advance();
    if (!baker_->finished()) return;
    baked_photons_ = baker_->photons();
    bake_ = baker_->take();
    baker_.reset(); // its device memory is for others
    keep();
    passes_ahead_ = photons_ ? photon_passes() : 0;
    begin_rendering(std::nullopt);
  }

  /// What there is to show. photons: the plan of the preset's, where it is known.
  void begin_rendering(const std::optional<photons::RunPlan>& photons)
  {
    if (!render_) return;
    if (!renderer_) {
      renderer_.emplace(*render_, preset_.white, preset_.seed, context_);
      shown_ = loaded_;
      go_on_with(preset_);
      if (photons) begin_photons(renderer_->scene(), *photons);
    }
    if (!bake_) return;
    caustics_.emplace(*bake_, context_, settings(preset_).technique);
    renderer_->set_caustics(*caustics_);
  }

  bool render_anew(const preset::Preset& preset)
  {
    const scene::Scene scene = scene::load_scene(preset);
    render_ =
        std::make_shared<const RenderTask>(make_render_task(preset, scene, scene::build_bvh(scene.geometry), task_->caster, render_.get()));
    loaded_ = preset;
    renderer_.reset(); // its device memory is for the next
    renderer_.emplace(*render_, preset.white, preset.seed, context_);
    if (caustics_) renderer_->set_caustics(*caustics_);
    shown_ = preset;
    return true;
  }

  /// Lets the renderer go from `shown_` to a preset that is adoptable. Whether another picture begins.
  bool go_on_with(const preset::Preset& preset)
  {
    if (!(with_view_of(with_places_of(shown_, preset), preset) == preset)) return render_anew(preset);
    bool begins = false;
    if (!(with_places_of(shown_, preset) == shown_)) {
      std::optional<MovedObjects> moved = move_objects(*render_, loaded_, shown_, preset, task_->caster);
      if (!moved) return render_anew(preset);
      renderer_->move_objects(std::move(*moved));
      begins = true;
    } else if (!(preset.scene.camera == shown_.scene.camera)) {
      renderer_->set_camera(scene::make_camera(preset.scene.camera, renderer_->scene()), Place(preset.source) / "scene" / "camera");
      begins = true;
    }
    const auto same_segmentation = [](const Settings& a, const Settings& b) {
      return a.lights == b.lights && a.segmentation == b.segmentation && a.threshold == b.threshold;
    };
    if (render_->cube.size > 0 && !same_segmentation(settings(preset), settings(shown_))) {
      renderer_->set_segmentation(segment_by(preset, render_->cube));
      begins = true;
    }
    if (preset.scene.environment && preset.scene.environment->rotate_deg != shown_.scene.environment->rotate_deg) {
      renderer_->turn_environment(preset.scene.environment->rotate_deg);
      begins = true;
    }
    renderer_->set_white(preset.white);
    if (photons_) photons_->set_white(preset.white);
    shown_ = preset;
    return begins;
  }

  /// Where there is no light the bake is all, and the preset's passes are directions.
  std::size_t wanted_directions() const
  {
    return !render_ && stop_.passes ? static_cast<std::size_t>(*stop_.passes) : task_->directions.size();
  }
  std::int64_t directions_done() const { return static_cast<std::int64_t>((bake_ ? *bake_ : baker_->bake()).baked.size()); }

  /// Ranks have rank 0's.
  void read()
  {
    const Communicator& communicator = context_.communicator();
    try {
      if (communicator.is_root()) bake_ = read_bake(file_, identity_);
    } catch (const Error& error) {
      warnings_.push_back(error.line() + "; it is baked again");
    }
    from_file_ = communicator.broadcast(bake_.has_value());
    if (!from_file_ || communicator.is_alone()) return;
    if (!bake_) bake_ = task_->empty_bake();
    bake_->baked = communicator.broadcast(std::move(bake_->baked));
    bake_->light = communicator.broadcast(std::move(bake_->light));
    bake_->ways = communicator.broadcast(std::move(bake_->ways));
  }

  void keep()
  {
    if (!context_.communicator().is_root()) return;
    try {
      write_bake(file_, identity_, *bake_);
    } catch (const Error& error) {
      warnings_.push_back(error.line() + "; the bake is not kept, and the next start bakes again");
    }
  }

  /// Makes what shows the directions that were baked since it was last made.
  void draw_spheres(const Bake& bake)
  {
    const Shown shown = choose_shown(bake, width_, height_);
    const auto baked = static_cast<std::size_t>(
        std::ranges::count_if(shown.directions, [&](std::size_t direction) { return direction < bake.baked.size(); }));
    if (sheet_ && baked == spheres_.size()) return;
    if (baked < spheres_.size()) spheres_.clear(); // an earlier state was loaded
    sheet_ = sheet(bake, shown, width_, height_, sphere_white_);
    for (std::size_t i = spheres_.size(); i < baked; ++i)
      spheres_.push_back({fmt::format("direction_{:03}", shown.directions[i] + 1),
                          spheres_picture(bake, shown.directions[i], shown.spheres, sphere_white_)});
  }

  /// As the panel Environment has them.
  void add_lights(job::Snapshot& snapshot) const
  {
    snapshot.curves.push_back({"lights", {"light", "azimuth_deg", "elevation_deg", "red", "green", "blue", "visible"}, {}});
    const double rotate_deg = backdrop_rotate_deg();
    const std::vector<Region>& lights = renderer_->segmentation().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const glm::dvec3 from = turned(lights[i].direction, rotate_deg), all = lights[i].flux, left = renderer_->visible()[i].flux;
      const double sum = all.x + all.y + all.z;
      snapshot.curves.back().rows.push_back({static_cast<double>(i + 1), glm::degrees(std::atan2(from.x, -from.z)),
                                             glm::degrees(std::asin(from.y)), all.x, all.y, all.z,
                                             sum > 0 ? (left.x + left.y + left.z) / sum : 1});
    }
    snapshot.scalars.push_back({"lights", "count", static_cast<double>(lights.size())});
  }

  preset::Preset preset_; ///< the newest
  preset::Preset shown_;  ///< what the renderer shows
  preset::Preset loaded_; ///< what render_ is of
  std::shared_ptr<const BakeTask> task_;
  std::shared_ptr<const RenderTask> render_; ///< null: only the bake is shown
  mpi::RankContext context_;
  std::filesystem::path file_;
  BakeIdentity identity_;
  int width_, height_;
  double sphere_white_; ///< of the pictures of spheres
  preset::Stop stop_;
  std::int64_t passes_ = -1;   ///< of the renderer; -1: until the time is over
  std::optional<Baker> baker_; ///< while it bakes
  std::optional<Bake> bake_;   ///< when that is done
  std::optional<Caustics> caustics_;
  double caustics_seconds_before_ = 0; ///< of Caustics::seconds(), what was before the newest preset
  std::optional<Renderer> renderer_;
  bool from_file_ = false;
  bool bakes_next_ = false;
  std::unique_ptr<photons::PhotonJob> photons_; ///< null: there are none, or not yet
  bool asked_for_photons_ = false;        ///< whether it is known which
  double passes_ahead_ = 0;               ///< of photons when the bake was done
  std::uint64_t baked_photons_ = 0;       ///< that the finished bake took here
  double bake_seconds_ = 0, render_seconds_ = 0, photon_seconds_ = 0;
  std::shared_ptr<const job::Picture> sheet_; ///< of the directions in spheres_
  std::vector<job::NamedPicture> spheres_;    ///< of each direction that is shown and baked
  std::vector<std::string> warnings_;
};

} // namespace

std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const EnvironmentPlan& plan, const mpi::RankContext& context)
{
  return std::make_unique<EnvironmentJob>(preset, plan, context);
}

} // namespace nephroid::environment
