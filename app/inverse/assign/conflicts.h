// SPDX-License-Identifier: Apache-2.0
// Which pictures hold each other back: what remains when the slopes are as good as they get.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// Light is misplaced in a picture where more falls than is wanted, or beside the receiver. Every facet in a cell has
/// the same share in what is too much there.
struct Conflicts {
  std::vector<double> misplaced; ///< of each picture: part of all light; what it keeps of its error, its floor
  std::vector<std::vector<double>>
      between; ///< [j][k]: part of all light that is misplaced in picture j for the sake of picture k
};

/// light: of facets with these slopes and heights, by their footprints.
class ConflictSearch {
public:
  /// All of them outlive it.
  ConflictSearch(const Layout& layout, const std::vector<Target>& targets, const std::vector<glm::dvec2>& slopes,
                 const std::vector<double>& heights, const std::vector<std::vector<double>>& light);

  /// For each facet the part of its light that is misplaced, in the picture where that is largest.
  std::vector<double> facet_conflicts() const;

  /// A facet would go where picture j gains most, were it alone. What is misplaced of it in j is put down to the others
  /// by what they would lose by that. Some facets speak for all: every one up to 32 a side.
  Conflicts picture_conflicts() const;

private:
  double misplaced(std::size_t facet, std::size_t receiver) const;
  double change(std::size_t facet, const glm::dvec2& slope, std::size_t receiver) const;
  std::vector<glm::dvec2> best_places(std::size_t receiver) const;

  const Layout& layout_;
  const std::vector<glm::dvec2>& slopes_;
  const std::vector<double>& heights_;
  const std::vector<std::vector<double>>& light_;
  std::vector<Target> wanted_; ///< in each picture's own tone
  std::vector<double> weights_;
  std::vector<std::vector<double>> too_much_; ///< [receiver][cell]: part of the light there
};

} // namespace nephroid::inverse
