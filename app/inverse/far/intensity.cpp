// SPDX-License-Identifier: Apache-2.0
#include "inverse/far/intensity.h"

#include "inverse/describe_settings.h"
#include "inverse/light.h"
#include "inverse/pictures/target.h"
#include "scene/photometry.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

using Type = Intensity::Type;

constexpr double rim = 0.25, most_rim_deg = 16, widest_deg = 80; // of the size, on both sides together; of half of all

Location own(const preset::Preset& preset) { return Location(preset.source) / "inverse" / "far"; }

scene::Photometry load_luminaire(const preset::Preset& preset) {
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  return scene::load_photometry(finder.find(settings(preset).far->file, own(preset) / "file"));
}

/// Of light that goes along (tangent.x, tangent.y, -1).
double luminaire_at(const scene::Photometry& luminaire, const glm::dvec2& tangent) {
  const double c = glm::degrees(std::atan2(tangent.y, tangent.x));
  return scene::intensity(luminaire, glm::degrees(std::atan(glm::length(tangent))), c < 0 ? c + 360 : c);
}

/// Half the angles that hold all directions with more than a hundredth of the greatest intensity.
glm::dvec2 half_of_luminaire(const scene::Photometry& luminaire, const Location& where) {
  constexpr double counts = 0.01;
  constexpr int steps_a_degree = 4;
  const double most = *std::ranges::max_element(luminaire.intensity);
  glm::dvec2 half(0);
  for (int i = 0; i <= 180 * steps_a_degree; ++i)
    for (int c = 0; c < 360; ++c) {
      const double gamma = static_cast<double>(i) / steps_a_degree;
      if (scene::intensity(luminaire, gamma, c) <= counts * most) continue;
      if (gamma > widest_deg)
        throw bad_input(where / "file", fmt::format("shines {:.4g} degrees from its axis", gamma),
                        fmt::format("expected light within {} degrees of gamma 0", widest_deg),
                        "turn the luminaire in its file, or choose one with a narrower beam");
      const double tangent = std::tan(glm::radians(gamma)), turn = glm::radians(c * 1.0);
      half = glm::max(half, glm::degrees(glm::atan(glm::abs(tangent * glm::dvec2(std::cos(turn), std::sin(turn))))));
    }
  return glm::max(half, glm::dvec2(1.0 / steps_a_degree));
}

/// How far p is within a shape, in degrees; p is in degrees to the right and up.
double depth_in(const Intensity& i, const glm::dvec2& p) {
  const glm::dvec2 half(i.size_deg[0] / 2, i.size_deg[1] / 2);
  if (i.type == Type::ellipse || i.type == Type::batwing) {
    const double r = glm::length(p / half);
    return r > 0 ? (1 - r) * glm::length(p) / r : std::min(half.x, half.y);
  }
  if (i.type == Type::cutoff) // the rectangle below the cut; its edges are the other three
    return std::min(half.x - std::abs(p.x), p.y + i.size_deg[1]);
  return std::min(half.x - std::abs(p.x), half.y - std::abs(p.y));
}

double shape_at(const Intensity& i, const glm::dvec2& p) {
  if (i.type == Type::cutoff && p.y > std::max(0.0, p.x) * std::tan(glm::radians(i.rise_deg))) return 0;
  const double depth = depth_in(i, p), t = i.edge_deg > 0 ? std::clamp(depth / i.edge_deg + 0.5, 0.0, 1.0) : depth >= 0,
               edge = t * t * (3 - 2 * t);
  if (i.type != Type::batwing) return edge;
  const glm::dvec2 tangent = glm::tan(glm::radians(p));
  return edge * std::pow(1 + glm::dot(tangent, tangent), 1.5); // 1 / cos^3
}

/// A picture over equal steps of the angles, as the light in each.
std::vector<double> picture_over_angles(const preset::Preset& preset, const Layout& layout,
                                        std::vector<std::string>& notes) {
  const Intensity& i = *settings(preset).far;
  Layout even = layout;
  even.receiver = glm::dvec2(i.size_deg[0], i.size_deg[1]);
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  return make_target(i.picture, even, finder, own(preset) / "picture", notes);
}

/// The intensity in each cell, in any unit, and its largest value at any place.
struct Spread {
  std::vector<double> cells;
  double most = 0;
};

