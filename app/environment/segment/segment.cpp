// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/segment.h"

#include "base/error.h"
#include "environment/segment/cuts.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace nephroid::environment {
namespace {

/// A region while it may be cut further.
struct Piece {
  int face = 0;
  Rect rect;
  Moments moments;
  double importance = 0; ///< of most importance is cut next

  auto place() const { return std::tuple(face, rect.y0, rect.x0); }
  bool operator<(const Piece& other) const
  {
    return importance < other.importance || (importance == other.importance && place() > other.place());
  }
};

class Segmenter {
public:
  Segmenter(const CubeMap& cube, const SegmentSettings& settings) : cube_(cube), settings_(settings), weighed_(cube, settings.weights) {}

  Segmentation result()
  {
    start();
    while (pieces_.size() + done_.size() < static_cast<std::size_t>(settings_.lights) && !pieces_.empty()) cut_next();
    for (; !pieces_.empty(); pieces_.pop()) done_.push_back(pieces_.top());
    return finished();
  }

private:
  void start()
  {
    const Rect whole{0, 0, cube_.size, cube_.size};
    std::array<Moments, face_count> faces;
    for (int face = 0; face < face_count; ++face) {
      faces[static_cast<std::size_t>(face)] = weighed_.sum(face, whole);
      least_ += settings_.threshold * faces[static_cast<std::size_t>(face)].m0;
    }
    for (int face = 0; face < face_count; ++face) add(face, whole, faces[static_cast<std::size_t>(face)]);
  }

  bool is_dark(const Moments& moments) const { return !(moments.m0 > least_); }

  void add(int face, const Rect& rect, const Moments& moments)
  {
    const Piece piece{face, rect, moments, settings_.method == SegmentMethod::thesis ? moments.m0 : moments.variance()};
    if (is_dark(moments))
      dropped_.push_back(piece);
    else
      pieces_.push(piece);
  }

  /// A piece that cannot be cut, or of which no light would be left, is passed over.
  void cut_next()
  {
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

  glm::dvec3 flux_of(int face, const Rect& rect) const
  {
    glm::dvec3 all{0};
    for (int y = rect.y0; y < rect.y1; ++y) {
      glm::dvec3 row{0};
      for (int x = rect.x0; x < rect.x1; ++x) row += cube_.flux_of(cube_.texel(face, x, y));
      all += row;
    }
    return all;
  }

  Region region_of(const Piece& piece) const
  {
    const Rect& r = piece.rect;
    // Moments along s, t and outwards are a point of the face, scaled; a black piece has none, so it gets the middle of its rectangle.
    const glm::dvec3 m = piece.moments.m1;
    const CubePoint centre = m.z > 0 ? CubePoint{piece.face, m.x / m.z, m.y / m.z}
                                     : CubePoint{piece.face, (border(r.x0, cube_.size) + border(r.x1, cube_.size)) / 2,
                                                 (border(r.y0, cube_.size) + border(r.y1, cube_.size)) / 2};
    const double spread = m.z > 0 ? std::acos(std::min(1.0, glm::length(m) / piece.moments.m0)) : 0;
    return {piece.face, r, glm::normalize(position(centre)), flux_of(piece.face, r), solid_angle(r, cube_.size), glm::degrees(spread)};
  }

  std::vector<Region> regions_of(std::vector<Piece>& pieces) const
  {
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.place() < b.place(); });
    std::vector<Region> regions;
    for (const Piece& piece : pieces) regions.push_back(region_of(piece));
    return regions;
  }

  Segmentation finished()
  {
    Segmentation result{cube_.size, glm::dvec3(0), regions_of(done_), regions_of(dropped_)};
    for (int face = 0; face < face_count; ++face) result.total_flux += flux_of(face, {0, 0, cube_.size, cube_.size});
    for (const Region& dark : result.dropped) {
      if (dark.flux == glm::dvec3(0) || result.lights.empty()) continue;
      const auto nearer = [&](const Region& a, const Region& b) {
        return glm::dot(a.direction, dark.direction) < glm::dot(b.direction, dark.direction);
      };
      std::max_element(result.lights.begin(), result.lights.end(), nearer)->flux += dark.flux;
    }
    return result;
  }

  const CubeMap& cube_;
  const SegmentSettings& settings_;
  WeighedCube weighed_;
  double least_ = 0; ///< what weighs no more is no light
  std::priority_queue<Piece> pieces_;
  std::vector<Piece> done_, dropped_;
};

} // namespace

Segmentation segment(const CubeMap& cube, const SegmentSettings& settings)
{
  if (settings.lights < face_count)
    throw bad_input("q", fmt::format("is {}", settings.lights), "expected 6 or more, as a cube has 6 faces");
  return Segmenter(cube, settings).result();
}

Segmentation even_segments(const CubeMap& cube, int lights)
{
  int across = 1;
  while (face_count * across * across < lights) ++across;
  const auto place = [&](int i) { // at equal angles, which gives about equal solid angles
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
            region.direction += luminance(flux) * glm::normalize(position({face, middle(x, cube.size), middle(y, cube.size)}));
          }
        region.direction = glm::normalize(region.direction);
        result.total_flux += region.flux;
        result.lights.push_back(region);
      }
  return result;
}

} // namespace nephroid::environment
