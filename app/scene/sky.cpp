// SPDX-License-Identifier: Apache-2.0
#include "scene/sky.h"

#include "base/error.h"
#include "optics/tables.h"
#include "preset/place.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nephroid::scene {
namespace {

using optics::Colour;
using optics::LinearTable;
using std::numbers::pi;

constexpr double degree = pi / 180;

/// (nm, W m^-2 nm^-1) outside the air: Thekaekara 1973 (ASTM E490-73a), every 10 nm.
const LinearTable& outside_air() {
  static const LinearTable rows({{380, 1.120}, {390, 1.098}, {400, 1.429}, {410, 1.751}, {420, 1.747}, {430, 1.639},
                                 {440, 1.810}, {450, 2.006}, {460, 2.066}, {470, 2.033}, {480, 2.074}, {490, 1.950},
                                 {500, 1.942}, {510, 1.882}, {520, 1.833}, {530, 1.842}, {540, 1.783}, {550, 1.725},
                                 {560, 1.695}, {570, 1.712}, {580, 1.715}, {590, 1.700}, {600, 1.666}, {610, 1.635},
                                 {620, 1.602}, {630, 1.570}, {640, 1.544}, {650, 1.511}, {660, 1.486}, {670, 1.456},
                                 {680, 1.427}, {690, 1.402}, {700, 1.369}, {710, 1.344}, {720, 1.314}, {730, 1.290},
                                 {740, 1.260}, {750, 1.235}, {760, 1.211}, {770, 1.185}, {780, 1.159}});
  return rows;
}

/// (nm, cm^-1): Preetham et al., table 2.
const LinearTable& ozone() {
  static const LinearTable rows(
      {{355, 0},    {445, .003}, {450, .003}, {455, .004}, {460, .006}, {465, .008}, {470, .009}, {475, .012},
       {480, .014}, {485, .017}, {490, .021}, {495, .025}, {500, .03},  {505, .035}, {510, .04},  {515, .045},
       {520, .048}, {525, .057}, {530, .063}, {535, .07},  {540, .075}, {545, .08},  {550, .085}, {555, .095},
       {560, .103}, {565, .11},  {570, .12},  {575, .122}, {580, .12},  {585, .118}, {590, .115}, {595, .12},
       {600, .125}, {605, .13},  {610, .12},  {620, .105}, {630, .09},  {640, .079}, {650, .067}, {660, .057},
       {670, .048}, {680, .036}, {690, .028}, {700, .023}, {710, .018}, {720, .014}, {730, .011}, {740, .01},
       {750, .009}, {760, .007}, {770, .004}, {780, 0}});
  return rows;
}

const LinearTable& mixed_gases() {
  static const LinearTable rows({{759, 0}, {760, 3}, {770, .21}, {771, 0}});
  return rows;
}

const LinearTable& water_vapour() {
  static const LinearTable rows({{689, 0},
                                 {690, .016},
                                 {700, .024},
                                 {710, .0125},
                                 {720, 1},
                                 {730, .87},
                                 {740, .061},
                                 {750, .001},
                                 {760, .00001},
                                 {770, .00001},
                                 {780, .0006}});
  return rows;
}

/// Relative to its value at the zenith, up to a factor. a: A to E of Perez's formula.
double perez(const std::array<double, 5>& a, double cos_zenith, double from_sun) {
  return (1 + a[0] * std::exp(a[1] / std::max(cos_zenith, 1e-6))) *
         (1 + a[2] * std::exp(a[3] * from_sun) + a[4] * std::pow(std::cos(from_sun), 2));
}

/// A to E by turbidity: slope and value at 0. Preetham et al., appendix A.2.
using PerezTable = std::array<std::array<double, 2>, 5>;
constexpr PerezTable luminance_terms{
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}}};
constexpr PerezTable x_terms{
    {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}}};
constexpr PerezTable y_terms{
    {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}}};

