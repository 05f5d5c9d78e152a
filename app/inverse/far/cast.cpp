// SPDX-License-Identifier: Apache-2.0
#include "inverse/far/cast.h"

#include "inverse/far/intensity.h"
#include "scene/luminaire_files.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace nephroid::inverse {
namespace {

constexpr double in_target = 0.01, bright = 0.5; // of the largest wanted intensity

/// Sums of a cutoff's light over its level part, in a band of a tenth of its height on either side of the cut.
double contrast_of(const CastIntensity& cast, const Intensity& far) {
  const double depth = far.size_deg[1] / 10, left = -0.9 * far.size_deg[0] / 2, right = -0.1 * far.size_deg[0] / 2;
  double below = 0, above = 0;
  constexpr int across = 64, up = 16;
  for (int k = 0; k < across * up; ++k) {
    const double x = left + (right - left) * (k % across + 0.5) / across,
                 y = depth * (k / across + 0.5) / up; // NOLINT(bugprone-integer-division)
    const double tx = std::tan(glm::radians(x)), ty = std::tan(glm::radians(y));
    above += at_tangent(cast.layout, cast.cast, {tx, ty});
    below += at_tangent(cast.layout, cast.cast, {tx, -ty});
  }
  return below / std::max(above, 1e-300);
}

scene::LuminaireGrid grid_of(const CastIntensity& cast) {
  const glm::dvec2 half = cast.layout.receiver / 2.0 / cast.layout.distances.front();
  const double cell =
                   glm::degrees(std::min(cast.layout.cell().x, cast.layout.cell().y) / cast.layout.distances.front()),
               reach = glm::degrees(std::atan(glm::length(half)));
  const int gammas = std::clamp(static_cast<int>(std::ceil(reach / cell)), 8, 256);
  scene::LuminaireGrid grid;
  for (int i = 0; i <= gammas + 1; ++i) grid.gamma_deg.push_back(reach * i / gammas); // the last one is dark
  if (grid.gamma_deg.back() < 90)
    grid.gamma_deg.push_back(90);
  else
    grid.gamma_deg.back() = 90;
  grid.planes = 4 * std::clamp(static_cast<int>(std::ceil(90 * std::sin(glm::radians(reach)) / cell)), 9, 90);
  for (int plane = 0; plane < grid.planes; ++plane)
    for (const double gamma : grid.gamma_deg) {
      const double c = glm::radians(grid.c_deg(plane)), t = std::tan(glm::radians(std::min(gamma, 89.9)));
      grid.candela.push_back(at_tangent(cast.layout, cast.cast, t * glm::dvec2(std::cos(c), std::sin(c))));
    }
  for (std::size_t c = 0; c < cast.cast.size(); ++c) grid.lumens += cast.cast[c] * steradians(cast.layout, c);
  return grid;
}

std::string csv_of(const CastIntensity& cast) {
  std::string text = "right_deg,up_deg,wanted_cd,cast_cd\n";
  for (std::size_t c = 0; c < cast.cast.size(); ++c) {
    const glm::dvec2 angles = glm::degrees(glm::atan(cast.layout.middle_of_cell(c) / cast.layout.distances.front()));
    fmt::format_to(std::back_inserter(text), "{:.4f},{:.4f},{:.6g},{:.6g}\n", angles.x, angles.y, cast.wanted[c],
                   cast.cast[c]);
  }
  return text;
}

/// Both intensities in the planes C0-C180 and C90-C270, as polar curves: down is along the axis.
std::string svg_of(const CastIntensity& cast) {
  constexpr double radius = 90, margin = 10; // mm
  constexpr int rings = 4;
  const double most = std::max(*std::ranges::max_element(cast.cast), *std::ranges::max_element(cast.wanted));
  const auto place = [&](double gamma, double part) {
    return fmt::format("{:.3f} {:.3f}", radius + margin + part * radius * std::sin(glm::radians(gamma)),
                       margin + part * radius * std::cos(glm::radians(gamma)));
  };
  std::string text =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\" "
                  "font-family=\"sans-serif\" font-size=\"3.5\" fill=\"none\">\n"
                  "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
                  2 * (radius + margin), radius + margin + 25);
  for (int ring = 1; ring <= rings; ++ring) {
    const double part = ring / (1.0 * rings);
    text += fmt::format("<path d=\"M{} A{:.3f} {:.3f} 0 0 0 {}\" stroke=\"silver\" stroke-width=\"0.2\"/>\n"
                        "<text x=\"{}\" y=\"{:.3f}\" fill=\"gray\">{:.4g} cd</text>\n",
                        place(-90, part), part * radius, part * radius, place(90, part), radius + margin + 1,
                        margin + part * radius - 1, part * most);
  }
  for (int gamma = -90; gamma <= 90; gamma += 30)
    text += fmt::format("<path d=\"M{}L{}\" stroke=\"silver\" stroke-width=\"0.2\"/>\n", place(0, 0), place(gamma, 1));
  const auto curve = [&](const std::vector<double>& cells, const glm::dvec2& along, const char* style) {
    std::string path;
    for (int quarter = -358; quarter <= 358; ++quarter) {
      const double gamma = quarter / 4.0;
      fmt::format_to(std::back_inserter(path), "{}{}", path.empty() ? "M" : "L",
                     place(gamma, at_tangent(cast.layout, cells, std::tan(glm::radians(gamma)) * along) / most));
    }
    text += fmt::format("<path d=\"{}\" stroke-width=\"0.4\" {}/>\n", path, style);
  };
  const std::pair<glm::dvec2, std::string> planes[] = {{{1, 0}, "crimson"}, {{0, 1}, "royalblue"}};
  for (const auto& [along, colour] : planes) {
    curve(cast.wanted, along, fmt::format("stroke=\"{}\" stroke-dasharray=\"1 1\"", colour).c_str());
    curve(cast.cast, along, fmt::format("stroke=\"{}\"", colour).c_str());
  }
  return text + fmt::format("<text x=\"{0}\" y=\"{1}\" fill=\"crimson\">C0 (right) to C180</text>\n"
                            "<text x=\"{0}\" y=\"{2}\" fill=\"royalblue\">C90 (up) to C270</text>\n"
                            "<text x=\"{0}\" y=\"{3}\" fill=\"black\">dashed: wanted</text>\n</svg>\n",
                            margin, radius + margin + 8, radius + margin + 14, radius + margin + 20);
}

