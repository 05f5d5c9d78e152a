// SPDX-License-Identifier: Apache-2.0
// Which cells a film of layers has (kernels/spectral/layers.h): a cell is a pixel with one reflector that it sees. On the host, without
// OpenCL.
#pragma once
#include "kernels/spectral/layer_types.h"
#include "kernels/tracing/shared_types.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace nephroid::spectral {

struct LayerCells {
  std::vector<int> first;               ///< [pixel + 1] in `cells`
  std::vector<shared::LayerCell> cells; ///< of each pixel, the reflector that it sees most at the beginning
  std::vector<int> reflector_of_block;  ///< cells of one reflector fill whole blocks of LAYER_BLOCK
  std::size_t count() const { return LAYER_BLOCK * reflector_of_block.size(); } ///< numbers of cells, those that nothing uses included
};

/// What a survey saw.
struct Survey {
  std::span<const int> seen; ///< [pixel][sample]: a reflector, -1: none
  int width = 0, height = 0;
  int samples = 0; ///< a pixel
  int reflector_count = 0;
};

/// A cell for each pixel and reflector that the pixel or one of its eight neighbours sees: what is at an edge may be in the pixel beside.
/// most: at most so many; then what pixels see least goes first. every_pixel: also a pixel that sees nothing has one, where there
/// are reflectors at all (then `most` is at least the number of pixels).
LayerCells make_layer_cells(const Survey& survey, std::size_t most, bool every_pixel);

/// The most that LayerCells::count() can be for so many cells.
std::size_t padded_cells(std::size_t cells, int reflector_count);

/// How many cells a camera's films may have, known before anything is surveyed: one a pixel and a quarter more for edges; of what is seen
/// through glass and mirrors two a pixel that may see `spheres`, which enclose all glass and mirrors. Both have some thousand more.
std::size_t unbent_cells(const shared::DeviceCamera& camera);
std::size_t bent_cells(const shared::DeviceCamera& camera, std::span<const scene::Sphere> spheres);

} // namespace nephroid::spectral
