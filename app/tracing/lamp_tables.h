// SPDX-License-Identifier: Apache-2.0
// The tables of lamps that are a mesh, have a picture or photometry (app/lights).
#pragma once
#include "tracing/scene_tables.h"

#include <memory>
#include <vector>

namespace nephroid::tracing {

/// from: the scene's lights in the order of `lights`, which get the places of their tables. Null where none has one.
/// Throws bad_input where they have more numbers together than a kernel can count, and at a photometric file whose beam
/// is narrower than its table's steps.
std::shared_ptr<const LampTables> make_lamp_tables(const scene::Scene& scene,
                                                   const std::vector<const scene::Light*>& from,
                                                   std::vector<shared::DeviceLight>& lights);

/// Where kernels have a lamp shine from, for the two numbers of its place, in [0, 1). light: index into tables.lights.
glm::dvec3 lamp_place(const SceneTables& tables, int light, float x, float y);

} // namespace nephroid::tracing
