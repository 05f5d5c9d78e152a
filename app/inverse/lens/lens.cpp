// SPDX-License-Identifier: Apache-2.0
#include "inverse/lens/lens.h"

#include "base/parallel.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

/// Cells of the finest grid along its longer side: several a cell of the picture.
int most_cells(const Layout& layout) { return std::clamp(4 * std::max(layout.cells.x, layout.cells.y), 128, 512); }
/// The transport's cells: corrections do the rest sooner.
int transport_cells(const Layout& layout) { return std::min(256, most_cells(layout)); }

/// Steps of the transport.
constexpr int moves = 40;
/// How often heights are made from where the transport sends the light, which starts from the heights before.
constexpr int rounds = 3;
/// A correction that gains less, in parts of the error, gains too little.
constexpr double worth = 0.02;

glm::dvec2 domain_of(const Layout& layout) { return glm::max(layout.size, layout.receiver * layout.shrink()); }

/// Parts of a facet along a side, in which the light of the surface is seen.
int parts_of_facet(const Layout& layout) {
  const glm::dvec2 a_cell = layout.facet() / (layout.cell() * layout.shrink());
  return std::clamp(static_cast<int>(std::ceil(3 * std::max(a_cell.x, a_cell.y))), 1, 4);
}

/// The values of a centred rectangle's cells on a grid over the domain, by the parts in which cells overlap.
Grid on_grid(const Layout& layout, int grid_cells, const glm::dvec2& rectangle, const glm::ivec2& cells,
             const std::vector<double>& values) {
  const glm::dvec2 domain = domain_of(layout);
  const double cell = std::max(domain.x, domain.y) / grid_cells;
  const auto overlaps = [&](int axis) { // [cell][cell of the grid]: part of the first; x to the right, y down
    const Eigen::Index count = std::max(2L, std::lround(domain[axis] / cell)); // Transport interpolates between two
    const double step = domain[axis] / static_cast<double>(count), side = rectangle[axis] / cells[axis],
                 begin = (domain[axis] - rectangle[axis]) / 2;
    Grid parts = Grid::Zero(cells[axis], count);
    for (int i = 0; i < cells[axis]; ++i) {
      const double low = begin + i * side;
      for (auto k = static_cast<Eigen::Index>(std::max(0.0, low / step)); k < count; ++k) {
        const double from = static_cast<double>(k) * step;
        if (from >= low + side) break;
        parts(i, k) = std::max(0.0, std::min(low + side, from + step) - std::max(low, from)) / side;
      }
    }
    return parts;
  };
  const Eigen::Map<const Grid> light(values.data(), cells.y, cells.x);
  return overlaps(1).transpose() * light * overlaps(0);
}

/// As spread() blurs what falls on cells evenly: 1/8, 3/4, 1/8 along either axis.
Grid blurred(const Grid& light) {
  const auto along_rows = [](const Grid& of) {
    Grid result = 0.75 * of;
    const Eigen::Index last = of.cols() - 1;
    result.rightCols(last) += 0.125 * of.leftCols(last);
    result.leftCols(last) += 0.125 * of.rightCols(last);
    result.col(0) += 0.125 * of.col(0);
    result.col(last) += 0.125 * of.col(last);
    return result;
  };
  return along_rows(along_rows(light).transpose()).transpose();
}

std::vector<double> flat_powers(const Layout& layout) {
  std::vector<double> powers(layout.facet_count(), 1);
  for (std::size_t i = 0; i < layout.incoming().size(); ++i) powers[i] = layout.incoming()[i].power;
  return powers;
}

} // namespace

