// SPDX-License-Identifier: Apache-2.0
#include "inverse/lens/lens.h"

#include "base/error.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

/// Cells of the grid along its longer side: several a cell of the picture, and no more than a step can do in half a second.
int grid_cells(const Layout& layout) { return std::clamp(4 * std::max(layout.cells.x, layout.cells.y), 128, 512); }
/// How often heights are made anew: light starts from them, so that they change where it has to be sent.
constexpr int rounds = 4;

glm::dvec2 domain_of(const Layout& layout) { return glm::max(layout.size, layout.receiver); }

/// What a centred rectangle of so many cells brings to each cell of the grid, by the parts in which they overlap.
Grid on_grid(const Layout& layout, const glm::dvec2& rectangle, const glm::ivec2& cells, const std::vector<double>& values)
{
  const glm::dvec2 domain = domain_of(layout);
  const double cell = std::max(domain.x, domain.y) / grid_cells(layout);
  const auto overlaps = [&](int axis) { // [cell][cell of the grid]: part of the first; x to the right, y down
    const Eigen::Index count = std::max(2L, std::lround(domain[axis] / cell)); // Transport interpolates between two
    const double step = domain[axis] / static_cast<double>(count), side = rectangle[axis] / cells[axis],
                 begin = (domain[axis] - rectangle[axis]) / 2;
    Grid parts(cells[axis], count);
    for (int i = 0; i < cells[axis]; ++i)
      for (Eigen::Index k = 0; k < count; ++k) {
        const double low = begin + i * side, from = static_cast<double>(k) * step;
        parts(i, k) = std::max(0.0, std::min(low + side, from + step) - std::max(low, from)) / side;
      }
    return parts;
  };
  const Eigen::Map<const Grid> light(values.data(), cells.y, cells.x);
  return overlaps(1).transpose() * light * overlaps(0);
}

} // namespace

Lens::Lens(const Layout& layout, const Target& target, Place settings)
    : layout_(layout), target_(target), settings_(std::move(settings)), domain_(domain_of(layout)),
      transport_(on_grid(layout, layout.size, {1, 1}, {1}), on_grid(layout, layout.receiver, layout.cells, target)),
      heights_of_(layout.facets.x + 1, layout.facets.y + 1, layout.facet()), heights_(Grid::Zero(layout.facets.y + 1, layout.facets.x + 1)),
      slopes_(layout.facet_count())
{
  make_surface();
}

/// Where the light has to go that leaves at p, on the receiver.
glm::dvec2 Lens::goal(const glm::dvec2& p) const
{
  const glm::dvec2 cell = domain_ / transport_.cells();
  const glm::dvec2 to = cell * transport_.map(glm::dvec2(p.x + domain_.x / 2, domain_.y / 2 - p.y) / cell);
  return {to.x - domain_.x / 2, domain_.y / 2 - to.y};
}

