// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/bake.h"

#include <glm/gtc/packing.hpp>

namespace nephroid::environment {

std::uint16_t to_half(double value) { return glm::packHalf1x16(static_cast<float>(value)); }

glm::dvec3 Bake::at(std::size_t direction, std::size_t sphere, std::size_t texel) const
{
  const std::size_t first = direction * direction_items() + sphere * sphere_items() + texel * static_cast<std::size_t>(channels);
  const auto channel = [&](std::size_t c) { return unit * static_cast<double>(glm::unpackHalf1x16(halves[first + c])); };
  return channels == 3 ? glm::dvec3(channel(0), channel(1), channel(2)) : glm::dvec3(channel(0));
}

} // namespace nephroid::environment
