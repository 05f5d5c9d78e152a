// SPDX-License-Identifier: Apache-2.0
#include "inverse/light.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/lamp.h"
#include "optics/fresnel.h"
#include "scene/sky.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

/// Facets meet 1 + t . g of light with slope t; above this value most of a facet lies in its neighbour's shadow.
constexpr double most_shadow = 1;

/// A lamp at distance a before the front, b thick, and a facet at r beside it. The sine q of the light's angle before
/// the front solves r(q) = a q / sqrt(1 - q^2) + b q / sqrt(n^2 - q^2) = r, which grows with q.
struct LampWay {
  double a, b, n;
  double r(double q) const { return q * (a / std::sqrt(1 - q * q) + b / std::sqrt(n * n - q * q)); }
  double change(double q) const { return a / std::pow(1 - q * q, 1.5) + b * n * n / std::pow(n * n - q * q, 1.5); }
  double sine(double at) const {
    return last_good(0.0, std::min(1.0, std::abs(n)), 60, [&](double q) { return r(q) < at; });
  }
};

/// The part of a facet whose light comes through the front, not through a side.
double through_front(const Layout& layout, const glm::dvec2& middle, const glm::dvec2& sines) {
  if (layout.is_mirror()) return layout.round ? part_within(layout, middle, layout.facet()) : 1;
  const glm::dvec2 from = middle + layout.thickness / light_inside(sines, layout.n).z * sines;
  return part_within(layout, from, layout.facet()) * (layout.round ? part_within(layout, middle, layout.facet()) : 1);
}

Incoming from_lamp(const Layout& layout, const glm::dvec2& middle) {
  const glm::dvec2 to = middle - glm::dvec2(*layout.light.lamp);
  const LampWay way{layout.light.lamp->z - layout.entry(), layout.entry(), layout.n};
  const double r = glm::length(to), q = way.sine(r), radial = 1 / way.change(q), around = r > 0 ? q / r : radial;
  const glm::dvec2 e = r > 0 ? to / r : glm::dvec2(1, 0);
  Incoming in;
  in.sines = q * e;
  in.spread = around * glm::dmat2(1) + (radial - around) * glm::outerProduct(e, e);
  // A solid angle of q dq dphi / cos alpha falls on r dr dphi.
  in.power = around * radial / std::sqrt(1 - q * q);
  return in;
}

/// Solid angle of a rectangle from the corner over which a lamp stands, z above it.
double solid_angle(double x, double y, double z) { return std::atan(x * y / (z * std::sqrt(x * x + y * y + z * z))); }

double solid_angle_of_front(const Layout& layout) {
  const glm::dvec2 low = -layout.size / 2.0 - glm::dvec2(*layout.light.lamp), high = low + layout.size;
  const double z = layout.light.lamp->z - layout.entry();
  if (!layout.round)
    return solid_angle(high.x, high.y, z) - solid_angle(low.x, high.y, z) - solid_angle(high.x, low.y, z) +
           solid_angle(low.x, low.y, z);
  constexpr int across = 256;
  const glm::dvec2 part = layout.size / (1.0 * across);
  double sum = 0;
  for (std::size_t i = 0; i < std::size_t{across} * across; ++i) {
    const glm::dvec2 middle = Layout::middle_of(i, {across, across}, layout.size);
    sum += part_within(layout, middle, part) * part.x * part.y * z /
           std::pow(glm::length(glm::dvec3(middle - glm::dvec2(*layout.light.lamp), z)), 3);
  }
  return sum;
}

/// The largest t . g of facets whose light goes to the last receiver as straight as it can; infinite: one cannot.
double worst_shadow(const Layout& layout) {
  constexpr int across = 9;
  double worst = 0;
  for (int i = 0; i < across * across; ++i) {
    const glm::dvec2 middle =
        (glm::dvec2(i % across, i / across) / (across - 1.0) - 0.5) * (layout.size - layout.facet());
    const glm::dvec2 sines = incoming_at(layout, middle).sines;
    const glm::dvec2 straight = middle + flat_slope(sines) * layout.distances.back(),
                     last = layout.offset(layout.distances.size() - 1);
    const glm::dvec2 slope =
        (glm::clamp(straight, last - layout.receiver / 2.0, last + layout.receiver / 2.0) - middle) /
        layout.distances.back();
    if (!reachable(slope, layout.n, sines)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, glm::dot(slope_inside(sines, layout.n), facet_gradient(slope, layout.n, sines)));
  }
  return worst;
}

Layout with_tilt(Layout layout, double tilt_deg, double turn_deg) {
  const double turn = glm::radians(turn_deg);
  layout.light.sines = std::sin(glm::radians(tilt_deg)) * glm::dvec2(std::cos(turn), std::sin(turn));
  return layout;
}

