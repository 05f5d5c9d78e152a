// SPDX-License-Identifier: Apache-2.0
// Where the photons of a launch ended, as sums in quanta of power: OUTCOME_*. The counters in global memory are shared
// by all items, so photons are first added up nearby: on a CPU by each item, which follows several, on a GPU by each
// work group in local memory. Sums of whole numbers are the same in any order.
//
// PHOTON_KERNEL(name, (parameters), (their names)) { ... } is an ITEM_KERNEL that adds its `outcomes` to its `energy`.
#include "kernels/tracing/film.h"
#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/item_kernel.h"

#define PHOTON_KERNEL(name, parameters, names)                                                                         \
  COMPILED_ONCE void name##_item(uint index, Outcomes outcomes, WITHOUT_BRACKETS parameters);                          \
  __kernel void name(WITHOUT_BRACKETS parameters) {                                                                    \
    OUTCOMES(outcomes);                                                                                                \
    name##_item(work_item(), outcomes, WITHOUT_BRACKETS names);                                                        \
    add_outcomes(energy, outcomes);                                                                                    \
  }                                                                                                                    \
  COMPILED_ONCE void name##_item(uint index, Outcomes outcomes, WITHOUT_BRACKETS parameters)

#ifdef NEPHROID_GPU
typedef volatile __local uint* Outcomes; // lower and upper halves: atomics of 64 bits in local memory are rare, or slow
#define OUTCOMES(name)                                                                                                 \
  __local uint name[2 * OUTCOME_COUNT];                                                                                \
  begin_outcomes(name)

static inline void begin_outcomes(Outcomes outcomes) {
  for (uint i = (uint)get_local_id(0); i < 2 * OUTCOME_COUNT; i += (uint)get_local_size(0)) outcomes[i] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
}

static inline void add_outcome(Outcomes outcomes, int outcome, long quanta) {
  const uint low = (uint)quanta, before = atomic_add(outcomes + 2 * outcome, low);
  const uint high = (uint)(quanta >> 32) + (before + low < before ? 1u : 0u);
  if (high != 0u) atomic_add(outcomes + 2 * outcome + 1, high);
}

static inline void add_outcomes(volatile __global long* energy, Outcomes outcomes) {
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = (uint)get_local_id(0); i < OUTCOME_COUNT; i += (uint)get_local_size(0)) {
    const long sum = (long)((ulong)outcomes[2 * i + 1] << 32 | outcomes[2 * i]);
    if (sum != 0) add_exactly(energy + i, sum);
  }
}
#else
typedef long* Outcomes;
#define OUTCOMES(name) long name[OUTCOME_COUNT] = {0}

static inline void add_outcome(Outcomes outcomes, int outcome, long quanta) { outcomes[outcome] += quanta; }

static inline void add_outcomes(volatile __global long* energy, Outcomes outcomes) {
  for (int i = 0; i < OUTCOME_COUNT; ++i)
    if (outcomes[i] != 0) add_exactly(energy + i, outcomes[i]);
}
#endif
