// SPDX-License-Identifier: Apache-2.0
#include "environment/job.h"

#include "base/hashed_bytes.h"
#include "environment/bake/baker.h"
#include "environment/engine.h"
#include "environment/photons.h"
#include "environment/segment/cube.h"
#include "environment/sheet.h"
#include "environment/view/scene_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::environment {
namespace {

class EnvironmentJob final : public job::Job {
public:
  EnvironmentJob(const preset::Preset& preset, const EnvironmentPlan& plan, const mpi::RankContext& context)
      : context_(context), preset_(preset), width_(preset.scene.camera.resolution[0]),
        height_(preset.scene.camera.resolution[1]), sphere_white_(plan.render ? 0.2 : preset.white.value_or(1)),
        stop_(preset.stop),
        // Without light the job only bakes, and the preset's passes are directions.
        baking_(plan.task, plan.baked,
                !plan.render && stop_.passes ? static_cast<std::size_t>(*stop_.passes)
                                             : plan.baked.size() * plan.task->directions.size(),
                context),
        photons_(context) {
    if (!plan.render) return;
    if (stop_.passes || !stop_.seconds) passes_ = stop_.passes.value_or(preset::default_passes);
    view_.emplace(preset, plan.render, context);
    if (!refines() && !baking_.is_complete()) return;
    begin_view();
    if (plan.photons) photons_.begin(preset, renderer()->scene(), renderer()->bvh(), *plan.photons);
  }

  void begin_with(const job::Beginning& beginning) override { photons_.begin_with(beginning); }

  void advance() override {
    if (renderer()) renderer()->renew_tree();
    const bool photons_next = wants_photons(),
               rests = !renderer() || (!photons_next && renderer()->passes() >= most_eye_passes());
    bakes_next_ = !baking_.is_complete() && (rests || !bakes_next_); // else they take turns
    if (bakes_next_)
      bake_seconds_ += tracing::seconds_of([&] { bake(); });
    else if (photons_next)
      photon_seconds_ += tracing::seconds_of([&] { photons_.advance(*view_); });
    else
      render_seconds_ += tracing::seconds_of([&] { renderer()->advance(); });
  }

  bool finished() const override {
    if (stop_.seconds && work_seconds() >= *stop_.seconds) return true;
    if (view_) return baking_.is_complete() && renderer() && passes() >= most_passes();
    return baking_.is_complete() || (stop_.passes && baking_.directions() >= *stop_.passes);
  }
  bool estimates_error() const override { return refines() && !view_->has_medium(); }

  job::Progress progress() const override {
    job::Progress p;
    p.work_seconds = work_seconds();
    if (view_)
      add_view(p);
    else
      add_bake(p);
    p.fraction =
        finished() ? 1 : std::min(1.0, std::max(p.fraction, stop_.seconds ? work_seconds() / *stop_.seconds : 0));
    return p;
  }

  job::Snapshot snapshot() override {
    job::Snapshot snapshot;
    if (!renderer() || renderer()->passes() > 0 || finished()) // would hold up the first picture
      spheres_.update(baking_.bake(), width_, height_, sphere_white_);
    snapshot.picture = renderer() ? picture() : spheres_.all();
    if (estimates_error()) snapshot.left = photons_.left();
    snapshot.stands_in = view_ && !renderer();
    snapshot.caption = caption();
    snapshot.pictures = spheres_.directions();
    if (renderer() && spheres_.all()) snapshot.pictures.insert(snapshot.pictures.begin(), {"spheres", spheres_.all()});
    snapshot.progress = progress();
    snapshot.warnings = baking_.warnings();
    snapshot.phases = {{"bake", bake_seconds_}};
    if (view_) snapshot.phases.emplace_back("render", render_seconds_);
    if (refines()) snapshot.phases.emplace_back("photons", photon_seconds_);
    if (view_ && view_->has_caustics()) snapshot.phases.emplace_back("caustics", view_->caustics_seconds());
    snapshot.scalars = {{"bake", "from_file", baking_.is_from_file() ? 1.0 : 0.0}};
    add_figures(baking_.bake(), snapshot);
    if (renderer()) add_lights(snapshot);
    return snapshot;
  }

  void save(ByteSink& sink) override {
    tracing::Archive archive(sink, context_.communicator());
    bool complete = baking_.is_complete();
    archive.value(bake_seconds_);
    archive.value(render_seconds_);
    archive.value(complete);
    if (!complete) {
      auto shape = std::uint64_t{baking_.shape()};
      archive.value(shape);
      baking_.serialize(archive);
    }
    if (renderer()) state_of_picture(archive);
  }

