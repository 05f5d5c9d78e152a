// SPDX-License-Identifier: Apache-2.0
#include "inverse/tolerances.h"

#include "inverse/uniform.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nephroid::inverse {
namespace {

struct MakingError {
  std::string_view what;
  double waves_mm = 0, turn_deg = 0, light_deg = 0, farther = 0;
};
constexpr std::array<MakingError, Tolerances::count> errors{
    MakingError{.what = "heights off by 1 um", .waves_mm = 0.001},
    MakingError{.what = "heights off by 5 um", .waves_mm = 0.005},
    MakingError{.what = "heights off by 20 um", .waves_mm = 0.02},
    MakingError{.what = "turned by 1 degree", .turn_deg = 1},
    MakingError{.what = "light turned by 1 degree", .light_deg = 1},
    MakingError{.what = "receivers 1 % farther", .farther = 0.01}};

/// Turns the solid about the x axis through its middle. Rays begin in front of what is turned towards them.
void turn(double radians, Layout& layout, Solid& solid) {
  const double sine = std::sin(radians), cosine = std::cos(radians), pivot = layout.thickness / 2;
  for (glm::vec3& p : solid.mesh.positions) {
    const double y = p.y, z = p.z - pivot;
    p.y = static_cast<float>(cosine * y - sine * z);
    p.z = static_cast<float>(pivot + sine * y + cosine * z);
  }
  layout.thickness += std::abs(sine) * layout.size.y / 2;
}

/// Turns light about the y axis through the front's middle. The judge's rays need no more than where it comes from.
void turn(double radians, double front, Illumination& light) {
  const double sine = std::sin(radians), cosine = std::cos(radians);
  const double x = light.sines.x, z = -std::sqrt(1 - glm::dot(light.sines, light.sines));
  light.sines.x = cosine * x + sine * z;
  if (!light.lamp) return;
  const double aside = light.lamp->x, before = light.lamp->z - front;
  light.lamp->x = cosine * aside + sine * before;
  light.lamp->z = front + cosine * before - sine * aside;
  for (glm::dvec4& place : light.lamp_places)
    place = {cosine * place.x + sine * place.z, place.y, cosine * place.z - sine * place.x, place.w};
}

/// Each triangle as four, by the middles of its edges, which two triangles share: what is closed stays closed.
Solid halved(const Solid& solid) {
  Solid fine = solid;
  fine.mesh.triangles.clear();
  fine.parts.clear();
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    const glm::uvec3& t = solid.mesh.triangles[i];
    const auto first = static_cast<glm::uint>(fine.mesh.positions.size());
    for (int k = 0; k < 3; ++k)
      fine.mesh.positions.push_back((solid.mesh.positions[t[k]] + solid.mesh.positions[t[(k + 1) % 3]]) / 2.0f);
    for (const glm::uvec3& part : {glm::uvec3(t.x, first, first + 2),
                                   {first, t.y, first + 1},
                                   {first + 2, first + 1, t.z},
                                   {first, first + 1, first + 2}})
      fine.mesh.triangles.push_back(part);
    fine.parts.insert(fine.parts.end(), 4, solid.parts[i]);
  }
  return fine;
}

} // namespace

int halvings(const Layout& layout) {
  constexpr double least_a_wave = 4; // triangles' sides
  const double sides = std::max(layout.facet().x, layout.facet().y) / (wave_mm / least_a_wave);
  return std::max(0, static_cast<int>(std::ceil(std::log2(sides))));
}

Solid with_waves(const Layout& layout, Solid solid, double rms_mm, std::uint64_t seed) {
  constexpr int count = 32;
  std::mt19937_64 random(seed);
  std::array<glm::dvec3, count> waves; // across and up in radians a millimetre, and where it begins
  for (glm::dvec3& wave : waves) {
    const double side = 2 * glm::pi<double>() * uniform(random), k = 2 * glm::pi<double>() / wave_mm;
    wave = {k * std::cos(side), k * std::sin(side), 2 * glm::pi<double>() * uniform(random)};
  }
  for (int i = 0; i < halvings(layout); ++i) solid = halved(solid);
  const double amplitude = rms_mm * std::sqrt(2.0 / count);
  for (glm::vec3& p : solid.mesh.positions) {
    if (p.z >= static_cast<float>(layout.thickness)) continue;
    double off = 0;
    for (const glm::dvec3& wave : waves) off += std::sin(wave.x * p.x + wave.y * p.y + wave.z);
    p.z += static_cast<float>(amplitude * off);
  }
  return solid;
}

