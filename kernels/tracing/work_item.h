// SPDX-License-Identifier: Apache-2.0
// The number of a work item. A long launch is a grid of rows (app/compute/kernel.cpp), so that PoCL, which compiles a
// kernel for grids below 65,535 items a side and once more for larger ones, compiles it once.
#include "kernels/tracing/registers.h"

static inline uint work_item(void) { return (uint)(get_global_id(1) * get_global_size(0) + get_global_id(0)); }

// ITEM_KERNEL(name, (parameters), (their names)) { ... } is the kernel `name`, whose work item `index` runs the body.
// PoCL compiles a kernel three times, for three ways to launch it, but a function that it calls once.
#define WITHOUT_BRACKETS(...) __VA_ARGS__
#define ITEM_KERNEL(name, parameters, names)                                                                           \
  COMPILED_ONCE void name##_item(uint index, WITHOUT_BRACKETS parameters);                                             \
  __kernel void name(WITHOUT_BRACKETS parameters) { name##_item(work_item(), WITHOUT_BRACKETS names); }                \
  COMPILED_ONCE void name##_item(uint index, WITHOUT_BRACKETS parameters)
