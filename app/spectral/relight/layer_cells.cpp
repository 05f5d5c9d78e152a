// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/layer_cells.h"

#include <algorithm>
#include <numeric>

namespace nephroid::spectral {
namespace {

/// How often a pixel sees a reflector; its own samples count more than all of its neighbours' together.
struct Seen {
  int reflector = 0, count = 0;
};

void add_samples(const Survey& survey, int x, int y, int weight, std::vector<Seen>& list)
{
  const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(survey.width) + static_cast<std::size_t>(x);
  const auto samples = static_cast<std::size_t>(survey.samples);
  for (const int reflector : survey.seen.subspan(pixel * samples, samples)) {
    if (reflector < 0) continue;
    const auto seen = std::find_if(list.begin(), list.end(), [&](const Seen& s) { return s.reflector == reflector; });
    if (seen == list.end())
      list.push_back({reflector, weight});
    else
      seen->count += weight;
  }
}

/// Of a pixel's own sample, where one of a neighbour's has 1.
int own_weight(const Survey& survey) { return 1 + 8 * survey.samples; }

/// What a pixel sees, by falling count; of equal ones the smaller number first.
void look(const Survey& survey, int x, int y, std::vector<Seen>& list)
{
  list.clear();
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (x + dx >= 0 && x + dx < survey.width && y + dy >= 0 && y + dy < survey.height)
        add_samples(survey, x + dx, y + dy, dx == 0 && dy == 0 ? own_weight(survey) : 1, list);
  std::sort(list.begin(), list.end(),
            [](const Seen& a, const Seen& b) { return a.count != b.count ? a.count > b.count : a.reflector < b.reflector; });
}

constexpr std::size_t spare_cells = 8192; // small pictures may have edges everywhere

std::size_t pixel_count(const shared::DeviceCamera& camera)
{
  return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

/// Numbers the cells reflector by reflector.
void number_cells(int reflector_count, LayerCells& result)
{
  std::vector<int> next(static_cast<std::size_t>(reflector_count) + 1, 0);
  for (const shared::LayerCell& cell : result.cells) ++next[static_cast<std::size_t>(cell.reflector) + 1];
  for (int r = 0; r < reflector_count; ++r) {
    const int blocks = (next[static_cast<std::size_t>(r) + 1] + LAYER_BLOCK - 1) / LAYER_BLOCK;
    result.reflector_of_block.insert(result.reflector_of_block.end(), static_cast<std::size_t>(blocks), r);
    next[static_cast<std::size_t>(r) + 1] = next[static_cast<std::size_t>(r)] + blocks * LAYER_BLOCK;
  }
  for (shared::LayerCell& cell : result.cells) cell.cell = next[static_cast<std::size_t>(cell.reflector)]++;
}

} // namespace

LayerCells make_layer_cells(const Survey& survey, std::size_t most, bool every_pixel)
{
  const std::size_t pixels = static_cast<std::size_t>(survey.width) * static_cast<std::size_t>(survey.height);
  std::vector<std::vector<Seen>> seen(pixels);
  std::size_t longest = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::vector<Seen> list;
    look(survey, static_cast<int>(i) % survey.width, static_cast<int>(i) / survey.width, list);
    if (list.empty() && every_pixel && survey.reflector_count > 0) list.push_back({i > 0 ? seen[i - 1][0].reflector : 0, 0});
    longest = std::max(longest, list.size());
    seen[i] = std::move(list);
  }
  // Every pixel gets its first reflector before any gets its second, and what it sees itself before what its neighbours see.
  std::vector<std::size_t> kept(pixels, 0);
  std::size_t left = most;
  for (const int fewest : {own_weight(survey), 0})
    for (std::size_t rank = 0; rank < longest && left > 0; ++rank)
      for (std::size_t i = 0; i < pixels && left > 0; ++i)
        if (kept[i] == rank && seen[i].size() > rank && seen[i][rank].count >= fewest) ++kept[i], --left;

  LayerCells result;
  for (std::size_t i = 0; i < pixels; ++i) {
    result.first.push_back(static_cast<int>(result.cells.size()));
    for (std::size_t k = 0; k < kept[i]; ++k) result.cells.push_back({seen[i][k].reflector, 0});
  }
  result.first.push_back(static_cast<int>(result.cells.size()));
  number_cells(survey.reflector_count, result);
  return result;
}

std::size_t padded_cells(std::size_t cells, int reflector_count)
{
  // Each reflector leaves at most one block less than full.
  const std::size_t blocks = cells / LAYER_BLOCK + static_cast<std::size_t>(std::max(reflector_count, 1));
  return LAYER_BLOCK * blocks;
}

std::size_t unbent_cells(const shared::DeviceCamera& camera)
{
  const std::size_t pixels = pixel_count(camera);
  return pixels + pixels / 4 + spare_cells;
}

std::size_t bent_cells(const shared::DeviceCamera& camera, std::span<const scene::Sphere> spheres)
{
  const auto vec = [](const shared::float4& v) { return glm::vec3(v.x, v.y, v.z); };
  const glm::vec3 position = vec(camera.position), right = vec(camera.right), up = vec(camera.up), forward = vec(camera.forward);
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const std::size_t pixels = pixel_count(camera);
  // Cells go to neighbours too, and places are anywhere in a pixel: about two pixels beyond a sphere.
  const float margin = 6 * std::max(camera.tan_x / width, camera.tan_y / height);
  const auto may_see = [&](const glm::vec3& way, const scene::Sphere& sphere) {
    const glm::vec3 to = sphere.centre - position;
    const float depth = glm::dot(to, forward), reach = sphere.radius + margin * depth;
    if (depth <= sphere.radius) return depth > -sphere.radius; // beside the camera or about it
    const glm::vec3 aside = glm::cross(to, way);
    return glm::dot(aside, aside) <= reach * reach;
  };
  std::size_t bent = camera.inside.count > 0 ? pixels : 0;
  for (int pixel = 0; bent < pixels && pixel < camera.width * camera.height; ++pixel) {
    const int column = pixel % camera.width, row = pixel / camera.width;
    const float x = 2 * (static_cast<float>(column) + 0.5f) / width - 1, y = 1 - 2 * (static_cast<float>(row) + 0.5f) / height;
    const glm::vec3 way = glm::normalize(forward + x * camera.tan_x * right + y * camera.tan_y * up);
    if (std::any_of(spheres.begin(), spheres.end(), [&](const scene::Sphere& sphere) { return may_see(way, sphere); })) ++bent;
  }
  return bent > 0 ? 2 * bent + spare_cells : 0;
}

} // namespace nephroid::spectral
