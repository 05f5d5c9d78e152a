// SPDX-License-Identifier: Apache-2.0
// A film of layers (kernels/photons/layers.h): its cells, on the host, its sums, on the device, and the pictures
// weighed from them. A cell is a pixel with one reflector that it sees. Also what stages share (thesis 6.2.2).
#pragma once
#include "compute/compute.h"
#include "kernels/photons/layer_types.h"
#include "kernels/tracing/shared_types.h"
#include "mpi/rank_context.h"
#include "photons/plan_part.h"
#include "photons/relight/layer_light.h"
#include "photons/stage_context.h"
#include "scene/scene.h"
#include "tracing/archive.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace nephroid::photons {

struct LayerCells {
  std::vector<int> first;               ///< [pixel + 1]: index into `cells`
  std::vector<shared::LayerCell> cells; ///< for each pixel, beginning with the reflector that it sees most
  std::vector<int> reflector_of_block;  ///< cells of one reflector fill whole blocks of LAYER_BLOCK
  std::size_t count() const { return LAYER_BLOCK * reflector_of_block.size(); } ///< cell numbers, unused ones included
};

struct ReflectorSurvey {
  std::span<const int> seen; ///< [pixel][sample]: a reflector; -1: none
  int width = 0, height = 0;
  int samples = 0; ///< samples of a pixel
  int reflector_count = 0;
};

/// Makes a cell for each pixel and reflector that the pixel or one of its eight neighbours sees: what is at an edge may
/// be in the pixel beside. There are at most `most` cells; if there would be more, what pixels see least is left out
/// first. With EmptyPixel::a_cell a pixel that sees nothing has one, too, if there are reflectors.
enum class EmptyPixel { no_cell, a_cell };
LayerCells make_layer_cells(const ReflectorSurvey& survey, std::size_t most, EmptyPixel unseen);

/// The largest LayerCells::count() for so many cells.
std::size_t padded_cells(std::size_t cells, int reflector_count);

/// The most cells of a camera's films, known before the survey. Unbent: one a pixel, and more for edges. Bent (seen
/// through glass and mirrors): two for each pixel that may see `spheres`, which enclose these, and some more.
std::size_t unbent_cells(const shared::DeviceCamera& camera);
std::size_t bent_cells(const shared::DeviceCamera& camera, std::span<const scene::Sphere> spheres);

/// The weights of a layer's sums of one half in each of two pictures, as linear sRGB.
struct LayerWeight {
  std::array<float, 3> first{}, second{};
};

/// The weights of a whole film, times 2^-exponent, so that the largest is about 1. Otherwise a light of 1e-30 W over
/// the film's quanta would leave weights only the last digits of single precision.
struct LayerFilmWeights {
  std::vector<LayerWeight> weights; ///< [reflector][half][layer]
  int exponent = 0;
};

/// The sums of one reflector that a pixel sees.
struct LayerSums {
  int reflector = 0;
  std::vector<double> sums; ///< [half][layer], in the film's quanta
};

class LayerFilm {
public:
  LayerFilm() = default;
  /// Holds halves x layers sums for each cell, all 0.
  LayerFilm(const mpi::RankContext& context, const std::string& name, const LayerCells& cells, std::size_t layers,
            std::size_t halves, const compute::Defines& defines);

  std::size_t layers() const { return layers_; }
  /// The kernel arguments LAYER_FILM_ARGUMENTS.
  const compute::Buffer<int>& first() const { return first_; }
  const compute::Buffer<shared::LayerCell>& cells() const { return cells_; }
  const compute::Buffer<std::int64_t>& sums() const { return sums_; }
  int layer_count() const { return static_cast<int>(layers_); }

  /// Returns two pictures, each [pixel][3]: sums over halves, layers and the pixel's cells, times the weights.
  std::array<std::vector<float>, 2> weigh(const LayerFilmWeights& by);

  std::vector<LayerSums> pixel(std::size_t index) const;

  void serialize(tracing::Archive& archive) { archive.buffer(sums_); }

private:
  mpi::RankContext context_{};
  std::size_t layers_ = 0, halves_ = 1, pixels_ = 0, cell_count_ = 0;
  compute::Buffer<int> first_, reflector_of_block_;
  compute::Buffer<shared::LayerCell> cells_;
  compute::Buffer<std::int64_t> sums_; ///< [block][half][layer][cell of the block]
  compute::Buffer<float> weights_, weighed_, pictures_;
  compute::Kernel weigh_, gather_;
};

/// The samples or photons of each half of one layer.
using HalfCounts = std::array<double, 2>;

/// Weights for weigh(). The first picture is the mean over both halves of `colours` [layer][reflector] times the film's
/// sums, the second the draw of its error (job::Picture::error_draw). counts: [layer]; those of 0 are left out.
LayerFilmWeights mean_and_draw(std::span<const std::array<double, 3>> colours, std::span<const HalfCounts> counts,
                               int reflectors, std::size_t halves, double quanta_per_unit);

/// Weights for weigh(): the first picture is the sum over the first half, the second that over the other.
LayerFilmWeights half_sums(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves,
                           double quanta_per_unit);

struct Relighting {
  LayerLight light;
  LayerWeights weights;
  std::uint64_t changes = 0; ///< number of changes of the light
  LayerCells unbent, bent;   ///< cells of what is seen directly, and through glass and mirrors
  compute::Buffer<float> mean_reflectance, luminance_share; ///< FlatLight
};

/// Returns StageContext::relighting. The first call surveys on the device what the camera sees.
const Relighting& relighting_of(StageContext& world, const scene::Scene& scene);

/// Changes the light. The energy counters begin anew, but for refused contributions.
void change_light(Relighting& relighting, StageContext& world, LayerLight light);

/// Adds a film of so many cells to the plan: its sums under their name, and its cells and weighed pictures.
void plan_layer_film(const char* name, std::size_t layers, std::size_t cells, const PlanInput& input, PlanPart& part);

} // namespace nephroid::photons