/// Of all surfaces the one whose rises along the facets' edges are closest to those that would send the light of the edges' middles where
/// it has to go, in the sense of least squares.
void Lens::make_surface()
{
  const double distance = layout_.distances.front(), limit = usable_slope(layout_);
  const glm::dvec2 facet = layout_.facet();
  const auto rise = [&](const glm::dvec2& p, double height) {
    glm::dvec2 slope = (goal(p) - p) / std::max(distance + height, 0.01 * distance); // solid() refuses to be so near
    slope *= std::min(1.0, limit / std::max(glm::length(slope), 1e-300));
    return facet_gradient(slope, layout_.n);
  };
  const Eigen::Index rows = heights_.rows(), columns = heights_.cols();
  heights_.setZero();
  const auto corner = [&](double x, double y) { return glm::dvec2(x * facet.x - layout_.size.x / 2, layout_.size.y / 2 - y * facet.y); };
  for (int round = 0; round < rounds; ++round) {
    Grid source = Grid::Zero(rows, columns); // minus the divergence of the rises
    for (Eigen::Index y = 0; y < rows; ++y)
      for (Eigen::Index x = 0; x < columns; ++x) {
        const auto u = static_cast<double>(x), v = static_cast<double>(y);
        if (x + 1 < columns) {
          const double along = rise(corner(u + 0.5, v), (heights_(y, x) + heights_(y, x + 1)) / 2).x / facet.x;
          source(y, x) -= along;
          source(y, x + 1) += along;
        }
        if (y + 1 < rows) { // rows go down, y goes up
          const double along = rise(corner(u, v + 0.5), (heights_(y, x) + heights_(y + 1, x)) / 2).y / facet.y;
          source(y, x) += along;
          source(y + 1, x) -= along;
        }
      }
    heights_ = heights_of_.solve(source);
    heights_.array() -= (heights_.minCoeff() + heights_.maxCoeff()) / 2;
  }

  light_.assign(1, std::vector<double>(layout_.cell_count()));
  const auto columns_of = static_cast<std::size_t>(layout_.facets.x);
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const auto x = static_cast<Eigen::Index>(i % columns_of), y = static_cast<Eigen::Index>(i / columns_of);
    const double a = heights_(y, x), b = heights_(y, x + 1), c = heights_(y + 1, x), d = heights_(y + 1, x + 1);
    slopes_[i] = facet_slope({(b + d - a - c) / (2 * facet.x), (a + b - c - d) / (2 * facet.y)}, layout_.n);
    add_light(layout_, i, slopes_[i], 1, light_, (a + b + c + d) / 4);
  }
}

void Lens::advance()
{
  transport_.advance();
  ++steps_;
  if (transport_.astray() < best_ * 0.99) {
    best_ = transport_.astray();
    best_step_ = steps_;
  }
  make_surface();
}

std::vector<double> Lens::heights() const
{
  std::vector<double> middles;
  for (Eigen::Index y = 0; y + 1 < heights_.rows(); ++y)
    for (Eigen::Index x = 0; x + 1 < heights_.cols(); ++x) middles.push_back(heights_.block<2, 2>(y, x).mean());
  return middles;
}

std::vector<Cost> Lens::costs() const { return {cost_of(target_, light_.front(), light_sent(layout_, slopes_))}; }

Solid Lens::solid() const
{
  const double reach = heights_.maxCoeff(); // and as far below z = 0
  const auto refuse = [&](const Place& where, double value) {
    throw bad_input(where, fmt::format("is {} mm, and half of the lens's relief is {:.4g} mm", value, reach), "expected more than that",
                    "choose a larger value or a receiver further away");
  };
  if (reach >= layout_.thickness) refuse(settings_ / "thickness_mm", layout_.thickness);
  if (reach >= layout_.distances.front()) refuse(settings_ / "receivers" / 0 / "distance_mm", layout_.distances.front());
  if (reach > layout_.band)
    throw bad_input(settings_, fmt::format("the lens's relief is {:.4g} mm", 2 * reach),
                    fmt::format("'max_relief_mm' and 'min_thickness_mm' leave {:.4g} mm", 2 * layout_.band),
                    "loosen them, choose a larger thickness_mm or a receiver further away");
  Solid solid = make_smooth_solid(layout_, {heights_.data(), heights_.data() + heights_.size()});
  if (const double most = glm::degrees(std::atan(layout_.steepest)); solid.steepest_deg > most)
    throw bad_input(settings_ / "max_slope_deg",
                    fmt::format("is {:.4g} degrees, and the lens is as steep as {:.4g}", most, solid.steepest_deg),
                    "expected more than that", "choose a larger angle or a receiver further away");
  return solid;
}

void Lens::show(job::Snapshot& made) const { made.scalars.push_back({"lens", "astray", transport_.astray()}); }

void Lens::state(State& state)
{
  transport_.state(state);
  state.value(steps_);
  state.value(best_step_);
  state.value(best_);
  if (state.is_read()) make_surface();
}

} // namespace nephroid::inverse
