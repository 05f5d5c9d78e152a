// SPDX-License-Identifier: Apache-2.0
// The caustic layer by tiles: photons leave the lights on square lattices, follow both branches at glass, and each is
// splatted as the piece of its lattice that it stands for (Schjoth et al. 2007, "Photon differentials"; lattices in the
// place of random points make footprints tile).
#define NEPHROID_PLACE_DIFFERENTIALS 1
#include "kernels/photons/footprint_splat.h"
#include "kernels/photons/launch_types.h"
#include "kernels/photons/receiver.h"
#include "kernels/photons/stretch.h"
#include "kernels/transport/scatter_path.h"

// The part of a photon's light below which not every point of the lattice follows what is left: one of 4, then of 16,
// ... does, and stands for all, as a lattice twice as wide. Beyond that many levels chance decides.
#define TILE_LEAST 0.3f
#define TILE_LEVELS 4
// How many branches of a photon can wait to be followed.
#define TILE_PENDING 4
// A footprint is swept where that moves it by so many pixels or more, and its direction by so many radians or less.
#define SWEEP_SHORTEST 0.5f
#define SWEEP_WIDEST 0.05f
// By how much less wide than others a footprint may be whose cell has spanned more than a triangle: it is a guess.
#define COARSE_PART 0.125f

// A branch of a photon's path, up to its last surface.
typedef struct {
  Path path;
  float weight; // Fresnel's part of the photon's light
  float stands; // photons that it stands for
  int level;    // one of 4^level points of the lattice follows it
  int surfaces;
  bool met;       // a caustic object
  bool is_coarse; // its cell has spanned more than a triangle, so that its footprint is a guess
} Branch;

// Decides whether a branch with this part of the light is followed from this point. *stands: the photons that the
// branch before stood for, then that this one does. u: uniform in [0, 1), for what is too little for every lattice.
static inline bool is_followed(float weight, uint2 point, float u, int* level, float* stands) {
  if (!(weight > 0.0f)) return false;
  const int now = max(*level, clamp((int)ceil(0.5f * log2(TILE_LEAST / weight) - 0.5f), 0, TILE_LEVELS));
  const uint mask = (1u << now) - 1u;
  if (((point.x | point.y) & mask) != 0u) return false;
  *stands *= (float)(1u << 2 * (now - *level));
  *level = now;
  const float left = weight * *stands / TILE_LEAST;
  if (left >= 0.25f) return true;
  *stands /= left;
  return u < left;
}

// A tile has one colour: textures are refused with tiles.
static inline Reflector reflector_of_tile(const World* world, const Surface* surface) {
  return reflector_of_row(material_of(world, surface->object).reflector);
}

#if NEPHROID_DIFFERENTIALS
// The light of the part low .. high of a cluster's distribution of wavelengths, as PhotonEnd's xyz.
static inline float3 light_of_part(const World* world, Source source, int cluster, Reflector reflector, float low,
                                   float high) {
  const int first = world->tables.cluster_first[cluster], count = world->tables.cluster_first[cluster + 1] - first;
  __global const float* cdf =
      world->tables.wavelength_cdf + source.light * world->tables.cluster_first[world->scene.cluster_count] + first;
  const bool is_sky = is_of_environment(world, source.light);
  int numbers[2];
  float parts[2];
  for (int i = 0; i < 2; ++i) {
    const float u = fmin(i == 0 ? low : high, 0x1.fffffep-1f);
    const int member = choose(cdf, count, u);
    const float before = chance_before(cdf, member);
    numbers[i] = first + member;
    parts[i] = (u - before) / (cdf[member] - before);
  }
  float3 xyz = (float3)(0.0f);
  for (int row = 0; row < (is_sky ? 3 : 1); ++row) {
    const float of_row = row == 0 ? source.rgb.x : row == 1 ? source.rgb.y : source.rgb.z;
    const float3 of_part =
        light_before(world, source.light + row, reflector, numbers[1], parts[1]) -
        light_before(world, source.light + row, reflector, numbers[0], parts[0]);
    xyz += (is_sky ? of_row : 1.0f) * of_part;
  }
  return xyz;
}

