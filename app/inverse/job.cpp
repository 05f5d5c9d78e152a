// SPDX-License-Identifier: Apache-2.0
// A run of engine 3: slopes, then the solid, then its judgement.
#include "inverse/assign/conflicts.h"
#include "inverse/engine.h"
#include "inverse/facets/files.h"
#include "inverse/figures.h"
#include "inverse/judge.h"
#include "inverse/judge_time.h"
#include "inverse/method.h"
#include "inverse/object_view.h"
#include "inverse/print_page.h"
#include "inverse/sheet.h"
#include "inverse/tolerances.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace nephroid::inverse {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

constexpr double slice_seconds = 0.025;
/// Of a run's work that the judge is, for its progress only.
constexpr double judge_part = 0.1;

/// What the object is made of, in words.
std::string material_of(const Settings& s, double n)
{
  const std::string name = s.index.type == preset::Dispersion::Type::file ? s.index.file + ", " : "";
  return fmt::format("{}index of refraction {:.6g} {}", name, n,
                     s.light.spectrum ? "in the mean over the light's luminance" : fmt::format("at {} nm", s.wavelength_nm));
}

struct CostRow {
  double step = 0, seconds = 0;
  Cost cost;
};

class InverseJob final : public job::Job {
public:
  InverseJob(const preset::Preset& preset, const InversePlan& plan, const mpi::RankContext& context)
      : context_(context), preset_(preset), layout_(plan.layout), targets_(plan.targets), best_(plan.best), triangles_(plan.triangles),
        method_(make_method(preset, layout_, targets_, context))
  {
    note_step();
  }

  void advance() override
  {
    const Clock::time_point begin = Clock::now();
    while (!finished() && context_.communicator().broadcast(since(begin) < slice_seconds)) advance_stage();
    (judge_ ? judge_seconds_ : method_seconds_) += since(begin);
  }

  bool finished() const override { return judged() && (!tolerances_ || tolerances_->finished()); }
  bool estimates_error() const override { return false; }

  job::Progress progress() const override
  {
    job::Progress p;
    p.step = method_->steps();
    p.steps = judge_ ? p.step : most_steps() ? began_.steps + *most_steps() : -1;
    p.work = method_->tried();
    p.work_seconds = method_seconds_ + judge_seconds_;
    const double steps = static_cast<double>(p.step - began_.steps) + method_->fraction_done();
    const double looked = std::max(most_steps() ? steps / static_cast<double>(*most_steps()) : 0,
                                   preset_.stop.seconds ? looked_for() / std::max(looked_for(), search_seconds()) : 0);
    p.fraction = judge_ ? 1 - judge_part + judge_part * judged_part() : std::min(1.0, looked) * (1 - judge_part);
    p.units = method_->units();
    return p;
  }

  job::Snapshot snapshot() override
  {
    job::Snapshot snapshot;
    add_pictures(snapshot);
    snapshot.progress = progress();
    add_scalars(snapshot);
    snapshot.curves.push_back({"cost", {std::string(method_->units().step), "seconds", "cost", "cost_all", "rel_l2", "missed"}, {}});
    for (const CostRow& r : history_)
      snapshot.curves.back().rows.push_back({r.step, r.seconds, r.cost.cost, r.cost.cost_all, r.cost.rel_l2, r.cost.missed});
    method_->show(snapshot);
    snapshot.phases = {{"slopes", method_seconds_}, {"judge", judge_seconds_}};
    if (finished()) {
      add_files(snapshot);
      add_frames(snapshot);
      if (!method_->finished() && !had_all_steps())
        snapshot.warnings.push_back(
            fmt::format("stop.seconds ended the search after {} {}, to leave time for the judge; with more seconds the "
                        "pictures become better",
                        method_->units().step, method_->steps()));
    }
    return snapshot;
  }

  /// The stop counts from here.
  bool adopt(const preset::Preset& preset) override
  {
    if (!engine::adoptable(preset_, preset)) return false;
    if (settings(preset) != settings(preset_) || preset.stop != preset_.stop) {
      InversePlan plan = make_plan(preset);
      layout_ = std::move(plan.layout);
      targets_ = std::move(plan.targets);
      best_ = std::move(plan.best);
      judge_needs_.reset();
      method_->relight();
      stop_judging();
      in_view_.reset();
      began_ = {method_->steps(), method_seconds_};
      note_step();
    }
    preset_ = preset;
    return true;
  }

