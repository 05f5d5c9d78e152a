// SPDX-License-Identifier: Apache-2.0
// Which functions are inlined, and means to save registers, which are few on a GPU and do nothing elsewhere.
// COMPILED_ONCE: a large function that is called once a path or a ray. PoCL compiles a kernel three times, for three
// ways to launch it, with all that is inlined in it, and a function of its own once.
#if defined(NEPHROID_CPU) && defined(POCL_DEVICE_ADDRESS_BITS)
#define COMPILED_ONCE static __attribute__((noinline))
#else
#define COMPILED_ONCE static inline
#endif

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
