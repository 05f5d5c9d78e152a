// SPDX-License-Identifier: Apache-2.0
#include "inverse/engine.h"

#include "inverse/glass_view.h"
#include "inverse/job.h"
#include "inverse/judge.h"
#include "inverse/object_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::inverse {
namespace {

/// A receiver with a drawing casts it now, or else the first one.
engine::PictureEdit take_picture(preset::Preset& preset, const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const auto picture_of = [&] {
    Picture picture;
    picture.type = Picture::Type::file;
    picture.file = std::filesystem::absolute(file).string();
    return picture;
  };
  if (std::optional<Intensity>& far = settings(preset).far) {
    far->type = Intensity::Type::picture;
    far->picture = picture_of();
    return {"cast " + name, name + " is the intensity; Parameters has its angles"};
  }
  std::vector<Receiver>& receivers = settings(preset).receivers;
  if (receivers.empty())
    throw bad_input(file.string(), "the preset has no receiver to cast it on", "", "add one in Parameters");
  auto receiver =
      std::ranges::find_if(receivers, [](const Receiver& r) { return r.picture.type != Picture::Type::file; });
  if (receiver == receivers.end()) receiver = receivers.begin();
  receiver->picture = picture_of();
  return {"cast " + name,
          fmt::format("{} is the picture at {:g} mm; Parameters has the others", name, receiver->distance_mm)};
}

constexpr const char* new_scene = R"({
  "name": "untitled", "description": "One piece of acrylic that casts a ring and a cross",
  "engine": "inverse", "unit": "mm",
  "scene": {"camera": {"resolution": [768, 384]}},
  "inverse": {
    "size_mm": [100, 100], "facets": [64, 64], "index": 1.5, "cells": [64, 64],
    "receivers": [
      {"distance_mm": 100, "picture": {"type": "ring", "radius": 0.3, "inner": 0.15}},
      {"distance_mm": 200, "picture": {"type": "cross", "length": 0.7, "width": 0.15}}
    ]
  },
  "stop": {"passes": 12}
})";

} // namespace

constinit const engine::Engine engine{
    .settings = settings_type,
    .state_version = 7,
    .plan = [](const preset::Preset& preset, const scene::Scene&, const scene::Bvh&) -> std::unique_ptr<plan::Plan> {
      auto plan = std::make_unique<InversePlan>(make_plan(preset));
      plan->notes = notes_of(preset, *plan->design);
      return plan;
    },
    .job =
        [](const preset::Preset& preset, const scene::Scene&, const scene::Bvh&, const plan::Plan& plan,
           const mpi::RankContext& context) {
          return make_job(preset, dynamic_cast<const InversePlan&>(plan), context);
        },
    .reference = [](const preset::Preset& preset, int) { return preset.reference->settings.value_or(preset.settings); },
    .checks = closed_forms,
    .adoptable = adoptable,
    .has_scene = false,
    .camera = view_camera,
    .take_picture = take_picture,
    .introduction = {.example = {.preset = "inverse/shapes",
                                 .title = "Designed glass",
                                 .sentence = "Say which pictures a piece of glass shall cast, and how far away. It is "
                                             "found, judged by rays, and written as a closed mesh.",
                                 .run = "design glass that casts a ring, a cross and a disc"},
                     .new_scene = {.preset = new_scene, .what = "An object that casts two drawings"},
                     .result = {.file = glass_view_file,
                                .action = "Show as glass",
                                .what = "as lit glass over its receivers"},
                     .badge = {112, 84, 62}}};

bool adoptable(const preset::Preset& before, const preset::Preset& now) {
  if (settings(before).receivers.size() != settings(now).receivers.size()) return false;
  preset::Preset same = now;
  same.name = before.name;
  same.description = before.description;
  same.scene.camera = before.scene.camera;
  const auto same_light = [](const Receiver& a, const Receiver& b) { return a.light == b.light; };
  if (settings(before).method == Settings::Method::assign &&
      std::ranges::equal(settings(before).receivers, settings(now).receivers, same_light)) {
    same.stop = before.stop;
    settings(same).receivers = settings(before).receivers;
  }
  return same == before;
}

} // namespace nephroid::inverse
