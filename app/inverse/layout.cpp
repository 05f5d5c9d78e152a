// SPDX-License-Identifier: Apache-2.0
#include "inverse/layout.h"

#include "base/files.h"
#include "inverse/bending.h"
#include "inverse/far/intensity.h"
#include "inverse/light.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

/// The most that a facet can reach from z = 0. The steepest turns light by as much as light straight on is turned.
double most_relief(const Layout& layout) {
  double tilt = glm::length(layout.light.sines);
  if (layout.light.lamp)
    for (const glm::dvec2& corner : {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)})
      tilt = std::max(tilt, glm::length(incoming_at(layout, corner * layout.size / 2.0).sines));
  const double bent = std::atan(glm::length(facet_gradient({usable_slope(layout), 0}, layout.n))) +
                      std::asin(tilt / std::abs(layout.n));
  constexpr double upright = 1.5; // radians, 86 degrees
  return std::min(std::tan(std::min(bent, upright)), layout.steepest) * glm::length(layout.facet()) / 2;
}

/// The least turn that brings a facet's light to a place of a receiver, as a slope of light that came straight on.
double least_turn(const Layout& layout, const glm::dvec2& to, double distance) {
  constexpr int across = 9;
  double closest = -1; // cosine
  for (int i = 0; i < across * across; ++i) {
    const glm::dvec2 middle =
        (glm::dvec2(i % across, i / across) / (across - 1.0) - 0.5) * (layout.size - layout.facet());
    for (const glm::dvec2& from :
         {middle, glm::clamp(to, -(layout.size - layout.facet()) / 2.0, (layout.size - layout.facet()) / 2.0)}) {
      const glm::dvec2 sines = layout.light.facets ? incoming_at(layout, from).sines : glm::dvec2(0);
      closest = std::max(closest, glm::dot(unturned(sines, layout.n), direction_of((to - from) / distance)));
    }
  }
  return closest > 0 ? std::sqrt(std::max(0.0, 1 - closest * closest)) / closest
                     : std::numeric_limits<double>::infinity();
}

/// The lit cells that lie farthest to 16 sides.
std::array<glm::dvec2, 16> farthest_lit(const Layout& layout, const Target& target, std::size_t receiver) {
  std::array<glm::dvec2, 16> to{};
  std::array<double, 16> farthest{};
  farthest.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < target.size(); ++c) {
    if (target[c] <= 0) continue;
    const glm::dvec2 at = layout.offset(receiver) + layout.middle_of_cell(c);
    for (std::size_t side = 0; side < to.size(); ++side) {
      const double angle = glm::pi<double>() * static_cast<double>(side) / 8,
                   far = glm::dot(at, glm::dvec2(std::cos(angle), std::sin(angle)));
      if (far <= farthest[side]) continue;
      farthest[side] = far;
      to[side] = at;
    }
  }
  return to;
}

/// Until a lens is known, half its relief is taken for this part of the sheet.
constexpr double foretold_lens = 0.1;

/// Free heights leave this part of the thickness, and of the way to the nearest receiver; a relief, of the sheet.
constexpr double spared = 0.1;

double band_of(const Settings& s, const Location& own) {
  double band = std::numeric_limits<double>::infinity();
  if (s.heights == Settings::Heights::free) {
    const double inside = s.stock_mm ? *s.stock_mm / 2 : s.thickness_mm;
    band = (1 - spared) * (s.far ? inside : std::min(inside, s.receivers.front().distance_mm));
  }
  if (s.max_relief_mm) band = std::min(band, *s.max_relief_mm / 2);
  if (s.stock_mm) { // which holds the relief above and below its middle
    const double least = s.min_thickness_mm.value_or(0);
    if (least >= *s.stock_mm)
      throw bad_input(own / "min_thickness_mm",
                      fmt::format("is {} mm, and the sheet is {} mm thick", least, *s.stock_mm),
                      "expected less than 'stock_mm', of which the relief is taken away",
                      fmt::format("choose a thicker sheet than {} mm", least));
    return std::min(band, std::min(*s.stock_mm - least, (1 - spared) * *s.stock_mm) / 2);
  }
  if (!s.min_thickness_mm) return band;
  if (*s.min_thickness_mm >= s.thickness_mm)
    throw bad_input(own / "min_thickness_mm",
                    fmt::format("is {} mm, and the object is {} mm thick in the middle of its relief",
                                *s.min_thickness_mm, s.thickness_mm),
                    "expected less than 'thickness_mm', of which half the relief is taken away",
                    fmt::format("choose a thickness_mm above {}", *s.min_thickness_mm));
  return std::min(band, s.thickness_mm - *s.min_thickness_mm);
}

