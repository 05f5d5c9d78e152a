// SPDX-License-Identifier: Apache-2.0
// Where light on receivers is kept: the charts of a scene's diffuse objects, and for each a quadtree of pages of texels
// that is as fine as the eye asks for (kernels/photons/receiver.h).
#pragma once
#include "kernels/photons/receiver_types.h"
#include "scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::photons {

struct Charts {
  std::vector<shared::DeviceCharts> receivers; ///< [object]
  std::size_t count = 0;
};

/// Charts of every diffuse object. A flat one that faces an axis has one slab.
Charts make_charts(const scene::Scene& scene);

struct PageTrees {
  std::vector<shared::DevicePage> pages;  ///< level by level
  std::vector<int> roots;                 ///< [chart], shared::NO_PAGE where no path ends
  std::vector<std::uint32_t> first_pages; ///< [level], and the number of pages last
};

/// How many paths must ask for finer texels than a page has, for it to be divided. Fewer are at a fold of what the eye
/// sees through glass, where there is no end of asking.
inline constexpr std::size_t least_looks = 24;

/// looks: their charts are not NO_PAGE. Trees of at most so many pages, at least one a chart that is looked at; those
/// that more paths ask for come first.
PageTrees make_pages(std::span<const shared::DeviceLook> looks, std::size_t charts, std::size_t most);

} // namespace nephroid::photons
