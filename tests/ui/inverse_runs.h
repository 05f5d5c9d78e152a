// SPDX-License-Identifier: Apache-2.0
// Real runs of engine 3 in a window without a device: it computes on the host.
#pragma once
#include "inverse/engine.h"
#include "window_fixture.h"

#include <string>

namespace nephroid::test {

/// Two pictures, small enough for a test.
inline std::string inverse_text(int sweeps, int facets = 24)
{
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

class InverseRuns : public FakeRuns {
public:
  ui::NewRun make(const preset::Preset& preset) override
  {
    ++made;
    auto made_plan = std::make_shared<const inverse::InversePlan>(inverse::make_plan(preset));
    return {inverse::make_job(preset, *made_plan), made_plan, nullptr};
  }
};

} // namespace nephroid::test