/// Light of the sun onto the front. Throws bad_input where it does not reach the front.
glm::dvec2 sines_of_sun(const Light& light, const Settings& s, const Location& where) {
  const scene::SunPlace at = scene::sun_place(light.place);
  if (at.elevation_deg <= 0)
    throw bad_input(
        where / "hour",
        fmt::format("is {:g}, when the sun is {:.1f} degrees below the horizon", light.place.hour, -at.elevation_deg),
        "expected an hour of daylight", "choose another hour or date, or see to the offset from UTC");
  const glm::dvec3 z = scene::to_sky({s.front_elevation_deg, s.front_azimuth_deg}),
                   y = scene::to_sky({s.front_elevation_deg + 90, s.front_azimuth_deg}), sun = scene::to_sky(at);
  if (const double facing = glm::dot(sun, z); facing <= 0)
    throw bad_input(where / "hour",
                    fmt::format("is {:g}, when the sun stands at azimuth {:.0f}, {:.0f} degrees high, {:.1f} degrees "
                                "behind the front",
                                light.place.hour, at.azimuth_deg, at.elevation_deg, glm::degrees(std::asin(-facing))),
                    "expected an hour at which it shines on the front",
                    "choose another hour, front_azimuth_deg or front_elevation_deg");
  const glm::dvec3 x =
      s.kind == Settings::Kind::mirror ? glm::cross(z, y) : glm::cross(y, z); // z of a mirror is its back
  return -glm::dvec2(glm::dot(sun, x), glm::dot(sun, y));
}

Layout with_lamp(Layout layout, const glm::dvec3& middle, double further = 0) {
  layout.light.lamp = middle + glm::dvec3(0, 0, further);
  return layout;
}

Layout tilted(const Layout& layout, const Light& light, const Location& where) {
  if (light.tilt_deg == 0) return layout; // light straight on casts no shadow, whatever a facet can do with it
  const double most = glm::degrees(std::asin(std::min(1.0, std::abs(layout.n))));
  if (std::abs(light.tilt_deg) >= most)
    throw bad_input(where, fmt::format("is {} degrees, and light would not enter through the front", light.tilt_deg),
                    fmt::format("expected less than {:.4g}", most));
  const auto good = [&](double tilt) { return worst_shadow(with_tilt(layout, tilt, light.turn_deg)) <= most_shadow; };
  if (const double worst = worst_shadow(with_tilt(layout, light.tilt_deg, light.turn_deg)); worst > most_shadow)
    throw bad_input(where,
                    fmt::format("is {} degrees, and {}", light.tilt_deg,
                                std::isinf(worst)
                                    ? "facets that bend such light to the receivers reflect all of it"
                                    : "facets that bend such light to the receivers stand in each other's shadow"),
                    fmt::format("expected at most {:.3g}", std::abs(last_good(0.0, light.tilt_deg, 40, good))),
                    "tilt it less, or move the receivers away");
  return with_tilt(layout, light.tilt_deg, light.turn_deg);
}

Layout lit_by_lamp(const Layout& layout, const Light& light, const Location& where) {
  if (light.distance_mm <= 0 && light.type != Light::Type::mesh)
    throw bad_input(where / "distance_mm",
                    fmt::format("is {} mm, and the light would stand behind the front", light.distance_mm),
                    "expected more than 0 mm");
  const glm::dvec3 at(light.offset_mm[0], light.offset_mm[1], layout.entry() + light.distance_mm);
  Lamp lamp{at, {}};
  if (light.type == Light::Type::area) lamp = flat_lamp(light, at);
  if (light.type == Light::Type::mesh) lamp = mesh_lamp(light, at, layout.entry(), where);
  const auto good = [&](double distance) {
    return worst_shadow(with_lamp(layout, lamp.middle, distance - light.distance_mm)) <= most_shadow;
  };
  if (const double worst = worst_shadow(with_lamp(layout, lamp.middle)); worst > most_shadow) {
    double far = light.distance_mm + lamp.middle.z - layout.entry();
    while (!good(far) && far < 1e9) far *= 2;
    throw bad_input(where / "distance_mm",
                    fmt::format("is {} mm, so near that facets at the rim, to bend its light to the receivers, {}",
                                light.distance_mm,
                                std::isinf(worst) ? "reflect all of it" : "stand in each other's shadow"),
                    fmt::format("expected at least {:.4g} mm", last_good(far, light.distance_mm, 40, good)),
                    "move the light away, or make the object smaller");
  }
  Layout lit = with_lamp(layout, lamp.middle);
  if (!lamp.places.empty()) {
    lit.light.lamp_covariance = points_of_places(lamp, layout.entry(), 1).left;
    lit.light.points = points_of_places(lamp, layout.entry(), LightPoints::most);
    lit.light.few_points = points_of_places(lamp, layout.entry(), LightPoints::few);
  }
  lit.light.lamp_places = std::move(lamp.places);
  return lit;
}

} // namespace

