// SPDX-License-Identifier: Apache-2.0
#include "inverse/pictures/drawing.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

bool in_bar(const glm::dvec2& p, double length, double width) { return std::abs(p.x) < length / 2 && std::abs(p.y) < width / 2; }

/// Bars along x, one above the other.
bool in_bars(const Picture& picture, const glm::dvec2& p)
{
  for (int i = 0; i < picture.count; ++i)
    if (in_bar({p.x, p.y - (2 * i - (picture.count - 1)) * picture.width}, picture.length, picture.width)) return true;
  return false;
}

/// Its first point is up. Between a point and the valley beside it the edge is a straight line: with the point at angle 0 and the valley
/// at beta, p is inside where it is on the middle's side of the line through both.
bool in_star(const Picture& picture, const glm::dvec2& p)
{
  const double beta = glm::pi<double>() / picture.count;
  const double turned = std::atan2(-p.x, p.y);
  const double angle = std::abs(turned - 2 * beta * std::round(turned / (2 * beta))), r = glm::length(p);
  const glm::dvec2 at{r * std::cos(angle), r * std::sin(angle)}, point{picture.radius, 0};
  const glm::dvec2 along = picture.inner * glm::dvec2(std::cos(beta), std::sin(beta)) - point, to = at - point;
  return along.x * to.y - along.y * to.x > 0;
}

/// How much of a spot of this radius is left at p: 1 in its middle, falling as a bell.
double spot(const glm::dvec2& p, const glm::dvec2& middle, const glm::dvec2& radius)
{
  const glm::dvec2 d = (p - middle) / radius;
  return std::exp(-glm::dot(d, d));
}

/// A ball of radius 1 in grey levels, lit from the left above as Lambert's law has it, with two eyes and a mouth.
double face(const glm::dvec2& p)
{
  const double r2 = glm::dot(p, p);
  if (r2 >= 1) return 0;
  const glm::dvec3 light = glm::normalize(glm::dvec3(-0.5, 0.6, 0.9));
  const double lit = 0.15 + 0.85 * std::max(0.0, glm::dot(light, glm::dvec3(p, std::sqrt(1 - r2))));
  const double eyes = spot(p, {-0.35, 0.25}, {0.16, 0.2}) + spot(p, {0.35, 0.25}, {0.16, 0.2});
  const double mouth = spot({p.x, p.y + 0.55 - 0.5 * p.x * p.x}, {0, 0}, {0.4, 0.1}); // along a parabola: it smiles
  return lit * (1 - 0.9 * std::min(1.0, eyes + mouth));
}

} // namespace

glm::dvec2 turned_back(const Picture& picture, const glm::dvec2& p)
{
  const double turn = glm::radians(picture.turn_deg), c = std::cos(turn), s = std::sin(turn);
  return {c * p.x + s * p.y, c * p.y - s * p.x};
}

double brightness(const Picture& picture, const glm::dvec2& p, const glm::dvec2& half)
{
  using Type = Picture::Type;
  const double r = glm::length(p);
  const glm::dvec2 turned = turned_back(picture, p);
  switch (picture.type) {
  case Type::disc:
    return r < picture.radius ? 1 : 0;
  case Type::ring:
    return r < picture.radius && r >= picture.inner ? 1 : 0;
  case Type::cross:
    return in_bar(turned, picture.length, picture.width) || in_bar({turned.y, turned.x}, picture.length, picture.width) ? 1 : 0;
  case Type::bars:
    return in_bars(picture, turned) ? 1 : 0;
  case Type::star:
    return in_star(picture, turned) ? 1 : 0;
  case Type::gradient: {
    const double turn = glm::radians(picture.turn_deg);
    const double reach = half.x * std::abs(std::cos(turn)) + half.y * std::abs(std::sin(turn)); // of the receiver along the gradient
    return std::clamp((turned.x / reach + 1) / 2, 0.0, 1.0);
  }
  case Type::face:
    return face(turned / picture.radius);
  case Type::file:
  case Type::text:
  case Type::qr:
    break;
  }
  return 0;
}

} // namespace nephroid::inverse
