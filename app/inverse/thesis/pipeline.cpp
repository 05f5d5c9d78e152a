// SPDX-License-Identifier: Apache-2.0
#include "inverse/thesis/pipeline.h"

#include "base/counted.h"
#include "inverse/assign/footprint.h"
#include "inverse/uniform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

constexpr std::size_t numbers_a_picture = 4; // size, right, down, distance

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

} // namespace

Annealer::Annealer(std::vector<AnnealedParameter> knobs, const Cooling& cooling, double cost)
    : knobs_(std::move(knobs)), cooling_(cooling), cost_(cost), lowest_cost_(cost) {
  for (const AnnealedParameter& knob : knobs_) values_.push_back(knob.start);
  lowest_ = values_;
}

double Annealer::temperature() const {
  return cooling_.temperature * std::pow(cooling_.factor, done_ / cooling_.moves);
}

const std::vector<double>& Annealer::propose(std::mt19937_64 random) {
  proposed_ = values_;
  for (std::size_t i = 0; i < knobs_.size(); ++i) {
    const AnnealedParameter& knob = knobs_[i];
    proposed_[i] = std::clamp(proposed_[i] + knob.step * (2 * uniform(random) - 1), knob.low, knob.high);
  }
  chance_ = uniform(random);
  return proposed_;
}

bool Annealer::decide(double cost) {
  const double rise = cost - cost_;
  const bool taken = rise <= 0 || chance_ < std::exp(-rise / temperature()); // at 0: exp(-inf), never
  ++done_;
  if (!taken) return false;
  ++accepted_;
  values_ = proposed_;
  cost_ = cost;
  if (cost >= lowest_cost_) return false;
  lowest_ = values_;
  lowest_cost_ = cost;
  return true;
}

void Annealer::serialize(Archive& archive) {
  archive.items(values_);
  archive.items(lowest_);
  archive.value(cost_);
  archive.value(lowest_cost_);
  archive.value(done_);
  archive.value(accepted_);
}

std::int64_t Pipeline::trials_of(const Thesis& settings) {
  return 1 + 2 * std::int64_t{settings.cycles} * settings.moves + settings.corrections;
}

Pipeline::Pipeline(const Layout& layout, const std::vector<Target>& targets, const Thesis& settings, std::uint64_t seed)
    : layout_(layout), targets_(targets), settings_(settings), seed_(seed), reach_(2 * targets.size()) {
  sizes_ = settings_.adjust == Thesis::Adjust::convergence ? std::vector<double>{1} : std::vector<double>();
  if (settings_.adjust == Thesis::Adjust::each)
    for (std::size_t j = 0; j < targets.size(); ++j) sizes_.insert(sizes_.end(), {1, 0, 0, 1});
  adjust(sizes_);
  keep({{}, flat_slopes(layout), 0}, 1);
  begin_trial();
}

/// D: the pictures with other sizes, places and distances.
void Pipeline::adjust(const std::vector<double>& values) {
  wanted_.clear();
  pictures_.clear();
  for (std::size_t j = 0; j < targets_.size(); ++j) {
    SamplingTarget aim{layout_.distances[j], {}, 0};
    if (settings_.adjust == Thesis::Adjust::convergence) {
      // Straight lines from the border of the object bound the light.
      aim.picture = moved(targets_[j], layout_, 1 + (values[0] - 1) * aim.distance / layout_.distances.back(), {0, 0});
    } else {
      const double* const own = values.data() + numbers_a_picture * j;
      aim.picture = moved(targets_[j], layout_, own[0], {own[1], own[2]});
      aim.distance *= own[3];
    }
    pictures_.push_back(aim.picture);
    wanted_.push_back(std::move(aim));
  }
}

