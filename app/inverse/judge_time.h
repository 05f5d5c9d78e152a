// SPDX-License-Identifier: Apache-2.0
// How long the judge will take, which a run that ends by time leaves to it.
#pragma once
#include "inverse/judge.h"
#include "mpi/rank_context.h"

namespace nephroid::inverse {

/// The seconds that this machine takes to make a solid of so many triangles and to trace two rounds of the judge's rays
/// through it. Two more rounds for noise are not counted. A piece of the object, 32 facets a side, is made and judged
/// for some milliseconds. The time grows in proportion to triangles and rays, and by a quarter because a larger tree is
/// slower.
double judge_seconds(const mpi::RankContext& context, const Layout& layout, std::uint64_t triangles);

} // namespace nephroid::inverse