  void save(ByteSink& to) override
  {
    State saved(to);
    state(saved);
  }
  void load(ByteSource& from) override
  {
    State saved(from);
    state(saved);
  }

private:
  /// A run that ended at its stop goes on where it is given more steps or time; what it had judged then counts no more.
  void state(State& state)
  {
    method_->state(state);
    state.value(method_seconds_);
    state.value(judge_seconds_);
    state.value(began_);
    state.list(history_);
    bool judged = judge_.has_value();
    state.value(judged);
    if (!judged) return;
    if (state.is_read()) begin_judging();
    judge_->state(state);
    if (tolerances_) tolerances_->state(state);
    if (!state.is_read() || search_is_over()) return;
    conflict_known_ = false;
    stop_judging();
  }

  bool search_is_over()
  {
    if (method_->finished() || had_all_steps()) return true;
    if (!preset_.stop.seconds || method_->steps() == began_.steps) return false; // what is judged has had one step at least
    if (!judge_needs_)
      judge_needs_ = judge_seconds(context_, layout_, triangles_) * (settings(preset_).tolerances ? 1 + Tolerances::count : 1);
    return context_.communicator().broadcast(looked_for() + (method_->fraction_done() == 0 ? last_step_seconds() : 0) >= search_seconds());
  }

  bool had_all_steps() const { return most_steps() && method_->steps() - began_.steps >= *most_steps(); }

  double looked_for() const { return method_seconds_ - began_.seconds; }

  /// Of the stop's seconds, what the judge leaves; once search_is_over() has asked how long it takes.
  double search_seconds() const { return *preset_.stop.seconds - judge_needs_.value_or(0); }

  /// A step is not begun where it would not end in time; 0 before the first.
  double last_step_seconds() const
  {
    if (method_->steps() == began_.steps || history_.size() < 2) return 0;
    return history_.back().seconds - history_[history_.size() - 2].seconds;
  }

  /// Empty: until the seconds are over.
  std::optional<std::int64_t> most_steps() const
  {
    if (preset_.stop.passes) return *preset_.stop.passes;
    return preset_.stop.seconds ? std::nullopt : std::optional(method_->most());
  }

  void advance_stage()
  {
    if (judge_ && !judged())
      judge_->advance();
    else if (judge_)
      tolerances_->advance();
    else if (search_is_over())
      begin_judging();
    else {
      const std::int64_t before = method_->steps();
      method_->advance();
      if (method_->steps() == before) return;
      note_step();
    }
  }

  void note_step()
  {
    conflict_known_ = false;
    history_.push_back({static_cast<double>(method_->steps()), method_seconds_, mean(method_->costs())});
  }

  void begin_judging()
  {
    solid_ = std::make_shared<const Solid>(method_->solid());
    judge_.emplace(context_, layout_, *solid_, preset_.seed, targets_);
    if (settings(preset_).tolerances) tolerances_.emplace(context_, layout_, targets_, *solid_, preset_.seed);
    conflict_known_ = false;
  }

  void stop_judging()
  {
    tolerances_.reset();
    judge_.reset();
    solid_.reset();
  }

  bool judged() const { return judge_ && judge_->finished(); }

  /// Of the judge's work, each error of the tolerances being as much as the object itself.
  double judged_part() const
  {
    return tolerances_ ? (judge_->fraction_done() + Tolerances::count * tolerances_->fraction_done()) / (1 + Tolerances::count) : judge_->fraction_done();
  }

  /// As judged where that is done, else as believed.
  const std::vector<double>& light(std::size_t receiver) const { return judged() ? judge_->light(receiver) : method_->light(receiver); }

  /// Of a receiver or, once it is judged, of a frame behind them. In colours where the judge has them.
  std::shared_ptr<const job::Picture> picture_of(std::size_t screen, double most) const
  {
    if (judged() && layout_.coloured) return coloured_picture(judge_->colours(screen), most, layout_);
    return received_picture(screen < targets_.size() ? light(screen) : judge_->frame(screen - targets_.size()), most, layout_);
  }

  /// Part of all light, in a cell.
  double brightest(std::size_t receiver) const { return *std::max_element(targets_[receiver].begin(), targets_[receiver].end()); }