Lens::Lens(const Layout& layout, const Target& target, std::optional<double> mesh_error, Location settings)
    : layout_(layout), target_(target), mesh_error_(mesh_error), settings_(std::move(settings)),
      domain_(domain_of(layout)), fine_(layout),
      transport_(on_grid(layout, transport_cells(layout), layout.size, layout.facets, flat_powers(layout)),
                 on_grid(layout, transport_cells(layout), layout.receiver * layout.shrink(), layout.cells, target)),
      aim_(target), best_aim_(target), wanted_(wanted_of(aim_)),
      heights_of_(layout.facets.x + 1, layout.facets.y + 1, layout.facet()),
      flow_of_(static_cast<int>(wanted_.cols()), static_cast<int>(wanted_.rows()), {1, 1}),
      heights_(Grid::Zero(layout.facets.y + 1, layout.facets.x + 1)), best_heights_(heights_),
      surface_(layout.size, heights_), slopes_(layout.facet_count()) {
  fine_.facets *= parts_of_facet(layout);
  fine_.free_heights = true; // no wall stands in the light
  if (fine_.light.facets) {
    fine_.light.facets->clear();
    for (std::size_t i = 0; i < fine_.facet_count(); ++i) {
      const glm::dvec2 p = fine_.middle(i);
      Incoming& in = fine_.light.facets->emplace_back(incoming_on(layout_, p, 0));
      if (const double facet = part_within(layout, layout.middle(facet_at(layout, p)), layout.facet());
          layout.round && facet > 0)
        in.power *= part_within(fine_, p, fine_.facet()) / facet;
    }
  }
  see();
}

std::uint64_t Lens::bytes(const Layout& layout) {
  constexpr std::uint64_t grids = 24; // the transport's, the flow's, and those of light that is added up in blocks
  const auto parts = static_cast<std::uint64_t>(parts_of_facet(layout)),
             cells = static_cast<std::uint64_t>(most_cells(layout));
  const std::uint64_t bytes_a_node = sizeof(double) + sizeof(glm::dvec2) + (layout.light.facets ? sizeof(Incoming) : 0);
  return layout.facet_count() * parts * parts * bytes_a_node + grids * sizeof(double) * cells * cells;
}

/// p from the domain's top left corner, y down.
glm::dvec2 Lens::from_corner(const glm::dvec2& p) const { return {p.x + domain_.x / 2, domain_.y / 2 - p.y}; }

/// The same for a place of the receiver.
glm::dvec2 Lens::drawn(const glm::dvec2& p) const { return from_corner(layout_.shrink() * (p - layout_.offset(0))); }

Grid Lens::wanted_of(const Target& target) const {
  return blurred(on_grid(layout_, most_cells(layout_), layout_.receiver * layout_.shrink(), layout_.cells, target));
}

/// Where the transport sends the light that leaves at p, on the receiver.
glm::dvec2 Lens::goal(const glm::dvec2& p) const {
  const glm::dvec2 cell = domain_ / transport_.cells(), to = cell * transport_.map(from_corner(p) / cell);
  return layout_.offset(0) + glm::dvec2(to.x - domain_.x / 2, domain_.y / 2 - to.y) / layout_.shrink();
}

/// Where the surface sends the light that leaves at p.
glm::dvec2 Lens::landing(const glm::dvec2& p, const Surface::At& at) const {
  return p +
         facet_slope(at.gradient, layout_.n, incoming_on(layout_, p, at.z).sines) * (layout_.distances.front() + at.z);
}