Tolerances::Tolerances(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
                       const Solid& solid, std::uint64_t seed)
    : context_(context), layout_(layout), targets_(targets), solid_(solid), seed_(seed) {}

bool Tolerances::finished() const { return rows_.size() == errors.size(); }

double Tolerances::fraction_done() const {
  return (static_cast<double>(rows_.size()) + (judge_ ? judge_->fraction_done() : 0)) /
         static_cast<double>(errors.size());
}

void Tolerances::begin() {
  const MakingError& wrong = errors[rows_.size()];
  changed_layout_ = layout_;
  changed_layout_.frames.clear();
  for (double& distance : changed_layout_.distances) distance *= 1 + wrong.farther;
  for (std::size_t k = 0; k <= layout_.own_lights.size(); ++k)
    turn(glm::radians(wrong.light_deg), layout_.thickness, changed_layout_.numbered(k));
  changed_ = wrong.waves_mm > 0 ? with_waves(layout_, solid_, wrong.waves_mm, seed_) : solid_;
  if (wrong.turn_deg != 0) turn(glm::radians(wrong.turn_deg), changed_layout_, changed_);
  judge_.emplace(context_, changed_layout_, changed_, seed_, targets_);
}

void Tolerances::advance() {
  if (!judge_) begin();
  judge_->advance();
  if (!judge_->finished()) return;
  rows_.push_back({errors[rows_.size()].what, judge_->costs(targets_)});
  judge_.reset();
}

void Tolerances::serialize(Archive& archive) {
  std::size_t done = rows_.size();
  archive.value(done);
  if (archive.is_read()) {
    rows_.clear();
    for (std::size_t i = 0; i < std::min(done, errors.size()); ++i)
      rows_.push_back({errors[i].what, std::vector<Cost>(layout_.distances.size())});
  }
  for (Row& row : rows_) archive.items(row.costs);
  bool judges = judge_.has_value();
  archive.value(judges);
  if (archive.is_read()) judge_.reset();
  if (!judges || finished()) return;
  if (archive.is_read()) begin();
  judge_->serialize(archive);
}

std::string tolerance_table(const std::vector<Cost>& judged, const std::vector<Tolerances::Row>& rows) {
  std::string table =
      "\n## Tolerances\n\nWhat the judge says of the object with one error at a time.\n\n| error | cost | rel_l2 |";
  const auto to = std::back_inserter(table);
  for (std::size_t j = 0; j < judged.size(); ++j) fmt::format_to(to, " {}: cost | {}: rel_l2 |", j + 1, j + 1);
  table += "\n|---|---|---|";
  for (std::size_t j = 0; j < judged.size(); ++j) table += "---|---|";
  const auto row = [&](std::string_view what, const std::vector<Cost>& costs) {
    const Cost all = mean(costs);
    fmt::format_to(to, "\n| {} | {:.3f} | {:.3f} |", what, all.cost, all.rel_l2);
    for (const Cost& c : costs) fmt::format_to(to, " {:.3f} | {:.3f} |", c.cost, c.rel_l2);
  };
  row("none", judged);
  for (const Tolerances::Row& r : rows) row(r.what, r.costs);
  fmt::format_to(to, "\n\nHeights are off in waves of {} mm along the surface, of this root mean square.\n", wave_mm);
  return table;
}

std::string tolerance_csv(const std::vector<Cost>& judged, const std::vector<Tolerances::Row>& rows) {
  std::string csv = "error,receiver,cost,rel_l2\n";
  const auto add = [&](std::string_view what, const std::vector<Cost>& costs) {
    for (std::size_t j = 0; j < costs.size(); ++j)
      fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", what, j + 1, costs[j].cost, costs[j].rel_l2);
  };
  add("none", judged);
  for (const Tolerances::Row& r : rows) add(r.what, r.costs);
  return csv;
}

} // namespace nephroid::inverse
