// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/segment.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <queue>
#include <tuple>

namespace nephroid::environment {
namespace {

/// A region while it may be cut further.
struct Piece {
  int face = 0;
  Rect rect;
  Moments moments;
  double importance = 0; ///< the piece with most is cut next

  auto place() const { return std::tuple(face, rect.y0, rect.x0); }
  bool operator<(const Piece& other) const {
    return importance < other.importance || (importance == other.importance && place() > other.place());
  }
};

class Segmenter {
public:
  Segmenter(const CubeMap& cube, const SegmentSettings& settings)
      : cube_(cube), settings_(settings), weighed_(cube, settings.weights) {}

  Segmentation result() {
    start();
    while (pieces_.size() + done_.size() < static_cast<std::size_t>(settings_.lights) && !pieces_.empty()) cut_next();
    for (; !pieces_.empty(); pieces_.pop()) done_.push_back(pieces_.top());
    return finished();
  }

private:
  void start() {
    const Rect whole{0, 0, cube_.size, cube_.size};
    std::array<Moments, face_count> faces;
    for (int face = 0; face < face_count; ++face) {
      faces[static_cast<std::size_t>(face)] = weighed_.sum(face, whole);
      least_ += settings_.threshold * faces[static_cast<std::size_t>(face)].m0;
    }
    for (int face = 0; face < face_count; ++face) add(face, whole, faces[static_cast<std::size_t>(face)]);
  }

  bool is_dark(const Moments& moments) const { return !(moments.m0 > least_); }

  void add(int face, const Rect& rect, const Moments& moments) {
    const Piece piece{face, rect, moments, settings_.method == SegmentMethod::thesis ? moments.m0 : moments.variance()};
    if (is_dark(moments))
      dropped_.push_back(piece);
    else
      pieces_.push(piece);
  }

  /// Cuts the next piece. One that cannot be cut, or whose parts would both be dark, stays as it is.
  void cut_next() {
    const Piece piece = pieces_.top();
    pieces_.pop();
    const std::optional<Cut> cut = best_cut(weighed_, piece.face, piece.rect, settings_.method);
    if (!cut || (is_dark(cut->first_moments) && is_dark(cut->second_moments))) {
      done_.push_back(piece);
      return;
    }
    add(piece.face, cut->first, cut->first_moments);
    add(piece.face, cut->second, cut->second_moments);
  }

  glm::dvec3 flux_of(int face, const Rect& rect) const {
    glm::dvec3 all{0};
    for (int y = rect.y0; y < rect.y1; ++y) {
      glm::dvec3 row{0};
      for (int x = rect.x0; x < rect.x1; ++x) row += cube_.flux_of(cube_.texel(face, x, y));
      all += row;
    }
    return all;
  }

  Region region_of(const Piece& piece) const {
    const Rect& r = piece.rect;
    // Moments along s, t and outwards are a scaled point of the face. A black piece gets the middle of its rectangle.
    const glm::dvec3 m = piece.moments.m1;
    const CubePoint centre = m.z > 0 ? CubePoint{piece.face, m.x / m.z, m.y / m.z}
                                     : CubePoint{piece.face, (border(r.x0, cube_.size) + border(r.x1, cube_.size)) / 2,
                                                 (border(r.y0, cube_.size) + border(r.y1, cube_.size)) / 2};
    return {piece.face, r, glm::normalize(position(centre)), flux_of(piece.face, r), solid_angle(r, cube_.size)};
  }

  std::vector<Region> regions_of(std::vector<Piece>& pieces) const {
    std::ranges::sort(pieces, [](const Piece& a, const Piece& b) { return a.place() < b.place(); });
    std::vector<Region> regions;
    for (const Piece& piece : pieces) regions.push_back(region_of(piece));
    return regions;
  }

  Segmentation finished() {
    Segmentation result{cube_.size, glm::dvec3(0), regions_of(done_), regions_of(dropped_)};
    for (int face = 0; face < face_count; ++face) result.total_flux += flux_of(face, {0, 0, cube_.size, cube_.size});
    for (const Region& dark : result.dropped) {
      if (dark.flux == glm::dvec3(0) || result.lights.empty()) continue;
      const auto nearer = [&](const Region& a, const Region& b) {
        return glm::dot(a.direction, dark.direction) < glm::dot(b.direction, dark.direction);
      };
      std::ranges::max_element(result.lights, nearer)->flux += dark.flux;
    }
    return result;
  }