Incoming incoming_at(const Layout& layout, const glm::dvec2& middle) {
  Incoming in;
  in.sines = layout.light.sines;
  if (layout.light.lamp) in = from_lamp(layout, middle);
  const double cosine = std::sqrt(1 - glm::dot(in.sines, in.sines));
  in.around =
      facet_gradient(nearest_reachable((layout.offset(layout.distances.size() - 1) - middle) / layout.distances.back(),
                                       layout.n, in.sines, layout.steepest),
                     layout.n, in.sines);
  if (!layout.is_mirror()) in.power *= 1 - optics::fresnel_reflectance(cosine, 1, layout.n);
  in.power *= through_front(layout, middle, in.sines);
  return in;
}

Illumination make_illumination(Layout layout, const Light& light, const Location& where, const Settings& settings) {
  layout.light = {};
  if (light.type == Light::Type::sun) {
    const glm::dvec2 sines = sines_of_sun(light, settings, where / "place");
    Light straight = light;
    straight.tilt_deg = glm::degrees(std::asin(glm::length(sines)));
    straight.turn_deg = glm::degrees(std::atan2(sines.y, sines.x));
    layout = tilted(layout, straight, where / "place" / "hour");
    if (!settings.sun_deg) layout.light.sun_radius = std::tan(glm::radians(scene::sun_angular_diameter_deg / 2));
  } else if (light.type == Light::Type::parallel)
    layout = tilted(layout, light, where / "tilt_deg");
  else
    layout = lit_by_lamp(layout, light, where);
  layout.light.facets = light_on_facets(layout);
  const std::span<const Incoming> facets = layout.incoming();
  if (layout.light.facets && std::ranges::none_of(facets, [](const Incoming& in) { return in.power > 0; }))
    throw bad_input(
        where,
        fmt::format("comes so much from the side that all of it leaves through a side of an object {:.4g} mm thick",
                    layout.thickness),
        "expected light that reaches some facet through the front",
        "choose a smaller thickness_mm, or light that comes more from the front");
  return layout.light;
}

namespace {

/// The light on each facet, over its mean.
std::vector<Incoming> facets_lit(const Layout& layout) {
  std::vector<Incoming> facets(layout.facet_count());
  for_ranges(facets.size(), 1024, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) facets[i] = incoming_at(layout, layout.middle(i));
  });
  double sum = 0;
  for (const Incoming& in : facets) sum += in.power;
  for (Incoming& in : facets) in.power *= static_cast<double>(facets.size()) / sum;
  return facets;
}

} // namespace

void add_own_lights(Layout& layout, const Settings& settings, const Location& own) {
  std::vector<const Light*> lights;
  std::vector<std::size_t> light_of;
  std::vector<Illumination> own_lights;
  for (std::size_t j = 0; j < settings.receivers.size(); ++j) {
    const std::optional<Light>& light = settings.receivers[j].light;
    std::size_t index = 0;
    if (light && !is_same_but_spectrum(*light, settings.light)) {
      while (index < lights.size() && !is_same_but_spectrum(*lights[index], *light)) ++index;
      if (index == lights.size()) {
        lights.push_back(&*light);
        own_lights.push_back(
            make_illumination(receiver_alone(layout, j), *light, own / "receivers" / j / "light", settings));
      }
      ++index;
    }
    light_of.push_back(index);
  }
  if (lights.empty()) return;
  layout.own_lights = std::move(own_lights);
  layout.light_of = std::move(light_of);
  const auto fill = [&](Illumination& light) {
    Layout lit = layout;
    lit.light = light;
    if (!light.facets) light.facets = facets_lit(lit);
  };
  fill(layout.light);
  for (Illumination& light : layout.own_lights) fill(light);
}

Layout receiver_alone(const Layout& layout, std::size_t receiver) {
  Layout alone = layout;
  alone.light = layout.light_on(receiver);
  alone.own_lights.clear();
  alone.light_of.clear();
  alone.distances = {layout.distances[receiver]};
  if (layout.offsets) alone.offsets = {layout.offset(receiver)};
  if (layout.weights) alone.weights = {(*layout.weights)[receiver]};
  alone.frames.clear();
  return alone;
}

