// SPDX-License-Identifier: Apache-2.0
// The tables of the environment as a light, which kernels/lights/sky.h reads.
#include "kernels/tracing/shared_types.h"

typedef struct {
  SKY_TABLES(TABLE_MEMBER)
  DeviceBackground size;
} Sky;
