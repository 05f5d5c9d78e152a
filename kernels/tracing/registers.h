// SPDX-License-Identifier: Apache-2.0
// Means to save registers, which are few on a GPU. They do nothing elsewhere.
// For a large function that takes a World, which it would need in memory without inlining.
#define IN_PLACE static inline __attribute__((always_inline))

// ROLLED: a loop that is not unrolled.
// SET_ASIDE: a value that a path does not need until it has found its next hit. It waits in memory, because compilers
// also keep what they compute from it early, such as addresses in tables.
// made_late(number): the number, from which compilers compute nothing before the loops that use it.
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
