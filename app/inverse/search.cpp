// SPDX-License-Identifier: Apache-2.0
#include "inverse/search.h"

#include "inverse/assign/assignment.h"
#include "inverse/lens/lens.h"
#include "inverse/thesis/pipeline.h"
#include "inverse/tolerances.h"

#include <algorithm>
#include <chrono>

namespace nephroid::inverse {
namespace {

std::unique_ptr<Method> make_method(const preset::Preset& preset, const Layout& layout,
                                    const std::vector<Target>& targets, const mpi::RankContext& context) {
  const Settings& s = settings(preset);
  if (s.method == Settings::Method::thesis) return std::make_unique<Pipeline>(layout, targets, s.thesis, preset.seed);
  if (s.method == Settings::Method::lens)
    return std::make_unique<Lens>(layout, targets.front(), s.mesh_error, Location(preset.source) / "inverse");
  return std::make_unique<Assignment>(context, layout, targets, preset.seed);
}

using Time = std::chrono::steady_clock::time_point;

Time now() { return std::chrono::steady_clock::now(); }

double seconds_from(Time begin) { return std::chrono::duration<double>(now() - begin).count(); }

constexpr double trial_seconds = 0.03, reserve = 1.25;

/// A part of the object, in light straight on.
Layout piece_of(const Layout& layout) {
  Layout piece = layout;
  piece.facets = glm::min(layout.facets, glm::ivec2(32));
  piece.size = layout.facet() * glm::dvec2(piece.facets);
  piece.light.facets.reset();
  piece.free_heights = false;
  return piece;
}

/// The seconds that this machine takes to make a solid of so many triangles and to trace two rounds of the judge's
/// rays. A piece of the object, 32 facets a side, is made and judged for some milliseconds. The time grows in
/// proportion to triangles and rays, and by a quarter because a larger tree is slower.
double judge_seconds(const mpi::RankContext& context, const Layout& layout, std::uint64_t triangles) {
  const Layout piece = piece_of(layout);
  std::vector<glm::dvec2> slopes(piece.facet_count());
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = glm::dvec2(i % 2, i % 3) * 0.05;
  double seconds = 0;
  for (int i = 0; i < 2; ++i) { // kernels are compiled in the first
    Time begin = now();
    const Solid solid = make_solid(piece, slopes);
    Judge judge(context, piece, solid, 0);
    seconds = seconds_from(begin) * static_cast<double>(triangles) / static_cast<double>(solid.mesh.triangles.size());
    begin = now();
    while (!judge.finished() && context.communicator().broadcast(seconds_from(begin) < trial_seconds)) judge.advance();
    seconds += seconds_from(begin) * static_cast<double>(rays_of(layout)) /
               (judge.fraction_done() * static_cast<double>(rays_of(piece)));
  }
  return reserve * seconds;
}

} // namespace

Search::Search(const preset::Preset& preset, const Layout& layout, const std::vector<Target>& targets,
               std::uint64_t triangles, const mpi::RankContext& context)
    : context_(context), preset_(preset), layout_(layout), triangles_(triangles),
      method_(make_method(preset, layout, targets, context)) {
  note_step();
}

bool Search::is_over() {
  if (!has_steps_left()) return true;
  if (!preset_.stop.seconds || method_->steps() == began_.steps)
    return false; // at least one step is done before the judge
  if (!judge_needs_)
    judge_needs_ =
        judge_seconds(context_, layout_, triangles_) * (settings(preset_).tolerances ? 1 + Tolerances::count : 1);
  return context_.communicator().broadcast(
      counted_seconds() + (method_->fraction_done() == 0 ? last_step_seconds() : 0) >= search_seconds());
}

bool Search::advance() {
  const std::int64_t before = method_->steps();
  method_->advance();
  if (method_->steps() == before) return false;
  note_step();
  return true;
}

void Search::go_on() {
  judge_needs_.reset();
  method_->relight();
  began_ = {method_->steps(), seconds_};
  note_step();
}

double Search::fraction_done() const {
  const double steps = static_cast<double>(method_->steps() - began_.steps) + method_->fraction_done();
  return std::max(most_steps() ? steps / static_cast<double>(*most_steps()) : 0,
                  preset_.stop.seconds ? counted_seconds() / std::max(counted_seconds(), search_seconds()) : 0);
}

void Search::show(job::Snapshot& snapshot) const {
  snapshot.curves.push_back(
      {"cost", {std::string(method_->units().step), "seconds", "cost", "cost_all", "rel_l2", "missed"}, {}});
  for (const CostRow& r : history_)
    snapshot.curves.back().rows.push_back(
        {r.step, r.seconds, r.cost.cost, r.cost.cost_all, r.cost.rel_l2, r.cost.missed});
  method_->show(snapshot);
}

void Search::state_of_method(Archive& archive) {
  method_->serialize(archive);
  archive.value(seconds_);
}

void Search::state_of_count(Archive& archive) {
  archive.value(began_);
  archive.list(history_);
}

void Search::note_step() {
  history_.push_back({static_cast<double>(method_->steps()), seconds_, mean(method_->costs())});
}

/// What the judge leaves of the stop's seconds; once is_over() has asked how long it takes.
double Search::search_seconds() const { return *preset_.stop.seconds - judge_needs_.value_or(0); }

/// A step is not begun where it would not end in time; 0 before the first.
double Search::last_step_seconds() const {
  if (method_->steps() == began_.steps || history_.size() < 2) return 0;
  return history_.back().seconds - history_[history_.size() - 2].seconds;
}

/// Empty where seconds end the search.
std::optional<std::int64_t> Search::most_steps() const {
  if (preset_.stop.passes) return *preset_.stop.passes;
  return preset_.stop.seconds ? std::nullopt : std::optional(method_->most());
}

} // namespace nephroid::inverse