  const CubeMap& cube_;
  const SegmentSettings& settings_;
  WeighedCube weighed_;
  double least_ = 0; ///< a piece that weighs no more is no light
  std::priority_queue<Piece> pieces_;
  std::vector<Piece> done_, dropped_;
};

/// The relative rounding of sums of positive numbers.
constexpr double rounding = 1e-12;

struct Candidate {
  int at = 0; ///< lines before the cut; 0: there is none
  double cost = 0;
  Moments before, after;
};

double cost_of(const Moments& before, const Moments& after, SegmentMethod method) {
  return method == SegmentMethod::thesis ? std::abs(before.m0 - after.m0) : before.variance() + after.variance();
}

/// lines: the sums of rows or of columns. Both sides are sums of lines: a difference may be mere rounding.
Candidate best_between(const std::vector<Moments>& lines, SegmentMethod method) {
  const std::size_t count = lines.size();
  if (count < 2) return {};
  std::vector<Moments> after(count); // [i]: the sum of lines i and on
  after.back() = lines.back();
  for (std::size_t i = count - 1; i-- > 0;) (after[i] = after[i + 1]) += lines[i];
  std::vector<double> costs(count);
  Moments before;
  for (std::size_t i = 1; i < count; ++i) {
    before += lines[i - 1];
    costs[i] = cost_of(before, after[i], method);
  }
  const double least = *std::min_element(costs.begin() + 1, costs.end()), enough = least + rounding * after.front().m0;
  std::size_t at = 0;
  const auto from_middle = [&](std::size_t i) { return std::abs(2 * static_cast<long>(i) - static_cast<long>(count)); };
  for (std::size_t i = 1; i < count; ++i)
    if (costs[i] <= enough && (at == 0 || from_middle(i) < from_middle(at))) at = i;
  Candidate best{static_cast<int>(at), costs[at], {}, after[at]};
  for (std::size_t i = 0; i < at; ++i) best.before += lines[i];
  return best;
}

double squared_deviation(int across, int down) {
  const double aspect = static_cast<double>(std::max(across, down)) / std::min(across, down);
  return (aspect - 1) * (aspect - 1);
}

/// Dev (3.2) of two rectangles `side` wide, which share `length` as `at` and the rest.
double deviation(int side, int length, int at) {
  return squared_deviation(side, at) + squared_deviation(side, length - at);
}

bool is_cut_across(const Rect& rect, const Candidate& across, const Candidate& along, SegmentMethod method,
                   double weight) {
  if (across.at == 0 || along.at == 0) return along.at == 0;
  if (method == SegmentMethod::thesis)
    return deviation(rect.width(), rect.height(), across.at) <= deviation(rect.height(), rect.width(), along.at);
  if (std::abs(across.cost - along.cost) <= rounding * weight) return rect.height() >= rect.width();
  return across.cost < along.cost;
}

} // namespace

Segmentation segment(const CubeMap& cube, const SegmentSettings& settings) {
  if (settings.lights < face_count)
    throw bad_input("q", fmt::format("is {}", settings.lights), "expected 6 or more, as a cube has 6 faces");
  return Segmenter(cube, settings).result();
}

Segmentation even_segments(const CubeMap& cube, int lights) {
  int across = 1;
  while (face_count * across * across < lights) ++across;
  const auto place = [&](int i) { // borders at equal angles have about equal solid angles
    const double angle = glm::radians(45.0) * (2.0 * i / across - 1);
    return static_cast<int>(std::lround((1 + std::tan(angle)) / 2 * cube.size));
  };
  Segmentation result{cube.size, glm::dvec3(0), {}, {}};
  for (int face = 0; face < face_count; ++face)
    for (int row = 0; row < across; ++row)
      for (int column = 0; column < across; ++column) {
        const Rect rect{place(column), place(row), place(column + 1), place(row + 1)};
        Region region{face, rect, glm::dvec3(0), glm::dvec3(0), solid_angle(rect, cube.size)};
        for (int y = rect.y0; y < rect.y1; ++y)
          for (int x = rect.x0; x < rect.x1; ++x) {
            const glm::dvec3 flux = cube.flux_of(cube.texel(face, x, y));
            region.flux += flux;
            region.direction +=
                luminance(flux) * glm::normalize(position({face, middle(x, cube.size), middle(y, cube.size)}));
          }
        region.direction = glm::normalize(region.direction);
        result.total_flux += region.flux;
        result.lights.push_back(region);
      }
  return result;
}

double Moments::variance() const {
  if (!(m0 > 0)) return 0;
  const double value = m0 - glm::dot(m1, m1) / m0;
  return value > rounding * m0 ? value : 0;
}

WeighedCube::WeighedCube(const CubeMap& cube, SegmentWeights weights)
    : size_(cube.size), side_(static_cast<std::size_t>(cube.size)), weights_(face_count * side_ * side_),
      outwards_(side_ * side_) {
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      const double s = middle(x, size_), t = middle(y, size_);
      outwards_[cube.texel(0, x, y)] = 1 / std::sqrt(1 + s * s + t * t);
      const double share = weights == SegmentWeights::texel ? 1 / solid_angle({x, y, x + 1, y + 1}, size_) : 1;
      for (int face = 0; face < face_count; ++face) {
        const std::size_t texel = cube.texel(face, x, y);
        weights_[texel] = share * luminance(cube.flux_of(texel));
      }
    }
}

Moments WeighedCube::sum(int face, const Rect& rect) const {
  Moments all;
  for (int y = rect.y0; y < rect.y1; ++y) {
    Moments row;
    for (int x = rect.x0; x < rect.x1; ++x) row += of(face, x, y);
    all += row;
  }
  return all;
}

std::optional<Cut> best_cut(const WeighedCube& cube, int face, const Rect& rect, SegmentMethod method) {
  std::vector<Moments> rows(static_cast<std::size_t>(rect.height())), columns(static_cast<std::size_t>(rect.width()));
  double weight = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    Moments& row = rows[static_cast<std::size_t>(y - rect.y0)];
    for (int x = rect.x0; x < rect.x1; ++x) {
      const Moments texel = cube.of(face, x, y);
      row += texel;
      columns[static_cast<std::size_t>(x - rect.x0)] += texel;
    }
    weight += row.m0;
  }
  const Candidate across = best_between(rows, method), along = best_between(columns, method);
  if (across.at == 0 && along.at == 0) return std::nullopt;
  if (is_cut_across(rect, across, along, method, weight)) {
    const int y = rect.y0 + across.at;
    return Cut{{rect.x0, rect.y0, rect.x1, y}, {rect.x0, y, rect.x1, rect.y1}, across.before, across.after};
  }
  const int x = rect.x0 + along.at;
  return Cut{{rect.x0, rect.y0, x, rect.y1}, {x, rect.y0, rect.x1, rect.y1}, along.before, along.after};
}

} // namespace nephroid::environment