/// Refuses constraints that keep light within the cell that it would reach straight on.
void check_constraints(const Layout& l, const Settings& s, const Location& own) {
  const double slope = std::min(l.cell().x, l.cell().y) / l.distances.back();
  if (usable_slope(l) >= slope || usable_slope(l.n) < slope) return;
  const double needed =
      glm::length(facet_gradient({slope, 0}, l.n)) * glm::length(l.facet()) / 2; // from its middle to its corners
  const bool too_shallow = s.method != Settings::Method::lens && l.band < needed;
  const char* const field = !too_shallow                                        ? "max_slope_deg"
                            : s.max_relief_mm && *s.max_relief_mm / 2 <= l.band ? "max_relief_mm"
                            : s.stock_mm                                        ? "stock_mm"
                            : s.min_thickness_mm                                ? "min_thickness_mm"
                                                                                : "heights";
  const double least = glm::degrees(std::atan(glm::length(facet_gradient({slope, 0}, l.n))));
  throw bad_input(
      own / field,
      fmt::format("lets facets of {:.4g} x {:.4g} mm move light by {:.3g} mm over {} mm, less than a cell of {:.3g} mm",
                  l.facet().x, l.facet().y, usable_slope(l) * l.distances.back(), l.distances.back(),
                  std::min(l.cell().x, l.cell().y)),
      too_shallow ? fmt::format("expected room for a relief of at least {:.3g} mm", 2 * needed)
                  : fmt::format("expected at least {:.3g} degrees", least),
      too_shallow ? "choose a deeper relief or more facets" : "choose a larger angle or a receiver further away");
}

void check_tool(const Layout& l, const Settings& s, const Location& own) {
  if (!s.tool_radius_mm) return;
  const double width = 2 * *s.tool_radius_mm;
  if (width > std::min(l.size.x, l.size.y))
    throw bad_input(own / "tool_radius_mm",
                    fmt::format("is {} mm, a tool that is wider than the object of {:.4g} x {:.4g} mm",
                                *s.tool_radius_mm, l.size.x, l.size.y),
                    "expected the radius of a tool that fits onto a facet");
  if (s.method == Settings::Method::lens || width <= std::min(l.facet().x, l.facet().y))
    return; // a lens has no corners
  throw bad_input(own / "tool_radius_mm",
                  fmt::format("is {} mm, a tool that is wider than a facet of {:.4g} x {:.4g} mm", *s.tool_radius_mm,
                              l.facet().x, l.facet().y),
                  fmt::format("expected at most {:.4g} mm, with which a ball touches the middles of facets; a smaller "
                              "one touches more of them, as workshop.md says",
                              std::min(l.facet().x, l.facet().y) / 2),
                  fmt::format("or choose at most {} x {} facets", static_cast<int>(l.size.x / width),
                              static_cast<int>(l.size.y / width)));
}

/// Refuses cells at which the solid, which turns facets a little, cannot aim.
void check_aim(const Layout& l, const Location& own) {
  const double cell = std::min(l.cell().x, l.cell().y), turn = std::abs(l.n - 1) * corners_join,
               last = l.distances.back();
  if (last * turn <= cell / 2) return;
  if (l.far)
    throw bad_input(own / "cells",
                    fmt::format("are {:.3g} degrees wide, and {:.2g} in its slope, the finest that facets are made, "
                                "moves light by {:.3g}",
                                glm::degrees(cell / last), turn, glm::degrees(turn)),
                    fmt::format("expected cells of {:.3g} degrees or more", glm::degrees(2 * turn)),
                    "choose fewer cells or a wider target");
  throw bad_input(own / "receivers" / (l.distances.size() - 1) / "distance_mm",
                  fmt::format("is {} mm, where {:.2g} in its slope, the finest that facets are made, moves light by "
                              "{:.4g} mm over a cell of {:.4g} mm",
                              last, turn, last * turn, cell),
                  fmt::format("expected at most {:.6g} mm", cell / 2 / turn),
                  "choose a nearer receiver, a larger receiver_mm or fewer cells");
}