// What a path leaves of that, as coloured_light does: each of the four wavelengths counts where it lies in the part.
static inline float3 part_left_of(const World* world, const Throughput* throughput, const DeviceLattice* lattice,
                                  Source source, const Band* band, float place, Reflector reflector, float low,
                                  float high) {
  float3 xyz = throughput->own.middle * light_of_part(world, source, band->cluster, reflector, low, high);
  if (!are_coloured(&throughput->own)) return xyz;
  const float size = lattice->high - lattice->low;
  for (int i = 0; i < 4; ++i) {
    const float u = lattice->low + size * quarters_on(place, i);
    if (u < low || u >= high) continue;
    const float weight = size * number_of_four(band->own.weights, i) *
                         (number_of_four(throughput->own.four, i) - throughput->own.middle);
    xyz += weight * source_wavelength_light(world, source, number_of_four_wavelengths(&band->own, i), reflector).xyz;
  }
  return xyz;
}
#endif

// Where a photon's four wavelengths lie in its lattice's part of the cluster, in [0, 1).
static inline float place_of_wavelengths(const DeviceLattice* lattice, uint photon) {
  return lattice->is_drawn ? (lattice->wavelength - lattice->low) / (lattice->high - lattice->low)
                           : place_within(photon, 0u).y;
}

#if NEPHROID_RECEIVERS && NEPHROID_DIFFERENTIALS
// What the part low .. high of a cluster's wavelengths has in a layer of light. xyz: of all of it, which stays where it
// is of one layer. False: nothing.
static inline bool light_in_layer(const World* world, const Receivers* on, int layer, const Path* path,
                                  const DeviceLattice* lattice, Source source, const Band* band, uint photon,
                                  Reflector reflector, float low, float high, float3* xyz) {
  const int first = world->tables.cluster_first[band->cluster], end = world->tables.cluster_first[band->cluster + 1],
            from = max(on->layer_members[layer], first), to = min(on->layer_members[layer + 1], end);
  if (from >= to) return false;
  if (from == first && to == end) return true;
  __global const float* cdf =
      world->tables.wavelength_cdf + source.light * world->tables.cluster_first[world->scene.cluster_count] + first;
  low = fmax(low, chance_before(cdf, from - first));
  high = fmin(high, to == end ? 1.0f : cdf[to - first - 1]);
  if (!(low < high)) return false;
  *xyz = part_left_of(world, &path->throughput, lattice, source, band, place_of_wavelengths(lattice, photon), reflector,
                      low, high);
  return true;
}
#endif

// The band of a photon, which goes the way of its lattice's wavelength.
static inline Band band_of_tile(const World* world, const DeviceLattice* lattice, uint photon) {
  Band band = choose_band(world, lattice->light, lattice->cluster, lattice->wavelength);
#if NEPHROID_LOSSES
  const float place = place_of_wavelengths(lattice, photon);
  DrawnWavelength drawn[4];
  for (int i = 0; i < 4; ++i) {
    const float u = lattice->low + (lattice->high - lattice->low) * quarters_on(place, i);
    drawn[i] = draw_wavelength(world, lattice->light, lattice->cluster, fmin(u, 0x1.fffffep-1f));
  }
  band.own = carriers_of(drawn[0], drawn[1], drawn[2], drawn[3], band.own.middle);
#endif
  return band;
}

// Whether a cell of the lattice is wider than the triangle that its middle meets.
static inline bool spans_triangles(const Geometry* geometry, uint primitive, const Differential* by_place, float size) {
  const DevicePrimitive met = geometry->primitives[primitive];
  if (is_ellipsoid(&met) || kind_of(&met) != PRIMITIVE_SMOOTH) return false;
  const float3 a = size * by_place[0].position, b = size * by_place[1].position, u = met.edge_u.xyz, v = met.edge_v.xyz;
  return dot(a, a) + dot(b, b) > dot(u, u) + dot(v, v);
}

// What splats need beside the photon.
typedef struct {
  __global const PixelView* views;
  volatile __global long* film; // the lattice's half of it
  float scale;
#if NEPHROID_RECEIVERS
  Receivers receivers;
  volatile __global long* light; // first_texel of the lattice's half
  float light_scale;
#endif
} TileFilm;

// The footprint about a place of a receiver, which spans a and b there. Where the receiver ends, it shrinks to what
// fits; beyond its triangle a receiver goes on.
static inline Footprint footprint_at(const World* world, const DeviceCamera* camera, const PhotonEnd* end,
                                     const Strand* strand, float side, float3 a, float3 b, float widest,
                                     float2 middle) {
  Footprint f;
  f.middle = middle;
  for (int halvings = 0; halvings < 4; ++halvings) {
    float shrunk;
    if (!footprint_on_film(camera, strand->surface.position, a, b, widest, &f, &shrunk)) break;
    if (!touches_film(camera, &f)) return f;
    a *= 0.5f * shrunk;
    b *= 0.5f * shrunk;
    bool fits = true;
    for (int c = 0; c < 4 && fits; ++c) {
      const float3 corner = strand->surface.position + (c == 1 || c == 2 ? a : -a) + (c >= 2 ? b : -b);
      Surface beside;
      uint triangle;
      fits = is_in_triangle(&world->geometry, strand->triangle, corner) ||
             surface_beside(world, &end->surface, side, corner, &beside, &triangle);
    }
    if (fits) return f;
  }
  shrink_to_point(&f);
  return f;
}

