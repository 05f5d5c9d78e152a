// SPDX-License-Identifier: Apache-2.0
// A glazing: one to three panes as one surface without thickness. Light goes straight on or is mirrored; what the panes
// keep is lost. The table has what passes and what is reflected, with all reflections between the faces
// (app/optics/glazing.h). Which way a path takes goes by the means over the wavelengths, and each wavelength then has
// its own part over that chance. The glazing is in air.
#include "kernels/scatter/interaction.h"

// Two neighbouring rows of the table at one of their three columns.
typedef struct {
  __global const float* row;
  float towards_next;
} GlazingColumn;

static inline GlazingColumn glazing_column(const World* world, const DeviceMaterial* material, float cos_i,
                                           int number) {
  const float place = sqrt(cos_i) * (float)(GLAZING_ANGLES - 1);
  const int before = min((int)place, GLAZING_ANGLES - 2);
  const GlazingColumn column = {
      world->tables.surface_data + material->surface_first + before * GLAZING_ROW + number * GLAZING_PARTS,
      place - (float)before};
  return column;
}

static inline float glazing_part(GlazingColumn column, int wavelength) {
  return mix(column.row[wavelength], column.row[wavelength + GLAZING_ROW], column.towards_next);
}

static inline Parts glazing_parts(GlazingColumn column, float scale, const Carriers* carriers) {
  const int4 w = carriers->wavelengths;
  const Parts parts = {scale * (float4)(glazing_part(column, w.x), glazing_part(column, w.y),
                                        glazing_part(column, w.z), glazing_part(column, w.w)),
                       scale * glazing_part(column, carriers->middle)};
  return parts;
}

static inline bool glazing_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                   ScatterSample* sample) {
  *sample = reflect_at(path->direction, &at->surface, 1.0f, 1.0f);
  const float cos_i = clamp(-dot(path->direction, sample->normal), 0.0f, 1.0f);
  const int reflected_column = dot(path->direction, at->surface.geometric) < 0.0f ? 1 : 2;
  const GlazingColumn through = glazing_column(world, &at->material, cos_i, 0),
                      back = glazing_column(world, &at->material, cos_i, reflected_column);
  const float passes = glazing_part(through, WAVELENGTH_COUNT), reflects = glazing_part(back, WAVELENGTH_COUNT),
              both = passes + reflects;
  sample->reflectance = both > 0.0f ? reflects / both : 1.0f;
  if (sample->reflectance < 1.0f && !(u < sample->reflectance)) {
    sample->direction = path->direction;
    sample->transmitted = sample->straight = true;
  }
  const float chance = sample->transmitted ? 1.0f - sample->reflectance : sample->reflectance;
  LEAVE_BY_WAVELENGTH(&path->throughput, band,
                      glazing_parts(sample->transmitted ? through : back, 1.0f / chance, carriers))
  return true;
}

MATERIAL_WITHOUT_BASE(glazing)
