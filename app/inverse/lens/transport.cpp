// SPDX-License-Identifier: Apache-2.0
#include "inverse/lens/transport.h"

#include "base/parallel.h"
#include "inverse/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

/// A step grows or shrinks by this where it gains more, or less, than these parts of what the gradient promises. Each
/// side has a step of its own: with one for both, that of the brighter picture's side overshoots.
constexpr double grows = 1.25, shrinks = 0.8, much = 0.75, little = 0.25;

/// min over j of (cell (i - j))^2 / 2 + f(j) for every i (Felzenszwalb and Huttenlocher 2012).
void lower_envelope(const double* f, double* out, int count, double cell) {
  std::vector<int> of(static_cast<std::size_t>(count));
  std::vector<double> begins(static_cast<std::size_t>(count) + 1);
  const double curvature = cell * cell;
  const auto at = [&](int j) { return f[j] / curvature + 0.5 * j * j; };
  std::size_t top = 0;
  of[0] = 0;
  begins[0] = -std::numeric_limits<double>::infinity();
  for (int j = 1; j < count; ++j) {
    double meets = 0;
    for (;; --top) {
      meets = (at(j) - at(of[top])) / (j - of[top]);
      if (meets > begins[top]) break;
    }
    ++top;
    of[top] = j;
    begins[top] = meets;
  }
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    while (k < top && begins[k + 1] < i) ++k;
    const double away = cell * (i - of[k]);
    out[i] = away * away / 2 + f[of[k]];
  }
}

/// A potential's gradient at the corner between four cells; on the rim that of the nearest corner inside.
glm::dvec2 gradient_at(const Grid& u, int column, int row, double cell) {
  const int right = std::clamp(column, 1, static_cast<int>(u.cols()) - 1), left = right - 1;
  const int down = std::clamp(row, 1, static_cast<int>(u.rows()) - 1), up = down - 1;
  return {(u(up, right) + u(down, right) - u(up, left) - u(down, left)) / (2 * cell),
          (u(down, left) + u(down, right) - u(up, left) - u(up, right)) / (2 * cell)};
}

void deposit(Grid& into, const glm::dvec2& p, double light) {
  const double x = std::clamp(p.x - 0.5, 0.0, static_cast<double>(into.cols() - 1));
  const double y = std::clamp(p.y - 0.5, 0.0, static_cast<double>(into.rows() - 1));
  const auto i = std::min(static_cast<Eigen::Index>(x), into.cols() - 2),
             k = std::min(static_cast<Eigen::Index>(y), into.rows() - 2);
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(k);
  into(k, i) += light * (1 - u) * (1 - v);
  into(k, i + 1) += light * u * (1 - v);
  into(k + 1, i) += light * (1 - u) * v;
  into(k + 1, i + 1) += light * u * v;
}

std::span<double> values(Grid& grid) { return {grid.data(), static_cast<std::size_t>(grid.size())}; }

/// Samples along a side: two for each cell that it is stretched over.
constexpr double most_samples = 32;

/// The light of `from` where x -> x - gradient(potential)(x) brings it. `cell` is the side of a cell.
Grid pushed(const Grid& from, const Grid& potential, double cell) {
  const auto rows = static_cast<int>(from.rows()), columns = static_cast<int>(from.cols());
  std::vector<glm::dvec2> corners;
  corners.reserve(index_at(0, rows + 1, columns + 1));
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) corners.push_back(glm::dvec2(x, y) - gradient_at(potential, x, y, cell) / cell);
  return spread(from, corners, rows, columns);
}

} // namespace

Grid conjugate(const Grid& f, double cell) {
  const auto rows = static_cast<int>(f.rows()), columns = static_cast<int>(f.cols());
  Grid along(rows, columns), turned(columns, rows), result(columns, rows);
  for_blocks(static_cast<std::size_t>(rows), [&](std::size_t row) {
    const auto r = static_cast<Eigen::Index>(row);
    const Eigen::RowVectorXd minus = -f.row(r);
    lower_envelope(minus.data(), along.row(r).data(), columns, cell);
  });
  turned = along.transpose();
  for_blocks(static_cast<std::size_t>(columns), [&](std::size_t column) {
    const auto c = static_cast<Eigen::Index>(column);
    lower_envelope(turned.row(c).data(), result.row(c).data(), rows, cell);
  });
  return result.transpose();
}