  /// Complete bakes are in their files; without its file a bake is made again, and all that came after.
  void load(ByteSource& source) override {
    tracing::Archive archive(source, context_.communicator());
    double bake_seconds = 0, render_seconds = 0;
    bool complete = false;
    archive.value(bake_seconds);
    archive.value(render_seconds);
    archive.value(complete);
    if (complete && !baking_.is_complete()) return read_to_end(source);
    if (!complete) {
      std::uint64_t shape = 0;
      archive.value(shape);
      if (shape > baking_.shape()) return read_to_end(source);
      if (shape < baking_.shape()) { // another run has completed it since
        if (view_) view_->end();
        baking_.begin_anew(shape);
        if (refines()) begin_view();
      }
      baking_.serialize(archive);
    }
    if (renderer()) state_of_picture(archive);
    bake_seconds_ = bake_seconds;
    render_seconds_ = render_seconds;
  }

  /// While the object is baked, the change waits. After a change that failed there is no renderer to go on with.
  bool adopt(const preset::Preset& preset) override {
    if (!view_ || ((baking_.is_complete() || refines()) && !renderer()) || !engine::adoptable(preset_, preset))
      return false;
    const preset::Preset turned = with_view_of(preset_, preset);
    const bool relit =
        turned.scene.environment != preset.scene.environment || turned.scene.lights != preset.scene.lights;
    if (relit && !has_light(scene::load_scene(preset))) return false; // without light only the bake is shown
    std::shared_ptr<const BakeTask> task;                             // of another shape
    if (with_weights_of(preset_, preset) != preset_) task = std::make_shared<const BakeTask>(make_task(preset));
    if (renderer() && view_->show(preset, task ? task->caster : baking_.task().caster)) { // begins another picture
      photons_.end();
      bake_seconds_ = render_seconds_ = photon_seconds_ = 0;
    }
    if (task) {
      std::vector<double> weights;
      for (const BakedShape& shape : baked_shapes(preset)) weights.push_back(shape.weight);
      baking_.set_shape(std::move(task), std::move(weights));
    }
    if (renderer() && baking_.is_complete() && !view_->has_caustics()) view_->set_bake(baking_.bake());
    photons_.set_white(preset.white.value_or(1));
    preset_ = preset;
    return true;
  }

private:
  Renderer* renderer() { return view_ ? view_->renderer() : nullptr; }
  const Renderer* renderer() const { return view_ ? view_->renderer() : nullptr; }

  double work_seconds() const { return bake_seconds_ + render_seconds_ + photon_seconds_; }

  /// Whether photons follow the spheres.
  bool refines() const { return view_ && settings(preset_).refine; }
  bool wants_photons() const {
    return refines() && photons_.wants_turn(renderer()->passes(), most_eye_passes(), most_passes());
  }
  std::int64_t most_passes() const { return passes_ >= 0 ? passes_ : preset::max_passes; }
  /// Where photons follow, the renderer has to show no more than what is smooth.
  std::int64_t most_eye_passes() const {
    return photons_.has_begun() && !view_->has_medium() ? std::min<std::int64_t>(2, most_passes()) : most_passes();
  }

  /// The passes of the whole picture.
  std::int64_t passes() const {
    if (!renderer()) return 0;
    if (!photons_.has_begun()) return renderer()->passes();
    const std::int64_t complete = photons_.complete_passes();
    return renderer()->passes() < most_eye_passes() ? std::min(renderer()->passes(), complete) : complete;
  }

  void bake() {
    baking_.advance();
    if (!baking_.is_complete()) return;
    begin_view();
  }

  void begin_view() {
    if (!view_) return;
    if (!renderer()) view_->begin(preset_, baking_.task().caster);
    if (baking_.is_complete()) view_->set_bake(baking_.bake());
  }

  void add_view(job::Progress& p) const {
    p.step = passes();
    p.steps = passes_;
    const double seen = renderer() ? static_cast<double>(renderer()->passes()) + renderer()->fraction_done() : 0;
    p.work = photons_.has_begun() ? photons_.sent() : static_cast<std::uint64_t>(seen * width_ * height_);
    if (!refines()) p.units = {.step = "pass", .steps = "passes", .work = "path", .works = "paths"};
    const double sent = photons_.has_begun() ? photons_.passes() : seen;
    const auto part = [&](double passes) {
      return passes_ > 0 ? std::min(passes / static_cast<double>(passes_), 1.0) : 0;
    };
    const double rendered = std::min(part(view_->has_medium() ? std::min(seen, sent) : sent), 0.999);
    // A bake is taken to last as long as all passes.
    p.fraction = !baking_.is_complete() ? 0.5 * baking_.fraction_done()
                 : bake_seconds_ > 0    ? 0.5 + 0.5 * rendered
                                        : rendered;
  }

