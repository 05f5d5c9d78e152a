// SPDX-License-Identifier: Apache-2.0
// The number of a work item. A long launch is a grid of rows (app/compute/kernel.cpp), so that PoCL, which compiles a
// kernel for grids below 65,535 items a side and once more for larger ones, compiles it once.
static inline uint work_item(void) { return (uint)(get_global_id(1) * get_global_size(0) + get_global_id(0)); }
