// SPDX-License-Identifier: Apache-2.0
#include "inverse/pictures/preview.h"

#include "base/parallel.h"
#include "inverse/assign/cost.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/light.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nephroid::inverse {
namespace {

/// Steps towards the best light: further ones gain below a hundredth. Large pictures have fewer: a plan takes a second.
constexpr std::size_t step_limit = 60, fewest_steps = 8, most_products = 400'000'000;
/// A picture that is further off at best is worth a word, in rel_l2.
constexpr double far_off = 0.1;
/// A cell of so many times an even picture's light asks for strong lenses; with the advised background it is `bright`.
constexpr double very_bright = 8, bright = 4;

/// Light that is aimed at a cell, on its neighbours: parts[i] of it on the cell first + i beside it.
struct Smear {
  int first = 0;
  std::vector<double> parts;
};

/// A footprint as if it were the product of what it is along each axis.
struct AxisBlur {
  Smear x, y;
};

AxisBlur smears_of(const Layout& layout, std::size_t receiver) {
  const glm::ivec2 at = layout.cells / 2;
  const glm::dvec2 to = layout.middle_of_cell(index_at(at.x, at.y, layout.cells.x));
  const auto turn = [&](std::size_t facet) {
    return glm::distance((to + layout.offset(receiver) - layout.middle(facet)) / layout.distances[receiver],
                         flat_slope(lit_facet(layout, facet, {}, receiver).in.sines));
  };
  const std::vector<std::size_t> facets = some_facets(layout, 64);
  const std::size_t facet =
      *std::min_element(facets.begin(), facets.end(), [&](std::size_t a, std::size_t b) { return turn(a) < turn(b); });
  const glm::dvec2 slope = nearest_reachable(
      slope_towards(layout, facet, (to + layout.offset(receiver) - layout.middle(facet)) / layout.distances[receiver],
                    receiver),
      layout.n, layout.sines_on(facet));
  const Footprint print = footprint(layout, facet, slope, receiver);
  AxisBlur smears{{print.x0 - at.x, std::vector<double>(static_cast<std::size_t>(print.columns))},
                  {print.y0 - at.y, std::vector<double>(static_cast<std::size_t>(print.rows))}};
  for (int k = 0; k < print.rows; ++k)
    for (int i = 0; i < print.columns; ++i) {
      const double part = print.cells[index_at(i, k, print.columns)];
      smears.x.parts[static_cast<std::size_t>(i)] += part;
      smears.y.parts[static_cast<std::size_t>(k)] += part;
    }
  return smears;
}

/// Light smeared along one axis; `back`: from where it falls to where it was aimed. Light beside the cells is left out.
std::vector<double> smeared(const std::vector<double>& light, const glm::ivec2& cells, const Smear& smear, int axis,
                            bool back) {
  std::vector<double> result(light.size());
  const int length = cells[axis], lines = cells[1 - axis];
  for (int line = 0; line < lines; ++line)
    for (int to = 0; to < length; ++to) {
      double sum = 0;
      for (std::size_t i = 0; i < smear.parts.size(); ++i) {
        const int away = smear.first + static_cast<int>(i), from = back ? to + away : to - away;
        if (from >= 0 && from < length)
          sum += smear.parts[i] * light[axis == 0 ? index_at(from, line, cells.x) : index_at(line, from, cells.x)];
      }
      result[axis == 0 ? index_at(to, line, cells.x) : index_at(line, to, cells.x)] = sum;
    }
  return result;
}

std::vector<double> smeared(const std::vector<double>& light, const glm::ivec2& cells, const AxisBlur& smears,
                            bool back) {
  return smeared(smeared(light, cells, smears.x, 0, back), cells, smears.y, 1, back);
}

/// The nearest values that are not negative and sum to 1: all of them less the same, by Newton's steps.
void make_light(std::vector<double>& values) {
  constexpr int most_steps = 20;
  double less = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    double sum = -1, count = 0;
    for (const double value : values)
      if (value > less) {
        sum += value;
        ++count;
      }
    const double next = sum / count;
    if (next <= less) break;
    less = next;
  }
  for (double& value : values) value = std::max(0.0, value - less);
}

/// The brightest cell over an even picture's.
double brightest(const Target& target) {
  return *std::max_element(target.begin(), target.end()) * static_cast<double>(target.size());
}

/// The width of a facet's light in millimetres: that of a box with its variance.
double width(const Smear& smear, double cell) {
  double sum = 0, first = 0, second = 0;
  for (std::size_t i = 0; i < smear.parts.size(); ++i) {
    const double at = smear.first + static_cast<double>(i);
    sum += smear.parts[i];
    first += smear.parts[i] * at;
    second += smear.parts[i] * at * at;
  }
  return sum > 0 ? cell * std::sqrt(12 * std::max(0.0, second / sum - first * first / (sum * sum)) + 1) : 0;
}

bool has_greys(const Picture& picture) {
  using Type = Picture::Type;
  return picture.type == Type::file || picture.type == Type::face || picture.type == Type::gradient ||
         picture.background > 0;
}

} // namespace

Layout blurring_layout(const Settings& settings, Layout layout) {
  constexpr double smaller = 256;
  if (settings.method == Settings::Method::lens) layout.size /= smaller;
  return layout;
}