/// The annealer of the stage in hand, from where it starts.
std::optional<Annealer> Pipeline::annealer() const {
  const Thesis& s = settings_;
  const auto about = [](double start, double step, double limit) {
    return AnnealedParameter{start, step, start - limit, start + limit};
  };
  std::vector<AnnealedParameter> knobs;
  if (stage_ == Stage::annealing_1 && s.adjust == Thesis::Adjust::convergence)
    knobs = {about(1, s.size_step, s.size_limit)};
  if (stage_ == Stage::annealing_1 && s.adjust == Thesis::Adjust::each)
    for (std::size_t j = 0; j < targets_.size(); ++j)
      knobs.insert(knobs.end(), {about(1, s.size_step, s.size_limit), about(0, s.shift_step, s.shift_limit),
                                 about(0, s.shift_step, s.shift_limit), about(1, s.distance_step, s.distance_limit)});
  if (stage_ == Stage::annealing_2) {
    knobs.assign(targets_.size(), {0, s.extension_step, 0, 1});
    knobs.resize(2 * targets_.size(), {0, s.overshoot_step, 0, 1});
  }
  if (knobs.empty()) return std::nullopt;
  return Annealer(std::move(knobs), {s.temperature, s.cooling, s.cycles, s.moves}, lowest_);
}

void Pipeline::find_needs() {
  margins_.clear();
  for (const SamplingTarget& aim : wanted_) margins_.push_back(margin_of(aim.picture, layout_));
  needs_ = needs_of(layout_, wanted_, margins_);
}

/// (5.3): scales every cell by what is wanted over what was received, in parts of their sums; at most by the limit.
void Pipeline::correct(const std::vector<std::vector<double>>& received) {
  for (std::size_t j = 0; j < pictures_.size(); ++j) {
    const double wanted_sum = sum_of(wanted_[j].picture), received_sum = sum_of(received[j]),
                 limit = settings_.ratio_limit;
    for (std::size_t i = 0; i < pictures_[j].size(); ++i) {
      const double wanted = wanted_[j].picture[i] * received_sum, there = received[j][i] * wanted_sum;
      pictures_[j][i] *= there > 0 ? std::clamp(wanted / there, 1 / limit, limit) : limit;
    }
    const double most = *std::max_element(pictures_[j].begin(), pictures_[j].end());
    for (double& value : pictures_[j]) value /= most;
  }
}

/// What light is aimed at: the pictures, extended and overshot (5.4).
std::vector<SamplingTarget> Pipeline::aims() const {
  std::vector<SamplingTarget> all = wanted_;
  for (std::size_t j = 0; j < all.size(); ++j) {
    all[j].picture = pictures_[j];
    if (needs_.empty()) continue;
    all[j].picture = extended(pictures_[j], margins_[j], reach_[j] * needs_[j].extension);
    all[j].beside =
        reach_[all.size() + j] * needs_[j].overshoot * *std::max_element(pictures_[j].begin(), pictures_[j].end());
  }
  return all;
}

void Pipeline::begin_trial() {
  const std::mt19937_64 random = numbers_of(~seed_, static_cast<std::uint64_t>(trials_));
  if (stage_ == Stage::annealing_1) adjust(annealer_->propose(random));
  if (stage_ == Stage::annealing_2) reach_ = annealer_->propose(random);
  trial_.emplace(layout_, aims(), settings_, seed_);
}

void Pipeline::advance() {
  trial_->advance();
  if (trial_->finished()) end_trial();
}

double Pipeline::cost_of_drawn(const TrialResult& drawn) const {
  double sum = 0;
  for (std::size_t j = 0; j < wanted_.size(); ++j) {
    const bool left = sum_of(wanted_[j].picture) > 0; // else it was moved off its receiver
    sum += left ? cost_of(wanted_[j].picture, drawn.light[j], 0).cost : 1;
  }
  return sum / static_cast<double>(wanted_.size());
}

void Pipeline::keep(TrialResult drawn, double cost) {
  best_ = std::move(drawn);
  lowest_ = cost;
  light_ = light_of_all(layout_, best_.slopes, heights());
}

void Pipeline::end_trial() {
  TrialResult drawn = trial_->drawn();
  trial_.reset();
  ++trials_;
  const double cost = cost_of_drawn(drawn), temperature = annealer_ ? annealer_->temperature() : 0;
  if (stage_ == Stage::correction) {
    correct(drawn.light);
    ++rounds_;
    idle_ = cost < lowest_ - settings_.worth ? 0 : idle_ + 1;
  }
  const bool gains = annealer_ ? annealer_->decide(cost) : stage_ == Stage::sampling || idle_ == 0;
  if (gains) keep(std::move(drawn), cost);
  history_.push_back({static_cast<double>(stage_), temperature, cost, lowest_,
                      static_cast<double>(annealer_ ? annealer_->accepted() : 0),
                      static_cast<double>(annealer_ ? annealer_->refused() : 0)});
  while (stage_ != Stage::done && stage_ended()) begin_next_stage();
  if (stage_ != Stage::done) begin_trial();
}

