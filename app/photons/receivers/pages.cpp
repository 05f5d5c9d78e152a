// SPDX-License-Identifier: Apache-2.0
#include "photons/receivers/pages.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace nephroid::photons {
namespace {

/// Slabs of an object that has depth. Two surfaces in one slab that face the same way share their texels.
constexpr int slabs_of_depth = 16;

/// Looks on a page, and the page.
struct Asked {
  std::uint32_t page = 0;
  std::vector<std::uint32_t> looks; ///< those that want finer texels
};

} // namespace

Charts make_charts(const scene::Scene& scene) {
  Charts charts;
  for (const scene::Object& object : scene.objects) {
    shared::DeviceCharts receiver{{}, 0, NO_PAGE, 0};
    if (is_matt(material_of(scene, object).type)) {
      const scene::Bounds bounds = bounds_of(scene, object);
      const glm::dvec3 size = bounds.high - bounds.low;
      const double largest = std::max({size.x, size.y, size.z}), edge = 1.002 * largest; // places are within it
      const glm::dvec3 low = (bounds.low + bounds.high) / 2.0 - edge / 2;
      receiver.low[0] = static_cast<float>(low.x);
      receiver.low[1] = static_cast<float>(low.y);
      receiver.low[2] = static_cast<float>(low.z);
      receiver.per_unit = static_cast<float>(1 / edge);
      receiver.first_chart = static_cast<int>(charts.count);
      receiver.slabs = std::min({size.x, size.y, size.z}) < 1e-6 * largest ? 1 : slabs_of_depth;
      charts.count += CHARTS_OF_SLAB * static_cast<std::size_t>(receiver.slabs);
    }
    charts.receivers.push_back(receiver);
  }
  return charts;
}

PageTrees make_pages(std::span<const shared::DeviceLook> looks, std::size_t charts, std::size_t most) {
  PageTrees trees;
  trees.roots.assign(charts, NO_PAGE);
  trees.first_pages.push_back(0);
  std::vector<Asked> level;
  for (std::uint32_t i = 0; i < looks.size(); ++i) {
    int& root = trees.roots[static_cast<std::size_t>(looks[i].chart)];
    if (root == NO_PAGE) {
      root = static_cast<int>(trees.pages.size());
      trees.pages.push_back({NO_PAGE, NO_PAGE, 0, 0, 0});
      level.push_back({static_cast<std::uint32_t>(root), {}});
    }
    if (looks[i].level > 0) level[static_cast<std::size_t>(root)].looks.push_back(i);
  }
  while (!level.empty()) {
    trees.first_pages.push_back(static_cast<std::uint32_t>(trees.pages.size()));
    std::ranges::stable_sort(level, [](const Asked& a, const Asked& b) { return a.looks.size() > b.looks.size(); });
    std::vector<Asked> next;
    for (const Asked& asked : level) {
      if (asked.looks.size() < least_looks || trees.pages.size() + 4 > most) break;
      const shared::DevicePage page = trees.pages[asked.page];
      const auto first = static_cast<std::uint32_t>(trees.pages.size());
      trees.pages[asked.page].child = static_cast<int>(first);
      std::array<Asked, 4> children;
      for (unsigned child = 0; child < 4; ++child) {
        children[child].page = first + child;
        trees.pages.push_back({NO_PAGE, static_cast<int>(asked.page), 2 * page.x + static_cast<int>(child & 1),
                               2 * page.y + static_cast<int>(child >> 1), page.level + 1});
      }
      const auto across = static_cast<float>(2 << page.level);
      for (const std::uint32_t i : asked.looks) {
        const bool right = looks[i].x * across >= static_cast<float>(2 * page.x + 1),
                   down = looks[i].y * across >= static_cast<float>(2 * page.y + 1);
        if (looks[i].level > page.level + 1) children[(down ? 2 : 0) + (right ? 1 : 0)].looks.push_back(i);
      }
      for (Asked& child : children) next.push_back(std::move(child));
    }
    level = std::move(next);
  }
  return trees;
}

} // namespace nephroid::photons