/// Of the zenith: rows by T^2, T, 1; columns by the sun's angle to it cubed, squared, itself, 1.
using ZenithTable = std::array<std::array<double, 4>, 3>;
constexpr ZenithTable zenith_x{
    {{0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithTable zenith_y{
    {{0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}}};

double of_zenith(const ZenithTable& terms, double t, double s) {
  double sum = 0;
  for (std::size_t row = 0; row < 3; ++row)
    sum = sum * t + ((terms[row][0] * s + terms[row][1]) * s + terms[row][2]) * s + terms[row][3];
  return sum;
}

/// Of the zenith's value.
double over_zenith(const PerezTable& terms, double t, double zenith, double from_sun, double sun_zenith) {
  std::array<double, 5> a{};
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = terms[i][0] * t + terms[i][1];
  return perez(a, std::cos(zenith), from_sun) / perez(a, 1, sun_zenith);
}

/// Of a sky: before it is turned.
SunPlace place_of(const preset::Environment& sky) {
  if (sky.place) return sun_place(*sky.place);
  const glm::dvec3 to = glm::normalize(to_dvec3(sky.sun_direction.value_or(preset::Vec3{0, 1, 1})));
  return {std::asin(std::clamp(to.y, -1.0, 1.0)) / degree, std::atan2(to.x, -to.z) / degree};
}

/// 1..366. date: checked.
int day_of_year(const std::string& date) {
  return preset::days_since_2000(date).value() - preset::days_since_2000(date.substr(0, 4) + "-01-01").value() + 1;
}

/// Adds to each of `sum` a factor times `by`.
void add(Colour& sum, double factor, const Colour& by) {
  for (std::size_t c = 0; c < 3; ++c) sum[c] += factor * by[c];
}

/// W m^-2 of 380 to 780 nm that light of a linear sRGB colour has.
double watts_of(const Colour& rgb) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const optics::Spectrum& primary = optics::primary_spectra()[c];
    sum += rgb[c] * std::accumulate(primary.begin(), primary.end(), 0.0);
  }
  return sum;
}

using optics::sum_of;

/// Gives a sky whose upper half has the colours of the visible one the light of Bird and Riordan's: its luminances, so
/// that a level plane has 1 of them, times one spectrum. Its lower half is the ground.
void as_clear_sky(Environment& map, const preset::Environment& sky, double elevation_deg, double sine,
                  optics::SpectralRange range) {
  const ClearSky light = clear_sky_of(sky, range);
  const double direct = sky.sun_scale * sum_of(light.direct), diffuse = sum_of(light.diffuse);
  const std::size_t texels = map.rgb.size() / 3, horizon = texels / 2;
  double level = 0;
  for (std::size_t i = 0; i < horizon; ++i) {
    const int row = static_cast<int>(i) / map.width;
    const double sine_of_row = std::sin(degree * (90 - 180 * (row + 0.5) / map.height));
    const float luminance =
        static_cast<float>(optics::linear_srgb_to_xyz({map.rgb[3 * i], map.rgb[3 * i + 1], map.rgb[3 * i + 2]})[1]);
    map.rgb[3 * i] = luminance;
    level += luminance * sine_of_row * texel_steradians(map, row);
  }
  // The first "primary" is the light of the sky, the second one that of the sun, which the ground sends back as well.
  const double of_sun = sky.radiance > 0 ? sky.sun_scale * sine / sky.radiance : 0;
  for (std::size_t i = 0; i < texels; ++i) {
    map.rgb[3 * i] = static_cast<float>(i < horizon ? map.rgb[3 * i] / level : sky.albedo / pi);
    map.rgb[3 * i + 1] = static_cast<float>(i < horizon ? 0 : sky.albedo / pi * of_sun);
    map.rgb[3 * i + 2] = 0;
  }
  map.primaries = {light.diffuse, light.direct, optics::Spectrum{}};
  map.about = fmt::format("sun and sky by Bird and Riordan (1986): the sun, {:.2f} degrees high, gives a plane that "
                          "faces it {:.1f} W/m^2 of {}, the sky a level one {:.1f}",
                          elevation_deg, direct, text_of(range), sky.radiance * diffuse);
}

} // namespace

