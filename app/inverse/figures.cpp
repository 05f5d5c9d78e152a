// SPDX-License-Identifier: Apache-2.0
#include "inverse/figures.h"

#include <fmt/format.h>

namespace nephroid::inverse {
namespace {

void add(job::Snapshot& snapshot, const std::string& group,
         std::initializer_list<std::pair<const char*, double>> figures) {
  for (const auto& [name, value] : figures) snapshot.scalars.push_back({group, name, value});
}

void add_cost(job::Snapshot& snapshot, const std::string& group, const Cost& c) {
  add(snapshot, group, {{"cost", c.cost}, {"cost_all", c.cost_all}, {"rel_l2", c.rel_l2}, {"missed", c.missed}});
}

} // namespace

std::string receiver_group(std::size_t receiver) { return fmt::format("inverse/receivers/{}", receiver); }

void add_costs(job::Snapshot& snapshot, const Layout& layout, const std::vector<Cost>& believed,
               const std::vector<Cost>& judged) {
  add_cost(snapshot, "believed", mean(believed));
  if (!judged.empty()) add_cost(snapshot, "judged", mean(judged));
  for (std::size_t j = 0; j < believed.size(); ++j) {
    const std::string group = receiver_group(j);
    add(snapshot, group,
        {{"distance_mm", layout.distances[j]},
         {"width_mm", layout.receiver.x},
         {"height_mm", layout.receiver.y},
         {"believed_cost", believed[j].cost},
         {"believed_rel_l2", believed[j].rel_l2}});
    if (!judged.empty()) add_cost(snapshot, group, judged[j]);
  }
}

void add_noise(job::Snapshot& snapshot, const Cost& noise) {
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

void add_fates(job::Snapshot& snapshot, const RayOutcomes& f) {
  add(snapshot, "light", {{"sent", f.sent}, {"reflected", f.reflected}, {"lost", f.lost}, {"by_walls", f.by_walls}});
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

} // namespace nephroid::inverse
