// SPDX-License-Identifier: Apache-2.0
// Columns and rows of the lattice in which some picture is dark all along are left out, and no product is kept: a row's
// sum is, and a draw computes its row again.
#include "inverse/thesis/sampler.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/uniform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

/// Facets of one advance(), and of one thread's turn.
constexpr std::size_t piece = 512, turn = 16;

} // namespace

/// The lattice's slopes along one axis, without those that have probability 0 whatever the other axis has.
struct Sampler::Axis {
  std::vector<double> slopes;
  std::vector<std::vector<int>> cells; ///< [aim][slope], counted with the rim; 0: beside
  std::vector<std::uint32_t> hits;     ///< [slope]: a bit for each aim whose receiver it meets
};

struct Sampler::Lattice {
  Axis x, y;
  std::vector<double> sums; ///< sums of the products of all rows up to this one
  double most = 0;          ///< the largest product
  glm::dvec2 sines{0};      ///< those of the light on the facet
};

Sampler::Sampler(const Layout& layout, const std::vector<SamplingTarget>& aims, const Thesis& settings)
    : layout_(layout), directions_(settings.directions), sampling_(settings.sampling) {
  const int columns = layout.cells.x + 2, rows = layout.cells.y + 2;
  for (const SamplingTarget& aim : aims) {
    distances_.push_back(aim.distance);
    std::vector<double> padded(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), aim.beside);
    std::vector<char> lit_columns(static_cast<std::size_t>(columns), aim.beside > 0),
        lit_rows(static_cast<std::size_t>(rows), aim.beside > 0);
    for (int y = 1; y <= layout.cells.y; ++y)
      for (int x = 1; x <= layout.cells.x; ++x) {
        const double value = aim.picture[index_at(x - 1, y - 1, layout.cells.x)];
        padded[index_at(x, y, columns)] = value;
        if (value <= 0) continue;
        lit_columns[static_cast<std::size_t>(x)] = 1;
        lit_rows[static_cast<std::size_t>(y)] = 1;
      }
    padded_.push_back(std::move(padded));
    lit_columns_.push_back(std::move(lit_columns));
    lit_rows_.push_back(std::move(lit_rows));
  }
}

Sampler::Axis Sampler::axis(std::size_t facet, int along) const {
  const double from = layout_.middle(facet)[along], half = layout_.receiver[along] / 2;
  const double limit = layout_.light.facets ? std::numeric_limits<double>::infinity() : usable_slope(layout_);
  double low = limit, high = -limit;
  for (const double distance : distances_) {
    low = std::min(low, (-half - from) / distance);
    high = std::max(high, (half - from) / distance);
  }
  const auto& lit = along == 0 ? lit_columns_ : lit_rows_;
  Axis made{{}, std::vector<std::vector<int>>(distances_.size()), {}};
  std::vector<int> cells(distances_.size());
  for (int i = 0; i < directions_; ++i) {
    const double slope = low + (high - low) * (i + 0.5) / directions_;
    if (std::abs(slope) > limit) continue;
    std::uint32_t hits = 0;
    bool dark = false;
    for (std::size_t j = 0; j < distances_.size() && !dark; ++j) {
      const double at = from + slope * distances_[j],
                   cell = (along == 0 ? at + half : half - at) / layout_.cell()[along];
      const bool hit = cell >= 0 && cell < layout_.cells[along];
      if (hit) hits |= std::uint32_t{1} << j;
      cells[j] = hit ? static_cast<int>(cell) + 1 : 0;
      dark = lit[j][static_cast<std::size_t>(cells[j])] == 0;
    }
    if (dark || hits == 0) continue;
    made.slopes.push_back(slope);
    made.hits.push_back(hits);
    for (std::size_t j = 0; j < cells.size(); ++j) made.cells[j].push_back(cells[j]);
  }
  return made;
}

double Sampler::product(const Lattice& lattice, std::size_t column, std::size_t row) const {
  if ((lattice.x.hits[column] & lattice.y.hits[row]) == 0) return 0;
  if (!reachable({lattice.x.slopes[column], lattice.y.slopes[row]}, layout_.n, lattice.sines, layout_.steepest))
    return 0;
  double product = 1;
  for (std::size_t j = 0; j < padded_.size(); ++j)
    product *= padded_[j][index_at(lattice.x.cells[j][column], lattice.y.cells[j][row], layout_.cells.x + 2)];
  return product;
}

