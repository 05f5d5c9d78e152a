// SPDX-License-Identifier: Apache-2.0
// Paths from the eye through glass and mirrors to the diffuse surface whose photons they gather (gather.cl).
#include "kernels/lights/transmittance.h"
#include "kernels/photons/launch_types.h"
#include "kernels/photons/pass_band.h"
#include "kernels/photons/photon_map.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_walk.h"

// The factors of X, Y and Z by which a path reduces the light that it brings to the eye. A single wavelength has its
// own. Photons of a whole cluster carry a sum over its wavelengths, of which each can no longer be reduced for itself.
static inline float3 part_seen(const World* world, const Throughput* throughput, const Band* band,
                               Reflector reflector) {
  const bool is_single = NEPHROID_JITTER && band->wavelength >= 0;
  return is_single || !are_coloured(&throughput->own) ? (float3)(part_left(throughput))
                                                      : transmittance(world, throughput, band, reflector);
}

// points: [count], where paths of the pixels end in the cluster's band.
ITEM_KERNEL(view, (WORLD_ARGUMENTS, __global VisiblePoint* points, DeviceCamera camera, DeviceViewLaunch launch),
                  (WORLD_NAMES, points, camera, launch)) {
  const World world = WORLD;
  if (index >= launch.count) return;
  const uint pixel = launch.first + index;
  const int column = (int)pixel % camera.width, row = (int)pixel / camera.width;
  const float4 jitter = random4(launch.seed, launch.pass, pixel, 0u, STREAM_VIEW);
  EYE_OF(camera);
  begin_on_lens(eye, pixel, jitter.xy, launch.seed, launch.pass, 0u, STREAM_VIEW);
  Path path = path_from_eye(eye, primary_direction(eye, column, row, jitter.xy));
  VisiblePoint point;
  point.position = point.normal = point.throughput = (float4)(0.0f);
  point.group = NO_PHOTON;
#if NEPHROID_JITTER
  const Band band = band_of_pass(&world, launch.cluster, launch.seed, launch.pass);
#else
  const Band band = choose_band(&world, scene.light_count, launch.cluster, jitter.w);
#endif
  Visitor eye_visit = eye_visitor(&band, launch.seed, launch.pass, 0u, pixel, STREAM_VIEW);
  Hit hit = next_hit(&world, &path);
  Interaction at;
  const float radiance_scale =
      hit.primitive == NEPHROID_NO_PRIMITIVE ? 0.0f : reach_base(&world, &eye_visit, &path, &hit, &at);
  if (radiance_scale != 0.0f) {
    const Reflector reflector = reflector_at(&world, &at.surface, at.triangle);
    point.position = (float4)(at.surface.position, 0.0f);
    point.normal = (float4)(at.surface.geometric, 0.0f);
    point.throughput = (float4)(radiance_scale * part_seen(&world, &path.throughput, &band, reflector), 0.0f);
    point.group = photon_group(at.surface.object, dot(path.direction, at.surface.geometric) < 0.0f, band.cluster,
                               launch.object_count);
  }
  points[index] = point;
}
