// SPDX-License-Identifier: Apache-2.0
// One of several things by one random number. A cdf is as app/tracing/scales.h makes it: [count], the last 1.
#ifndef NEPHROID_CHOICE_H
#define NEPHROID_CHOICE_H

// The first with cdf > u, u in [0, 1).
static inline int choose(__global const float* cdf, int count, float u)
{
  int low = 0, high = count - 1;
  while (low < high) {
    const int middle = (low + high) >> 1;
    if (cdf[middle] > u)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// The chance of all before the chosen one; its own is cdf[chosen] less that.
static inline float chance_before(__global const float* cdf, int chosen) { return chosen > 0 ? cdf[chosen - 1] : 0.0f; }

#endif
