// SPDX-License-Identifier: Apache-2.0
#include "environment/sheet.h"

#include "base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace nephroid::environment {
namespace {

constexpr int picture_width = 512, picture_height = 256;
/// The least width of a sphere in a sheet, in pixels, and the most spheres across or down a sheet.
constexpr int least_width = 200, most_cells = 6;
constexpr int gap = 4;
constexpr float grey = 0.02f; ///< sets black spheres apart

std::vector<std::size_t> spread(std::size_t count, int fit) {
  const std::size_t shown = std::min(count, static_cast<std::size_t>(std::clamp(fit, 1, most_cells)));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < shown; ++i) chosen.push_back(shown > 1 ? i * (count - 1) / (shown - 1) : 0);
  return chosen;
}

std::shared_ptr<job::Picture> picture_of(int width, int height, float value) {
  auto picture = std::make_shared<job::Picture>();
  picture->width = width;
  picture->height = height;
  picture->rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value);
  return picture;
}

/// Takes the mean of a few places in each pixel, because a pixel covers several texels.
std::vector<float> latitude_longitude(const Bake& bake, std::size_t direction, std::size_t sphere, int width,
                                      int height, double white) {
  constexpr int places = 2;
  std::vector<float> rgb(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (direction >= bake.baked.size()) return rgb;
  for_ranges(static_cast<std::size_t>(height), 8, [&](std::size_t, const Range& rows) {
    for (std::size_t row = rows.begin; row < rows.end; ++row)
      for (std::size_t column = 0; column < static_cast<std::size_t>(width); ++column) {
        glm::dvec3 sum(0);
        for (int i = 0; i < places * places; ++i) {
          const int below = i / places, right = i % places;
          const double down = (static_cast<double>(row) + (below + 0.5) / places) / height,
                       across = (static_cast<double>(column) + (right + 0.5) / places) / width;
          const double zenith = std::numbers::pi * down,
                       azimuth = 2 * std::numbers::pi * (across - 0.5); // from -z to +x
          const glm::dvec3 way(std::sin(zenith) * std::sin(azimuth), std::cos(zenith),
                               -std::sin(zenith) * std::cos(azimuth));
          sum += bake.at(direction, sphere, bake.map.texel(way));
        }
        for (int c = 0; c < 3; ++c)
          rgb[3 * (row * static_cast<std::size_t>(width) + column) + static_cast<std::size_t>(c)] =
              static_cast<float>(sum[c] / (places * places * white));
      }
  });
  return rgb;
}

} // namespace

Shown choose_shown(const Bake& bake, int width, int height) {
  Shown shown;
  shown.spheres = spread(bake.radii.size(), width / (least_width + gap));
  const int cell = width / static_cast<int>(shown.spheres.size());
  shown.directions = spread(bake.directions.size(), height / std::max(1, cell / 2));
  return shown;
}

std::shared_ptr<const job::Picture> sheet(const Bake& bake, const Shown& shown, int width, int height, double white) {
  const std::shared_ptr<job::Picture> picture = picture_of(width, height, grey);
  const int across = static_cast<int>(shown.spheres.size()), down = static_cast<int>(shown.directions.size());
  const int w = std::max(1, std::min(width / across, 2 * (height / down)) - gap), h = std::max(1, w / 2);
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const std::vector<float> cell = latitude_longitude(bake, shown.directions[static_cast<std::size_t>(row)],
                                                         shown.spheres[static_cast<std::size_t>(column)], w, h, white);
      const int left = std::max(0, (2 * column + 1) * width / (2 * across) - w / 2),
                top = std::max(0, (2 * row + 1) * height / (2 * down) - h / 2);
      for (int y = 0; y < h && top + y < height; ++y) {
        const int visible = std::min(w, width - left);
        std::copy_n(cell.begin() + static_cast<std::ptrdiff_t>(3) * y * w, 3 * visible,
                    picture->rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * width + left));
      }
    }
  return picture;
}

std::shared_ptr<const job::Picture> spheres_picture(const Bake& bake, std::size_t direction,
                                                    const std::vector<std::size_t>& spheres, double white) {
  const std::shared_ptr<job::Picture> picture = picture_of(picture_width, picture_height, 0);
  for (const std::size_t sphere : spheres) {
    picture->layers.push_back({fmt::format("sphere_{:02}", sphere + 1),
                               latitude_longitude(bake, direction, sphere, picture_width, picture_height, white)});
    const std::vector<float>& layer = picture->layers.back().rgb;
    std::transform(layer.begin(), layer.end(), picture->rgb.begin(), picture->rgb.begin(), std::plus());
  }
  return picture;
}

void SpherePictures::update(const Bake& bake, int width, int height, double white) {
  const Shown shown = choose_shown(bake, width, height);
  const auto baked = static_cast<std::size_t>(
      std::ranges::count_if(shown.directions, [&](std::size_t direction) { return direction < bake.baked.size(); }));
  if (sheet_ && baked == directions_.size()) return;
  if (baked < directions_.size()) directions_.clear(); // an earlier state was loaded
  sheet_ = sheet(bake, shown, width, height, white);
  for (std::size_t i = directions_.size(); i < baked; ++i)
    directions_.push_back({fmt::format("direction_{:03}", shown.directions[i] + 1),
                           spheres_picture(bake, shown.directions[i], shown.spheres, white)});
}

void add_figures(const Bake& bake, job::Snapshot& snapshot) {
  snapshot.curves.push_back({"directions", {"direction", "x", "y", "z", "met", "sent", "absorbed", "lost"}, {}});
  BakedDirection sum;
  double weights = 0;
  for (std::size_t i = 0; i < bake.baked.size(); ++i) {
    const BakedDirection& d = bake.baked[i];
    const glm::dvec3& way = bake.directions[i];
    snapshot.curves.back().rows.push_back(
        {static_cast<double>(i + 1), way.x, way.y, way.z, d.met, d.sent, d.absorbed, d.lost});
    const double weight = bake.weights[i / (bake.directions.size() / bake.weights.size())];
    weights += weight;
    sum.met += weight * d.met;
    sum.sent += weight * d.sent;
    sum.absorbed += weight * d.absorbed;
    sum.lost += weight * d.lost;
  }
  snapshot.scalars.insert(snapshot.scalars.end(),
                          {{"bake", "size", bake.size},
                           {"bake", "smallest_radius", bake.radii.front()},
                           {"bake", "largest_radius", bake.radii.back()},
                           {"bake", "channels", static_cast<double>(bake.channels)},
                           {"bake", "bytes", static_cast<double>(bake.bytes(bake.baked.size()))}});
  if (sum.met <= 0) return;
  snapshot.scalars.insert(snapshot.scalars.end(), {{"energy", "met", sum.met / weights},
                                                   {"energy", "sent", sum.sent / sum.met},
                                                   {"energy", "absorbed", sum.absorbed / sum.met},
                                                   {"energy", "lost", sum.lost / sum.met}});
}

std::uint64_t picture_bytes(const BakeTask& task) {
  const auto shown = [](std::size_t count) { return std::min<std::uint64_t>(count, most_cells); };
  return sizeof(float) * 3 * picture_width * picture_height * (shown(task.radii.size()) + 1) *
         shown(task.directions.size());
}

} // namespace nephroid::environment
