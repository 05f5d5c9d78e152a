// SPDX-License-Identifier: Apache-2.0
#include "ui/state/new_scenes.h"

#include "preset/read.h"

namespace nephroid::ui {
namespace {

// Cauchy's formula with the two terms that fit N-BK7: the scene needs no file.
constexpr const char* spectral = R"({
  "name": "untitled", "description": "A glass sphere on a floor under a lamp", "engine": "spectral", "unit": "cm", "white": 6,
  "scene": {
    "camera": {"position": [2, 5, 8], "target": [0.6, 0.4, 0], "fov_deg": 36, "resolution": [512, 512]},
    "materials": {
      "glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.5046, 0.0042]}},
      "floor": {"type": "diffuse", "reflectance": 0.8}
    },
    "objects": [
      {"name": "floor", "shape": {"type": "quad", "size": [24, 1, 24]}, "material": "floor"},
      {"name": "sphere", "shape": {"type": "sphere", "radius": 1}, "material": "glass", "transform": {"translate": [0, 1.5, 0]}}
    ],
    "lights": [{"type": "point", "spectrum": "D65", "power_w": 10, "position": [-4, 6, -2]}]
  },
  "stop": {"passes": 64}
})";

constexpr const char* environment = R"({
  "name": "untitled", "description": "A glass sphere on a floor under an evening sky", "engine": "environment", "unit": "cm", "white": 4,
  "scene": {
    "camera": {"position": [0.5, 5, 7], "target": [0.9, 0.3, -0.2], "fov_deg": 38, "resolution": [512, 512]},
    "environment": {"type": "file", "file": "spectral/low-sun.hdr"},
    "materials": {
      "glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.5046, 0.0042]}},
      "floor": {"type": "diffuse", "reflectance": 0.8}
    },
    "objects": [
      {"name": "sphere", "shape": {"type": "sphere", "radius": 1}, "material": "glass", "transform": {"translate": [0, 1.0001, 0]}},
      {"name": "floor", "shape": {"type": "quad", "size": [40, 1, 40]}, "material": "floor"}
    ]
  }
})";

constexpr const char* inverse = R"({
  "name": "untitled", "description": "One piece of acrylic that casts a ring and a cross", "engine": "inverse", "unit": "mm",
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

const char* text_of(NewScene kind)
{
  switch (kind) {
  case NewScene::environment:
    return environment;
  case NewScene::inverse:
    return inverse;
  case NewScene::spectral:
    break;
  }
  return spectral;
}

} // namespace

preset::Preset new_scene(NewScene kind)
{
  preset::Preset made = preset::parse_preset(text_of(kind), "untitled");
  made.source.clear(); // else a file that happens to have this name would be its own
  return made;
}

} // namespace nephroid::ui
