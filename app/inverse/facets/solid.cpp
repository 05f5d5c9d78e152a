// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/solid.h"

#include "inverse/bending.h"
#include "inverse/facets/heights.h"

#include <glm/gtc/constants.hpp>

namespace nephroid::inverse {
namespace {

/// Heights closer than corners_join are made equal, and also those closer than this part of the height: a post cuts a
/// stretch into four, and each must be some steps of single precision long.
constexpr double tells_apart = 0x1p-19;

/// A vertex of the mesh, with its height in double precision.
struct Vertex {
  double z = 0;
  std::uint32_t id = 0;
};

/// A vertical line where four facets meet, and the vertices on it. Each facet ends at a height of its own, and a wall
/// stands between each two neighbours. Along the line the walls' ends overlap; for every stretch of it to be an edge of
/// two walls, a wall's end has vertices wherever another one begins or ends. Where two facets across from each other
/// are both higher than the two others, all four walls share the stretch between. There they are joined in pairs by
/// edges of their own, told apart by one vertex more: at the lower end around the higher facets, at the upper end
/// around the lower ones. So the surface does not touch itself in a vertex either. Facets around are counted
/// counter-clockwise seen from above (+z): 0 is at +x +y. Wall k stands between facets k and k + 1.
struct Post {
  std::array<Vertex, 4> ends; ///< where each facet around ends; equal heights are one vertex
  /// Where all four walls share a stretch: vertices that pair them, ascending, and a low facet; the other is low + 2.
  std::array<Vertex, 3> pairs{};
  std::optional<std::size_t> low;
};

void join_close_heights(std::array<double, 4>& heights, double joins) {
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
  for (std::size_t i = 1; i < 4; ++i)
    if (heights[order[i]] - heights[order[i - 1]] < joins) heights[order[i]] = heights[order[i - 1]];
}

Vertex add_vertex(const glm::dvec2& at, double z, Solid& solid) { return {z, solid.add({at, z})}; }

void pair_walls(Post& post, const glm::dvec2& at, Solid& solid) {
  for (const std::size_t low : {std::size_t{0}, std::size_t{1}}) {
    const double bottom = std::max(post.ends[low].z, post.ends[low + 2].z),
                 top = std::min(post.ends[low + 1].z, post.ends[(low + 3) % 4].z);
    if (bottom >= top) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const double part = 0.25 * static_cast<double>(i + 1);
      post.pairs[i] = add_vertex(at, (1 - part) * bottom + part * top, solid);
    }
    post.low = low;
  }
}

/// Heights that are closer than `joins` become one, so that no triangle is thinner than single precision can tell.
Post make_post(const glm::dvec2& at, std::array<double, 4> heights, double joins, Solid& solid) {
  join_close_heights(heights, joins);
  Post post;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto before = std::find(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(f), heights[f]);
    const auto same = static_cast<std::size_t>(before - heights.begin());
    post.ends[f] = same < f ? post.ends[same] : add_vertex(at, heights[f], solid);
  }
  pair_walls(post, at, solid);
  return post;
}

/// A wall's end from the bottom to the top, both ends included; one vertex where there is no wall.
std::vector<Vertex> end_of_wall(const Post& post, std::size_t wall) {
  Vertex low = post.ends[wall], high = post.ends[(wall + 1) % 4];
  if (low.id == high.id) return {low};
  if (low.z > high.z) std::swap(low, high);
  std::vector<Vertex> all{low, high};
  for (const Vertex& end : post.ends)
    if (end.z > low.z && end.z < high.z) all.push_back(end);
  if (post.low) {
    // The walls of facet f are those before and after it.
    const auto is_of = [&](std::size_t f) { return wall == f || (wall + 1) % 4 == f; };
    if (is_of(*post.low + 1)) all.push_back(post.pairs[0]);
    all.push_back(post.pairs[1]);
    if (is_of(*post.low + 2)) all.push_back(post.pairs[2]);
  }
  std::sort(all.begin(), all.end(), [](const Vertex& p, const Vertex& q) { return p.z < q.z; });
  all.erase(std::unique(all.begin(), all.end(), [](const Vertex& p, const Vertex& q) { return p.id == q.id; }),
            all.end());
  return all;
}

class Builder {
public:
  /// `solid` has its facets.
  Builder(const Layout& layout, Solid solid)
      : layout_(layout), nx_(layout.facets.x), ny_(layout.facets.y), solid_(std::move(solid)) {}

