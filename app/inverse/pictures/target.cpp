// SPDX-License-Identifier: Apache-2.0
#include "inverse/pictures/target.h"

#include "base/error.h"
#include "inverse/pictures/drawing.h"
#include "inverse/pictures/grey.h"
#include "inverse/pictures/qr.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace nephroid::inverse {
namespace {

/// A drawing's edges are as sharp as this many samples along a cell's side.
constexpr int samples = 8;

double shorter_side(const Layout& layout) { return std::min(layout.receiver.x, layout.receiver.y); }
glm::dvec2 half_receiver(const Layout& layout) { return layout.receiver / shorter_side(layout) / 2.0; }

/// brightness(p): 0..1, p in parts of the receiver's shorter side from its middle, y up.
template <class F>
Target draw(const Layout& layout, const F& brightness_at)
{
  Target target;
  const glm::dvec2 cell = layout.cell() / shorter_side(layout), half = half_receiver(layout);
  for (int y = 0; y < layout.cells.y; ++y)
    for (int x = 0; x < layout.cells.x; ++x) {
      double sum = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const int column = i % samples, row = i / samples;
        const double across = x + (column + 0.5) / samples, down = y + (row + 0.5) / samples;
        sum += brightness_at(glm::dvec2(across * cell.x - half.x, half.y - down * cell.y));
      }
      target.push_back(sum / (samples * samples));
    }
  return target;
}

Target draw_words(const Picture& picture, const Layout& layout, const Place& where)
{
  const Grey words = grey_of_words(picture.text, where / "text");
  const double pixels = words.width / picture.length; // in the receiver's shorter side
  return draw(layout, [&](const glm::dvec2& p) {
    const glm::dvec2 turned = turned_back(picture, p);
    const double x = std::floor(turned.x * pixels + words.width / 2.0), y = std::floor(words.height / 2.0 - turned.y * pixels);
    const bool inside = x >= 0 && y >= 0 && x < words.width && y < words.height;
    return inside ? words.at(static_cast<int>(x), static_cast<int>(y)) : 0.0;
  });
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
          sum += overlap(low.x, high.x, u) * overlap(low.y, high.y, v) * grey.at(u, v);
      target.push_back(sum / (cell.x * cell.y));
    }
  return target;
}

Target brightness_of(const Picture& picture, const Layout& layout, const FileFinder& finder, const Place& where)
{
  switch (picture.type) {
  case Picture::Type::file: {
    Grey grey = read_grey(finder.find(picture.file, where));
    for (double& value : grey.values) value = std::pow(value, picture.tone);
    return fit(grey, layout);
  }
  case Picture::Type::text:
    return draw_words(picture, layout, where);
  case Picture::Type::qr:
    return qr_cells(picture.text, layout.cells, where / "text");
  default:
    return draw(layout, [&, half = half_receiver(layout)](const glm::dvec2& p) { return brightness(picture, p, half); });
  }
}

} // namespace

Target make_target(const Picture& picture, const Layout& layout, const FileFinder& finder, const Place& where)
{
  Target target = brightness_of(picture, layout, finder, where);
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