Target best_possible(const Layout& layout, const Target& target, std::size_t receiver) {
  const AxisBlur smears = smears_of(layout, receiver);
  const std::size_t taps = smears.x.parts.size() + smears.y.parts.size();
  if (taps <= 2) return target;
  // Light may be aimed beside the receiver: a rim of cells, in which nothing is wanted or minded.
  const glm::ivec2 rim(smears.x.parts.size() / 2, smears.y.parts.size() / 2), cells = layout.cells + 2 * rim;
  const auto for_receiver = [&](const auto& use) {
    for (int y = 0; y < layout.cells.y; ++y)
      for (int x = 0; x < layout.cells.x; ++x)
        use(index_at(x, y, layout.cells.x), index_at(x + rim.x, y + rim.y, cells.x));
  };
  std::vector<double> aimed(index_at(0, cells.y, cells.x));
  for_receiver([&](std::size_t cell, std::size_t at) { aimed[at] = target[cell]; });
  std::vector<double> ahead = aimed, over(aimed.size());
  const std::size_t steps = std::clamp(most_products / (2 * aimed.size() * taps), fewest_steps, step_limit);
  double t = 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const std::vector<double> cast = smeared(ahead, cells, smears, false);
    for_receiver([&](std::size_t cell, std::size_t at) { over[at] = cast[at] - target[cell]; });
    const std::vector<double> gradient = smeared(over, cells, smears, true);
    const double next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    std::vector<double> moved(aimed.size());
    for (std::size_t c = 0; c < aimed.size(); ++c) moved[c] = ahead[c] - gradient[c];
    make_light(moved);
    for (std::size_t c = 0; c < aimed.size(); ++c) ahead[c] = moved[c] + (t - 1) / next * (moved[c] - aimed[c]);
    aimed = std::move(moved);
    t = next;
  }
  const std::vector<double> cast = smeared(aimed, cells, smears, false);
  Target best(target.size());
  for_receiver([&](std::size_t cell, std::size_t at) { best[cell] = cast[at]; });
  const double sum = std::accumulate(best.begin(), best.end(), 0.0);
  for (double& light : best) light /= sum;
  return best;
}

std::vector<Target> best_possible(const Layout& layout, const std::vector<Target>& targets) {
  std::vector<Target> best(targets.size());
  for_blocks(targets.size(), [&](std::size_t j) { best[j] = best_possible(layout, targets[j], j); });
  return best;
}

std::vector<std::string> picture_notes(const Settings& settings, const Layout& layout,
                                       const std::vector<Target>& targets, const std::vector<Target>& best) {
  std::vector<std::string> notes;
  for (std::size_t j = 0; j < targets.size(); ++j) {
    // Flat facets cast bright lines on black best.
    const bool wants_even =
        settings.method == Settings::Method::lens || settings.receivers[j].picture.type == Picture::Type::file;
    if (const double off = cost_of(targets[j], best[j], 1).rel_l2; off > far_off) {
      const AxisBlur smears = smears_of(blurring_layout(settings, layout), j);
      notes.push_back(fmt::format(
          "picture {} comes hardly closer than {:.2f} (rel_l2): a facet's light is {:.3g} x {:.3g} mm wide there, a "
          "cell {:.3g} x {:.3g} mm; choose fewer cells, more facets or less blur",
          j + 1, off, width(smears.x, layout.cell().x), width(smears.y, layout.cell().y), layout.cell().x,
          layout.cell().y));
    }
    if (const double times = brightest(targets[j]); wants_even && times > very_bright)
      notes.push_back(fmt::format(
          "picture {} is dark: all light goes to its bright parts, the brightest gets {:.0f} times that of an even "
          "picture, and the object is steep for it; a 'background' of {:.2f} more makes that {}",
          j + 1, times, (1 / bright - 1 / times) / (1 - 1 / times), bright));
  }
  if (settings.method == Settings::Method::assign && targets.size() == 1 && has_greys(settings.receivers[0].picture))
    notes.push_back("flat facets cast patches of their own size, which greys show as grain or rings; for one picture "
                    "choose the method 'lens'");
  return notes;
}

std::vector<std::string> workshop_notes(const Settings& settings, const Layout& layout) {
  constexpr double much_light = 0.02, few_layers = 4;
  if (settings.method == Settings::Method::lens) return {};
  std::vector<std::string> notes;
  // A facet like many sends light a quarter of the receiver beside its middle. Its walls are about as high as it rises.
  const double slope = std::min(
                   std::hypot(glm::length(layout.receiver) / std::sqrt(2.0) / 4, glm::length(layout.offset(0))) /
                       layout.distances.front(),
                   usable_slope(layout)),
               steepness = glm::length(facet_gradient({slope, 0}, layout.n)), rise = steepness * layout.facet().x,
               walls = layout.free_heights ? 1.0 / 3 : 1; // their part of that height, measured
  // Four walls; to each the facet gives half of the wall's height times the draft's tangent.
  if (const double light = 2 * layout.draft * steepness * walls; light > much_light)
    notes.push_back(fmt::format(
        "walls that lean by {} degrees take some {:.0f} % of the light, which the search does not know; choose "
        "receivers further away, a smaller draft_deg or free heights",
        settings.draft_deg, 100 * light));
  if (settings.layer_mm && rise < few_layers * *settings.layer_mm)
    notes.push_back(
        fmt::format("a facet that sends light a quarter of receiver 1 beside its middle rises by {:.2g} mm, "
                    "{:.2g} layers of {} mm; choose thinner layers or fewer facets",
                    rise, rise / *settings.layer_mm, *settings.layer_mm));
  return notes;
}

} // namespace nephroid::inverse
