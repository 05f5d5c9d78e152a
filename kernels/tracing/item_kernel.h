// SPDX-License-Identifier: Apache-2.0
// ITEM_KERNEL(name, (parameters), (their names)) { ... } is the kernel `name`, whose work item `index` runs the body.
// PoCL compiles a kernel three times, for three ways to launch it, but a function that it calls once.
#include "kernels/tracing/registers.h"
#include "kernels/tracing/work_item.h"

#define WITHOUT_BRACKETS(...) __VA_ARGS__
#define ITEM_KERNEL(name, parameters, names)                                                                           \
  COMPILED_ONCE void name##_item(uint index, WITHOUT_BRACKETS parameters);                                             \
  __kernel void name(WITHOUT_BRACKETS parameters) { name##_item(work_item(), WITHOUT_BRACKETS names); }                \
  COMPILED_ONCE void name##_item(uint index, WITHOUT_BRACKETS parameters)