/// Refuses facets that could cut the object in two or reach the nearest receiver.
void check_room(const Layout& l, const Settings& s, const Location& own) {
  const double relief = most_relief(l);
  const auto refuse = [&](const Location& where, double value, const char* what) {
    if (value > relief) return;
    throw bad_input(where,
                    fmt::format("is {} mm, and facets of {:.4g} x {:.4g} mm can reach {:.4g} mm from their middle",
                                value, l.facet().x, l.facet().y, relief),
                    fmt::format("expected more than that, so that {}", what),
                    "choose more facets, a larger value here or another index");
  };
  if (!s.stock_mm) refuse(own / "thickness_mm", l.thickness, "the object holds together");
  refuse(own / "receivers" / 0 / "distance_mm", l.distances.front(), "the receiver is free of the object");
}

template <class Of>
auto of_receivers(const Settings& s, const Of& of) {
  std::vector<decltype(of(s.receivers.front()))> values;
  for (const Receiver& receiver : s.receivers) values.push_back(of(receiver));
  return values;
}

/// Distances of the frames between each receiver and the next.
std::vector<double> frames_of(const Settings& s) {
  std::vector<double> frames;
  for (std::size_t j = 1; j < s.receivers.size(); ++j)
    for (int k = 1; k <= s.frames; ++k)
      frames.push_back(glm::mix(s.receivers[j - 1].distance_mm, s.receivers[j].distance_mm, k / (s.frames + 1.0)));
  return frames;
}

std::optional<std::vector<glm::dvec2>> offsets_of(const Settings& s) {
  const auto offsets = of_receivers(s, [](const Receiver& r) { return glm::dvec2(r.offset_mm[0], r.offset_mm[1]); });
  if (std::ranges::all_of(offsets, [](const glm::dvec2& offset) { return offset == glm::dvec2(0); }))
    return std::nullopt;
  return offsets;
}

/// The settings, where a lamp's mesh is the file that was found. Throws bad_input where there is none.
Settings with_found_meshes(const preset::Preset& preset, const Location& own) {
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  const auto find = [&](Light& light, const Location& where) {
    if (light.type == Light::Type::mesh) light.file = finder.find(light.file, where / "file").string();
  };
  Settings s = settings(preset);
  find(s.light, own / "light");
  for (std::size_t j = 0; j < s.receivers.size(); ++j)
    if (s.receivers[j].light) find(*s.receivers[j].light, own / "receivers" / j / "light");
  return s;
}

} // namespace

glm::dvec2 Layout::wave_width() const {
  // Of all boxes this one is closest to sinc^2 in the mean of squares.
  constexpr double box = 1.2, least_cells = 0.25;
  if (!diffracts) return glm::dvec2(0);
  const glm::dvec2 spread = diffraction() * distances.back() / cell();
  return std::max(spread.x, spread.y) < least_cells ? glm::dvec2(0) : box * diffraction();
}

