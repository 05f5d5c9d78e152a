// SPDX-License-Identifier: Apache-2.0
// A film of scalars, from which the picture of any light is a weighted sum. A layer is the light of one lamp in one
// wavelength cluster (or in all wavelengths, where nothing is bent), as if the layer had 1 W (directional light: 1 W
// m^-2) and every surface were white. So that a surface's reflectance can be multiplied later, a pixel has a cell for
// each reflector that it sees: most have one, those at an edge two. Sums are 64-bit fixed point: [block of LAYER_BLOCK
// cells][half][layer][cell of the block], so that weighing reads one stretch of memory.
#include "kernels/photons/layer_types.h"
#include "kernels/tracing/throughput.h"
#include "kernels/tracing/film.h"

typedef struct {
  __global const int* first;         // each pixel's first index in `cells`; one more at the end
  __global const LayerCell* cells;   // each pixel's cells, that of the reflector it sees most first
  volatile __global long* sums;
  int layer_count;
  int image;                         // half of the film that this pass adds to
} LayerFilm;

#define LAYER_FILM_ARGUMENTS(name)                                                                                     \
  __global const int *name##_first, __global const LayerCell *name##_cells, volatile __global long *name##_sums,       \
      int name##_layer_count
#define LAYER_FILM_NAMES(name) name##_first, name##_cells, name##_sums, name##_layer_count
#define LAYER_FILM(name, pass)                                                                                         \
  {                                                                                                                    \
    name##_first, name##_cells, name##_sums, name##_layer_count, (int)((pass) % NEPHROID_FILM_HALVES)                  \
  }

static inline bool has_cells(const LayerFilm* film, int pixel) { return film->first[pixel] < film->first[pixel + 1]; }

// Adds value * scale to a layer where the pixel, which has cells, sees the reflector. If the pixel's survey missed
// that, the light goes to the reflector that it sees most, in the ratio of their mean reflectances in the layer's
// wavelengths (mean_reflectance: [reflector]). That is right but for how they differ within those wavelengths. dither
// and the result are as in film_add_dithered.
static inline bool layer_add(const LayerFilm* film, int pixel, int reflector, int layer, float value, float scale,
                             float limit, __global const float* mean_reflectance, float dither) {
  const int begin = film->first[pixel], end = film->first[pixel + 1];
  int i = begin;
  while (i < end && film->cells[i].reflector != reflector) ++i;
  float quanta = value * scale;
  if (i == end) {
    i = begin;
    const float most = mean_reflectance[film->cells[i].reflector];
    quanta *= most > 0.0f ? mean_reflectance[reflector] / most : 0.0f;
  }
  if (!(fabs(quanta) <= limit)) return false;
  const int cell = film->cells[i].cell;
  const size_t row = (size_t)(cell / LAYER_BLOCK) * NEPHROID_FILM_HALVES * (size_t)film->layer_count +
                     (size_t)(film->image * film->layer_count + layer);
  add_exactly(film->sums + row * LAYER_BLOCK + cell % LAYER_BLOCK, convert_long_rte(quanta + (dither - 0.5f)));
  return true;
}

// The band of a path in a flat cluster: all its wavelengths have the same power, for layers know no other. u: in
// [0, 1).
static inline Band flat_cluster(const SpectralTables* tables, int cluster, float u) {
  Band band = whole_cluster(cluster);
#if NEPHROID_LOSSES
  const int first = tables->cluster_first[cluster], count = tables->cluster_first[cluster + 1] - first;
  const float size = (float)count;
  __global const int* wavelengths = tables->cluster_wavelengths + first;
  band.own.wavelengths = (int4)(wavelengths[min((int)(u * size), count - 1)],
                                wavelengths[min((int)(quarters_on(u, 1) * size), count - 1)],
                                wavelengths[min((int)(quarters_on(u, 2) * size), count - 1)],
                                wavelengths[min((int)(quarters_on(u, 3) * size), count - 1)]);
#endif
  return band;
}

// The part that a path leaves of a flat cluster.
static inline float flat_part_left(const Throughput* throughput) {
  return NEPHROID_LOSSES ? 0.25f * dot(throughput->own.four, (float4)(1.0f)) : 1.0f;
}