/// The surface's heights, changed so that it is as steep in the middles of the facets' edges as it has to be to send
/// their light to its goal, along each edge and in the sense of least squares.
Grid Lens::bent(const std::function<glm::dvec2(const glm::dvec2&, const Surface::At&)>& goal_of) const {
  const glm::dvec2 facet = layout_.facet();
  const double distance = layout_.distances.front();
  const auto lacks = [&](double column, double row) { // by how much the surface is not steep enough
    const glm::dvec2 p = layout_.corner(column, row);
    const Surface::At at = surface_.at(p);
    const glm::dvec2 sines = incoming_on(layout_, p, at.z).sines,
                     slope = (goal_of(p, at) - p) / std::max(distance + at.z, 0.01 * distance);
    return facet_gradient(nearest_reachable(slope, layout_.n, sines, layout_.steepest), layout_.n, sines) - at.gradient;
  };
  const Eigen::Index rows = heights_.rows(), columns = heights_.cols();
  Grid across = Grid::Zero(rows, columns), down = across; // along the edges to the right and below
  for_ranges(static_cast<std::size_t>(rows), 16, [&](std::size_t, const Range& range) {
    for (auto y = static_cast<Eigen::Index>(range.begin); y < static_cast<Eigen::Index>(range.end); ++y)
      for (Eigen::Index x = 0; x < columns; ++x) {
        const auto u = static_cast<double>(x), v = static_cast<double>(y);
        if (x + 1 < columns) across(y, x) = lacks(u + 0.5, v).x / facet.x;
        if (y + 1 < rows) down(y, x) = -lacks(u, v + 0.5).y / facet.y; // rows go down, y goes up
      }
  });
  Grid source = -across - down; // minus the divergence
  source.rightCols(columns - 1) += across.leftCols(columns - 1);
  source.bottomRows(rows - 1) += down.topRows(rows - 1);
  Grid heights = heights_ + heights_of_.solve(source);
  const glm::dvec2 most = lowest_highest(heights);
  heights.array() -= (most.x + most.y) / 2;
  return heights;
}

/// The surface's z within the outline: at the facets' corners, those beside a round one being moved onto it.
glm::dvec2 Lens::lowest_highest(const Grid& heights) const {
  if (!layout_.round) return {heights.minCoeff(), heights.maxCoeff()};
  const Surface surface(layout_.size, heights);
  glm::dvec2 most(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (int row = 0; row <= layout_.facets.y; ++row)
    for (int column = 0; column <= layout_.facets.x; ++column) {
      const glm::dvec2 p = glm::dvec2(column, layout_.facets.y - row) * layout_.facet() - layout_.size / 2.0;
      const double z = surface.at(p / std::max(1.0, 2 * glm::length(p / layout_.size))).z;
      most = {std::min(most.x, z), std::max(most.y, z)};
    }
  return most;
}

void Lens::set_heights(Grid heights) {
  heights_ = std::move(heights);
  surface_ = Surface(layout_.size, heights_);
}

/// Where the corners of the facets' parts send their light, in cells of the finest grid, row by row.
std::vector<glm::dvec2> Lens::corners_land() const {
  const std::size_t columns = static_cast<std::size_t>(fine_.facets.x) + 1,
                    rows = static_cast<std::size_t>(fine_.facets.y) + 1;
  const glm::dvec2 cell = fine_cell();
  std::vector<glm::dvec2> corners(rows * columns);
  for_ranges(rows, 16, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin * columns; i < range.end * columns; ++i) {
      const std::size_t row = i / columns, column = i % columns;
      const glm::dvec2 p = fine_.corner(static_cast<double>(column), static_cast<double>(row));
      corners[i] = drawn(landing(p, surface_.at(p))) / cell;
    }
  });
  return corners;
}

/// The surface's light far away where nothing blurs it: there it is as wide as the surface bends it, not as a facet.
std::vector<double> Lens::sharp_light() const {
  constexpr Eigen::Index finer = 4, rim = 1; // a rim of cells gets what falls beside
  const glm::dvec2 part = fine_cell() / (layout_.cell() * layout_.shrink() / static_cast<double>(finer)),
                   corner = drawn(layout_.offset(0) + glm::dvec2(-1, 1) * layout_.receiver / 2.0) / fine_cell();
  std::vector<glm::dvec2> corners = corners_land();
  for (glm::dvec2& p : corners) p = (p - corner) * part + glm::dvec2(finer * rim);
  const glm::i64vec2 cells = glm::i64vec2(layout_.cells) + 2 * rim;
  const Grid all = spread(sent_by_, corners, finer * cells.y, finer * cells.x);
  std::vector<double> light;
  for (Eigen::Index y = 0; y < layout_.cells.y; ++y)
    for (Eigen::Index x = 0; x < layout_.cells.x; ++x)
      light.push_back(all.block((y + rim) * finer, (x + rim) * finer, finer, finer).sum());
  return light;
}

