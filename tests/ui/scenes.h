// SPDX-License-Identifier: Apache-2.0
// Presets for tests of the window: what is selected and moved, what light does in glass, a sky, two pictures for
// engine 3. And fake runs whose scene is loaded, so that a click finds something and panels know what the glass sees.
#pragma once
#include "fake_job.h"
#include "inverse/job.h"
#include "tests/support/render.h"
#include "ui/shell/panels.h"
#include "ui/view/pinhole.h"

namespace nephroid::test {

/// From (0, 0, 4) to the origin, 40 degrees high. The ball is at the left, the light at the upper right.
inline std::string ball_text(const std::string& engine = "spectral") {
  return R"({
  "name": "Ball", "engine": ")" +
         engine + R"(", "unit": "m", "white": 1,
  "scene": {
    "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40, "resolution": [64, 48]},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "wall": {"type": "diffuse", "reflectance": 0.5}},
    "objects": [
      {"name": "ball", "shape": {"type": "sphere", "radius": 0.3}, "material": "glass", "transform": {"translate": [-0.5, 0, 0]}},
      {"name": "floor", "shape": {"type": "quad", "size": [2, 1, 2]}, "material": "wall", "transform": {"translate": [0, -1, 0]}}
    ],
    "lights": [{"type": "point", "power_w": 10, "position": [0.9, 0.9, 0]},
               {"type": "spot", "power_w": 10, "position": [-1, 1, 0], "direction": [0, -1, 0]}]
  },
  "stop": {"passes": 20}
})";
}

/// A glass ball in a room of two colours. spectrum, effort: JSON.
inline std::string room_text(const std::string& spectrum, const std::string& effort = "importance") {
  return R"({
  "name": "Room", "engine": "spectral", "unit": "m",
  "scene": {
    "camera": {"position": [0, 0, 4], "resolution": [64, 48]},
    "materials": {
      "glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.6, 0.02]}},
      "red": {"type": "diffuse", "reflectance": "red"},
      "floor": {"type": "diffuse", "reflectance": 0.5},
      "unused": {"type": "diffuse", "reflectance": 1}
    },
    "objects": [
      {"name": "ball", "shape": {"type": "sphere", "radius": 0.4}, "material": "glass"},
      {"name": "room", "shape": {"type": "box", "size": [4, 4, 4], "inwards": true}, "material": "red"},
      {"name": "floor", "shape": {"type": "quad", "size": [4, 1, 4]}, "material": "floor", "transform": {"translate": [0, -1, 0]}}
    ],
    "lights": [{"type": "point", "power_w": 10, "position": [0.5, 1.5, 1], "spectrum": )" +
         spectrum + R"(}]
  },
  "spectral": {"effort": ")" +
         effort + R"(", "threshold_deg": 0.2},
  "stop": {"passes": 100}
})";
}

/// A glass ball on a floor under a shipped sky of three lamps. resolution, settings: JSON, of the camera and of the
/// engine.
inline std::string lamps_text(const std::string& resolution, const std::string& settings) {
  return R"({
  "name": "Three lamps", "description": "A glass ball under three lamps", "engine": "environment", "unit": "cm", "white": 10,
  "stop": {"passes": 4},
  "scene": {
    "camera": {"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34, "resolution": )" +
         resolution + R"(},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "floor": {"type": "diffuse", "reflectance": 0.8}},
    "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "glass"},
                {"name": "floor", "shape": {"type": "quad", "size": [30, 1, 30]}, "material": "floor", "transform": {"translate": [0, -1.2, 0]}}],
    "environment": {"type": "file", "file": ")" NEPHROID_SOURCE_DIR R"(/presets/spectral/three-lamps.hdr"}
  },
  "environment": {)" +
         settings + "}\n}";
}

/// Two pictures, small enough for a test.
inline std::string inverse_text(int sweeps, int facets = 24) {
  return R"({
  "name": "Small", "engine": "inverse", "unit": "mm", "scene": {"camera": {"resolution": [96, 96]}},
  "inverse": {
    "facets": [)" +
         std::to_string(facets) + ", " + std::to_string(facets) + R"(], "cells": [12, 12],
    "receivers": [
      {"distance_mm": 100, "picture": {"type": "ring", "radius": 0.4, "inner": 0.15}},
      {"distance_mm": 200, "picture": {"type": "disc", "radius": 0.28}}
    ]
  },
  "stop": {"passes": )" +
         std::to_string(sweeps) + "}\n}";
}

inline std::shared_ptr<const run::LoadedScene> loaded_scene(const preset::Preset& preset) {
  auto loaded = std::make_shared<run::LoadedScene>();
  loaded->scene = scene::load_scene(preset);
  loaded->bvh = std::make_shared<scene::Bvh>(scene::build_bvh(loaded->scene.geometry));
  return loaded;
}

inline std::shared_ptr<const ui::ViewedScene> seen_scene(const preset::Preset& preset) {
  return ui::take_facts(preset, loaded_scene(preset)).view;
}

/// Fake jobs, but what there is to see in the scene is looked at as the program does.
class SceneRuns : public FakeRuns {
public:
  ui::NewRun make(const preset::Preset& preset, const Watch& watch) override {
    ui::NewRun run = FakeRuns::make(preset, watch);
    run.scene_facts = ui::take_facts(preset, loaded_scene(preset));
    return run;
  }
};

/// Real runs of engine 3, short enough for a test.
class InverseRuns : public FakeRuns {
public:
  InverseRuns() { shared_context(); } // before there are threads: it may look at and change the environment

  ui::NewRun make(const preset::Preset& preset, const Watch&) override {
    ++made;
    auto made_plan = std::make_shared<const inverse::InversePlan>(inverse::make_plan(preset));
    return {inverse::make_job(preset, *made_plan, shared_context()), made_plan, nullptr};
  }
};

} // namespace nephroid::test
