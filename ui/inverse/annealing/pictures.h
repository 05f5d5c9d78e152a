// SPDX-License-Identifier: Apache-2.0
// A snapshot's further pictures (job::NamedPicture) as textures, and boxes of the panel that show them.
#pragma once
#include "job/job.h"
#include "ui/inverse/annealing/beam.h"
#include "ui/widgets/picture_texture.h"

#include <map>
#include <memory>
#include <string>

struct ImVec2;

namespace nephroid::ui {

class RunPictures {
public:
  /// Once a frame, with the snapshot that the panel shows; null: nothing is shown.
  void follow(const std::shared_ptr<const job::Snapshot>& snapshot);
  /// Null where the snapshot has no such picture.
  const job::Picture* find(const std::string& name) const;
  /// The picture from corner to corner; signed_values: 0 is middle grey, and the largest of all values white or black.
  void draw(const std::string& name, const ImVec2& low, const ImVec2& high, bool signed_values = false);

private:
  struct Shown {
    std::shared_ptr<const job::Picture> picture; ///< that is in the texture
    PictureTexture texture;
  };
  std::shared_ptr<const job::Snapshot> snapshot_;
  std::map<std::string, Shown> shown_;
};

/// A frame about the beam on a receiver's picture of so many cells, which lies from corner to corner; large enough to be found.
void draw_beam_frame(const inverse::Footprint& print, const glm::ivec2& cells, const ImVec2& low, const ImVec2& high);
/// The cells about the beam, large, from corner to corner: how bright the picture is there, and the parts of the beam over it.
void draw_beam_cells(const inverse::Footprint& print, const job::Picture& picture, const ImVec2& low, const ImVec2& high);

} // namespace nephroid::ui
