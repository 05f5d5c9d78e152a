// SPDX-License-Identifier: Apache-2.0
// The caustic layer by tiles: photons leave the lights on square lattices, go both ways at glass, and each is splatted as
// the piece of its lattice that it stands for (Schjoth et al. 2007, "Photon differentials"; lattices in the place of
// random points make footprints tile).
#define NEPHROID_TILES 1
#include "kernels/photons/footprint_splat.h"
#include "kernels/photons/stretch.h"

// The part of a photon's light below which not every point of the lattice follows what is left: one of 4, then of 16,
// ... does, and stands for all, as a lattice twice as wide.
#define TILE_LEAST 0.3f
#define TILE_LEVELS 4
#define TILE_PENDING 8
#define COARSE 1.0f
#define COARSE_PART 0.125f

// A way of a photon that is still to be followed.
typedef struct {
  Path path;
  float weight; // Fresnel's part of the photon's light
  float stands; // photons that it stands for
  int surfaces;
  bool met; // a caustic object
  bool is_coarse; // its cell has spanned more than a triangle, so that its footprint is a guess
} Way;

// The lattice that a point belongs to.
static inline int lattice_of(__global const DeviceLattice* lattices, int count, uint photon) {
  int low = 0, high = count - 1;
  while (low < high) {
    const int middle = (low + high + 1) >> 1;
    if (lattices[middle].first_photon <= photon)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

// Decides whether a way with this part of the light is followed from this point. *stands: the photons that the way
// before stood for, then that this one does. u: uniform in [0, 1), for what is too little for every lattice.
static inline bool is_followed(float weight, uint2 point, float u, float* stands) {
  int level = clamp((int)ceil(0.5f * log2(TILE_LEAST / weight) - 0.5f), 0, TILE_LEVELS);
  const uint mask = (1u << level) - 1u;
  if (((point.x | point.y) & mask) != 0u) return false;
  const float of_level = (float)(1u << 2 * level);
  *stands = fmax(*stands, of_level);
  const float left = weight * *stands / TILE_LEAST;
  if (left >= 0.25f) return true;
  *stands /= left;
  return u < left;
}

#if NEPHROID_DIFFERENTIALS
// The light of the part low .. high of a cluster's distribution of wavelengths, as PhotonEnd's xyz.
static inline float3 light_of_part(const World* world, const Losses* losses, Source source, int cluster, int reflector,
                                   float low, float high) {
  const int first = world->tables.cluster_first[cluster], count = world->tables.cluster_first[cluster + 1] - first;
  __global const float* cdf = world->tables.wavelength_cdf +
                              source.light * world->tables.cluster_first[world->scene.cluster_count] + first;
  float3 xyz = (float3)(0.0f);
  for (int member = choose(cdf, count, low); member < count; ++member) {
    const float before = chance_before(cdf, member), after = cdf[member];
    if (before >= high) break;
    const Band band = {cluster, world->tables.cluster_wavelengths[first + member], 1.0f / (after - before)};
    xyz += (fmin(after, high) - fmax(before, low)) * carried_light(world, losses, source, &band, reflector).xyz;
  }
  return xyz;
}
#endif

// Whether a cell of the lattice is wider than the triangle that its middle meets.
static inline bool spans_triangles(const Geometry* geometry, uint primitive, const Differential* tile, float size) {
  const DevicePrimitive met = geometry->primitives[primitive];
  if (is_ellipsoid(&met) || kind_of(&met) != PRIMITIVE_SMOOTH) return false;
  const float3 a = size * tile[0].position, b = size * tile[1].position, u = met.edge_u.xyz, v = met.edge_v.xyz;
  return dot(a, a) + dot(b, b) > COARSE * (dot(u, u) + dot(v, v));
}

// Splats a way that ends on a diffuse surface. Returns false where a contribution is too large.
static inline bool splat_way(const World* world, const DeviceCamera* camera, const DeviceLattice* lattice,
                             const PhotonEnd* end, const Path* path, Source source, const Band* band, float stands, bool is_coarse,
                             float watts, __global const uint2* corners, volatile __global long* film,
                             float film_scale, uint photon) {
  const float distance = dot(end->surface.position - path->origin, path->direction), size = lattice->step * sqrt(stands);
  const float3 a = size * transferred(&path->tile[0], path->direction, distance, end->surface.geometric),
               b = size * transferred(&path->tile[1], path->direction, distance, end->surface.geometric);
  const float side = dot(path->direction, end->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  Strand strand;
  strand.surface = end->surface;
  strand.triangle = end->triangle;
  strand.xyz = end->xyz;
  Stretch stretch = {1, true, false};
#if NEPHROID_DIFFERENTIALS
  const int reflector = material_of(world, end->surface.object).reflector;
  float from_x, to_x;
  stretched_band(world, source.light, band, lattice->low, &from_x);
  stretched_band(world, source.light, band, fmin(lattice->high, 0x1.fffffep-1f), &to_x);
  if (!stretch_over(world, camera, end, path, from_x, to_x, &stretch)) stretch.count = 1;
#endif
  bool fits = true;
  const float turn = place_within(photon, 0u).x;
  for (int i = 0; i < stretch.count; ++i) {
#if NEPHROID_DIFFERENTIALS
    const float part = (lattice->high - lattice->low) / (float)stretch.count, low = lattice->low + part * (float)i;
    if (stretch.count > 1) {
      float x;
      float3 place;
      stretched_band(world, source.light, band, low + turn * part, &x);
      if (!stretched_place(path, &end->surface, x, &place)) continue;
      strand.surface = end->surface;
      strand.triangle = end->triangle;
      strand.surface.position = place;
      if (stretch.beside && !is_in_triangle(&world->geometry, end->triangle, place) &&
          !surface_beside(world, end, side, place, &strand.surface, &strand.triangle))
        continue;
    }
#endif
    float weight, shrunk;
    FilmFootprint f;
    if (!project_to_film(camera, strand.surface.position, strand.surface.geometric, path->direction,
                         world->scene.metres_per_unit, &f.middle, &weight))
      continue;
    if (!footprint_on_film(camera, strand.surface.position, a, b, is_coarse ? COARSE_PART * lattice->widest : lattice->widest, &f, &shrunk)) f.area = 0.0f;
    if (f.area == 0.0f)
      for (int c = 0; c < 4; ++c) f.corner[c] = (float2)(0.0f);
    if (!touches_film(camera, &f)) continue;
    // Beyond its triangle the receiver goes on, or the footprint shrinks to its middle.
    for (int c = 0; c < 4 && f.area != 0.0f; ++c) {
      const float3 corner = strand.surface.position + (0.5f * shrunk) * ((c == 1 || c == 2 ? a : -a) + (c >= 2 ? b : -b));
      if (is_in_triangle(&world->geometry, strand.triangle, corner)) continue;
      Surface beside;
      uint triangle;
      if (!surface_beside(world, end, side, corner, &beside, &triangle)) f.area = 0.0f;
    }
    if (f.area == 0.0f)
      for (int c = 0; c < 4; ++c) f.corner[c] = (float2)(0.0f);
    if (camera->receiver >= 0 && strand.surface.object != camera->receiver) continue;
#if NEPHROID_DIFFERENTIALS
    strand.xyz = light_of_part(world, &path->losses, source, band->cluster, reflector, low, low + part);
#endif
    const SeenReceiver receiver = {corners, strand.surface.object, strand.surface.position, strand.surface.geometric,
                                   side, strand.surface.offset, strand.triangle};
    const float3 xyz = strand.xyz * (watts * weight * shading_ratio(&strand.surface, path->direction) / PI_F);
    fits = add_footprint(world, film, camera, &receiver, &f, photon, xyz, film_scale) && fits;
  }
  return fits;
}

// Follows the photons first .. first + count - 1 of a round.
__kernel void tiles(WORLD_ARGUMENTS, __global const DeviceTarget* targets, __global const DeviceLattice* lattices,
                    __global const uint2* corners, volatile __global long* film,
                    volatile __global long* energy, // [OUTCOME_COUNT]
                    int lattice_count, DeviceCamera camera, uint2 seed, uint iteration, uint first, uint count,
                    float film_scale, float energy_scale) {
  const World world = WORLD;
  OUTCOMES(outcomes);
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint number = (uint)get_global_id(0) * NEPHROID_PHOTONS_PER_ITEM + k;
    if (number >= count) break;
    const uint photon = first + number;
    const DeviceLattice lattice = lattices[lattice_of(lattices, lattice_count, photon)];
    const uint in_lattice = photon - lattice.first_photon;
    const uint2 index = (uint2)(in_lattice % lattice.side, in_lattice / lattice.side);
    const float2 disc = (convert_float2(index) + (float2)(lattice.shift_x, lattice.shift_y)) * lattice.step - 1.0f;
    if (dot(disc, disc) > 1.0f) continue;
    const uint2 point = index + (uint2)(lattice.phase & 0xffffu, lattice.phase >> 16);
    DeviceLight light = lights[lattice.light];
    const float2 place = (float2)(lattice.place_x, lattice.place_y);
    const Source source = source_of(&world, lattice.light, place, &light);
    Way way;
    const Emission emission = emit_on_lattice(&light, targets, &scene, lattice.target, disc, place, way.path.tile);
    if (emission.watts == 0.0f) continue;
    const Band band = choose_band(&world, lattice.light, lattice.cluster, lattice.wavelength);
    const Band whole = whole_cluster(lattice.cluster);
    const float share = band_share(&world, source, &band, lattice.share),
                power_share = band_share(&world, source, &whole, lattice.share), watts = emission.watts / lattice.photons;
    way.path.origin = emission.origin;
    way.path.direction = emission.direction;
    way.path.skip = NEPHROID_NO_PRIMITIVE;
    way.path.media = light.inside;
    way.path.losses = no_losses();
    way.path.behind = emission.behind;
    way.path.differential.position = way.path.differential.direction = (float3)(0.0f);
    way.weight = way.stands = 1.0f;
    way.surfaces = 0;
    way.met = way.is_coarse = false;
    Way pending[TILE_PENDING];
    int waiting = 0;
    uint draws = 0;
    for (;;) {
      bool goes_on = false;
      PhotonEnd end;
      end.outcome = OUTCOME_LOST;
      const Hit hit = next_hit(&world, &way.path);
      if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
        end.outcome = way.met ? OUTCOME_ESCAPED : OUTCOME_MISSED;
      } else {
        end.surface = surface_at(&world.geometry, hit);
        end.triangle = hit.primitive;
        const DeviceMaterial material = material_of(&world, end.surface.object);
        lose_in_medium(&world, &way.path, hit.t);
        if (material.type == MATERIAL_DIFFUSE) {
          end.outcome = way.met ? OUTCOME_DEPOSITED : OUTCOME_MISSED;
        } else if (way.surfaces++ < world.scene.max_surfaces) {
          way.met = true;
          Way reflected = way;
          Bend bend;
          float n_ratio;
          if (bend_path_as(&world, &way.path, hit.primitive, &end.surface, &material, &band, 2.0f, &n_ratio, &bend)) {
            goes_on = true;
            way.is_coarse = way.is_coarse || spans_triangles(&world.geometry, hit.primitive, way.path.tile,
                                                             lattice.step * sqrt(way.stands));
            reflected.is_coarse = way.is_coarse;
            if (bend.transmitted && bend.reflectance > 0.0f) {
              const float4 u = random4(seed, iteration, photon, draws++, STREAM_PHOTONS);
              reflected.weight *= bend.reflectance;
              way.weight *= 1.0f - bend.reflectance;
              bool through = is_followed(way.weight, point, u.x, &way.stands);
              bool back = is_followed(reflected.weight, point, u.y, &reflected.stands);
              if (through && back && waiting == TILE_PENDING) { // no room: one stands for both
                const float chance = way.weight * way.stands / (way.weight * way.stands + reflected.weight * reflected.stands);
                through = u.z < chance;
                back = !through;
                way.stands /= chance;
                reflected.stands /= 1.0f - chance;
              }
              if (back) back = bend_path_as(&world, &reflected.path, hit.primitive, &end.surface, &material, &band, -1.0f,
                                            &n_ratio, &bend);
              if (through && back) { // the one with less light first: so few ways wait
                const bool more_through = way.weight > reflected.weight;
                pending[waiting++] = more_through ? way : reflected;
                if (more_through) way = reflected;
              } else if (back)
                way = reflected;
              else if (!through) {
                if (waiting == 0) break;
                way = pending[--waiting];
              }
            }
          }
        }
      }
      if (goes_on) continue;
      end.left = 1.0f;
      const bool deposited = end.outcome == OUTCOME_DEPOSITED;
      if (deposited || way.path.losses.any) {
        const int reflector = deposited ? material_of(&world, end.surface.object).reflector : -1;
        const float4 carried = carried_light(&world, &way.path.losses, source, &band, reflector);
        end.xyz = carried.xyz;
        if (way.path.losses.any) end.left = share != 0.0f ? carried.w / share : 1.0f;
      }
      const float carried_watts = watts * way.weight * way.stands;
      if (deposited && !splat_way(&world, &camera, &lattice, &end, &way.path, source, &band, way.stands, way.is_coarse, carried_watts, corners,
                                  film_of_iteration(film, lattice.film_half, camera.width * camera.height), film_scale, photon))
        add_outcome(outcomes, OUTCOME_REFUSED, 1);
      count_photon(outcomes, end.outcome, carried_watts * power_share * (lattice.high - lattice.low) * energy_scale, end.left);
      if (waiting == 0) break;
      way = pending[--waiting];
    }
  }
  add_outcomes(energy, outcomes);
}