  void add_pictures(job::Snapshot& snapshot)
  {
    std::vector<std::vector<Captioned>> columns;
    const std::vector<Cost> costs = judged() ? judge_->costs(targets_) : method_->costs();
    for (std::size_t j = 0; j < targets_.size(); ++j) {
      const auto wanted = grey_picture(targets_[j], 1 / brightest(j), layout_.cells), received = picture_of(j, brightest(j));
      columns.push_back({{wanted, fmt::format("wanted at {} mm", layout_.distances[j])},
                         {received, fmt::format("cast: cost {:.3f}", costs[j].cost)},
                         {difference_picture(*wanted, *received), "red: too much, blue: too little"}});
      const char* const names[] = {"target", "receiver", "difference"};
      for (std::size_t i = 0; i < 3; ++i) snapshot.pictures.push_back({fmt::format("{}_{}", names[i], j + 1), columns.back()[i].picture});
      snapshot.pictures.push_back({fmt::format("best_{}", j + 1), grey_picture(best_[j], 1 / brightest(j), layout_.cells)});
    }
    snapshot.pictures.push_back({"slopes", slopes_picture(method_->slopes(), method_->heights(), layout_)});
    snapshot.picture = sheet(columns, layout_.receiver, preset_.scene.camera.resolution[0], preset_.scene.camera.resolution[1]);
    if (!std::exchange(conflict_known_, true)) find_conflicts();
    snapshot.pictures.push_back({"conflict", conflict_});
    snapshot.in_view = object_picture(columns);
  }

  /// The same picture until a quarter of a step, the judge or the camera changes it.
  std::shared_ptr<const job::Picture> object_picture(const std::vector<std::vector<Captioned>>& columns)
  {
    const preset::Camera camera = view_camera(preset_);
    const Viewed now{method_->steps(), static_cast<int>(4 * method_->fraction_done()), finished(), camera};
    if (in_view_ && now == viewed_) return in_view_;
    viewed_ = now;
    const std::vector<double> heights = method_->heights();
    ObjectView view{layout_, method_->slopes(), heights, settings(preset_).method == Settings::Method::lens, {}};
    for (const std::vector<Captioned>& column : columns) view.receivers.push_back(column[1].picture);
    in_view_ = view_of(view, camera);
    return in_view_;
  }

  /// Once for every step, where somebody looks; which pictures fight once the slopes are found.
  void find_conflicts()
  {
    std::vector<std::vector<double>> light;
    for (std::size_t j = 0; j < targets_.size(); ++j) light.push_back(method_->light(j));
    const std::vector<double> heights = method_->heights();
    const ConflictSearch search(layout_, targets_, method_->slopes(), heights, light);
    conflict_ = grey_picture(search.facet_conflicts(), 1, layout_.facets);
    conflicts_.reset();
    if (judge_) conflicts_ = search.picture_conflicts();
  }

  /// The receivers' pictures and those between them in the order of their distance, as a screen that moves away would show them: as bright
  /// as is wanted at the receivers, and between them from the one to the other.
  void add_frames(job::Snapshot& snapshot) const
  {
    if (layout_.frames.empty()) return;
    snapshot.curves.push_back({"frames", {"frame", "distance_mm"}, {}});
    const auto add = [&](double distance, std::size_t screen, double most) {
      const std::size_t number = snapshot.curves.back().rows.size() + 1;
      snapshot.curves.back().rows.push_back({static_cast<double>(number), distance});
      snapshot.pictures.push_back({fmt::format("frame_{:04}", number), picture_of(screen, most)});
    };
    const std::size_t gaps = layout_.distances.size() - 1, between = layout_.frames.size() / gaps;
    for (std::size_t j = 0; j < layout_.distances.size(); ++j) {
      add(layout_.distances[j], j, brightest(j));
      for (std::size_t k = 0; k < between && j < gaps; ++k) {
        const double part = static_cast<double>(k + 1) / static_cast<double>(between + 1);
        add(layout_.frames[j * between + k], targets_.size() + j * between + k, (1 - part) * brightest(j) + part * brightest(j + 1));
      }
    }
  }

