// SPDX-License-Identifier: Apache-2.0
#include "inverse/pictures/target.h"

#include "image/image.h"
#include "inverse/far/intensity.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

bool in_bar(const glm::dvec2& p, double length, double width) {
  return std::abs(p.x) < length / 2 && std::abs(p.y) < width / 2;
}

/// Bars along x, one above the other.
bool in_bars(const Picture& picture, const glm::dvec2& p) {
  for (int i = 0; i < picture.count; ++i)
    if (in_bar({p.x, p.y - (2 * i - (picture.count - 1)) * picture.width}, picture.length, picture.width)) return true;
  return false;
}

/// Its first point is up. Between a point and the valley beside it the edge is a straight line: with the point at angle
/// 0 and the valley at beta, p is inside where it is on the middle's side of the line through both.
bool in_star(const Picture& picture, const glm::dvec2& p) {
  const double beta = glm::pi<double>() / picture.count;
  const double turned = std::atan2(-p.x, p.y);
  const double angle = std::abs(turned - 2 * beta * std::round(turned / (2 * beta))), r = glm::length(p);
  const glm::dvec2 at{r * std::cos(angle), r * std::sin(angle)}, point{picture.radius, 0};
  const glm::dvec2 along = picture.inner * glm::dvec2(std::cos(beta), std::sin(beta)) - point, to = at - point;
  return along.x * to.y - along.y * to.x > 0;
}

/// How much of a spot of this radius is left at p: 1 in its middle, falling as a bell.
double spot(const glm::dvec2& p, const glm::dvec2& middle, const glm::dvec2& radius) {
  const glm::dvec2 d = (p - middle) / radius;
  return std::exp(-glm::dot(d, d));
}

/// A ball of radius 1 in grey levels, lit from the left above as Lambert's law has it, with two eyes and a mouth.
double face(const glm::dvec2& p) {
  const double r2 = glm::dot(p, p);
  if (r2 >= 1) return 0;
  const glm::dvec3 light = glm::normalize(glm::dvec3(-0.5, 0.6, 0.9));
  const double lit = 0.15 + 0.85 * std::max(0.0, glm::dot(light, glm::dvec3(p, std::sqrt(1 - r2))));
  const double eyes = spot(p, {-0.35, 0.25}, {0.16, 0.2}) + spot(p, {0.35, 0.25}, {0.16, 0.2});
  const double mouth = spot({p.x, p.y + 0.55 - 0.5 * p.x * p.x}, {0, 0}, {0.4, 0.1}); // along a parabola: it smiles
  return lit * (1 - 0.9 * std::min(1.0, eyes + mouth));
}

/// Where p lies in a drawing that is not turned.
glm::dvec2 turned_back(const Picture& picture, const glm::dvec2& p) {
  const double turn = glm::radians(picture.turn_deg), c = std::cos(turn), s = std::sin(turn);
  return {c * p.x + s * p.y, c * p.y - s * p.x};
}

/// A drawing's brightness 0..1 at p, without background. p and `half` (the receiver) are in its shorter sides, y up.
double brightness(const Picture& picture, const glm::dvec2& p, const glm::dvec2& half) {
  using Type = Picture::Type;
  const double r = glm::length(p);
  const glm::dvec2 turned = turned_back(picture, p);
  if (picture.type == Type::disc) return r < picture.radius ? 1 : 0;
  if (picture.type == Type::ring) return r < picture.radius && r >= picture.inner ? 1 : 0;
  if (picture.type == Type::cross)
    return in_bar(turned, picture.length, picture.width) || in_bar({turned.y, turned.x}, picture.length, picture.width)
               ? 1
               : 0;
  if (picture.type == Type::bars) return in_bars(picture, turned) ? 1 : 0;
  if (picture.type == Type::star) return in_star(picture, turned) ? 1 : 0;
  if (picture.type == Type::face) return face(turned / picture.radius);
  const double turn = glm::radians(picture.turn_deg);
  const double reach =
      half.x * std::abs(std::cos(turn)) + half.y * std::abs(std::sin(turn)); // how far the receiver reaches along it
  return std::clamp((turned.x / reach + 1) / 2, 0.0, 1.0);
}

/// A drawing's edges are as sharp as this many samples along a cell's side.
constexpr int samples = 8;

double shorter_side(const Layout& layout) { return std::min(layout.receiver.x, layout.receiver.y); }
glm::dvec2 half_receiver(const Layout& layout) { return layout.receiver / shorter_side(layout) / 2.0; }

/// Each cell's mean of brightness_at(p), with p as brightness() has it.
template <class F>
Target draw(const Layout& layout, const F& brightness_at) {
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

Target draw_words(const Picture& picture, const Layout& layout, const Location& where) {
  constexpr int height = 256; // finer than any cell, so that the cells' mean is that of the letters
  const image::Image words = image::text_picture(picture.text, height, where / "text");
  const double pixels = words.width / picture.length; // in the receiver's shorter side
  return draw(layout, [&](const glm::dvec2& p) {
    const glm::dvec2 turned = turned_back(picture, p);
    const double x = std::floor(turned.x * pixels + words.width / 2.0),
                 y = std::floor(words.height / 2.0 - turned.y * pixels);
    const bool inside = x >= 0 && y >= 0 && x < words.width && y < words.height;
    return inside ? words.data[index_at(static_cast<int>(x), static_cast<int>(y), words.width)] : 0.0;
  });
}

Target brightness_of(const Picture& picture, const Layout& layout, const FileFinder& finder, const Location& where,
                     std::vector<std::string>& notes) {
  if (picture.type == Picture::Type::text) return draw_words(picture, layout, where);
  if (picture.type == Picture::Type::qr) return qr_cells(picture.text, layout.cells, where / "text");
  if (picture.type != Picture::Type::file)
    return draw(layout,
                [&, half = half_receiver(layout)](const glm::dvec2& p) { return brightness(picture, p, half); });
  return photograph(finder.find(picture.file, where), picture, layout, notes);
}

} // namespace

Target make_target(const Picture& picture, const Layout& layout, const FileFinder& finder, const Location& where,
                   std::vector<std::string>& notes) {
  Target target = brightness_of(picture, layout, finder, where, notes);
  if (std::all_of(target.begin(), target.end(), [](double t) { return t == 0; }))
    throw bad_input(where, "leaves every cell of the receiver dark",
                    picture.type == Picture::Type::file ? "expected 'levels' that some of the file is above"
                                                        : "expected a drawing that lies on the receiver");
  for (double& t : target) t = picture.background + (1 - picture.background) * t;
  const double sum = std::accumulate(target.begin(), target.end(), 0.0);
  for (double& t : target) t /= sum;
  return target;
}

std::vector<Target> make_targets(const preset::Preset& preset, const Layout& layout, std::vector<std::string>& notes) {
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  const Location where = Location(preset.source) / "inverse" / "receivers";
  std::vector<Target> targets;
  if (layout.far) targets.push_back(far_target(preset, layout, notes));
  for (const Receiver& r : layout.far ? std::vector<Receiver>() : settings(preset).receivers)
    targets.push_back(make_target(r.picture, layout, finder, where / targets.size() / "picture", notes));
  check_reach(layout, targets, preset);
  return targets;
}

} // namespace nephroid::inverse