SunPlace sun_place(const preset::PlaceAndTime& place) {
  // Days from noon of 2000-01-01, UTC; universal and terrestrial time are taken as one.
  const double days = preset::days_since_2000(place.date).value() - 0.5 + (place.hour - preset::offset_h(place)) / 24;
  const double mean = 280.460 + 0.9856474 * days, anomaly = (357.528 + 0.9856003 * days) * degree;
  const double longitude = (mean + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * degree;
  const double tilt = (23.439 - 4e-7 * days) * degree;
  const double ascension = std::atan2(std::cos(tilt) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(tilt) * std::sin(longitude));
  const double sidereal = 15 * std::fmod(18.697374558 + 24.06570982441908 * days, 24);
  const double hour = (sidereal + place.longitude_deg) * degree - ascension, latitude = place.latitude_deg * degree;
  const double height =
      std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour);
  const double north = std::cos(latitude) * std::sin(declination) -
                       std::sin(latitude) * std::cos(declination) * std::cos(hour),
               east = -std::cos(declination) * std::sin(hour);
  return {std::asin(std::clamp(height, -1.0, 1.0)) / degree, std::fmod(std::atan2(east, north) / degree + 360, 360)};
}

glm::dvec3 to_sky(const SunPlace& place) {
  const double height = place.elevation_deg * degree, around = place.azimuth_deg * degree;
  return {std::cos(height) * std::sin(around), std::sin(height), -std::cos(height) * std::cos(around)};
}

optics::Spectrum sun_irradiance(double elevation_deg, double turbidity) {
  const double mass = 1 / (std::sin(elevation_deg * degree) + 0.15 * std::pow(93.885 - (90 - elevation_deg), -1.253));
  const double haze = 0.04608365822050 * turbidity - 0.04586025928522; // Angstrom's beta
  optics::Spectrum result{};
  for (std::size_t w = 0; w < result.size(); ++w) {
    const double nm = optics::first_nm + static_cast<double>(w), um = nm / 1000;
    const double gases = mixed_gases()(nm) * mass, water = water_vapour()(nm) * 2 * mass; // 2 cm of water
    const double depth = mass * (0.008735 * std::pow(um, -4.08) + haze * std::pow(um, -1.3) + 0.35 * ozone()(nm)) +
                         1.41 * gases / std::pow(1 + 118.93 * gases, 0.45) +
                         0.2385 * water / std::pow(1 + 20.07 * water, 0.45);
    result[w] = outside_air()(nm) * std::exp(-depth);
  }
  return result;
}

