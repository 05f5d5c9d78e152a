// SPDX-License-Identifier: Apache-2.0
// The solid as files that mesh tools read, in millimetres.
#pragma once
#include "base/bytes.h"
#include "scene/mesh.h"

namespace nephroid::inverse {

void write_obj(const scene::Mesh& mesh, ByteSink& to); ///< Wavefront
void write_stl(const scene::Mesh& mesh, ByteSink& to); ///< binary
void write_ply(const scene::Mesh& mesh, ByteSink& to); ///< binary, little-endian

} // namespace nephroid::inverse