  Solid build() {
    make_posts();
    make_walls();
    for (int row = 0; row < ny_; ++row)
      for (int column = 0; column < nx_; ++column) make_facet(column, row);
    make_front();
    return std::move(solid_);
  }

private:
  /// Around a post: 0 at +x +y, 1 at -x +y, 2 at -x -y, 3 at +x -y.
  static constexpr std::array<glm::ivec2, 4> around{
      glm::ivec2{0, -1}, {-1, -1}, {-1, 0}, {0, 0}}; ///< facet's column and row over the post's

  bool is_facet(int column, int row) const { return column >= 0 && row >= 0 && column < nx_ && row < ny_; }

  /// z of a facet at so much from its middle; beside the object that of the front, which makes sides of walls.
  double height(int column, int row, const glm::dvec2& from_middle) const {
    if (!is_facet(column, row)) return layout_.thickness;
    const Facet& facet = solid_.facets[index_at(column, row, nx_)];
    return facet.height + glm::dot(facet.gradient, from_middle);
  }

  const Post& post(int a, int b) const { return posts_[index_at(a, b, nx_ + 1)]; }

  void make_posts() {
    const glm::dvec2 half = layout_.facet() / 2.0;
    double farthest = 0;
    for (const Facet& f : solid_.facets)
      farthest = std::max(farthest, std::abs(f.height) + glm::dot(glm::abs(f.gradient), half));
    const double closest =
        std::max(corners_join * std::min(layout_.facet().x, layout_.facet().y), tells_apart * farthest);
    const std::array<glm::dvec2, 4> corner{
        glm::dvec2{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
    for (int b = 0; b <= ny_; ++b)
      for (int a = 0; a <= nx_; ++a) {
        std::array<double, 4> heights{};
        for (std::size_t f = 0; f < 4; ++f) heights[f] = height(a + around[f].x, b + around[f].y, corner[f]);
        posts_.push_back(make_post(layout_.corner(a, b), heights, closest, solid_));
        for (std::size_t f = 0; f < 4; ++f)
          if (is_facet(a + around[f].x, b + around[f].y)) solid_.reach(heights[f]);
      }
  }

  /// Between two vertical lines; seen from the side where `a` is at the left, it faces the viewer unless it is turned.
  void strip(const std::vector<Vertex>& a, const std::vector<Vertex>& b, bool turned, Part part) {
    std::size_t i = 0, k = 0;
    while (i + 1 < a.size() || k + 1 < b.size()) {
      const bool on_a = k + 1 == b.size() || (i + 1 < a.size() && a[i + 1].z <= b[k + 1].z);
      const std::uint32_t next = on_a ? a[++i].id : 0;
      const std::uint32_t low_a = on_a ? a[i - 1].id : a[i].id, low_b = b[k].id;
      const std::uint32_t third = on_a ? next : b[++k].id;
      turned ? solid_.add(low_b, low_a, third, part) : solid_.add(low_a, low_b, third, part);
    }
  }

  /// The wall over the line from post a to b, at whose right hand (seen from above) facet p ends at ap and bp, and q at
  /// the left at aq and bq. Its air is on the higher facet's side. It has two parts where the edges cross, and returns
  /// that vertex.
  std::optional<Vertex> wall(const Post& a, const Post& b, std::size_t wall_a, std::size_t wall_b,
                             std::array<Vertex, 4> ends, const glm::dvec2& at_a, const glm::dvec2& at_b, Part part) {
    const auto [ap, aq, bp, bq] = ends;
    const double height_a = ap.z - aq.z, height_b = bp.z - bq.z;
    if (part == Part::wall) measure(height_a, height_b, glm::length(at_b - at_a));
    const std::vector<Vertex> end_a = end_of_wall(a, wall_a), end_b = end_of_wall(b, wall_b);
    if (height_a * height_b >= 0) {
      strip(end_a, end_b, height_a + height_b < 0, part);
      return std::nullopt;
    }
    const double t = height_a / (height_a - height_b);
    const Vertex crossing = add_vertex(at_a + t * (at_b - at_a), ap.z + t * (bp.z - ap.z), solid_);
    strip(end_a, {crossing}, height_a < 0, part);
    strip({crossing}, end_b, height_b < 0, part);
    return crossing;
  }

  /// A wall that is so high at its ends; the signs differ where the facets' edges cross.
  void measure(double height_a, double height_b, double length) {
    const double a = std::abs(height_a), b = std::abs(height_b);
    solid_.highest_wall = std::max({solid_.highest_wall, a, b});
    if (a + b > 0) solid_.wall_area += length / 2 * (height_a * height_b >= 0 ? a + b : (a * a + b * b) / (a + b));
  }

  Part part_between(int column, int row, int other_column, int other_row) const {
    return is_facet(column, row) && is_facet(other_column, other_row) ? Part::wall : Part::side;
  }

  void make_walls() {
    for (int b = 0; b < ny_; ++b) // down from each post: wall 2 of the upper one, wall 0 of the lower one
      for (int a = 0; a <= nx_; ++a) {
        const Post &up = post(a, b), &down = post(a, b + 1);
        down_.push_back(wall(up, down, 2, 0, {up.ends[2], up.ends[3], down.ends[1], down.ends[0]}, layout_.corner(a, b),
                             layout_.corner(a, b + 1), part_between(a - 1, b, a, b)));
      }
    for (int b = 0; b <= ny_; ++b) // across: wall 3 of the left one, wall 1 of the right one
      for (int a = 0; a < nx_; ++a) {
        const Post &left = post(a, b), &right = post(a + 1, b);
        across_.push_back(wall(left, right, 3, 1, {left.ends[3], left.ends[0], right.ends[2], right.ends[1]},
                               layout_.corner(a, b), layout_.corner(a + 1, b), part_between(a, b, a, b - 1)));
      }
  }

  /// A fan about the facet's middle, clockwise seen from above: it faces down.
  void make_facet(int column, int row) {
    std::vector<std::uint32_t> ring;
    const auto corner = [&](int a, int b, std::size_t f) { ring.push_back(post(a, b).ends[f].id); };
    const auto crossing = [&](const std::optional<Vertex>& vertex) {
      if (vertex) ring.push_back(vertex->id);
    };
    corner(column, row, 3);
    crossing(across_[index_at(column, row, nx_)]);
    corner(column + 1, row, 2);
    crossing(down_[index_at(column + 1, row, nx_ + 1)]);
    corner(column + 1, row + 1, 1);
    crossing(across_[index_at(column, row + 1, nx_)]);
    corner(column, row + 1, 0);
    crossing(down_[index_at(column, row, nx_ + 1)]);
    const auto facet = index_at(column, row, nx_);
    const std::uint32_t middle = solid_.add({layout_.middle(facet), solid_.facets[facet].height});
    for (std::size_t i = 0; i < ring.size(); ++i) solid_.add(middle, ring[i], ring[(i + 1) % ring.size()], Part::facet);
  }

  /// The vertex of a post on the rim at the front's height, where the facets beside the object end.
  std::uint32_t at_front(int a, int b) const {
    for (std::size_t f = 0;; ++f)
      if (!is_facet(a + around[f].x, b + around[f].y)) return post(a, b).ends[f].id;
  }

  /// Strips along y, one a column, so that rays find their triangle soon; the outer ones share their sides' vertices.
  void make_front() {
    const auto side = [&](int a) {
      std::vector<Vertex> ascending; // along y, which stands for the height here
      const int step = a == 0 || a == nx_ ? 1 : ny_;
      for (int b = ny_; b >= 0; b -= step) ascending.push_back({layout_.corner(a, b).y, at_front(a, b)});
      return ascending;
    };
    for (int a = 0; a < nx_; ++a) strip(side(a), side(a + 1), false, Part::front);
  }

  const Layout& layout_;
  int nx_, ny_;
  std::vector<Post> posts_;
  std::vector<std::optional<Vertex>> down_, across_; ///< crossings on the lines from a post down and to the right
  Solid solid_;
};

} // namespace

Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights) {
  Solid solid;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    solid.facets.push_back({slopes[i], facet_gradient(slopes[i], layout.n, layout.sines_on(i)), heights[i]});
    solid.lean(solid.facets.back().gradient);
  }
  return layout.draft > 0 ? with_leaning_walls(layout, std::move(solid)) : Builder(layout, std::move(solid)).build();
}

Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes) {
  return make_solid(layout, slopes, heights_of(layout, slopes));
}

} // namespace nephroid::inverse
