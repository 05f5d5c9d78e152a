// SPDX-License-Identifier: Apache-2.0
// How long the judge will take, which a run that ends by time leaves to it.
#pragma once
#include "inverse/judge.h"
#include "mpi/rank_context.h"

namespace nephroid::inverse {

/// Seconds that this machine takes for the solid of so many triangles and for two rounds of the judge's rays through
/// it, without two more that noise may ask for: a piece of such an object, 32 facets a side, is made, and judged for
/// some milliseconds. Triangles and rays then take as long as they do there, and a quarter more, because a larger tree
/// is slower.
double judge_seconds(const mpi::RankContext& context, const Layout& layout, std::uint64_t triangles);

} // namespace nephroid::inverse
