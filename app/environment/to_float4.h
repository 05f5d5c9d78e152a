// SPDX-License-Identifier: Apache-2.0
// A vector as devices have it.
#pragma once
#include "kernels/tracing/shared_types.h"

#include <glm/glm.hpp>

namespace nephroid::environment {

inline shared::float4 to_float4(const glm::dvec3& v)
{
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}

} // namespace nephroid::environment