/// Finds the surface's light, as that of its facets' parts.
void Lens::see() {
  const std::size_t columns = static_cast<std::size_t>(fine_.facets.x), rows = static_cast<std::size_t>(fine_.facets.y),
                    blocks = 8;
  std::vector<std::vector<double>> light(blocks, std::vector<double>(layout_.cell_count()));
  sent_by_.resize(fine_.facets.y, fine_.facets.x);
  const double part = static_cast<double>(layout_.facet_count()) / static_cast<double>(fine_.facet_count());
  for_blocks(blocks, [&](std::size_t block) {
    for (std::size_t i = block * rows / blocks * columns; i < (block + 1) * rows / blocks * columns; ++i) {
      const Surface::At at = surface_.at(fine_.middle(i));
      const glm::dvec2 slope = facet_slope(at.gradient, layout_.n, incoming_on(layout_, fine_.middle(i), at.z).sines);
      sent_by_.data()[i] = part * facet_power(fine_, i, slope);
      for_cells(fine_, footprint(fine_, i, slope, 0, at.z),
                [&](std::size_t cell, double of) { light[block][cell] += sent_by_.data()[i] * of; });
    }
  });
  light_ = std::move(light.front());
  for (std::size_t block = 1; block < blocks; ++block)
    for (std::size_t c = 0; c < light_.size(); ++c) light_[c] += light[block][c];
  if (layout_.far && !layout_.blurs()) light_ = sharp_light();
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const glm::dvec2 p = layout_.middle(i);
    const Surface::At at = surface_.at(p);
    slopes_[i] = facet_slope(at.gradient, layout_.n, incoming_on(layout_, p, at.z).sines);
  }
  sent_ = sent_by_.sum();
}

/// Aims more light at cells that lack some because a lamp's size spreads it, and less at those that have too much.
void Lens::aim() {
  constexpr double most = 2; // a step's factor
  const double received = std::accumulate(light_.begin(), light_.end(), 0.0);
  double sum = 0;
  for (std::size_t c = 0; c < aim_.size(); ++c)
    sum += aim_[c] *=
        std::pow(std::clamp(received * target_[c] / std::max(light_[c], 1e-12 * received), 1 / most, most), share_);
  for (double& cell : aim_) cell /= sum;
  wanted_ = wanted_of(aim_);
}

/// Light flows from where there is too much: along the gradient of Poisson's solution, over what is there.
void Lens::correct() {
  if (layout_.far && layout_.blurs()) aim();
  Grid there = spread(sent_by_, corners_land(), wanted_.rows(), wanted_.cols());
  there *= wanted_.sum() / there.sum();
  const Spline flow(flow_of_.solve(wanted_ - there)), amount(Grid((wanted_ + there) / 2));
  const double least = 0.05 * wanted_.mean();
  const glm::dvec2 cell = fine_cell(), cells(wanted_.cols(), wanted_.rows());
  set_heights(bent([&](const glm::dvec2& p, const Surface::At& at) {
    const glm::dvec2 to = landing(p, at);
    if (layout_.is_beside(p)) return to; // there is no light to move
    const glm::dvec2 on_grid = glm::clamp(drawn(to) / cell - 0.5, glm::dvec2(0), cells - 1.0);
    const glm::dvec2 move = flow.at(on_grid).gradient * (share_ / std::max(least, amount.at(on_grid).value));
    return to + move * cell * glm::dvec2(1, -1) / layout_.shrink();
  }));
}

