// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/layer_film.h"

#include <cmath>

namespace nephroid::spectral {

static_assert(sizeof(LayerWeight) == 6 * sizeof(float), "the weights as kernels/relight_weigh.cl reads them");

LayerFilm::LayerFilm(const compute::Context& context, const std::string& name, const LayerCells& cells, std::size_t layers,
                     std::size_t halves, const compute::Defines& defines)
    : context_(context), layers_(layers), halves_(halves), pixels_(cells.first.size() - 1), cell_count_(cells.count()),
      first_(context, name + ": cells of each pixel", std::span<const int>(cells.first)),
      reflector_of_block_(context, name + ": reflectors", std::span<const int>(cells.reflector_of_block)),
      cells_(context, name + ": cells", std::span<const shared::LayerCell>(cells.cells)),
      sums_(context, name, halves * layers * cell_count_), weighed_(context, name + ": weighed", 6 * cell_count_),
      pictures_(context, name + ": pictures", 6 * pixels_)
{
  const compute::Program program(context, "relight_weigh.cl", defines);
  weigh_ = program.kernel("weigh");
  gather_ = program.kernel("gather_cells");
  sums_.fill_zero();
}

std::array<std::vector<float>, 2> LayerFilm::weigh(std::span<const LayerWeight> weights)
{
  std::array<std::vector<float>, 2> pictures;
  for (std::vector<float>& picture : pictures) picture.resize(3 * pixels_);
  if (cell_count_ == 0) return pictures;
  const std::span<const float> numbers(weights.front().first.data(), 6 * weights.size());
  if (weights_.size() == numbers.size())
    weights_.write(numbers);
  else
    weights_ = compute::Buffer<float>(context_, "weights of layers", numbers);
  weigh_.run(cell_count_ / 8, 64, sums_, static_cast<int>(cell_count_ / LAYER_BLOCK), static_cast<int>(halves_ * layers_),
             reflector_of_block_, weights_, weighed_);
  gather_.run(pixels_, 64, first_, cells_, weighed_, static_cast<int>(pixels_), pictures_);
  const std::size_t bytes = 3 * pixels_ * sizeof(float);
  pictures_.RawBuffer::read(pictures[0].data(), bytes, 0);
  pictures_.RawBuffer::read(pictures[1].data(), bytes, bytes);
  return pictures;
}

namespace {

/// weight(half, layer) -> factors of the two pictures.
template <class Factors>
std::vector<LayerWeight> make_weights(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves, Factors factors)
{
  const auto r_count = static_cast<std::size_t>(reflectors);
  const std::size_t layers = r_count > 0 ? colours.size() / r_count : 0;
  std::vector<LayerWeight> weights;
  weights.reserve(r_count * halves * layers);
  for (std::size_t r = 0; r < r_count; ++r)
    for (std::size_t half = 0; half < halves; ++half)
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const std::array<double, 2> by = factors(half, layer);
        LayerWeight& weight = weights.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
          weight.first[c] = static_cast<float>(colours[layer * r_count + r][c] * by[0]);
          weight.second[c] = static_cast<float>(colours[layer * r_count + r][c] * by[1]);
        }
      }
  return weights;
}

} // namespace

std::vector<LayerWeight> mean_and_draw(std::span<const std::array<double, 3>> colours, std::span<const HalfCounts> counts, int reflectors,
                                       std::size_t halves, double quanta_per_unit)
{
  return make_weights(colours, reflectors, halves, [&](std::size_t half, std::size_t layer) -> std::array<double, 2> {
    const auto [a, b] = counts[layer];
    if (a + b <= 0) return {0, 0};
    const double mean = 1 / ((a + b) * quanta_per_unit);
    if (a <= 0 || b <= 0) return {mean, 0};
    // (A / a - B / b) sqrt(a b) / (a + b), with the sums A and B
    return {mean, half == 0 ? mean * std::sqrt(b / a) : -mean * std::sqrt(a / b)};
  });
}

std::vector<LayerWeight> half_sums(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves,
                                   double quanta_per_unit)
{
  return make_weights(colours, reflectors, halves, [&](std::size_t half, std::size_t) -> std::array<double, 2> {
    return half == 0 ? std::array{1 / quanta_per_unit, 0.0} : std::array{0.0, 1 / quanta_per_unit};
  });
}

} // namespace nephroid::spectral
