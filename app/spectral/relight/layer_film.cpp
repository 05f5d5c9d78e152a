// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/layer_film.h"

#include <algorithm>
#include <cmath>

namespace nephroid::spectral {

static_assert(sizeof(LayerWeight) == 6 * sizeof(float), "the weights as kernels/spectral/relight_weigh.cl reads them");

LayerFilm::LayerFilm(const compute::Context& context, const std::string& name, const LayerCells& cells, std::size_t layers,
                     std::size_t halves, const compute::Defines& defines)
    : context_(context), layers_(layers), halves_(halves), pixels_(cells.first.size() - 1), cell_count_(cells.count()),
      first_(context, name + ": cells of each pixel", std::span<const int>(cells.first)),
      reflector_of_block_(context, name + ": reflectors", std::span<const int>(cells.reflector_of_block)),
      cells_(context, name + ": cells", std::span<const shared::LayerCell>(cells.cells)),
      sums_(context, name, halves * layers * cell_count_), weighed_(context, name + ": weighed", 6 * cell_count_),
      pictures_(context, name + ": pictures", 6 * pixels_)
{
  const compute::Program program(context, "spectral/relight_weigh.cl", defines);
  weigh_ = program.kernel("weigh");
  gather_ = program.kernel("gather_cells");
  sums_.fill_zero();
}

std::array<std::vector<float>, 2> LayerFilm::weigh(const LayerFilmWeights& by)
{
  std::array<std::vector<float>, 2> pictures;
  for (std::vector<float>& picture : pictures) picture.resize(3 * pixels_);
  if (cell_count_ == 0) return pictures;
  const std::span<const float> numbers(by.weights.front().first.data(), 6 * by.weights.size());
  if (weights_.size() == numbers.size())
    weights_.write(numbers);
  else
    weights_ = compute::Buffer<float>(context_, "weights of layers", numbers);
  weigh_.run(cell_count_ / 8, 64,
             {{"sums", sums_},
              {"block_count", static_cast<int>(cell_count_ / LAYER_BLOCK)},
              {"rows", static_cast<int>(halves_ * layers_)},
              {"reflector_of_block", reflector_of_block_},
              {"weights", weights_},
              {"weighed", weighed_}});
  gather_.run(
      pixels_, 64,
      {{"first", first_}, {"cells", cells_}, {"weighed", weighed_}, {"pixel_count", static_cast<int>(pixels_)}, {"pictures", pictures_}});
  const std::size_t bytes = 3 * pixels_ * sizeof(float);
  pictures_.RawBuffer::read(pictures[0].data(), bytes, 0);
  pictures_.RawBuffer::read(pictures[1].data(), bytes, bytes);
  const double unit = std::ldexp(1.0, by.exponent);
  for (std::vector<float>& picture : pictures)
    for (float& value : picture) value = static_cast<float>(value * unit);
  return pictures;
}

std::vector<LayerSums> LayerFilm::pixel(std::size_t index) const
{
  std::vector<LayerSums> cells;
  std::array<int, 2> range{};
  first_.RawBuffer::read(range.data(), sizeof(range), index * sizeof(int));
  for (int i = range[0]; i < range[1]; ++i) {
    shared::LayerCell cell{};
    cells_.RawBuffer::read(&cell, sizeof(cell), static_cast<std::size_t>(i) * sizeof(cell));
    const auto number = static_cast<std::size_t>(cell.cell);
    std::vector<std::int64_t> block(halves_ * layers_ * LAYER_BLOCK);
    const std::size_t bytes = block.size() * sizeof(std::int64_t);
    sums_.RawBuffer::read(block.data(), bytes, number / LAYER_BLOCK * bytes);
    LayerSums sums{cell.reflector, {}};
    for (std::size_t row = 0; row < halves_ * layers_; ++row)
      sums.sums.push_back(static_cast<double>(block[row * LAYER_BLOCK + number % LAYER_BLOCK]));
    cells.push_back(std::move(sums));
  }
  return cells;
}

namespace {

/// factors(half, layer): what a layer's colours are multiplied by in the two pictures.
template <class Factors>
LayerFilmWeights make_weights(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves, Factors factors)
{
  const auto r_count = static_cast<std::size_t>(reflectors);
  const std::size_t layers = r_count > 0 ? colours.size() / r_count : 0;
  std::vector<std::array<double, 6>> exact;
  exact.reserve(r_count * halves * layers);
  double largest = 0;
  for (std::size_t r = 0; r < r_count; ++r)
    for (std::size_t half = 0; half < halves; ++half)
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const auto [first, second] = factors(half, layer);
        const std::array<double, 3>& c = colours[layer * r_count + r];
        exact.push_back({c[0] * first, c[1] * first, c[2] * first, c[0] * second, c[1] * second, c[2] * second});
        for (const double value : exact.back()) largest = std::max(largest, std::abs(value));
      }
  LayerFilmWeights weights{{}, largest > 0 ? std::ilogb(largest) : 0};
  weights.weights.reserve(exact.size());
  const auto number = [&](double value) { return static_cast<float>(std::ldexp(value, -weights.exponent)); };
  for (const std::array<double, 6>& v : exact)
    weights.weights.push_back({{number(v[0]), number(v[1]), number(v[2])}, {number(v[3]), number(v[4]), number(v[5])}});
  return weights;
}

} // namespace

LayerFilmWeights mean_and_draw(std::span<const std::array<double, 3>> colours, std::span<const HalfCounts> counts, int reflectors,
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

LayerFilmWeights half_sums(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves, double quanta_per_unit)
{
  return make_weights(colours, reflectors, halves, [&](std::size_t half, std::size_t) -> std::array<double, 2> {
    return half == 0 ? std::array{1 / quanta_per_unit, 0.0} : std::array{0.0, 1 / quanta_per_unit};
  });
}

} // namespace nephroid::spectral