struct Figure {
  const char *name, *unit, *sentence;
  double value;
};

std::vector<Figure> figures_of(const CastIntensity& cast) {
  std::vector<Figure> figures{
      {"lumens", "lm", "of the lamp", cast.lumens},
      {"on_front", "", "the part of them that falls on the front", cast.on_front},
      {"on_target", "", "the part of those that goes to the target", cast.on_target},
      {"on_target_of_sent", "", "the part of what the object sends forward", cast.of_sent},
      {"on_target_of_lamp", "", "the part of the lamp's", cast.on_target * cast.on_front},
      {"wanted_cd", "cd", "the largest wanted intensity", *std::ranges::max_element(cast.wanted)},
      {"cast_cd", "cd", "the largest cast intensity", *std::ranges::max_element(cast.cast)},
      {"rms", "", "the deviation from what is wanted, over the target, relative to it", cast.rms},
      {"uniformity", "", "the least of cast over wanted, over its mean, where half or more is wanted",
       cast.uniformity}};
  if (cast.contrast)
    figures.push_back({"contrast", "", "the intensity just below the cut over that just above", *cast.contrast});
  return figures;
}

std::string page_of(const CastIntensity& cast, const std::string& name) {
  std::string text = fmt::format("# Intensity: {}\n\n| figure | value | what |\n|---|---|---|\n", name);
  for (const Figure& f : figures_of(cast))
    text += fmt::format("| `{}` | {:.4g}{}{} | {} |\n", f.name, f.value, *f.unit ? " " : "", f.unit, f.sentence);
  return text;
}

} // namespace

