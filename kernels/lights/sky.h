// SPDX-License-Identifier: Apache-2.0
// The environment as a light: parallel light from every texel of a latitude-longitude picture (background.h says where
// a texel is seen). A row is drawn by its flux, radiance times solid angle, then a texel of the row, then a place in
// the texel by solid angle. So every photon of a target carries nearly the same power.
//
// A texel has one colour, which stands for r, g and b times the fixed spectra of the three sRGB primaries, as in
// background.h. These are three rows of the tables of lights, from the environment's own on. A photon carries their
// sum, which may be negative at a wavelength where a primary is. Flux counts colours by (r + g + b) / 3.
//
// Its light is even up to the mean over all directions; what is above is its peaks. Surfaces draw by the peaks alone.
// Their second draw, by the cosine, finds the rest (Karlik et al. 2019, "MIS compensation"). Photons of caustics are
// of the peaks alone where even_sky.cl brings the rest.
#include "kernels/lights/light.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/sky_tables.h"

// A direction of the sky and its light. density: the chance of being drawn, per steradian. Radiance is rgb * density,
// for a sky whose grey light has 1 W m^-2 from all directions together.
typedef struct {
  float3 direction; // unit, to the sky
  float3 rgb;
  float density;
  float peak_density; // the same among the peaks
} SkyPlace;

// The part of a texel's light that is even. The mean radiance of a sky of 1 W m^-2 in all is 1 / (4 pi).
static inline float even_part(const SkyPlace* place) {
  if (!(place->peak_density > 0.0f)) return 1.0f;
  const float grey = (place->rgb.x + place->rgb.y + place->rgb.z) / 3.0f * place->density;
  return fmin(1.0f / (4.0f * PI_F * grey), 1.0f);
}

static inline __global const float* cdf_of_peaks(const Sky* sky) {
  return sky->texel_cdf + (size_t)sky->size.height * (size_t)(sky->size.width + 1);
}

static inline float sky_density(const Sky* sky, __global const float* cdf, int row, int column) {
  const int width = made_late(sky->size.width), height = made_late(sky->size.height);
  __global const float* columns = cdf + height + (size_t)row * (size_t)width;
  const float row_chance = cdf[row] - chance_before(cdf, row),
              column_chance = columns[column] - chance_before(columns, column);
  // cos a - cos b as a product, exact for thin rows.
  const float steradians =
      4.0f * PI_F / (float)width * sin(PI_F * ((float)row + 0.5f) / (float)height) * sin(0.5f * PI_F / (float)height);
  return row_chance * column_chance / steradians;
}

static inline SkyPlace sky_texel(const Sky* sky, float3 direction, int row, int column) {
  const SkyPlace place = {direction, vload3((size_t)row * (size_t)sky->size.width + (size_t)column, sky->texel_colour),
                          sky_density(sky, sky->texel_cdf, row, column),
                          sky->size.has_peaks ? sky_density(sky, cdf_of_peaks(sky), row, column) : 0.0f};
  return place;
}

// cdf: sky->texel_cdf, or that of the peaks, if it has any. place: two numbers in [0, 1).
static inline SkyPlace sample_sky(const Sky* sky, __global const float* cdf, float2 place) {
  const int width = made_late(sky->size.width), height = made_late(sky->size.height);
  const int row = choose(cdf, height, place.x);
  __global const float* columns = cdf + height + (size_t)row * (size_t)width;
  const int column = choose(columns, width, place.y);
  // 1 - |cos| of the zenith angle, uniform over the row. It is counted from the nearer pole, where it stays exact.
  const bool upper = 2 * row < height;
  const int from_pole = upper ? row : height - 1 - row;
  const float edge = sin(0.5f * PI_F * (float)from_pole / (float)height);
  const float within = place_in_bin(cdf, row, place.x);
  const float deep = 2.0f * sin(PI_F * ((float)from_pole + 0.5f) / (float)height) * sin(0.5f * PI_F / (float)height);
  const float below = 2.0f * edge * edge + (upper ? within : 1.0f - within) * deep;
  const float sine = sqrt(fmax(below * (2.0f - below), 0.0f));
  const float azimuth =
      ((float)column + place_in_bin(columns, column, place.y)) / (float)width - 0.5f - sky->size.turns;
  float cosine_azimuth;
  const float sine_azimuth = sincos(2.0f * PI_F * azimuth, &cosine_azimuth);
  const float3 direction = {sine * sine_azimuth, upper ? 1.0f - below : below - 1.0f, -sine * cosine_azimuth};
  return sky_texel(sky, direction, row, column);
}

// The texel that is seen in a unit direction.
static inline SkyPlace sky_in(const Sky* sky, float3 direction) {
  const float azimuth = atan2(direction.x, -direction.z) / (2.0f * PI_F) + 0.5f + sky->size.turns;
  const float zenith = atan2(sqrt(direction.x * direction.x + direction.z * direction.z), direction.y) / PI_F;
  const int column = min((int)((azimuth - floor(azimuth)) * (float)sky->size.width), sky->size.width - 1);
  const int row = min((int)(zenith * (float)sky->size.height), sky->size.height - 1);
  return sky_texel(sky, direction, row, column);
}

// Radiance times Source::rgb of the even light in a direction, for a sky of 1 W m^-2 in all.
static inline float3 even_radiance(const Sky* sky, float3 direction) {
  const SkyPlace place = sky_in(sky, direction);
  return even_part(&place) * place.density * place.rgb;
}
