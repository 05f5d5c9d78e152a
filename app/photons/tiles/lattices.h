// SPDX-License-Identifier: Apache-2.0
// The lattices on which the photons of a round leave the lights: kernels/photons/tiles.cl.
#pragma once
#include "kernels/photons/tile_types.h"
#include "photons/tables/run_tables.h"

#include <cstdint>
#include <vector>

namespace nephroid::photons {

/// A round's lattices. Each half of the film has its own.
struct Lattices {
  std::vector<shared::DeviceLattice> lattices;
  std::uint32_t points = 0; ///< of all lattices; those outside the discs are no photons
};

/// Makes the lattices of a round of so many batches of photons in each half. Shifts, wavelengths and places on lamps of
/// a size are drawn anew for each round.
Lattices make_lattices(const RunTables& tables, unsigned halves, double batches, shared::uint2 seed,
                       std::int64_t round);

} // namespace nephroid::photons