Spread spread_of(const preset::Preset& preset, const Layout& layout, std::vector<std::string>& notes) {
  constexpr int samples = 8; // along a cell's side
  const Intensity& i = *settings(preset).far;
  const glm::dvec2 half = layout.receiver / 2.0 / layout.distances.front(), size(i.size_deg[0], i.size_deg[1]);
  std::optional<scene::Photometry> luminaire;
  std::vector<double> picture;
  if (i.type == Type::luminaire) luminaire = load_luminaire(preset);
  if (i.type == Type::picture) picture = picture_over_angles(preset, layout, notes);
  const auto at = [&](const glm::dvec2& tangent) {
    if (luminaire) return luminaire_at(*luminaire, tangent);
    const glm::dvec2 p = glm::degrees(glm::atan(tangent));
    if (picture.empty()) return shape_at(i, p);
    const glm::dvec2 cell = (glm::dvec2(p.x, -p.y) / size + 0.5) * glm::dvec2(layout.cells);
    const bool within = cell.x >= 0 && cell.y >= 0 && cell.x < layout.cells.x && cell.y < layout.cells.y;
    return within ? picture[index_at(static_cast<int>(cell.x), static_cast<int>(cell.y), layout.cells.x)] : 0;
  };
  Spread spread;
  for (int y = 0; y < layout.cells.y; ++y)
    for (int x = 0; x < layout.cells.x; ++x) {
      double sum = 0;
      for (int k = 0; k < samples * samples; ++k) {
        const glm::dvec2 in_cell(k % samples, k / samples); // NOLINT(bugprone-integer-division)
        const glm::dvec2 part = (glm::dvec2(x, y) + (in_cell + 0.5) / (1.0 * samples)) / glm::dvec2(layout.cells);
        const double value = at((2.0 * part - 1.0) * half * glm::dvec2(1, -1));
        spread.most = std::max(spread.most, value);
        sum += value;
      }
      spread.cells.push_back(sum / (samples * samples));
    }
  return spread;
}

double light_of(const Layout& layout, const Spread& spread) {
  double sum = 0;
  for (std::size_t c = 0; c < spread.cells.size(); ++c) sum += spread.cells[c] * steradians(layout, c);
  return sum;
}

/// The largest value of the spread in candela, where that is wanted.
std::optional<double> candela_of(const Intensity& i, const Spread& spread) {
  if (i.candela || i.type != Type::luminaire || !i.lumens) return i.candela;
  return spread.most;
}

/// The angle under which the object's middle sees the lamp or the light's disc, in degrees.
double seen_deg(const Layout& layout) {
  if (!layout.light.lamp) return 2 * glm::degrees(std::atan(layout.disc(layout.light)));
  const glm::dmat3& covariance = layout.light.lamp_covariance; // r^2 / 4 of a disc along each axis
  return glm::degrees(4 * std::sqrt(std::max(covariance[0][0], covariance[1][1])) /
                      (layout.light.lamp->z - layout.entry()));
}

} // namespace

glm::dvec2 far_half(const preset::Preset& preset) {
  const Intensity& i = *settings(preset).far;
  glm::dvec2 half = glm::dvec2(i.size_deg[0], i.size_deg[1]) / 2.0;
  if (i.type == Type::luminaire) half = half_of_luminaire(load_luminaire(preset), own(preset));
  const glm::dvec2 more = glm::min(rim * half, glm::dvec2(most_rim_deg / 2));
  if (i.type == Type::cutoff) // below the cut is its height; as much is looked at above
    half.y = std::max(i.size_deg[1], half.x * std::tan(glm::radians(i.rise_deg)));
  return glm::tan(glm::radians(glm::min(half + more + i.edge_deg / 2, glm::dvec2(widest_deg + 5))));
}

