// SPDX-License-Identifier: Apache-2.0
#include "inverse/judge_time.h"

#include <chrono>

namespace nephroid::inverse {
namespace {

using Time = std::chrono::steady_clock::time_point;

Time now() { return std::chrono::steady_clock::now(); }

double seconds_from(Time begin) { return std::chrono::duration<double>(now() - begin).count(); }

constexpr double trial_seconds = 0.03, reserve = 1.25;

/// With facets of the same size, in light straight on.
Layout piece_of(const Layout& layout) {
  Layout piece = layout;
  piece.facets = glm::min(layout.facets, glm::ivec2(32));
  piece.size = layout.facet() * glm::dvec2(piece.facets);
  piece.light.facets.reset();
  piece.free_heights = false;
  return piece;
}

} // namespace

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

} // namespace nephroid::inverse