/// The same for all of a row.
void Sampler::multiply_row(const Lattice& lattice, std::size_t row, std::vector<double>& products) const {
  const std::size_t across = lattice.x.slopes.size();
  const double y = lattice.y.slopes[row];
  const std::uint32_t hits = lattice.y.hits[row];
  products.resize(across);
  for (std::size_t i = 0; i < across; ++i) {
    products[i] = (hits & lattice.x.hits[i]) != 0 &&
                          reachable({lattice.x.slopes[i], y}, layout_.n, lattice.sines, layout_.steepest)
                      ? 1.0
                      : 0.0;
  }
  for (std::size_t j = 0; j < padded_.size(); ++j) {
    const double* const cells =
        padded_[j].data() + static_cast<std::ptrdiff_t>(lattice.y.cells[j][row]) * (layout_.cells.x + 2);
    const int* const cell = lattice.x.cells[j].data();
    for (std::size_t i = 0; i < across; ++i) products[i] *= cells[cell[i]];
  }
}

Sampler::Lattice Sampler::lattice(std::size_t facet) const {
  Lattice made{axis(facet, 0), axis(facet, 1), {}, 0, layout_.sines_on(facet)};
  std::vector<double> products;
  double sum = 0;
  for (std::size_t row = 0; row < made.y.slopes.size(); ++row) {
    multiply_row(made, row, products);
    for (const double product : products) {
      sum += product;
      made.most = std::max(made.most, product);
    }
    made.sums.push_back(sum);
  }
  return made;
}

Draws Sampler::draw(std::size_t facet, int count, std::mt19937_64& random) const {
  const Lattice all = lattice(facet);
  Draws draws;
  if (all.most <= 0) return draws;
  std::vector<double> products;
  const auto take = [&](std::size_t column, std::size_t row) {
    draws.slopes.emplace_back(all.x.slopes[column], all.y.slopes[row]);
    for (std::size_t j = 0; j < distances_.size(); ++j) {
      const int x = all.x.cells[j][column] - 1, y = all.y.cells[j][row] - 1;
      draws.cells.push_back(x < 0 || y < 0 ? -1 : y * layout_.cells.x + x);
    }
  };
  const auto exact = [&] {
    const double to = uniform(random) * all.sums.back();
    const auto row =
        static_cast<std::size_t>(std::upper_bound(all.sums.begin(), all.sums.end(), to) - all.sums.begin());
    multiply_row(all, row, products);
    double sum = row > 0 ? all.sums[row - 1] : 0;
    std::size_t column = 0;
    while ((sum += products[column]) <= to) ++column; // adds as lattice() did, so the row's last sum is above
    take(column, row);
  };
  const auto rejection = [&] {
    for (;;) {
      const auto column = static_cast<std::size_t>(uniform(random) * static_cast<double>(all.x.slopes.size()));
      const auto row = static_cast<std::size_t>(uniform(random) * static_cast<double>(all.y.slopes.size()));
      if (uniform(random) * all.most < product(all, column, row)) return take(column, row);
    }
  };
  for (int i = 0; i < count; ++i) sampling_ == Thesis::Sampling::exact ? exact() : rejection();
  return draws;
}

std::vector<glm::dvec2> flat_slopes(const Layout& layout) {
  std::vector<glm::dvec2> slopes(layout.facet_count());
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = flat_slope(layout.sines_on(i));
  return slopes;
}

Trial::Trial(const Layout& layout, const std::vector<SamplingTarget>& aims, const Thesis& settings, std::uint64_t seed)
    : layout_(layout), settings_(settings), seed_(seed), sampler_(layout, aims, settings),
      counts_(aims.size(), std::vector<std::uint32_t>(layout.cell_count())), slopes_(flat_slopes(layout)) {}

void Trial::advance() {
  const std::size_t count = std::min(piece, layout_.facet_count() - next_), receivers = counts_.size();
  std::vector<Draws> found(count);
  for_ranges(count, turn, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      std::mt19937_64 random = numbers_of(seed_, next_ + i);
      found[i] = sampler_.draw(next_ + i, settings_.draws, random);
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    if (found[i].slopes.empty())
      ++dark_;
    else
      slopes_[next_ + i] = found[i].slopes.front();
    for (std::size_t k = 0; k < found[i].cells.size(); ++k)
      if (const int cell = found[i].cells[k]; cell >= 0) ++counts_[k % receivers][static_cast<std::size_t>(cell)];
  }
  next_ += count;
}

TrialResult Trial::drawn() const {
  TrialResult drawn{{}, slopes_, dark_};
  for (const auto& counts : counts_) {
    drawn.light.emplace_back(counts.begin(), counts.end());
    for (double& light : drawn.light.back()) light /= settings_.draws;
  }
  return drawn;
}

void Trial::serialize(Archive& archive) {
  archive.value(next_);
  for (auto& counts : counts_) archive.items(counts);
  archive.items(slopes_);
  archive.value(dark_);
}

} // namespace nephroid::inverse
