// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/posts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

void join_close_heights(std::array<double, 4>& heights, double joins)
{
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
  for (std::size_t i = 1; i < 4; ++i)
    if (heights[order[i]] - heights[order[i - 1]] < joins) heights[order[i]] = heights[order[i - 1]];
}

Vertex add(const glm::dvec2& at, double z, scene::Mesh& mesh)
{
  mesh.positions.emplace_back(glm::vec3(glm::dvec3(at, z)));
  return {z, static_cast<std::uint32_t>(mesh.positions.size() - 1)};
}

/// Where all four walls share a stretch: vertices that pair them.
void pair_walls(Post& post, const glm::dvec2& at, scene::Mesh& mesh)
{
  for (const std::size_t low : {std::size_t{0}, std::size_t{1}}) { // a low facet; the other is low + 2
    const double bottom = std::max(post.ends[low].z, post.ends[low + 2].z),
                 top = std::min(post.ends[low + 1].z, post.ends[(low + 3) % 4].z);
    if (bottom >= top) continue;
    const Vertex lower = add(at, 0.75 * bottom + 0.25 * top, mesh), middle = add(at, 0.5 * bottom + 0.5 * top, mesh),
                 upper = add(at, 0.25 * bottom + 0.75 * top, mesh);
    const std::size_t one_high = low + 1, other_low = low + 2;
    // The walls of facet f are those before and after it.
    const auto is_of = [](std::size_t wall, std::size_t f) { return wall == f || (wall + 1) % 4 == f; };
    for (std::size_t wall = 0; wall < 4; ++wall) {
      std::vector<Vertex>& between = post.between[wall];
      if (is_of(wall, one_high)) between.push_back(lower);
      between.push_back(middle);
      if (is_of(wall, other_low)) between.push_back(upper);
    }
  }
}

} // namespace

Post make_post(const glm::dvec2& at, std::array<double, 4> heights, double joins, scene::Mesh& mesh)
{
  join_close_heights(heights, joins);
  Post post;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto before = std::find(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(f), heights[f]);
    const auto same = static_cast<std::size_t>(before - heights.begin());
    post.ends[f] = same < f ? post.ends[same] : add(at, heights[f], mesh);
  }
  pair_walls(post, at, mesh);
  for (std::size_t wall = 0; wall < 4; ++wall) {
    const double a = heights[wall], b = heights[(wall + 1) % 4];
    std::vector<Vertex>& between = post.between[wall];
    for (const Vertex& end : post.ends)
      if (end.z > std::min(a, b) && end.z < std::max(a, b)) between.push_back(end);
    std::sort(between.begin(), between.end(), [](const Vertex& p, const Vertex& q) { return p.z < q.z; });
    const auto last = std::unique(between.begin(), between.end(), [](const Vertex& p, const Vertex& q) { return p.id == q.id; });
    between.erase(last, between.end());
  }
  return post;
}

std::vector<Vertex> end_of_wall(const Post& post, std::size_t wall)
{
  Vertex low = post.ends[wall], high = post.ends[(wall + 1) % 4];
  if (low.id == high.id) return {low};
  if (low.z > high.z) std::swap(low, high);
  std::vector<Vertex> all{low};
  all.insert(all.end(), post.between[wall].begin(), post.between[wall].end());
  all.push_back(high);
  return all;
}

} // namespace nephroid::inverse
