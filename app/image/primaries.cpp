// SPDX-License-Identifier: Apache-2.0
#include "image/primaries.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::image {
namespace {

constexpr Chromaticities rec_709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

/// Each primary is as strong as makes white, of Y = 1, of all three.
std::optional<glm::dmat3> matrix_to_xyz(const Chromaticities& c) {
  constexpr double least = 1e-6;
  const auto xyz = [&](std::size_t i) {
    const double x = double(c[2 * i]), y = double(c[2 * i + 1]);
    return glm::dvec3(x, y, 1 - x - y);
  };
  const glm::dmat3 primaries(xyz(0), xyz(1), xyz(2));
  const glm::dvec3 white = xyz(3);
  if (!(std::abs(glm::determinant(primaries)) > least) || !(white.y > least)) return std::nullopt;
  const glm::dvec3 strengths = glm::inverse(primaries) * (white / white.y);
  if (!(glm::length(strengths) < 1 / least)) return std::nullopt;
  return glm::dmat3(strengths.x * primaries[0], strengths.y * primaries[1], strengths.z * primaries[2]);
}

/// As the eye adapts from the white of `from` to D65, in XYZ.
glm::dmat3 adapted(const Chromaticities& from) {
  const glm::dmat3 bradford(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
  const auto cones = [&](const Chromaticities& c) { return bradford * *matrix_to_xyz(c) * glm::dvec3(1); };
  const glm::dvec3 ratio = cones(rec_709) / cones(from);
  return glm::inverse(bradford) * glm::dmat3(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z) * bradford;
}

} // namespace

std::optional<glm::dmat3> matrix_to_srgb(const Chromaticities& from) {
  constexpr float alike = 5e-4f;
  if (std::ranges::equal(from, rec_709, [](float a, float b) { return std::abs(a - b) < alike; })) return glm::dmat3(1);
  const std::optional<glm::dmat3> to_xyz = matrix_to_xyz(from);
  if (!to_xyz) return std::nullopt;
  constexpr std::array<float, 6> of_xyz{1, 0, 0, 1, 0, 0};
  const bool is_xyz = std::equal(of_xyz.begin(), of_xyz.end(), from.begin());
  return glm::inverse(*matrix_to_xyz(rec_709)) * (is_xyz ? *to_xyz : adapted(from) * *to_xyz);
}

void convert(std::vector<float>& colours, const glm::dmat3& matrix) {
  if (matrix == glm::dmat3(1)) return;
  for (std::size_t i = 0; i + 2 < colours.size(); i += 3) {
    const glm::dvec3 converted = matrix * glm::dvec3(colours[i], colours[i + 1], colours[i + 2]);
    for (int c = 0; c < 3; ++c) colours[i + static_cast<std::size_t>(c)] = static_cast<float>(converted[c]);
  }
}

} // namespace nephroid::image
