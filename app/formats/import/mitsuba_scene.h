// SPDX-License-Identifier: Apache-2.0
// What Mitsuba's spectra, bsdfs and media are here, wherever its scenes put them.
#pragma once
#include "formats/import/description.h"
#include "formats/import/mitsuba_file.h"
#include "scatter/texture.h"

namespace nephroid::formats {

struct MitsubaScene {
  MitsubaFile file;
  Description& d;
  std::map<std::pair<std::size_t, std::size_t>, std::string> keys{}; ///< of materials, by bsdf and medium or normalmap
  TakenNames taken{};
  int nested = 0;      ///< how many textures are being read, each in the one before
  std::string black{}; ///< the key of what is black; empty: none yet
};

/// The child of this name; where it is none, a note says that a grey of `standard` takes its place.
DescribedColour mitsuba_colour(MitsubaScene& scene, xml_node parent, const std::string& name, double standard);

/// A picture or a checkerboard in a colour's or number's place; nothing where there is none.
std::optional<preset::Texture> mitsuba_texture(MitsubaScene& scene, xml_node parent, const std::string& name,
                                               scatter::Texels texels);

/// A note for each value of a node that nothing has asked for and that changes a picture.
void note_unasked(MitsubaScene& scene, xml_node node);

/// The key of the shape's material or dielectric, which may be a new one. Empty: its surface is none. back: gets the
/// key of its back where that has another: the second of a twosided, or black.
std::string mitsuba_material(MitsubaScene& scene, xml_node shape, std::optional<std::string>* back);

} // namespace nephroid::formats