  void add_bake(job::Progress& p) const {
    const auto directions = static_cast<std::int64_t>(baking_.bake().directions.size());
    p.steps = stop_.passes ? std::min<std::int64_t>(directions, *stop_.passes) : directions;
    p.step = baking_.directions();
    p.work = baking_.photons();
    p.units = {.step = "direction", .steps = "directions", .work = "photon", .works = "photons"};
    p.fraction = baking_.fraction_done() * static_cast<double>(directions) / static_cast<double>(p.steps);
  }

  /// The caption of a picture that lacks light, or spheres that are to come.
  std::string caption() const {
    if (!view_) return "There is no light: the object's caustic spheres, as far as they are baked";
    const std::string which =
        baking_.shapes() > 1 ? fmt::format(", bake {} of {}", baking_.shape() + 1, baking_.shapes()) : "";
    if (!renderer()) return fmt::format("The object is baked first{}: its caustic spheres, as far as they are", which);
    if (baking_.is_complete()) return "";
    const std::optional<double> left = baking_.seconds_left();
    return fmt::format(
        "Photons alone: the caustic spheres of {} show each change at once when they are baked, {:.0f} % are{}{}",
        baking_.task().caster.name, 100 * baking_.fraction_done(), which,
        left ? fmt::format("; {:.0f} s left", std::ceil(*left)) : "");
  }

  std::shared_ptr<const job::Picture> picture() {
    std::vector<Renderer::Layer> layers = renderer()->layers();
    Renderer::Layer smooth = std::move(layers[Renderer::smooth]);
    layers.erase(layers.begin() + Renderer::smooth);
    auto picture = std::make_shared<job::Picture>();
    picture->width = width_;
    picture->height = height_;
    if (refines()) picture->error_draw = photons_.join(layers, std::move(smooth.rgb));
    if (!estimates_error()) picture->error_draw.clear();
    picture->rgb.resize(layers.front().rgb.size());
    for (Renderer::Layer& layer : layers) {
      std::ranges::transform(picture->rgb, layer.rgb, picture->rgb.begin(), std::plus());
      picture->layers.push_back({layer.name, std::move(layer.rgb)});
    }
    return picture;
  }

  void state_of_picture(tracing::Archive& archive) {
    double caustics_seconds = view_->caustics_seconds();
    archive.value(caustics_seconds);
    archive.value(photon_seconds_);
    view_->serialize(archive);
    view_->set_caustics_seconds(caustics_seconds);
    photons_.serialize(archive, *view_);
  }

  /// Adds the lights for the panel Environment.
  void add_lights(job::Snapshot& snapshot) const {
    snapshot.curves.push_back(
        {"lights", {"light", "azimuth_deg", "elevation_deg", "red", "green", "blue", "visible"}, {}});
    const double rotate_deg = view_->backdrop_rotate_deg();
    const std::vector<Region>& lights = renderer()->segmentation().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const glm::dvec3 from = turned(lights[i].direction, rotate_deg), all = lights[i].flux,
                       left = renderer()->visible()[i].flux;
      const double sum = all.x + all.y + all.z;
      snapshot.curves.back().rows.push_back({static_cast<double>(i + 1), glm::degrees(std::atan2(from.x, -from.z)),
                                             glm::degrees(std::asin(from.y)), all.x, all.y, all.z,
                                             sum > 0 ? (left.x + left.y + left.z) / sum : 1});
    }
    snapshot.scalars.push_back({"lights", "count", static_cast<double>(lights.size())});
  }

  mpi::RankContext context_;
  preset::Preset preset_; ///< the newest preset
  int width_, height_;
  double sphere_white_; ///< white for the pictures of spheres
  preset::Stop stop_;
  std::int64_t passes_ = -1; ///< the renderer's most; -1: until the time is over
  Baking baking_;
  std::optional<SceneView> view_; ///< empty without light
  JoinedPhotons photons_;
  SpherePictures spheres_;
  bool bakes_next_ = false;
  double bake_seconds_ = 0, render_seconds_ = 0, photon_seconds_ = 0;
};

} // namespace

std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const EnvironmentPlan& plan,
                                   const mpi::RankContext& context) {
  return std::make_unique<EnvironmentJob>(preset, plan, context);
}

} // namespace nephroid::environment
