// SPDX-License-Identifier: Apache-2.0
#include "inverse/pictures/target.h"

#include "base/error.h"
#include "image/image.h"
#include "inverse/pictures/drawing.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace nephroid::inverse {
namespace {

/// A drawing's edges are as sharp as this many samples along a cell's side.
constexpr int samples = 8;

Target draw(const Picture& picture, const Layout& layout)
{
  Target target;
  const double unit = std::min(layout.receiver.x, layout.receiver.y);
  const glm::dvec2 cell = layout.cell() / unit, half = layout.receiver / unit / 2.0;
  for (int y = 0; y < layout.cells.y; ++y)
    for (int x = 0; x < layout.cells.x; ++x) {
      double sum = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const double across = x + (i % samples + 0.5) / samples, down = y + (i / samples + 0.5) / samples;
        sum += brightness(picture, {across * cell.x - half.x, half.y - down * cell.y}, half);
      }
      target.push_back(sum / (samples * samples));
    }
  return target;
}

struct Grey {
  int width = 0, height = 0;
  std::vector<double> values;
};

/// Luminance of linear sRGB.
Grey read_grey(const std::filesystem::path& file)
{
  const image::Image picture = image::read_image(file);
  const image::Rgb rgb = image::rgb_of(picture, file.string());
  Grey grey{picture.width, picture.height, {}};
  for (std::size_t i = 0; i < rgb.values.size(); i += 3) {
    const auto linear = [&](std::size_t channel) {
      const double value = rgb.values[i + channel];
      return picture.integers ? image::decoded_srgb(value) : value;
    };
    const double y = 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
    if (!std::isfinite(y) || y < 0)
      throw bad_input(file.string(), "has a pixel that is negative or not a number", "expected a picture of light");
    grey.values.push_back(y);
  }
  const auto [low, high] = std::minmax_element(grey.values.begin(), grey.values.end());
  if (*high == 0) throw bad_input(file.string(), "is black all over", "expected a picture with some light in it");
  if (*low == *high)
    throw bad_input(file.string(), "is one grey all over", "expected a picture with an outline", "for a disc of light use a drawing");
  for (double& value : grey.values) value /= *high;
  return grey;
}

/// A cell's mean over the pixels that it covers, with their parts. Dark where the file does not reach.
Target fit(const Grey& grey, const Layout& layout)
{
  const double pixel = std::min(layout.receiver.x / grey.width, layout.receiver.y / grey.height); // millimetres
  const auto overlap = [](double low, double high, int i) { return std::max(0.0, std::min(high, i + 1.0) - std::max(low, double(i))); };
  Target target;
  const glm::dvec2 cell = layout.cell() / pixel;
  const glm::dvec2 corner = (glm::dvec2(grey.width, grey.height) - layout.receiver / pixel) / 2.0;
  for (int y = 0; y < layout.cells.y; ++y)
    for (int x = 0; x < layout.cells.x; ++x) {
      const glm::dvec2 low = corner + glm::dvec2(x, y) * cell, high = low + cell;
      double sum = 0;
      for (int v = std::max(0, static_cast<int>(low.y)); v < grey.height && v < high.y; ++v)
        for (int u = std::max(0, static_cast<int>(low.x)); u < grey.width && u < high.x; ++u)
          sum += overlap(low.x, high.x, u) * overlap(low.y, high.y, v) *
                 grey.values[static_cast<std::size_t>(v) * static_cast<std::size_t>(grey.width) + static_cast<std::size_t>(u)];
      target.push_back(sum / (cell.x * cell.y));
    }
  return target;
}

} // namespace

Target make_target(const Picture& picture, const Layout& layout, const FileFinder& finder, const Place& where)
{
  const bool file = picture.type == Picture::Type::file;
  Target target = file ? fit(read_grey(finder.find(picture.file, where)), layout) : draw(picture, layout);
  if (std::all_of(target.begin(), target.end(), [](double t) { return t == 0; }))
    throw bad_input(where, "leaves every cell of the receiver dark", "expected a drawing that lies on the receiver");
  for (double& t : target) t = picture.background + (1 - picture.background) * t;
  const double sum = std::accumulate(target.begin(), target.end(), 0.0);
  for (double& t : target) t /= sum;
  return target;
}

std::vector<Target> make_targets(const preset::Preset& preset, const Layout& layout)
{
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  const Place where = Place(preset.source) / "inverse" / "receivers";
  std::vector<Target> targets;
  for (const Receiver& r : settings(preset).receivers)
    targets.push_back(make_target(r.picture, layout, finder, where / targets.size() / "picture"));
  check_reach(layout, targets, preset);
  return targets;
}

} // namespace nephroid::inverse