void Lens::advance() {
  if (moved_ < moves) {
    transport_.advance();
    if (++moved_ < moves) return;
    for (int round = 0; round < rounds; ++round)
      set_heights(bent([&](const glm::dvec2& p, const Surface::At&) { return goal(p); }));
  } else
    correct();
  ++steps_;
  see();
  const double error = costs().front().rel_l2;
  stale_ = error < best_ * (1 - worth) ? 0 : stale_ + 1;
  if (error < best_) {
    best_ = error;
    best_heights_ = heights_;
    best_aim_ = aim_;
  } else {
    share_ /= 2;
    aim_ = best_aim_;
    set_heights(best_heights_);
    see();
  }
}

double Lens::fraction_done() const { return moved_ < moves ? moved_ / static_cast<double>(moves) : 0; }

std::vector<double> Lens::heights() const {
  std::vector<double> middles;
  for (std::size_t i = 0; i < slopes_.size(); ++i) middles.push_back(surface_.at(layout_.middle(i)).z);
  return middles;
}

/// The part of the thickness, and of the way to the receiver, that a relief may take: free heights leave a tenth, too.
constexpr double most_of_room = 0.9;

Solid Lens::solid() const {
  const double reach = this->reach(); // and as far below z = 0
  const auto refuse = [&](const Location& where, double value) {
    throw bad_input(where, fmt::format("is {} mm, and half of the lens's relief is {:.4g} mm", value, reach),
                    fmt::format("expected at least {:.4g} mm", reach / most_of_room),
                    layout_.far ? "choose a larger value or a narrower target"
                                : "choose a larger value or a receiver further away");
  };
  if (reach > layout_.band)
    throw bad_input(settings_, fmt::format("the lens's relief is {:.4g} mm", 2 * reach),
                    fmt::format("'max_relief_mm', 'min_thickness_mm' and 'stock_mm' leave {:.4g} mm", 2 * layout_.band),
                    "loosen them, choose a thicker object or a receiver further away");
  if (reach > most_of_room * layout_.thickness) refuse(settings_ / "thickness_mm", layout_.thickness);
  if (reach > most_of_room * layout_.distances.front())
    refuse(settings_ / "receivers" / 0 / "distance_mm", layout_.distances.front());
  const double mesh_error = this->mesh_error();
  const std::vector<int> parts = mesh_parts(layout_, surface_, mesh_error);
  if (const std::uint64_t triangles = count_triangles(layout_, parts); stl_bytes(triangles) > most_stl_bytes)
    refuse_mesh(settings_, mesh_error, triangles);
  Solid solid = make_smooth_solid(layout_, surface_, parts);
  if (const double most = glm::degrees(std::atan(layout_.steepest)); solid.steepest_deg > most)
    throw bad_input(settings_ / "max_slope_deg",
                    fmt::format("is {:.4g} degrees, and the lens is as steep as {:.4g}", most, solid.steepest_deg),
                    "expected more than that", "choose a larger angle or a receiver further away");
  return solid;
}

void Lens::show(job::Snapshot& made) const { made.scalars.push_back({"lens", "astray", transport_.astray()}); }

void Lens::serialize(Archive& archive) {
  transport_.serialize(archive);
  archive.value(moved_);
  archive.value(steps_);
  archive.value(stale_);
  archive.value(share_);
  archive.value(best_);
  archive.items(std::span(aim_));
  archive.items(std::span(best_aim_));
  for (Grid* const grid : {&heights_, &best_heights_})
    archive.items(std::span(grid->data(), static_cast<std::size_t>(grid->size())));
  if (!archive.is_read()) return;
  constexpr double farthest = 1e7; // mm
  if (!(heights_.array().abs() < farthest).all() || !(best_heights_.array().abs() < farthest).all())
    throw bad_input("checkpoint.bin", "is of another run");
  wanted_ = wanted_of(aim_);
  set_heights(heights_);
  see();
}

} // namespace nephroid::inverse