bool Pipeline::stage_ended() const {
  if (annealer_) return annealer_->finished();
  return stage_ == Stage::sampling || rounds_ >= settings_.corrections || idle_ >= settings_.patience;
}

void Pipeline::begin_next_stage() {
  costs_[static_cast<std::size_t>(stage_)] = lowest_;
  if (stage_ == Stage::annealing_1) {
    sizes_ = annealer_->lowest();
    adjust(sizes_);
    find_needs();
  }
  if (stage_ == Stage::annealing_2) {
    reach_ = annealer_->lowest();
    correct(best_.light);
  }
  stage_ = static_cast<Stage>(static_cast<std::int32_t>(stage_) + 1);
  annealer_ = annealer();
}

std::uint64_t Pipeline::tried() const {
  return static_cast<std::uint64_t>(trials_) * layout_.facet_count() + (trial_ ? trial_->tried() : 0);
}

std::vector<Cost> Pipeline::costs() const {
  return costs_of(targets_, light_, light_sent_to_each(layout_, best_.slopes));
}

void Pipeline::show(job::Snapshot& snapshot) const {
  static constexpr const char* names[stages] = {"sampling", "annealing_1", "annealing_2", "correction"};
  const auto add = [&](std::string name, double value) {
    snapshot.scalars.push_back({"thesis", std::move(name), value});
  };
  for (std::size_t i = 0; i < std::min(stages, static_cast<std::size_t>(stage_)); ++i) {
    add(fmt::format("cost_{}", names[i]), costs_[i]);
    if (i > 0) add(fmt::format("gain_{}", names[i]), costs_[i - 1] - costs_[i]);
  }
  add("dark_facets", static_cast<double>(best_.dark));
  if (!needs_.empty() && settings_.adjust == Thesis::Adjust::convergence) add("convergence", sizes_[0]);
  for (std::size_t j = 0; j < needs_.size(); ++j) {
    add(fmt::format("missing_cells_{}", j + 1), static_cast<double>(needs_[j].missing));
    add(fmt::format("extension_{}", j + 1), reach_[j] * needs_[j].extension);
    add(fmt::format("overshoot_{}", j + 1), reach_[needs_.size() + j] * needs_[j].overshoot);
  }
  if (best_.dark > 0)
    snapshot.warnings.push_back(fmt::format("{} can send light nowhere where all pictures are lit, and stay flat",
                                            counted(best_.dark, "facet")));
  job::Curve curve{"annealing", {"trial", "stage", "temperature", "cost", "lowest", "accepted", "refused"}, {}};
  for (std::size_t i = 0; i < history_.size(); ++i) {
    const Row& r = history_[i];
    curve.rows.push_back({static_cast<double>(i + 1), r.stage, r.temperature, r.cost, r.lowest, r.accepted, r.refused});
  }
  snapshot.curves.push_back(std::move(curve));
}

void Pipeline::serialize(Archive& archive) {
  archive.value(stage_);
  archive.value(trials_);
  archive.list(sizes_);
  if (archive.is_read()) {
    adjust(sizes_);
    if (stage_ > Stage::annealing_1) find_needs();
  }
  archive.list(reach_);
  for (auto& picture : pictures_) archive.list(picture);
  archive.value(rounds_);
  archive.value(idle_);
  archive.items(best_.slopes);
  archive.value(best_.dark);
  bool tried = !best_.light.empty();
  archive.value(tried);
  best_.light.resize(tried ? targets_.size() : 0);
  for (auto& light : best_.light) archive.list(light);
  for (auto& light : light_) archive.list(light);
  archive.value(lowest_);
  archive.value(costs_);
  archive.list(history_);
  if (archive.is_read()) annealer_ = annealer();
  if (annealer_) annealer_->serialize(archive);
  if (archive.is_read()) {
    trial_.reset();
    if (stage_ != Stage::done) begin_trial();
  }
  if (trial_) trial_->serialize(archive);
}

} // namespace nephroid::inverse
