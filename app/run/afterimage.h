// SPDX-License-Identifier: Apache-2.0
// afterimage.bin: what a frame of an animation leaves for the next one, its noisy layers and the places that its pixels
// show. It goes when the next frame has been rendered after it. It ends in a hash, and so tells one frame's from
// another's.
#pragma once
#include "job/job.h"
#include "photons/seen_places.h"
#include "plan/plan.h"
#include "run/prepare.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace nephroid::run {

inline constexpr const char* afterimage_file = "afterimage.bin";

struct Afterimage {
  photons::SeenPlaces seen;
  double white = 1;
  std::vector<job::Layer> layers; ///< job::Snapshot::left
  plan::Input input;              ///< its name from the next frame's folder, and its hash
};

/// What the frame in a folder left; null where there is none that can be read.
std::shared_ptr<const Afterimage> read_afterimage(const std::filesystem::path& frame_folder);

/// Written whole. seen: of the prepared scene.
void write_afterimage(const std::filesystem::path& frame_folder, const Prepared& prepared,
                      const photons::SeenPlaces& seen, const std::vector<job::Layer>& layers);

/// What a frame begins with. seen: of the prepared scene; Prepared::before may be null.
job::Beginning beginning_of(const Prepared& prepared, const photons::SeenPlaces& seen);

} // namespace nephroid::run