LitFacet lit_facet(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver) {
  LitFacet lit;
  if (layout.light.facets) lit.in = layout.incoming()[facet];
  lit.slope = slope;
  lit.gradient = facet_gradient(slope, layout.n, lit.in.sines);
  if (layout.light_index(receiver) == 0) return lit;
  lit.in = (*layout.light_on(receiver).facets)[facet];
  lit.slope = facet_slope(lit.gradient, layout.n, lit.in.sines);
  const double along = glm::dot(light_inside(lit.in.sines, layout.n), glm::normalize(glm::dvec3(lit.gradient, -1)));
  const double square = 1 - layout.n * layout.n + along * along;
  const double out = light_inside(lit.in.sines, layout.n).z +
                     (along - std::sqrt(std::max(square, 0.0))) / glm::length(glm::dvec3(lit.gradient, -1));
  lit.goes = along * layout.n > 0 && square > 0 && out < 0; // as slope_behind of kernels/inverse/footprint.h
  return lit;
}

glm::dvec2 slope_towards(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver) {
  if (layout.light_index(receiver) == 0) return slope;
  const glm::dvec2 sines = (*layout.light_on(receiver).facets)[facet].sines;
  return facet_slope(facet_gradient(slope, layout.n, sines), layout.n, layout.sines_on(facet));
}

std::optional<std::vector<Incoming>> light_on_facets(const Layout& layout) {
  if (!layout.light.lamp && layout.light.sines == glm::dvec2(0) && !layout.round) return std::nullopt;
  return facets_lit(layout);
}

std::size_t facet_at(const Layout& layout, const glm::dvec2& p) {
  const glm::ivec2 column_row((p.x + layout.size.x / 2) / layout.facet().x,
                              (layout.size.y / 2 - p.y) / layout.facet().y);
  const glm::ivec2 inside = glm::clamp(column_row, glm::ivec2(0), layout.facets - 1);
  return index_at(inside.x, inside.y, layout.facets.x);
}

Incoming incoming_on(const Layout& layout, const glm::dvec2& p, double height) {
  if (!layout.light.facets) return {};
  const std::size_t facet = facet_at(layout, p);
  Incoming in = layout.incoming()[facet];
  in.sines += in.spread * (p + slope_inside(in.sines, layout.n) * height - layout.middle(facet));
  return in;
}

double part_within(const Layout& layout, const glm::dvec2& middle, const glm::dvec2& size) {
  const glm::dvec2 half = layout.size / 2.0;
  if (!layout.round) {
    const glm::dvec2 low = glm::max(middle - size / 2.0, -half), high = glm::min(middle + size / 2.0, half);
    const glm::dvec2 part = glm::max(high - low, glm::dvec2(0)) / size;
    return part.x * part.y;
  }
  constexpr int across = 8; // points that are counted where the rim may cross it
  const double away = glm::length(middle / half), reach = glm::length(size / half) / 2;
  if (away + reach < 1) return 1;
  if (away - reach > 1) return 0;
  int within = 0;
  for (int i = 0; i < across * across; ++i) {
    const glm::dvec2 cell(i % across, i / across); // NOLINT(bugprone-integer-division)
    const glm::dvec2 at = middle + ((cell + 0.5) / (1.0 * across) - 0.5) * size;
    within += glm::length(at / half) <= 1;
  }
  return within / (1.0 * across * across);
}

LightRay light_ray(const Layout& layout, const glm::dvec3& front) {
  if (!layout.light.lamp)
    return {glm::dvec3(layout.light.sines, -std::sqrt(1 - glm::dot(layout.light.sines, layout.light.sines))), 1};
  const glm::dvec3 way = front - *layout.light.lamp;
  const double length = glm::length(way), angle = -way.z / (length * length * length); // that a square mm takes
  return {way / length, angle * lamp_weight(layout)};
}

double shaded_part(const Layout& layout, std::size_t receiver) {
  if (!layout.is_mirror()) return 0;
  const Illumination& light = layout.light_on(receiver);
  const double distance = layout.distances[receiver];
  if (light.lamp && light.lamp->z <= distance) return 0; // the lamp stands before it
  const std::vector<std::size_t> facets = some_facets(layout, 64);
  const auto is_shaded = [&](std::size_t facet) {
    const glm::dvec2 sines = light.facets ? (*light.facets)[facet].sines : glm::dvec2(0),
                     at = layout.middle(facet) - distance * flat_slope(sines);
    return layout.cell_at(at - layout.offset(receiver)).has_value();
  };
  return static_cast<double>(std::ranges::count_if(facets, is_shaded)) / static_cast<double>(facets.size());
}

double lamp_weight(const Layout& layout) { return layout.size.x * layout.size.y / solid_angle_of_front(layout); }

} // namespace nephroid::inverse
