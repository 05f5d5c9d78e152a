// SPDX-License-Identifier: Apache-2.0
// Meshes that deform: an object's mesh, and the states that it can become. Private to scene/.
#pragma once
#include "base/location.h"
#include "preset/preset.h"
#include "scene/mesh.h"

#include <functional>

namespace nephroid::scene {

/// The mesh of an object that has one, each of its vertices moved by weight * (state's - own) for every state, as
/// glTF's morph targets are. Corners of triangles are matched, not vertices: files of one mesh may join them
/// differently. Normals are moved alike where all files have them, else none. Texcoords are the object's. What is the
/// same at all weights is kept for the next call: a frame of an animation is a sum over the vertices. load: gives the
/// mesh of a file that the place names. where: FILE#/scene/objects/INDEX. Throws as `load`, and bad_input where a state
/// has another count of triangles or where these weights turn a closed mesh inside out.
std::shared_ptr<const Mesh>
deformed_mesh(const preset::Object& object, const Location& where,
              const std::function<std::shared_ptr<const Mesh>(const std::string& file, const Location& at)>& load);

} // namespace nephroid::scene
