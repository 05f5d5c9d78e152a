// SPDX-License-Identifier: Apache-2.0
// A snapshot's further pictures (job::NamedPicture) as textures, and where a facet's light falls, over them.
#pragma once
#include "inverse/assign/footprint.h"
#include "job/job.h"
#include "ui/widgets/picture_texture.h"

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

struct FacetBeam {
  glm::ivec2 facet{0, 0}; ///< column and row, from the top left
  glm::dvec2 slope{0, 0};
  double height = 0;                      ///< z of its middle, millimetres
  double power = 0;                       ///< over that of a facet that lies flat
  std::vector<inverse::Footprint> prints; ///< on each receiver
};

/// `slopes` has a pixel a facet: slope along x, along y, height. Empty for a layout of other facets or a facet outside.
std::optional<FacetBeam> facet_beam(const job::Picture& slopes, const inverse::Layout& layout, const glm::ivec2& facet);

/// A footprint on a receiver's picture, in cells from its top left corner.
struct BeamBox {
  glm::dvec2 low{0, 0}, high{0, 0};
};
/// Empty where nothing of the beam is on the receiver.
std::optional<BeamBox> box_of(const inverse::Footprint& print);
/// The part of the beam that is on the receiver.
double part_on(const inverse::Footprint& print);

/// The beam in the object's coordinates: a line from the front to the last receiver, and its box of cells on each.
std::vector<std::vector<preset::Vec3>> lines_of(const FacetBeam& beam, const inverse::Layout& layout);

/// A frame about the beam on a receiver's picture of so many cells, from corner to corner; large enough to be found.
void draw_beam_frame(const inverse::Footprint& print, const glm::ivec2& cells, const ImVec2& low, const ImVec2& high);
/// The cells about the beam, large, from corner to corner: how bright the picture is, and over it the beam's parts.
void draw_beam_cells(const inverse::Footprint& print, const job::Picture& picture, const ImVec2& low,
                     const ImVec2& high);

} // namespace nephroid::ui
