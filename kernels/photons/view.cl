// SPDX-License-Identifier: Apache-2.0
// Paths from the eye through glass and mirrors to the diffuse surface whose photons they gather (gather.cl).
#include "kernels/lights/transmittance.h"
#include "kernels/photons/launch_types.h"
#include "kernels/photons/pass_band.h"
#include "kernels/photons/photon_map.h"
#include "kernels/tracing/work_item.h"
#include "kernels/transport/eye_walk.h"

// The factors of X, Y and Z by which a path reduces the light that it brings to the eye. A single wavelength has its
// own. Photons of a whole cluster carry a sum over its wavelengths, of which each can no longer be reduced for itself.
static inline float3 part_seen(const World* world, const Throughput* throughput, const Band* band,
                               Reflector reflector) {
  const bool is_single = NEPHROID_JITTER && band->wavelength >= 0;
  return is_single || !are_coloured(&throughput->own) ? (float3)(part_left(throughput))
                                                      : transmittance(world, throughput, band, reflector);
}

static inline VisiblePoint nothing_visible(void) {
  VisiblePoint point;
  point.position = point.normal = point.throughput = (float4)(0.0f);
  point.group = NO_PHOTON;
  return point;
}

// Where a path that has hit `hit` ends in a band, which belongs to a part of its cluster. weight is the path's.
// reflected: by the coat that it meets first.
COMPILED_ONCE VisiblePoint see(const World* world, Path path, Hit hit, bool reflected, const Band* band, int part,
                               float weight, int object_count, uint2 seed, uint sample, uint pixel) {
  VisiblePoint point = nothing_visible();
  Visitor eye = eye_visitor(band, seed, sample, 0u, pixel, STREAM_VIEW);
  if (reflected) eye.first_lobes = LOBE_REFLECTION;
  Interaction at;
  const float radiance_scale = reach_base(world, &eye, &path, &hit, &at);
  if (radiance_scale == 0.0f) return point;
  const Reflector reflector = reflector_at(world, &at.surface, at.triangle);
  point.position = (float4)(at.surface.position, 0.0f);
  point.normal = (float4)(at.surface.geometric, 0.0f);
  point.throughput = (float4)(weight * radiance_scale * part_seen(world, &path.throughput, band, reflector), 0.0f);
  point.group = photon_group(at.surface.object, dot(path.direction, at.surface.geometric) < 0.0f,
                             band_number(band->cluster, part), object_count);
  return point;
}

// points: [count]; position.w is the film's dither. Where launch.cluster is -1, each path that meets glass or a mirror
// first takes a cluster by its chance in cluster_cdf and counts for so much more; so does what a coat reflects, and the
// others see nothing here.
__kernel void view(WORLD_ARGUMENTS, __global VisiblePoint* points, DeviceCamera camera, __global const uint* pixels,
                   DeviceViewLaunch launch) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= launch.count) return;
  const uint pixel = pixels[launch.first + index];
  const int column = (int)pixel % camera.width, row = (int)pixel / camera.width;
  const float4 jitter = random4(launch.seed, launch.sample, pixel, 0u, STREAM_VIEW);
  EYE_OF(camera);
  begin_on_lens(eye, pixel, jitter.xy, launch.seed, launch.sample, 0u, STREAM_VIEW);
  Path path = path_from_eye(eye, primary_direction(eye, column, row, jitter.xy));
  const Hit hit = next_hit(&world, &path);
  VisiblePoint point = nothing_visible();
  if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
    const DeviceMaterial met = material_of_hit(&world, &hit);
    const bool bent = !is_only_matt(&met);
    int cluster = launch.cluster;
    float weight = 1.0f / (float)launch.path_count;
    const bool reflected = cluster < 0 && has_coat(&met);
    if (cluster < 0 && bent) {
      cluster = choose_cluster(world.cluster_cdf, scene.cluster_count, launch.seed, launch.pass, launch.place, 0u,
                               pixel, STREAM_VIEW_CLUSTER);
      weight /= (world.cluster_cdf[cluster + 1] - world.cluster_cdf[cluster]);
    }
    if (cluster >= 0) {
      const int part = part_of_cluster(jitter.w);
#if NEPHROID_JITTER
      const Band band = band_of_pass(&world, cluster, part, launch.seed, launch.pass);
#else
      const Band band = choose_band(&world, scene.light_count, cluster, jitter.w);
#endif
      point = see(&world, path, hit, reflected, &band, part, weight * (float)NEPHROID_PASS_BANDS,
                  launch.object_count, launch.seed, launch.sample, pixel);
    }
  }
  point.position.w = jitter.z;
  points[index] = point;
}
