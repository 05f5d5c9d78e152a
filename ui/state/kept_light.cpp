// SPDX-License-Identifier: Apache-2.0
#include "ui/state/kept_light.h"

#include "base/parallel.h"
#include "photons/seen_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::ui {
namespace {

/// The light before counts as at most so many passes: its pixels may have been larger, and its highlights elsewhere.
constexpr double most_passes = 8;
/// It is left out where it has less than this part.
constexpr double least_part = 1.0 / 16;

/// By the camera alone, if at all, and a lens blurs neither. What glass or water around a camera takes hangs on the
/// way.
bool can_lend(preset::Preset a, const scene::Camera& camera_a, const preset::Preset& b, const scene::Camera& camera_b) {
  if (a.scene.camera.aperture > 0 || b.scene.camera.aperture > 0) return false;
  if (!camera_a.inside.empty() || !camera_b.inside.empty()) return false;
  if (camera_a.width != camera_b.width || camera_a.height != camera_b.height) return false;
  a.scene.camera = b.scene.camera;
  return a == b;
}

} // namespace

struct KeptLight::Shown {
  preset::Preset preset;
  scene::Camera camera;
  std::shared_ptr<const job::Picture> picture; ///< null before the first pass is complete
  double passes = 0;                           ///< those that the picture is worth
  bool lends = true;                           ///< its pictures are those of `preset` and `camera`
  std::shared_ptr<const Shown> before;         ///< what stands in while there is no picture; null: nothing
};

class KeptLight::Keeper final : public job::Job, public job::SpectrumSource {
public:
  /// before: what the pictures begin with; null: nothing.
  Keeper(std::unique_ptr<job::Job> job, std::shared_ptr<Shown> shown, std::shared_ptr<const Shown> before,
         const run::LoadedScene& loaded)
      : job_(std::move(job)), shown_(std::move(shown)) {
    if (!before) return;
    const photons::SeenPlaces now = photons::matt_places(loaded.scene, *loaded.bvh, shown_->camera),
                              then = photons::matt_places(loaded.scene, *loaded.bvh, before->camera);
    before_ = before->picture;
    taps_ = photons::taps_before(now, loaded.scene.geometry, then);
    for (std::size_t i = 0; i < taps_.size(); ++i) {
      const auto nearest =
          static_cast<std::size_t>(std::ranges::max_element(taps_[i].weights) - taps_[i].weights.begin());
      // A pixel that is smaller than those before shows what they do not tell.
      const double finer = now.places[i].reach / then.places[taps_[i].pixels[nearest]].reach;
      passes_.push_back(
          taps_[i].weights[nearest] > 0 ? std::min(before->passes, most_passes) * std::min(finer * finer, 1.0) : 0);
    }
    if (std::ranges::all_of(passes_, [](double passes) { return !(passes > 0); })) before_.reset();
  }

  job::Snapshot snapshot() override {
    job::Snapshot snapshot = job_->snapshot();
    if (!snapshot.picture || snapshot.in_view) return snapshot;
    const auto own = static_cast<double>(snapshot.progress.step);
    if (before_ && !job_->finished() && most_passes > least_part * (most_passes + own)) {
      snapshot.in_view = with_light_before(*snapshot.picture, own);
      if (snapshot.caption.empty()) snapshot.caption = "with light from before the camera moved";
    }
    if (own >= 1 && shown_->lends) {
      shown_->picture = snapshot.in_view ? snapshot.in_view : snapshot.picture;
      shown_->passes = own;
    }
    return snapshot;
  }

  void begin_with(const job::Beginning& beginning) override { job_->begin_with(beginning); }
  void advance() override { job_->advance(); }
  bool finished() const override { return job_->finished(); }
  job::Progress progress() const override { return job_->progress(); }
  bool estimates_error() const override { return job_->estimates_error(); }
  std::shared_ptr<const job::History> history() const override { return job_->history(); }
  void save(ByteSink& to) override { job_->save(to); }
  void load(ByteSource& from) override { job_->load(from); }
  bool adopt(const preset::Preset& preset) override {
    if (!job_->adopt(preset)) return false;
    shown_->lends = false; // it may have another light, another camera and other places now
    shown_->before.reset();
    shown_->picture.reset();
    before_.reset();
    return true;
  }
  std::shared_ptr<const job::PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override {
    auto* source = dynamic_cast<job::SpectrumSource*>(job_.get());
    return source ? source->spectrum(pixel) : nullptr;
  }

private:
  std::shared_ptr<const job::Picture> with_light_before(const job::Picture& own, double own_passes) const {
    const job::Picture& before = *before_;
    auto picture = std::make_shared<job::Picture>(own);
    const auto mix = [&](const std::vector<float>& from, std::vector<float>& into) {
      for_items(taps_.size(), [&](std::size_t i) {
        if (!(passes_[i] > 0)) return;
        const auto part = static_cast<float>(passes_[i] / (passes_[i] + own_passes));
        for (std::size_t c = 0; c < 3; ++c) {
          float there = 0;
          for (std::size_t tap = 0; tap < taps_[i].weights.size(); ++tap)
            there += taps_[i].weights[tap] * from[std::size_t{3} * taps_[i].pixels[tap] + c];
          into[3 * i + c] += part * (there - into[3 * i + c]);
        }
      });
    };
    mix(before.rgb, picture->rgb);
    for (job::Layer& layer : picture->layers)
      if (const auto same = std::ranges::find(before.layers, layer.name, &job::Layer::name);
          same != before.layers.end())
        mix(same->rgb, layer.rgb);
    return picture;
  }

  std::unique_ptr<job::Job> job_;
  std::shared_ptr<Shown> shown_;
  std::shared_ptr<const job::Picture> before_; ///< null: there is no light before
  std::vector<photons::Taps> taps_;            ///< [pixel]
  std::vector<double> passes_;                 ///< [pixel]: those that the light before counts as
};

std::unique_ptr<job::Job> KeptLight::wrap(std::unique_ptr<job::Job> job, const run::Prepared& prepared) {
  const std::shared_ptr<Shown> last = std::exchange(last_, nullptr);
  if (!prepared.plan->mixes_frames) return job;
  last_ = std::make_shared<Shown>();
  last_->preset = prepared.preset;
  last_->camera = prepared.loaded->scene.camera;
  if (last && last->picture) last->before.reset(); // no chain of all pictures
  const bool begins_anew = last && last->preset == prepared.preset;
  std::shared_ptr<const Shown> before =
      last && last->lends && !begins_anew ? last->picture ? last : last->before : nullptr;
  if (before && !can_lend(before->preset, before->camera, last_->preset, last_->camera)) before.reset();
  last_->before = before;
  return std::make_unique<Keeper>(std::move(job), last_, std::move(before), *prepared.loaded);
}

} // namespace nephroid::ui