Grid spread(const Grid& light, const std::vector<glm::dvec2>& corners, Eigen::Index rows, Eigen::Index columns) {
  constexpr Eigen::Index most_blocks = 8; // each has a grid of its own
  const Eigen::Index blocks = std::min(most_blocks, light.rows()), across = light.cols() + 1;
  std::vector<Grid> parts(static_cast<std::size_t>(blocks));
  for_blocks(parts.size(), [&](std::size_t block) {
    Grid& into = parts[block];
    into = Grid::Zero(rows, columns);
    const auto i = static_cast<Eigen::Index>(block);
    for (Eigen::Index y = i * light.rows() / blocks; y < (i + 1) * light.rows() / blocks; ++y)
      for (Eigen::Index x = 0; x + 1 < across; ++x) {
        if (light(y, x) == 0) continue;
        const glm::dvec2* const upper = corners.data() + y * across + x;
        const glm::dvec2* const lower = upper + across;
        const glm::dvec2 wide = glm::max(glm::abs(upper[1] - upper[0]) + glm::abs(lower[0] - upper[0]),
                                         glm::abs(lower[1] - lower[0]) + glm::abs(lower[1] - upper[1]));
        const int samples = static_cast<int>(std::clamp(std::ceil(2 * std::max(wide.x, wide.y)), 1.0, most_samples));
        const double part = light(y, x) / (samples * samples);
        for (int k = 0; k < samples * samples; ++k) {
          const double u = (k % samples + 0.5) / samples,
                       v = (k / samples + 0.5) / samples; // NOLINT(bugprone-integer-division)
          deposit(into, glm::mix(glm::mix(upper[0], upper[1], u), glm::mix(lower[0], lower[1], u), v), part);
        }
      }
  });
  Grid sum = Grid::Zero(rows, columns);
  for (const Grid& part : parts) sum += part;
  return sum;
}

Transport::Transport(Grid from, Grid to)
    : from_(std::move(from)), to_(std::move(to)),
      cell_(1.0 / static_cast<double>(std::max(from_.rows(), from_.cols()))),
      poisson_(static_cast<int>(from_.cols()), static_cast<int>(from_.rows()), {cell_, cell_}),
      phi_{Grid::Zero(from_.rows(), from_.cols())}, psi_(phi_) {
  const double area = cell_ * cell_;
  from_ /= from_.sum() * area;
  to_ /= to_.sum() * area;
  phi_.step = psi_.step = 8 / std::max(from_.maxCoeff(), to_.maxCoeff());
}

double Transport::value() const {
  return cell_ * cell_ * (phi_.potential.cwiseProduct(to_).sum() + psi_.potential.cwiseProduct(from_).sum());
}

void Transport::move(Side& side, const Grid& wanted, const Grid& arrived, Side& other) {
  const double before = value();
  const Grid lack = wanted - arrived, direction = poisson_.solve(lack);
  side.potential += side.step * direction;
  const double expected = side.step * cell_ * cell_ * lack.cwiseProduct(direction).sum();
  other.potential = conjugate(side.potential, cell_);
  const double gain = value() - before;
  if (gain > much * expected)
    side.step *= grows;
  else if (gain < little * expected)
    side.step *= shrinks;
}

void Transport::advance() {
  const Grid arrived = pushed(from_, psi_.potential, cell_);
  astray_ = cell_ * cell_ * (arrived - to_).cwiseAbs().sum() / 2;
  move(phi_, to_, arrived, psi_);
  move(psi_, from_, pushed(to_, phi_.potential, cell_), phi_);
}

glm::dvec2 Transport::map(const glm::dvec2& p) const {
  const int x = std::clamp(static_cast<int>(p.x), 0, static_cast<int>(from_.cols()) - 1);
  const int y = std::clamp(static_cast<int>(p.y), 0, static_cast<int>(from_.rows()) - 1);
  const glm::dvec2 at = p - glm::dvec2(x, y);
  const auto way = [&](int u, int v) { return gradient_at(psi_.potential, x + u, y + v, cell_) / cell_; };
  return p - glm::mix(glm::mix(way(0, 0), way(1, 0), at.x), glm::mix(way(0, 1), way(1, 1), at.x), at.y);
}

void Transport::serialize(Archive& archive) {
  for (Side* const side : {&phi_, &psi_}) {
    archive.items(values(side->potential));
    archive.value(side->step);
  }
  archive.value(astray_);
}

} // namespace nephroid::inverse
