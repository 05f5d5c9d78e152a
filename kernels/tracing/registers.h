// SPDX-License-Identifier: Apache-2.0
// Registers are few on a GPU. What keeps compilers from filling them there, and does nothing elsewhere.
#ifndef NEPHROID_REGISTERS_H
#define NEPHROID_REGISTERS_H

// For what takes a World and is large: called as a function of its own it would need the World in memory, which kernels
// have as arguments.
#define IN_PLACE static inline __attribute__((always_inline))

// ROLLED: a loop that stays one.
// SET_ASIDE: what a path does not need until it has found its next hit. It waits in memory, for compilers also keep
// what they can make of such numbers beforehand, as addresses in tables.
// made_late: of a number, from which nothing is made before the loops that it stands in.
#ifdef NEPHROID_GPU
#define ROLLED _Pragma("unroll 1")
#define SET_ASIDE volatile
static inline int made_late(int number) {
  volatile int kept = number;
  return kept;
}
#else
#define ROLLED
#define SET_ASIDE
static inline int made_late(int number) { return number; }
#endif

#endif
