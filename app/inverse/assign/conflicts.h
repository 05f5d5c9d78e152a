// SPDX-License-Identifier: Apache-2.0
// Which pictures hold each other back: what remains when the slopes are as good as they get.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// Light is misplaced where more falls than is wanted, evenly among a cell's facets, and beside the receiver.
struct Conflicts {
  std::vector<double> misplaced; ///< the part of all light in each picture: its floor, the error that it keeps
  std::vector<std::vector<double>> between; ///< [j][k]: the part that is misplaced in picture j for the sake of k
};

/// Finds misplaced light. `light` is that of facets with these slopes and heights, by their footprints.
class ConflictSearch {
public:
  /// The arguments outlive it.
  ConflictSearch(const Layout& layout, const std::vector<Target>& targets, const std::vector<glm::dvec2>& slopes,
                 const std::vector<double>& heights, const std::vector<std::vector<double>>& light);

  /// The part of each facet's light that is misplaced, in the picture where that is largest.
  std::vector<double> facet_conflicts() const;

  /// For picture j, each facet is moved where j gains most, as if j were alone. Its misplaced light in j is then
  /// charged to the other pictures, by what they would lose. Some facets stand for all: every one, up to 32 a side.
  Conflicts picture_conflicts() const;

private:
  double misplaced(std::size_t facet, std::size_t receiver) const;
  double change(std::size_t facet, const glm::dvec2& slope, std::size_t receiver) const;
  std::vector<glm::dvec2> best_places(std::size_t receiver) const;

  const Layout& layout_;
  const std::vector<glm::dvec2>& slopes_;
  const std::vector<double>& heights_;
  const std::vector<std::vector<double>>& light_;
  std::vector<Target> wanted_; ///< the targets, each in its own tone
  std::vector<double> weights_;
  std::vector<std::vector<double>> too_much_; ///< [receiver][cell]: part of the light there that is too much
};

} // namespace nephroid::inverse
