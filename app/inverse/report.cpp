// SPDX-License-Identifier: Apache-2.0
#include "inverse/report.h"

#include "base/counted.h"
#include "inverse/diffraction.h"
#include "inverse/facets/files.h"
#include "inverse/far/cast.h"
#include "inverse/glass_view.h"
#include "inverse/object_view.h"
#include "inverse/print_page.h"
#include "inverse/step/step.h"
#include "plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

namespace nephroid::inverse {
namespace {

void add(job::Snapshot& snapshot, const std::string& group,
         std::initializer_list<std::pair<const char*, double>> figures) {
  for (const auto& [name, value] : figures) snapshot.scalars.push_back({group, name, value});
}

void add_cost(job::Snapshot& snapshot, const std::string& group, const Cost& c) {
  add(snapshot, group, {{"cost", c.cost}, {"cost_all", c.cost_all}, {"rel_l2", c.rel_l2}, {"missed", c.missed}});
}

/// Receivers that show this one's picture in another light, once it is judged.
std::vector<std::size_t> other_lights(const RunState& run, std::size_t receiver) {
  std::vector<std::size_t> others, lights{run.layout.light_index(receiver)};
  for (std::size_t k = 0; k < run.targets.size() && run.is_judged(); ++k)
    if (const std::size_t light = run.layout.light_index(k); std::ranges::find(lights, light) == lights.end()) {
      lights.push_back(light);
      others.push_back(k);
    }
  return others;
}

/// What the receiver's brightest cell has where the picture is as it is wanted, in facets.
double most_of(const RunState& run, std::size_t receiver) {
  const std::vector<double>& light = run.judgement->judge().light(receiver);
  return std::accumulate(light.begin(), light.end(), 0.0) * run.brightest(receiver);
}

/// The correlation of a picture with light, cell by cell: 1 is the picture itself, 0 has nothing of it.
double likeness(const Target& target, const std::vector<double>& light) {
  const double count = static_cast<double>(target.size());
  const double t = std::accumulate(target.begin(), target.end(), 0.0) / count,
               z = std::accumulate(light.begin(), light.end(), 0.0) / count;
  double both = 0, tt = 0, zz = 0;
  for (std::size_t c = 0; c < target.size(); ++c) {
    both += (target[c] - t) * (light[c] - z);
    tt += (target[c] - t) * (target[c] - t);
    zz += (light[c] - z) * (light[c] - z);
  }
  return tt > 0 && zz > 0 ? both / std::sqrt(tt * zz) : 0;
}

double part_of(const std::vector<double>& light, const std::vector<double>& whole) {
  const double sum = std::accumulate(whole.begin(), whole.end(), 0.0);
  return sum > 0 ? std::accumulate(light.begin(), light.end(), 0.0) / sum : 0;
}

/// What a picture's words say of its light, where receivers have lights of their own.
std::string in_light_of(const RunState& run, std::size_t receiver) {
  if (run.layout.own_lights.empty()) return "";
  const Settings& s = settings(run.preset);
  const Light& light = s.receivers[receiver].light ? *s.receivers[receiver].light : s.light;
  if (light.type == Light::Type::sun) {
    const long minutes = std::lround(60 * light.place.hour);
    return fmt::format(", {:02}:{:02}", minutes / 60, minutes % 60);
  }
  if (light.type == Light::Type::parallel) return fmt::format(", tilt {:g}", light.tilt_deg);
  return fmt::format(", lamp at {:g}, {:g}, {:g}", light.offset_mm[0], light.offset_mm[1], light.distance_mm);
}

void add_costs(job::Snapshot& snapshot, const RunState& run) {
  const std::vector<Cost> believed = run.method.costs(), judged = run.is_judged() ? run.costs() : std::vector<Cost>();
  add_cost(snapshot, "believed", mean(believed));
  if (!judged.empty()) add_cost(snapshot, "judged", mean(judged));
  for (std::size_t j = 0; j < believed.size(); ++j) {
    add(snapshot, receiver_group(j),
        {{"distance_mm", run.layout.distances[j]},
         {"width_mm", run.layout.receiver.x},
         {"height_mm", run.layout.receiver.y},
         {"believed_cost", believed[j].cost},
         {"believed_rel_l2", believed[j].rel_l2},
         {"diffraction_cells", diffraction_cells(settings(run.preset), run.layout, j)}});
    if (!judged.empty()) add_cost(snapshot, receiver_group(j), judged[j]);
    if (const std::vector<std::size_t> others = other_lights(run, j); !others.empty()) {
      double alike = 0, bright = 0;
      for (const std::size_t other : others) {
        const std::vector<double>& light = run.judgement->judge().light_under(j, other);
        alike = std::max(alike, likeness(run.targets[j], light));
        bright = std::max(bright, part_of(light, run.judgement->judge().light(j)));
      }
      add(snapshot, receiver_group(j),
          {{"likeness", likeness(run.targets[j], run.judgement->judge().light(j))},
           {"likeness_in_others", alike},
           {"brightness_in_others", bright}});
    }
  }
  if (judged.empty()) return;
  const Cost noise = mean(run.judgement->judge().noise(run.targets));
  add(snapshot, "judged", {{"noise_cost", noise.cost}, {"noise_rel_l2", noise.rel_l2}});
}

void add_conflicts(job::Snapshot& snapshot, const Conflicts& conflicts) {
  for (std::size_t j = 0; j < conflicts.misplaced.size(); ++j) {
    snapshot.scalars.push_back({"conflicts", fmt::format("floor_{}", j + 1), conflicts.misplaced[j]});
    for (std::size_t k = j + 1; k < conflicts.misplaced.size(); ++k)
      snapshot.scalars.push_back(
          {"conflicts", fmt::format("{}_{}", j + 1, k + 1), conflicts.between[j][k] + conflicts.between[k][j]});
  }
}

void add_object(job::Snapshot& snapshot, const Layout& layout, const Solid& solid,
                const std::vector<glm::dvec2>& slopes) {
  add(snapshot, "object",
      {{"index", layout.n},
       {"slope_limit", usable_slope(layout)},
       {"relief_mm", solid.relief()},
       {"thinnest_mm", layout.thickness - solid.highest},
       {"highest_wall_mm", solid.highest_wall},
       {"wall_area_mm2", solid.wall_area},
       {"steepest_wall_deg", solid.wall_area > 0 ? solid.steepest_wall_deg : 0},
       {"roughness", roughness(layout, slopes)},
       {"steepest_deg", solid.steepest_deg},
       {"triangles", static_cast<double>(solid.mesh.triangles.size())}});
}

/// The STEP file and its sentence in workshop.md, of whichever is asked for first: it takes minutes.
class StepOnce {
public:
  StepOnce(std::shared_ptr<const Layout> layout, std::shared_ptr<const Solid> solid, std::string name)
      : layout_(std::move(layout)), solid_(std::move(solid)), name_(std::move(name)) {}
  const StepFile& file() const {
    std::call_once(made_, [&] { file_ = step_file(*layout_, *solid_, name_); });
    return file_;
  }
  std::string sentence() const {
    return fmt::format(
        "- `object.step`: {} in {}, AP214; OpenCascade reads it back as one closed solid of {:.6g} cm3.\n",
        counted(file().faces, "face"), plan::readable_bytes(file().bytes.size()), file().volume / 1000);
  }

private:
  std::shared_ptr<const Layout> layout_;
  std::shared_ptr<const Solid> solid_;
  std::string name_;
  mutable std::once_flag made_;
  mutable StepFile file_;
};

std::string material_of(const Settings& s, double n) {
  if (s.kind == Settings::Kind::mirror) return "a mirror";
  const std::string name = s.index.type == preset::Dispersion::Type::file ? s.index.file + ", " : "";
  return fmt::format("{}index of refraction {:.6g} {}", name, n,
                     s.light.spectrum ? "in the mean over the light's luminance"
                                      : fmt::format("at {} nm", s.wavelength_nm));
}

CastIntensity cast_far(const RunState& run) {
  return cast_of(run.preset, run.layout, run.targets.front(), run.judgement->judge().light(0),
                 run.judgement->judge().outcomes().sent);
}

} // namespace

double RunState::brightest(std::size_t receiver) const { return *std::ranges::max_element(targets[receiver]); }

std::shared_ptr<const job::Picture> RunState::picture_of(std::size_t screen, double most) const {
  if (!is_judged()) return received_picture(method.light(screen), most, layout);
  const Judge& judge = judgement->judge();
  if (layout.coloured()) return coloured_picture(judge.colours(screen), most, layout);
  return received_picture(judge.light(screen), most, layout);
}

std::string receiver_group(std::size_t receiver) { return fmt::format("inverse/receivers/{}", receiver); }

void add_figures(job::Snapshot& snapshot, const RunState& run, const std::optional<Conflicts>& conflicts) {
  add_costs(snapshot, run);
  if (conflicts) add_conflicts(snapshot, *conflicts);
  if (!run.is_judged()) return;
  const RayOutcomes f = run.judgement->judge().outcomes();
  if (run.layout.far) add_intensity_figures(snapshot, cast_far(run));
  add(snapshot, "light", {{"sent", f.sent}, {"reflected", f.reflected}, {"lost", f.lost}, {"by_walls", f.by_walls}});
  add_object(snapshot, run.layout, *run.judgement->solid(), run.method.slopes());
}

std::vector<std::shared_ptr<const job::Picture>> add_pictures(job::Snapshot& snapshot, const RunState& run) {
  std::vector<std::vector<Captioned>> columns;
  std::vector<std::shared_ptr<const job::Picture>> receivers;
  const std::vector<Cost> costs = run.costs();
  for (std::size_t j = 0; j < run.targets.size(); ++j) {
    const double brightest = run.brightest(j);
    const auto wanted = grey_picture(run.targets[j], 1 / brightest, run.layout.cells),
               received = run.picture_of(j, brightest);
    columns.push_back(
        {{wanted, run.layout.far ? "wanted, over tangents of angles"
                                 : fmt::format("wanted at {} mm{}", run.layout.distances[j], in_light_of(run, j))},
         {received, fmt::format("cast: cost {:.3f}", costs[j].cost)},
         {difference_picture(*wanted, *received), "red: too much, blue: too little"}});
    const char* const names[] = {"target", "receiver", "difference"};
    for (std::size_t i = 0; i < 3; ++i)
      snapshot.pictures.push_back({fmt::format("{}_{}", names[i], j + 1), columns.back()[i].picture});
    snapshot.pictures.push_back(
        {fmt::format("best_{}", j + 1), grey_picture(run.best[j], 1 / brightest, run.layout.cells)});
    receivers.push_back(received);
    for (const std::size_t other : other_lights(run, j))
      snapshot.pictures.push_back(
          {fmt::format("receiver_{}_light_{}", j + 1, other + 1),
           grey_picture(run.judgement->judge().light_under(j, other), 1 / most_of(run, j), run.layout.cells)});
  }
  snapshot.pictures.push_back({"slopes", slopes_picture(run.method.slopes(), run.method.heights(), run.layout)});
  const auto& [width, height] = run.preset.scene.camera.resolution;
  snapshot.picture = sheet(columns, run.layout.receiver, width, height);
  return receivers;
}

void add_frames(job::Snapshot& snapshot, const RunState& run) {
  const Layout& layout = run.layout;
  if (layout.frames.empty()) return;
  snapshot.curves.push_back({"frames", {"frame", "distance_mm"}, {}});
  const auto add = [&](double distance, std::size_t screen, double most) {
    const std::size_t number = snapshot.curves.back().rows.size() + 1;
    snapshot.curves.back().rows.push_back({static_cast<double>(number), distance});
    snapshot.pictures.push_back({fmt::format("frame_{:04}", number), run.picture_of(screen, most)});
  };
  const std::size_t gaps = layout.distances.size() - 1, between = layout.frames.size() / gaps;
  for (std::size_t j = 0; j < layout.distances.size(); ++j) {
    add(layout.distances[j], j, run.brightest(j));
    for (std::size_t k = 0; k < between && j < gaps; ++k) {
      const double part = static_cast<double>(k + 1) / static_cast<double>(between + 1);
      add(layout.frames[j * between + k], run.targets.size() + j * between + k,
          (1 - part) * run.brightest(j) + part * run.brightest(j + 1));
    }
  }
}

void add_files(job::Snapshot& snapshot, const RunState& run) {
  const Judgement& judgement = *run.judgement;
  const std::string name = run.preset.name.empty() ? "The object" : run.preset.name;
  // One for all files: a lamp's has a table of the facets.
  const auto layout = std::make_shared<const Layout>(run.layout);
  const auto add = [&](const std::string& file, auto write) {
    snapshot.files.push_back(
        {file, [write, solid = judgement.solid(), layout](ByteSink& to) { write(*layout, *solid, to); }});
  };
  add("object.obj", [](const Layout&, const Solid& solid, ByteSink& to) { write_obj(solid.mesh, to); });
  add("object.stl", [](const Layout&, const Solid& solid, ByteSink& to) { write_stl(solid.mesh, to); });
  if (judgement.solid()->mesh.triangles.size() <= most_3mf_triangles)
    add("object.3mf", [](const Layout&, const Solid& solid, ByteSink& to) { write_3mf(solid.mesh, to); });
  else
    snapshot.warnings.push_back(fmt::format("object.3mf is left out: the object has more than {} million triangles",
                                            most_3mf_triangles / 1'000'000));
  add("object.ply",
      [](const Layout&, const Solid& solid, ByteSink& to) { scene::write_ply(solid.mesh, to, mesh_title); });
  add("facets.json", write_facets);
  add("heights.exr", write_height_exr);
  add("heights.png", write_height_png);
  if (!run.layout.light.lamp && run.layout.own_lights.empty() && !run.layout.far)
    snapshot.files.push_back({glass_view_file, [view = glass_view(run.layout, run.targets, run.preset)](ByteSink& to) {
                                to.write(std::as_bytes(std::span(view)));
                              }});
  const auto add_text = [&](const std::string& file, auto text) {
    add(file, [text](const Layout& of, const Solid& solid, ByteSink& to) {
      const std::string words = text(of, solid);
      to.write(std::as_bytes(std::span(words)));
    });
  };
  std::string table, csv;
  if (const std::optional<Tolerances>& tolerances = judgement.tolerances()) {
    table = tolerance_table(run.costs(), tolerances->rows());
    csv = tolerance_csv(run.costs(), tolerances->rows());
  }
  const Settings& s = settings(run.preset);
  std::shared_ptr<const StepOnce> step;
  if (s.step) {
    step = std::make_shared<const StepOnce>(layout, judgement.solid(), name);
    snapshot.files.push_back(
        {"object.step", [step](ByteSink& to) { to.write(std::as_bytes(std::span(step->file().bytes))); }});
  }
  add_text("workshop.md", [material = material_of(s, run.layout.n), table, step,
                           making = Manufacturing{s.tool_radius_mm, s.layer_mm}](const Layout& of, const Solid& solid) {
    return workshop_page(of, solid, material, making) + (step ? step->sentence() : "") + table;
  });
  if (!csv.empty()) add_text("tolerance.csv", [csv](const auto&...) { return csv; });
  add_text("print_object.svg", [name](const Layout& of, const Solid&) { return object_page(of, name); });
  if (run.layout.far) add_intensity_files(snapshot, cast_far(run), name);
  for (std::size_t j = 0; j < run.targets.size() && !run.layout.far; ++j)
    add_text(fmt::format("print_{}.svg", j + 1),
             [name, j, cast = run.picture_of(j, run.brightest(j))](const Layout& of, const Solid&) {
               return receiver_page(of, j, *cast, name);
             });
}

std::shared_ptr<const job::Picture>
ObjectPicture::of(const RunState& run, const std::vector<std::shared_ptr<const job::Picture>>& receivers) {
  const preset::Camera camera = view_camera(run.preset);
  const bool finished = run.judgement && run.judgement->finished();
  const Shown now{run.method.steps(), static_cast<int>(4 * run.method.fraction_done()), finished, camera};
  if (picture_ && now == shown_) return picture_;
  shown_ = now;
  const std::vector<double> heights = run.method.heights();
  const bool smooth = settings(run.preset).method == Settings::Method::lens;
  picture_ = view_of({run.layout, run.method.slopes(), heights, smooth, receivers}, camera);
  return picture_;
}

} // namespace nephroid::inverse