// Splats a branch that ends on a diffuse surface, swept along the wavelengths low .. high of its cluster. Returns false
// where a contribution is too large.
COMPILED_ONCE bool splat_branch(const World* world, const DeviceCamera* camera, const DeviceLattice* lattice,
                                const PhotonEnd* end, const Branch* branch, Source source, const Band* band,
                                float watts, const TileFilm* film, uint photon) {
  const Path* path = &branch->path;
  const float distance = dot(end->surface.position - path->origin, path->direction),
              size = lattice->step * sqrt(branch->stands),
              widest = branch->is_coarse ? COARSE_PART * lattice->widest : lattice->widest;
  const float3 a = size * transferred(&path->by_place[0], path->direction, distance, end->surface.geometric),
               b = size * transferred(&path->by_place[1], path->direction, distance, end->surface.geometric);
  const float side = dot(path->direction, end->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  Strand strand = {end->surface, end->triangle, end->xyz};
  Stretch sweep = {1, true, false};
#if NEPHROID_DIFFERENTIALS
  const Reflector reflector = reflector_of_tile(world, &end->surface);
  float from_x, to_x;
  stretched_band(world, source.light, band, lattice->low, &from_x);
  stretched_band(world, source.light, band, fmin(lattice->high, 0x1.fffffep-1f), &to_x);
  if (!stretch_over(world, camera, end, path, from_x, to_x, SWEEP_SHORTEST, SWEEP_WIDEST, &sweep)) {
    sweep.count = 1;
    if (lattice->is_drawn) strand.xyz = carried_light(world, &path->throughput, source, band, reflector).xyz;
  }
#endif
  bool fits = true;
  const float turn = place_within(photon, 0u).x;
  for (int i = 0; i < sweep.count; ++i) {
#if NEPHROID_DIFFERENTIALS
    const float part = (lattice->high - lattice->low) / (float)sweep.count, low = lattice->low + part * (float)i;
    if (sweep.count > 1) {
      float x;
      float3 place;
      stretched_band(world, source.light, band, fmin(low + turn * part, 0x1.fffffep-1f), &x);
      if (!stretched_place(path, &end->surface, x, &place)) continue;
      strand.surface = end->surface;
      strand.triangle = end->triangle;
      if (!move_on_receiver(world, side, place, sweep.beside, &strand.surface, &strand.triangle)) continue;
    }
#endif
    if (camera->receiver >= 0 && strand.surface.object != camera->receiver) continue;
    float2 middle;
    float weight;
    bool on_film = project_to_film(camera, strand.surface.position, strand.surface.geometric, path->direction,
                                   world->scene.metres_per_unit, &middle, &weight);
    Footprint f;
    if (on_film) {
      f = footprint_at(world, camera, end, &strand, side, a, b, widest, middle);
      on_film = touches_film(camera, &f);
    }
    if (!NEPHROID_RECEIVERS && !on_film) continue;
#if NEPHROID_DIFFERENTIALS
    if (sweep.count > 1 || lattice->high - lattice->low < 1.0f)
      strand.xyz = part_left_of(world, &path->throughput, lattice, source, band, place_of_wavelengths(lattice, photon),
                                reflector, low, low + part);
#endif
    const float shading = shading_ratio(&strand.surface, path->direction);
#if NEPHROID_RECEIVERS
    const float on_receiver = branch->is_coarse ? COARSE_PART : 1.0f;
    const float power = watts * shading * film->light_scale;
    for (int layer = 0; layer < film->receivers.layers; ++layer) {
      float3 of_layer = strand.xyz;
#if NEPHROID_DIFFERENTIALS
      if (!light_in_layer(world, &film->receivers, layer, path, lattice, source, band, photon, reflector, low,
                          low + part, &of_layer))
        continue;
#else
      if (layer != layer_of_band(&film->receivers, &world->tables, band)) continue;
#endif
      fits = add_to_receiver(&film->receivers, &strand.surface, side, on_receiver * a, on_receiver * b,
                             film->light + 3 * PAGE_TEXELS * (size_t)layer, of_layer * power) &&
             fits;
    }
#endif
    if (!on_film) continue;
    const SeenReceiver receiver = seen_receiver(camera, film->views, &strand.surface, strand.triangle, side);
    const float3 xyz = strand.xyz * (watts * weight * shading / PI_F);
    fits = add_footprint(world, film->film, camera, &receiver, &f, photon, xyz, film->scale) && fits;
  }
  return fits;
}

// How a branch and those that wait are followed: the visitor of a walk.
typedef struct {
  Band band;
  Branch branch, before; // now; at the surface that scatters it
  Branch pending[TILE_PENDING];
  int waiting;
  int segments; // rays of all branches
  float cell;   // the side of the lattice's cells
  uint2 point;  // of the lattice
  uint2 seed;
  uint iteration, photon;
} Visitor;

static inline Band visitor_band(const Visitor* tile) { return tile->band; }

static inline WalkNumbers visitor_numbers(const Visitor* tile, const Interaction* at, int n) {
  const WalkNumbers none = {0.0f, (float2)(0.0f)}; // what goes through and what is reflected are both followed
  return none;
}

static inline uint visitor_lobes(const Visitor* tile, const Interaction* at, int n) {
  return LOBE_DIFFUSE | LOBE_TRANSMISSION;
}

static inline void visit_segment(const World* world, Visitor* tile, const Path* path, const Hit* hit) {
  ++tile->segments;
}

static inline void visit_surface(const World* world, Visitor* tile, const Path* path, const Interaction* at, int n) {
  if (!is_only_matt(&at->material)) tile->before = tile->branch;
}

static inline bool visit_scatter(const World* world, Visitor* tile, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n);

#define WALK_SEGMENTS
#define WALK_SURFACES
#define WALK_LOBES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

// At glass both branches are followed. tile->branch has gone through and `reflected` waits before the surface; what is
// followed later is put into tile->pending, and of two that with more light: so few branches wait. False: other points
// of the lattice stand for both.
static inline bool split_branch(const World* world, Visitor* tile, const Interaction* at, const ScatterSample* through,
                                Branch* reflected) {
  const float4 u = random4(tile->seed, tile->iteration, tile->photon, (uint)tile->segments - 1u, STREAM_PHOTONS);
  Branch* branch = &tile->branch;
  reflected->weight *= through->reflectance;
  branch->weight *= 1.0f - through->reflectance;
  bool goes_through = is_followed(branch->weight, tile->point, u.x, &branch->level, &branch->stands);
  bool goes_back = is_followed(reflected->weight, tile->point, u.y, &reflected->level, &reflected->stands);
  if (goes_through && goes_back && tile->waiting == TILE_PENDING) { // no room: one stands for both
    const float light = branch->weight * branch->stands,
                chance = light / (light + reflected->weight * reflected->stands);
    goes_through = u.z < chance;
    goes_back = !goes_through;
    branch->stands /= chance;
    reflected->stands /= 1.0f - chance;
  }
  const WalkNumbers none = {0.0f, (float2)(0.0f)};
  ScatterSample back;
  goes_back = goes_back && scatter_path(world, &reflected->path, at, &tile->band, LOBE_REFLECTION, none, &back);
  if (goes_through && goes_back) {
    const bool more_through = branch->weight > reflected->weight;
    tile->pending[tile->waiting++] = more_through ? *branch : *reflected;
    if (more_through) *branch = *reflected;
  } else if (goes_back)
    *branch = *reflected;
  return goes_through || goes_back;
}

static inline bool visit_scatter(const World* world, Visitor* tile, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  Branch *branch = &tile->branch, *before = &tile->before;
  branch->met = before->met = true;
  branch->surfaces = before->surfaces = n + 1;
  branch->is_coarse = branch->is_coarse || spans_triangles(&world->geometry, at->triangle, branch->path.by_place,
                                                           tile->cell * sqrt(branch->stands));
  before->is_coarse = branch->is_coarse;
  if (!sample->transmitted || sample->reflectance == 0.0f) return true;
  return split_branch(world, tile, at, sample, before);
}

// A photon's first branch. emission: its by_place[2] is set already.
static inline void start_branch(Branch* branch, const Emission* emission, Media inside) {
  branch->path.origin = emission->origin;
  branch->path.direction = emission->direction;
  branch->path.skip = NEPHROID_NO_PRIMITIVE;
  branch->path.media = inside;
  branch->path.throughput = full_throughput();
  branch->path.behind = emission->behind;
  branch->path.differential.position = branch->path.differential.direction = (float3)(0.0f);
  branch->weight = branch->stands = 1.0f;
  branch->surfaces = branch->level = 0;
  branch->met = branch->is_coarse = false;
}

// Follows the points launch.offset, ..., offset + count - 1 of a round. energy: as of photons.cl.
PHOTON_KERNEL(tiles, (WORLD_ARGUMENTS, __global const DeviceLattice* lattices, int lattice_count,
                      __global const PixelView* views,
                      volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]
                      __global const int* receiver_table, volatile __global long* light, // with NEPHROID_RECEIVERS
                      DeviceCamera camera, DevicePhotonLaunch launch),
                     (WORLD_NAMES, lattices, lattice_count, views, film, energy, receiver_table, light, camera,
                      launch)) {
  const World world = WORLD;
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint number = index * NEPHROID_PHOTONS_PER_ITEM + k;
    if (number >= launch.count) break;
    const uint photon = launch.offset + number;
    const DeviceLattice lattice =
        lattices[last_from(&lattices->first_photon, sizeof(DeviceLattice) / sizeof(uint), lattice_count, photon)];
    const uint in_lattice = photon - lattice.first_photon;
    const uint2 index = (uint2)(in_lattice % lattice.side, in_lattice / lattice.side);
    const float2 disc = (convert_float2(index) + (float2)(lattice.shift_x, lattice.shift_y)) * lattice.step - 1.0f;
    if (dot(disc, disc) > 1.0f) continue;
    const uint2 point = index + (uint2)(lattice.phase & 0xffffu, lattice.phase >> 16);
    const float2 place = (float2)(lattice.place_x, lattice.place_y);
    Visitor tile;
    const Emission emission =
        emit_on_lattice(&world, lattice.light, lattice.target, disc, place, tile.branch.path.by_place);
    const Source source = emission.source;
    if (emission.watts == 0.0f) continue;
    const Band band = band_of_tile(&world, &lattice, photon);
    Band whole = band;
    whole.wavelength = -1;
    const Throughput full = full_throughput();
    // Any reflector's row of the table has the share as w.
    const float power_share = is_of_environment(&world, lattice.light)
                                  ? carried_light(&world, &full, source, &whole, reflector_of_row(0)).w
                                  : lattice.share,
                watts = emission.watts / lattice.photons;
    TileFilm to_film;
    to_film.views = views;
    to_film.film = film_of_iteration(film, lattice.film_half, camera.width * camera.height);
    to_film.scale = launch.film_scale;
#if NEPHROID_RECEIVERS
    to_film.receivers = receivers_of(receiver_table);
    to_film.light = light + first_texel(&to_film.receivers, lattice.film_half, 0, 0);
    to_film.light_scale = launch.stored_scale;
#endif
    tile.band = band;
    tile.waiting = tile.segments = 0;
    tile.cell = lattice.step;
    tile.point = point;
    tile.seed = launch.seed;
    tile.iteration = launch.iteration;
    tile.photon = photon;
    start_branch(&tile.branch, &emission, world.lights[lattice.light].inside);
    for (;;) {
      Branch* const branch = &tile.branch;
      Hit hit;
      Interaction at;
      int surface_number;
      const int how = walk(&world, &tile, &branch->path, &hit, false, branch->surfaces, &at, &surface_number);
      if (how != WALK_DROPPED) {
        PhotonEnd end;
        const bool met = branch->met, deposited = how == WALK_AT_BASE && met;
        end.outcome = how == WALK_LOST ? OUTCOME_LOST
                      : deposited      ? OUTCOME_DEPOSITED
                      : met            ? OUTCOME_ESCAPED
                                       : OUTCOME_MISSED;
        const Throughput* throughput = &branch->path.throughput;
        end.left = power_left(&world, throughput, source, &whole, power_share);
        if (deposited) {
          end.surface = at.surface;
          end.triangle = at.triangle;
          end.xyz = carried_light(&world, throughput, source, &whole, reflector_of_tile(&world, &end.surface)).xyz;
        }
        const float carried_watts = watts * branch->weight * branch->stands;
        if (deposited &&
            !splat_branch(&world, &camera, &lattice, &end, branch, source, &band, carried_watts, &to_film, photon))
          add_outcome(outcomes, OUTCOME_REFUSED, 1);
        count_photon(outcomes, end.outcome, 0,
                     carried_watts * power_share * (lattice.high - lattice.low) * launch.energy_scale, end.left);
      }
      if (tile.waiting == 0) break;
      *branch = tile.pending[--tile.waiting];
    }
    add_outcome(outcomes, OUTCOME_SEGMENTS, tile.segments);
  }
}