Target far_target(const preset::Preset& preset, const Layout& layout, std::vector<std::string>& notes) {
  const Settings& s = settings(preset);
  const Spread spread = spread_of(preset, layout, notes);
  const double light = light_of(layout, spread);
  if (!(light > 0))
    throw bad_input(own(preset), "leaves every direction dark", "expected an intensity that is wider than a cell",
                    "choose more 'cells' or a wider target");
  if (const std::optional<double> candela = candela_of(*s.far, spread)) {
    const double needed = *candela / spread.most * light, there = lumens_on_front(layout, s);
    if (needed > there)
      throw bad_input(
          own(preset) / (s.far->candela ? "candela" : "file"),
          fmt::format("asks for {:.4g} lm in all, up to {:.4g} cd, and of the lamp's {:.4g} lm {:.4g} fall on "
                      "the front",
                      needed, *candela, *s.far->lumens, there),
          fmt::format("expected at most {:.4g} cd", *candela * there / needed),
          s.far->candela ? "choose fewer candela, a brighter or nearer lamp, or a larger object"
                         : "remove 'lumens', with which a file's candela count, or choose a brighter or "
                           "nearer lamp");
  }
  Target target;
  for (std::size_t c = 0; c < spread.cells.size(); ++c)
    target.push_back(spread.cells[c] * steradians(layout, c) / light);
  return target;
}

std::optional<double> wanted_candela(const preset::Preset& preset, const Layout& layout) {
  std::vector<std::string> ignored;
  return candela_of(*settings(preset).far, spread_of(preset, layout, ignored));
}

double part_on_front(const Layout& layout, const Settings& s) {
  if (!layout.light.lamp) return 1;
  const double around = layout.size.x * layout.size.y / lamp_weight(layout) / (4 * glm::pi<double>());
  if (s.light.type != Light::Type::area) return around;
  // Lambert's law: cos^2 over pi r^2 of each part of the front, which the disc within it is of a round one.
  constexpr int across = 64;
  constexpr std::size_t every = 61; // of the lamp's places
  const glm::dvec2 part = layout.size / (1.0 * across);
  double sum = 0;
  std::size_t places = 0;
  for (std::size_t p = 0; p < layout.light.lamp_places.size(); p += every, ++places) {
    const glm::dvec3 lamp = *layout.light.lamp + glm::dvec3(layout.light.lamp_places[p]);
    for (int k = 0; k < across * across; ++k) {
      const glm::dvec2 cell(k % across, k / across); // NOLINT(bugprone-integer-division)
      const glm::dvec2 at = (cell + 0.5) * part - layout.size / 2.0;
      if (layout.is_beside(at)) continue;
      const glm::dvec3 way(at - glm::dvec2(lamp), lamp.z - layout.entry());
      const double square = glm::dot(way, way);
      sum += way.z * way.z / (glm::pi<double>() * square * square) * part.x * part.y;
    }
  }
  return sum / static_cast<double>(places);
}

double lumens_on_front(const Layout& layout, const Settings& s) {
  return part_on_front(layout, s) * s.far->lumens.value_or(default_lumens);
}

double steradians(const Layout& layout, std::size_t cell) {
  const glm::dvec2 half = layout.cell() / 2.0 / layout.distances.front(),
                   middle = layout.middle_of_cell(cell) / layout.distances.front();
  const auto corner = [](double x, double y) { return std::atan(x * y / std::sqrt(1 + x * x + y * y)); };
  const glm::dvec2 low = middle - half, high = middle + half;
  return corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) + corner(low.x, low.y);
}

std::vector<std::string> far_notes(const preset::Preset& preset, const Layout& layout) {
  const Settings& s = settings(preset);
  std::vector<std::string> notes;
  const double seen = seen_deg(layout);
  const bool sharp = s.far->type != Type::luminaire && s.far->type != Type::picture && s.far->edge_deg < seen;
  if (seen > glm::degrees(std::atan(layout.cell().x / layout.distances.front())) && sharp)
    notes.push_back(fmt::format("the object sees a lamp {:.3g} degrees wide, and no edge becomes sharper than that; "
                                "choose an 'edge_deg' of {:.3g} or more, a smaller lamp or one farther away",
                                seen, seen));
  std::vector<std::string> ignored;
  const Spread spread = spread_of(preset, layout, ignored);
  if (const std::optional<double> candela = candela_of(*s.far, spread)) {
    const double needed = *candela / spread.most * light_of(layout, spread), there = lumens_on_front(layout, s);
    notes.push_back(fmt::format("the intensity that is wanted takes {:.4g} lm, {:.3g} % of those on the front: the "
                                "object makes it so much brighter, or loses the rest",
                                needed, 100 * needed / there));
  }
  return notes;
}

} // namespace nephroid::inverse
