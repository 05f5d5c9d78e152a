// SPDX-License-Identifier: Apache-2.0
// What an interface with one thin layer reflects: both faces of the layer, with the interference of all reflections in
// it (Airy's sum; Born and Wolf, Principles of Optics, 7.6). It depends on the wavelength, so a path must have one.
#include "kernels/scatter/fresnel.h"
#include "kernels/tracing/frame.h"

// 0: no object has a coating.
#ifndef NEPHROID_COATINGS
#define NEPHROID_COATINGS 1
#endif

typedef struct {
  float n;         // index of refraction at the path's wavelength
  float thickness; // in wavelengths of the vacuum; 0: there is no film
} ThinFilm;

static inline ThinFilm no_film(void) {
  const ThinFilm none = {1.0f, 0.0f};
  return none;
}

#if NEPHROID_COATINGS
// One polarisation. front, back: the admittances on both sides of the layer's two faces, in the order of the path and
// each pair up to a factor: n cos for light polarised across the plane of incidence, n / cos in it. Where light is
// evanescent in the layer: its size. phase: of the way there and back, or the exponent by which light fades on it.
static inline float layer_reflectance(float2 front, float2 back, float phase, bool evanescent) {
  if (!evanescent) {
    const float first = (front.x - front.y) / (front.x + front.y), second = (back.x - back.y) / (back.x + back.y);
    const float cross = 2.0f * first * second * cos(phase);
    return (first * first + second * second + cross) / (1.0f + first * first * second * second + cross);
  }
  // The amplitudes are exp(-2 i p) and -exp(-2 i q), with tan p and tan q the layer's admittance over the other one.
  const float fade = exp(-phase), lost = (1.0f - fade) * (1.0f - fade);
  const float scale = 4.0f * fade / (dot(front, front) * dot(back, back));
  const float2 products = front * back; // sin(p - q) is as their difference, sin(p + q) as their sum
  const float difference = products.y - products.x, sum = products.y + products.x;
  return (lost + scale * difference * difference) / (lost + scale * sum * sum);
}

// Mean of both polarisations. cos_t: beyond the layer, not negative.
static inline float coated_reflectance(float cos_i, float cos_t, float n_i, float n_t, ThinFilm film) {
  const float sine = n_i * sqrt(fmax((1.0f - cos_i) * (1.0f + cos_i), 0.0f)) / film.n;
  const float cos2 = (1.0f - sine) * (1.0f + sine), cosine = fmax(sqrt(fabs(cos2)), 1e-6f);
  const float phase = 4.0f * PI_F * film.n * film.thickness * cosine;
  const bool evanescent = cos2 < 0.0f;
  const float2 across_front = {n_i * cos_i, film.n * cosine}, across_back = {film.n * cosine, n_t * cos_t};
  const float2 in_front = {n_i * cosine, film.n * cos_i}, in_back = {film.n * cos_t, n_t * cosine};
  const float s = layer_reflectance(across_front, across_back, phase, evanescent);
  const float p = layer_reflectance(in_front, in_back, phase, evanescent);
  return clamp(0.5f * (s + p), 0.0f, 1.0f);
}
#endif

static inline float film_reflectance(float cos_i, float cos_t, float n_i, float n_t, ThinFilm film) {
#if NEPHROID_COATINGS
  if (film.thickness > 0.0f) return coated_reflectance(cos_i, cos_t, n_i, n_t, film);
#endif
  return fresnel_reflectance(cos_i, cos_t, n_i, n_t);
}