  void add_scalars(job::Snapshot& snapshot) const
  {
    const std::vector<Cost> believed = method_->costs(), judged = this->judged() ? judge_->costs(targets_) : std::vector<Cost>();
    add_costs(snapshot, layout_, believed, judged);
    if (this->judged()) add_noise(snapshot, mean(judge_->noise(targets_)));
    if (conflicts_) add_conflicts(snapshot, *conflicts_);
    if (!this->judged()) return;
    add_fates(snapshot, judge_->outcomes());
    add_object(snapshot, layout_, *solid_, method_->slopes());
  }

  void add_files(job::Snapshot& snapshot) const
  {
    const std::string name = preset_.name.empty() ? "The object" : preset_.name;
    const auto layout = std::make_shared<const Layout>(layout_); // one for all files: a lamp's has a table of the facets
    const auto add = [&](const std::string& file, auto write) {
      snapshot.files.push_back({file, [write, solid = solid_, layout](ByteSink& to) { write(*layout, *solid, to); }});
    };
    add("object.obj", [](const Layout&, const Solid& solid, ByteSink& to) { write_obj(solid.mesh, to); });
    add("object.stl", [](const Layout&, const Solid& solid, ByteSink& to) { write_stl(solid.mesh, to); });
    add("object.ply", [](const Layout&, const Solid& solid, ByteSink& to) { scene::write_ply(solid.mesh, to, mesh_title); });
    add("facets.json", write_facets);
    add("heights.exr", write_height_exr);
    add("heights.png", write_height_png);
    if (!layout_.lamp)
      snapshot.files.push_back(
          {glass_view_file, [view = glass_view(layout_, targets_, preset_)](ByteSink& to) { to.write(std::as_bytes(std::span(view))); }});
    const auto add_text = [&](const std::string& file, auto text) {
      add(file, [text](const Layout& of, const Solid& solid, ByteSink& to) {
        const std::string words = text(of, solid);
        to.write(std::as_bytes(std::span(words)));
      });
    };
    const std::string tolerances = tolerances_ ? tolerance_table(judge_->costs(targets_), tolerances_->rows()) : "";
    const Settings& s = settings(preset_);
    add_text("workshop.md", [material = material_of(s, layout_.n), tolerances, making = Manufacturing{s.tool_radius_mm, s.layer_mm}](
                                const Layout& of, const Solid& solid) { return workshop_page(of, solid, material, making) + tolerances; });
    if (tolerances_)
      add_text("tolerance.csv", [csv = tolerance_csv(judge_->costs(targets_), tolerances_->rows())](const auto&...) { return csv; });
    add_text("print_object.svg", [name](const Layout& of, const Solid&) { return object_page(of, name); });
    for (std::size_t j = 0; j < targets_.size(); ++j)
      add_text(fmt::format("print_{}.svg", j + 1),
               [name, j, cast = picture_of(j, brightest(j))](const Layout& of, const Solid&) { return receiver_page(of, j, *cast, name); });
  }

  /// Where the stop counts from: the run's begin, or the newest preset that it took on.
  struct Began {
    std::int64_t steps = 0;
    double seconds = 0;
  };

  mpi::RankContext context_;
  /// What the picture of the object is of.
  struct Viewed {
    std::int64_t steps = 0;
    int quarter = 0; ///< of the slice in hand
    bool judged = false;
    preset::Camera camera;
    bool operator==(const Viewed&) const = default;
  };

  preset::Preset preset_;
  Layout layout_;
  std::vector<Target> targets_, best_;
  std::uint64_t triangles_;
  std::unique_ptr<Method> method_;
  Began began_;
  std::vector<CostRow> history_;
  double method_seconds_ = 0, judge_seconds_ = 0;
  std::optional<double> judge_needs_;  ///< seconds; where time ends the run, from its first step on
  std::shared_ptr<const Solid> solid_; ///< from when the slopes are found
  std::optional<Judge> judge_;
  std::optional<Tolerances> tolerances_; ///< where they are wanted, from when the judge begins
  Viewed viewed_;
  std::shared_ptr<const job::Picture> in_view_; ///< of what viewed_ says
  bool conflict_known_ = false;
  std::shared_ptr<const job::Picture> conflict_; ///< where known
  std::optional<Conflicts> conflicts_;           ///< the same, once the slopes are found
};

} // namespace

std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const InversePlan& plan, const mpi::RankContext& context)
{
  return std::make_unique<InverseJob>(preset, plan, context);
}

} // namespace nephroid::inverse