optics::Colour sky_xyy(double zenith_deg, double from_sun_deg, double sun_zenith_deg, double turbidity) {
  const double t = turbidity, zenith = zenith_deg * degree, from_sun = from_sun_deg * degree,
               s = sun_zenith_deg * degree;
  const double chi = (4.0 / 9 - t / 120) * (pi - 2 * s);
  const double kcd = std::max((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192, 0.0);
  return {of_zenith(zenith_x, t, s) * over_zenith(x_terms, t, zenith, from_sun, s),
          of_zenith(zenith_y, t, s) * over_zenith(y_terms, t, zenith, from_sun, s),
          kcd * 1000 / 683 * over_zenith(luminance_terms, t, zenith, from_sun, s)};
}

ClearSky clear_sky_of(const preset::Environment& sky, optics::SpectralRange range) {
  const double distance = sky.place ? distance_factor(day_of_year(sky.place->date)) : 1;
  return clear_sky(place_of(sky).elevation_deg, air_of(sky.turbidity), sky.albedo, distance, range);
}

bool is_night(const preset::Environment& environment) {
  return environment.type == preset::Environment::Type::sky && !(place_of(environment).elevation_deg > 0);
}

Environment make_sky(const preset::Environment& sky, optics::SpectralRange range) {
  const SunPlace place = place_of(sky);
  const glm::dvec3 to_sun = to_sky(place);
  Environment result;
  result.width = sky_width;
  result.height = sky_height;
  result.rgb.resize(std::size_t{3} * sky_width * sky_height);
  if (is_night(sky)) {
    result.about = fmt::format("the sun is {:.1f} degrees below the horizon: the sky is dark", -place.elevation_deg);
    return result;
  }
  Colour on_ground{}; // irradiance
  for (int row = 0; row < sky_height / 2; ++row) {
    const double elevation_deg = 90 - 180 * (row + 0.5) / sky_height, steradians = texel_steradians(result, row);
    for (int column = 0; column < sky_width; ++column) {
      const glm::dvec3 to = to_sky({elevation_deg, 360 * (column + 0.5) / sky_width - 180});
      const double from_sun_deg = std::acos(std::clamp(glm::dot(to, to_sun), -1.0, 1.0)) / degree;
      const auto [x, y, luminance] = sky_xyy(90 - elevation_deg, from_sun_deg, 90 - place.elevation_deg, sky.turbidity);
      const Colour rgb = optics::xyz_to_linear_srgb({luminance * x / y, luminance, luminance * (1 - x - y) / y});
      add(on_ground, steradians * to.y, rgb);
      for (std::size_t c = 0; c < 3; ++c)
        result.rgb[3 * static_cast<std::size_t>(row * sky_width + column) + c] = static_cast<float>(rgb[c]);
    }
  }
  if (range != optics::SpectralRange::visible) {
    as_clear_sky(result, sky, place.elevation_deg, to_sun.y, range);
    return result;
  }
  const optics::Spectrum sun = sun_irradiance(place.elevation_deg, sky.turbidity);
  result.about = fmt::format("the sun is {:.2f} degrees high at azimuth {:.2f} and gives a plane that faces it {:.1f} "
                             "W/m^2 of 380 to 780 nm; the sky gives the ground {:.1f}",
                             place.elevation_deg, std::fmod(place.azimuth_deg + 360, 360), sky.sun_scale * sum_of(sun),
                             sky.radiance * watts_of(on_ground));
  // The map is multiplied by `radiance`. Where that is 0 the ground is as black as the sky.
  const double sun_part = sky.radiance > 0 ? sky.sun_scale / sky.radiance : 0;
  add(on_ground, sun_part * to_sun.y, optics::xyz_to_linear_srgb(optics::to_xyz(sun)));
  const std::size_t horizon = result.rgb.size() / 2;
  for (std::size_t i = horizon; i < result.rgb.size(); ++i)
    result.rgb[i] = static_cast<float>(std::max(sky.albedo / pi * on_ground[i % 3], 0.0));
  return result;
}

std::optional<Light> make_sun(const preset::Environment& sky, optics::SpectralRange range) {
  if (sky.type != preset::Environment::Type::sky || sky.sun_scale == 0 || is_night(sky)) return std::nullopt;
  const SunPlace place = place_of(sky);
  Light sun;
  sun.type = preset::Light::Type::directional;
  sun.direction = rotation({0, sky.rotate_deg, 0}) * -to_sky(place);
  sun.spectrum = range == optics::SpectralRange::visible ? sun_irradiance(place.elevation_deg, sky.turbidity)
                                                         : clear_sky_of(sky, range).direct;
  const double watts = sum_of(sun.spectrum);
  for (double& value : sun.spectrum) value /= watts;
  sun.irradiance_w_m2 = sky.sun_scale * watts;
  sun.one_minus_cos = 2 * std::pow(std::sin(sun_angular_diameter_deg / 4 * degree), 2);
  return sun;
}

} // namespace nephroid::scene
