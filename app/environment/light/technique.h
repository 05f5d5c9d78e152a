// SPDX-License-Identifier: Apache-2.0
// How caustics on receivers are put together from the spheres of all lights.
#pragma once

namespace nephroid::environment {

/// Those other than eight_sets are the thesis' (3.4.3, table 3.3) and let all light come from the object's middle: OneByOne.
enum class Technique { eight_sets, direct, direct_launches, direct_buffers, compiled, compiled_launches, compiled_buffers };

} // namespace nephroid::environment
