// SPDX-License-Identifier: Apache-2.0
#include "inverse/plan.h"

#include "base/counted.h"
#include "inverse/assign/assignment.h"
#include "inverse/describe_settings.h"
#include "inverse/diffraction.h"
#include "inverse/facets/smooth_solid.h"
#include "inverse/far/intensity.h"
#include "inverse/lens/lens.h"
#include "inverse/light.h"
#include "inverse/pictures/preview.h"
#include "inverse/pictures/target.h"
#include "inverse/step/step.h"
#include "inverse/thesis/pipeline.h"
#include "inverse/tolerances.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::inverse {
namespace {

/// Measured: a triangle of the solid with its tree, and of a copy with errors; a facet on the host, with its pictures.
constexpr std::uint64_t triangle_bytes = 145, copied_triangle_bytes = 21, facet_bytes = 400;

std::vector<plan::Decision> decisions_of(const Settings& s, const Layout& l, std::uint64_t triangles) {
  const bool blurred = l.blurs(), straight = !l.light.facets;
  const bool assign = s.method == Settings::Method::assign, thesis = s.method == Settings::Method::thesis,
             lens = s.method == Settings::Method::lens;
  const std::string what =
      fmt::format("{} x {} facets, {}, slopes up to {:.3g}", l.facets.x, l.facets.y,
                  l.far ? "an intensity over directions" : counted(l.distances.size(), "receiver"), usable_slope(l));
  const std::string chosen = fmt::format("inverse.method is '{}'", preset::word(s.method));
  const bool anneals = thesis && s.thesis.cycles > 0, corrects = thesis && s.thesis.corrections > 0;
  return {{"assign", assign, assign ? what : chosen},
          {"sampling", thesis, thesis ? what : chosen},
          {"annealing", anneals,
           anneals  ? "sizes, then extension and overshoot"
           : thesis ? "inverse.thesis.cycles is 0"
                    : chosen},
          {"correction", corrects,
           corrects ? "of intensities, cell by cell"
           : thesis ? "inverse.thesis.corrections is 0"
                    : chosen},
          {"blur", blurred,
           blurred ? "the size of a lamp or of the sun's disc, a rough surface or dispersion, in every footprint"
                   : "the light has no disc (inverse.sun_deg), scatter_deg is 0, and there is one index"},
          {"smoothing", assign && l.smoothing > 0,
           !assign           ? "the method 'assign' alone has it"
           : l.smoothing > 0 ? "facets unlike their neighbours cost something"
                             : "inverse.smoothing_normals is 0: no term"},
          {"heights", l.free_heights,
           l.free_heights ? "facets move along z to where their walls are lowest"
           : lens         ? "a smooth surface has no walls"
                          : "inverse.heights is flat: nothing is solved"},
          {"transport", lens, lens ? what : chosen},
          {"incoming", !straight,
           !l.own_lights.empty() ? "a direction of its own for each facet, in each of several lights"
           : straight            ? "parallel light straight on: one direction for all facets"
           : l.round             ? "a direction and a power of its own for each facet: none beside the round outline"
                                 : "a direction of its own for each facet"},
          {"mesh", true,
           fmt::format("some {:.2g} million triangles, an STL of {}", static_cast<double>(triangles) / 1e6,
                       plan::readable_bytes(stl_bytes(triangles)))},
          {"judge", true,
           l.coloured() ? "in colours, by rays through the finished solid, walls and all"
                        : "rays through the finished solid, walls and all"}};
}

} // namespace

Design::Design(const preset::Preset& preset)
    : layout(make_layout(preset)), targets(make_targets(preset, layout, file_notes)), settings_(settings(preset)) {}

const std::vector<Target>& Design::best() const {
  std::call_once(has_best_, [&] { best_ = best_possible(blurring_layout(settings_, layout), targets); });
  return best_;
}

const LensForecast& Design::lens() const {
  std::call_once(has_lens_, [&] { lens_ = forecast(layout, targets.front(), settings_.mesh_error); });
  return lens_;
}