Layout make_layout(const preset::Preset& preset, std::optional<double> thickness) {
  const Location own = Location(preset.source) / "inverse";
  const Settings s = with_found_meshes(preset, own);
  const glm::dvec2 size(s.size_mm[0], s.size_mm[1]);
  const glm::ivec2 facets(s.facets[0], s.facets[1]);
  const Refraction refraction = make_refraction(preset);
  const bool lens = s.method == Settings::Method::lens; // its facets lean on as they rise; forecast.h has its limits
  const double band = band_of(s, own), most = s.kind == Settings::Kind::mirror ? steepest_mirror : any_steepness,
               steepest = lens ? most : std::min(most, 2 * band / glm::length(size / glm::dvec2(facets)));
  Layout l{.size = size,
           .round = s.outline == Settings::Outline::round,
           .thickness = thickness.value_or(s.stock_mm.value_or(s.thickness_mm)),
           .facets = facets,
           .n = refraction.n,
           .spectrum = refraction.spectrum,
           .receiver = s.far           ? 2.0 * far_half(preset) * far_away * std::max(size.x, size.y)
                       : s.receiver_mm ? glm::dvec2((*s.receiver_mm)[0], (*s.receiver_mm)[1])
                                       : size,
           .cells = {s.cells[0], s.cells[1]},
           .distances = s.far ? std::vector<double>{far_away * std::max(size.x, size.y)}
                              : of_receivers(s, [](const Receiver& r) { return r.distance_mm; }),
           .far = s.far.has_value(),
           .frames = frames_of(s),
           .weights = of_receivers(s, [](const Receiver& r) { return r.weight; }),
           .offsets = offsets_of(s),
           .sun_radius = std::tan(glm::radians(s.sun_deg.value_or(0) / 2)),
           .scatter = std::tan(glm::radians(s.scatter_deg)),
           .wavelength = refraction.nm * mm_a_nm,
           .diffracts = s.diffraction && !lens,
           .light = {},
           .free_heights = s.heights == Settings::Heights::free,
           .band = band,
           .steepest = s.max_slope_deg ? std::min(steepest, std::tan(glm::radians(*s.max_slope_deg))) : steepest,
           .draft = std::tan(glm::radians(s.draft_deg)),
           .smoothing = s.smoothing_normals / s.smoothing_pictures};
  check_tool(l, s, own);
  check_constraints(l, s, own);
  if (s.stock_mm && !thickness) l.thickness -= std::min(band, lens ? foretold_lens * *s.stock_mm : most_relief(l));
  l.light = make_illumination(l, s.light, own / "light", s);
  add_own_lights(l, s, own);
  check_room(l, s, own);
  check_aim(l, own);
  return l;
}

std::vector<std::size_t> some_facets(const Layout& layout, int a_side) {
  const glm::ivec2 step = (layout.facets + a_side - 1) / a_side;
  std::vector<std::size_t> facets;
  for (int y = step.y / 2; y < layout.facets.y; y += step.y)
    for (int x = step.x / 2; x < layout.facets.x; x += step.x) facets.push_back(index_at(x, y, layout.facets.x));
  return facets;
}

double usable_slope(const Layout& layout) {
  return std::min(usable_slope(layout.n), slope_behind(std::atan(layout.steepest), layout.n));
}

void check_reach(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset) {
  const double limit = layout.light.facets && !layout.is_mirror() ? usable_slope(layout.n) : usable_slope(layout);
  const std::string limits = limit < usable_slope(layout.n)
                                 ? "the constraints on the facets let it have a slope of"
                                 : fmt::format("an index of {:.4g} bends it by a slope of", layout.n);
  for (std::size_t j = 0; j < targets.size(); ++j) {
    const double distance = layout.distances[j];
    const std::array<glm::dvec2, 16> lit = farthest_lit(layout, targets[j], j);
    const Layout alone = receiver_alone(layout, j);
    const auto turn = [&](const glm::dvec2& to, double over) { return least_turn(alone, to, over); };
    const glm::dvec2 place = *std::max_element(lit.begin(), lit.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
      return turn(a, distance) < turn(b, distance);
    });
    if (turn(place, distance) <= limit) continue;
    if (layout.far)
      throw bad_input(Location(preset.source) / "inverse" / "far",
                      fmt::format("light must go {:.4g} degrees from the axis, a turn by a slope of {:.3g}",
                                  glm::degrees(std::atan(glm::length(place) / distance)), turn(place, distance)),
                      fmt::format("{} {:.3g} at most", limits, limit),
                      "choose a narrower target, or an index farther from 1");
    double far = distance;
    while (far < 1e7 && turn(place, far) > limit) far *= 1.01;
    throw bad_input(
        Location(preset.source) / "inverse" / "receivers" / j / "distance_mm",
        fmt::format("light must reach ({:.4g}, {:.4g}) mm over {:.4g} mm, a turn by a slope of {:.3g}", place.x,
                    place.y, distance, turn(place, distance)),
        fmt::format("{} {:.3g} at most", limits, limit),
        far < 1e7
            ? fmt::format(
                  "choose a distance of at least {:.4g} mm, a larger object, or a smaller receiver_mm or offset_mm",
                  far)
        : layout.is_mirror() ? "choose light that is tilted less"
                             : "choose an index farther from 1, or light that is tilted less");
  }
}

} // namespace nephroid::inverse