double at_tangent(const Layout& layout, const std::vector<double>& cells, const glm::dvec2& tangent) {
  const glm::dvec2 at = layout.in_cells(tangent * layout.distances.front());
  if (!layout.cell_at(tangent * layout.distances.front())) return 0;
  const glm::dvec2 from = glm::clamp(at - 0.5, glm::dvec2(0), glm::dvec2(layout.cells) - 1.0);
  const glm::ivec2 first = glm::min(glm::ivec2(from), layout.cells - 2);
  const glm::dvec2 part = from - glm::dvec2(first);
  const auto cell = [&](int x, int y) { return cells[index_at(first.x + x, first.y + y, layout.cells.x)]; };
  return glm::mix(glm::mix(cell(0, 0), cell(1, 0), part.x), glm::mix(cell(0, 1), cell(1, 1), part.x), part.y);
}

CastIntensity cast_of(const preset::Preset& preset, const Layout& layout, const Target& wanted_light,
                      const std::vector<double>& light, double sent) {
  const Settings& s = settings(preset);
  CastIntensity cast;
  cast.layout = layout;
  cast.lumens = s.far->lumens.value_or(default_lumens);
  cast.on_front = part_on_front(layout, s);
  const double a_facet = cast.lumens * cast.on_front / static_cast<double>(layout.facet_count());
  for (std::size_t c = 0; c < light.size(); ++c) {
    cast.cast.push_back(a_facet * light[c] / steradians(layout, c));
    cast.wanted.push_back(wanted_light[c] / steradians(layout, c));
  }
  const double most = *std::ranges::max_element(cast.wanted);
  double wanted = 0, there = 0;
  const double limit = in_target * most;
  std::vector<std::size_t> target, brightest;
  for (std::size_t c = 0; c < light.size(); ++c) {
    if (cast.wanted[c] > limit) target.push_back(c);
    if (cast.wanted[c] > bright * most) brightest.push_back(c);
  }
  for (const std::size_t c : target) {
    wanted += cast.wanted[c] * steradians(layout, c);
    there += cast.cast[c] * steradians(layout, c);
  }
  there = std::max(there, 1e-300); // a mesh that sends no light there
  cast.on_target = there / (cast.lumens * cast.on_front);
  cast.of_sent = sent > 0 ? cast.on_target / sent : 0;
  double over = 0, squares = 0, least = std::numeric_limits<double>::infinity(), sum = 0;
  for (const std::size_t c : target) {
    const double angle = steradians(layout, c), is = cast.cast[c] / there * wanted - cast.wanted[c];
    over += angle * is * is;
    squares += angle * cast.wanted[c] * cast.wanted[c];
  }
  for (const std::size_t c : brightest) {
    const double ratio = cast.cast[c] / cast.wanted[c];
    least = std::min(least, ratio);
    sum += ratio;
  }
  cast.rms = std::sqrt(over / squares);
  cast.uniformity = least / std::max(1e-300, sum / static_cast<double>(brightest.size()));
  const double scale = wanted_candela(preset, layout).value_or(most * there / wanted) / most;
  for (double& value : cast.wanted) value *= scale;
  if (s.far->type == Intensity::Type::cutoff) cast.contrast = contrast_of(cast, *s.far);
  return cast;
}

void add_intensity_figures(job::Snapshot& snapshot, const CastIntensity& cast) {
  for (const Figure& f : figures_of(cast)) snapshot.scalars.push_back({"far", f.name, f.value});
}

void add_intensity_files(job::Snapshot& snapshot, const CastIntensity& cast, const std::string& name) {
  const auto shared = std::make_shared<const CastIntensity>(cast);
  const auto add = [&](const char* file, auto text) {
    snapshot.files.push_back({file, [text, shared, name](ByteSink& to) {
                                const std::string words = text(*shared, name);
                                to.write(std::as_bytes(std::span(words)));
                              }});
  };
  add("intensity.ies",
      [](const CastIntensity& c, const std::string& of) { return scene::ies(grid_of(c), "judged", of); });
  add("intensity.ldt",
      [](const CastIntensity& c, const std::string& of) { return scene::eulumdat(grid_of(c), "judged", of); });
  add("intensity.csv", [](const CastIntensity& c, const std::string&) { return csv_of(c); });
  add("intensity.svg", [](const CastIntensity& c, const std::string&) { return svg_of(c); });
  add("intensity.md", page_of);
}

} // namespace nephroid::inverse