InversePlan make_plan(const preset::Preset& preset) {
  const Settings& s = settings(preset);
  if (s.step) require_step(Location(preset.source) / "inverse" / "step");
  InversePlan plan;
  plan.design = std::make_shared<const Design>(preset);
  const Layout& l = plan.design->layout;
  constexpr std::uint64_t triangles_a_facet = 14; // with its walls
  const std::uint64_t triangles = plan.triangles =
      s.method == Settings::Method::lens ? plan.design->lens().triangles : triangles_a_facet * l.facet_count();
  if (stl_bytes(triangles) > most_stl_bytes)
    refuse_mesh(Location(preset.source) / "inverse", plan.design->lens().mesh_error, triangles);
  plan.engine = "inverse";
  plan.layers = 1;
  plan.defines = facet_defines(l);
  plan.smaller = "choose fewer inverse.facets, inverse.cells or inverse.frames, or a smaller scene.camera.resolution";
  plan.decisions = decisions_of(s, l, triangles);
  const std::uint64_t light_channels = l.coloured() ? 6 : 2; // even and odd rounds
  const int cut = 2 * halvings(l);
  const std::uint64_t with_errors = (cut > 0 ? triangle_bytes : copied_triangle_bytes) * (triangles << cut) +
                                    light_channels * sizeof(std::int64_t) * l.cell_count() * l.distances.size();
  plan.buffers = {
      {"light on the facets (host)", 2 * sizeof(Incoming) * (1 + l.own_lights.size()) * l.incoming().size(), true},
      {"light on the receivers (host)", 8 * sizeof(double) * l.cell_count() * l.distances.size(), true},
      {"facets and what the pictures lack", s.method == Settings::Method::assign ? DeviceFacets::bytes(l) : 0},
      {"a lens's fine grids (host)", s.method == Settings::Method::lens ? Lens::bytes(l) : 0, true},
      {"light on the frames (host)", 5 * sizeof(double) * l.cell_count() * l.frames.size(), true},
      {"the judge's light", light_channels * sizeof(std::int64_t) * l.cell_count() *
                                ((1 + l.own_lights.size()) * l.distances.size() + l.frames.size())},
      {"the facets and their pictures (host)", facet_bytes * l.facet_count(), true},
      {"the solid and its tree (host)", triangle_bytes * triangles, true},
      {"a solid with errors (host)", s.tolerances ? with_errors : 0, true}};
  return plan;
}

std::vector<std::string> notes_of(const preset::Preset& preset, const Design& design) {
  const Settings& s = settings(preset);
  const Layout& l = design.layout;
  std::vector<std::string> notes = design.file_notes;
  if (l.facet().x > l.cell().x / 2 * 1.001 || l.facet().y > l.cell().y / 2 * 1.001)
    notes.push_back(fmt::format(
        "facets of {:.4g} x {:.4g} mm are larger than half a cell of {:.4g} x {:.4g} mm: {}; choose more facets or "
        "fewer cells",
        l.facet().x, l.facet().y, l.cell().x, l.cell().y,
        s.method == Settings::Method::lens ? "even grey shows them as a pattern" : "the pictures become soft"));
  for (std::size_t j = 0; j < l.distances.size(); ++j)
    if (const double part = shaded_part(l, j); part > 0)
      notes.push_back(fmt::format("receiver {} stands in the light of {:.3g} % of the mirror, which the judge does not "
                                  "know; choose a larger tilt_deg, or give the receiver or the lamp an offset_mm",
                                  j + 1, 100 * part));
  std::ranges::move(picture_notes(s, l, design.targets, design.best()), std::back_inserter(notes));
  std::ranges::move(workshop_notes(s, l), std::back_inserter(notes));
  if (s.method == Settings::Method::lens)
    std::ranges::move(forecast_notes(s, design.lens()), std::back_inserter(notes));
  std::ranges::move(diffraction_notes(s, l), std::back_inserter(notes));
  if (l.far) std::ranges::move(far_notes(preset, l), std::back_inserter(notes));
  const std::int64_t trials = Pipeline::trials_of(s.thesis);
  if (s.method == Settings::Method::thesis && preset.stop.passes.value_or(trials) < trials)
    notes.push_back(
        fmt::format("the thesis' pipeline takes up to {} trials and stops after {}: a 'stop.passes' of {} lets it end",
                    trials, *preset.stop.passes, trials));
  return notes;
}

} // namespace nephroid::inverse
