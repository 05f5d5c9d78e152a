// SPDX-License-Identifier: Apache-2.0
// Adds photons near a visible point to its pixel's progressive statistics.
//
// A photon carries the flux F that arrives, times the reflectance, as XYZ. On a surface of area A it adds F / A to the
// exitance, of which a Lambertian surface sends 1 / pi per steradian and projected area. The photons within r of a
// point of a plane lie on A = pi r^2, so
//   L = sum of F / (pi * pi r^2),
// and what reaches the eye is L times the path's throughput.
#include "kernels/tracing/work_item.h"
#include "kernels/photons/photon_map.h"

// One iteration of Hachisuka and Jensen (2009), "Stochastic Progressive Photon Mapping", with the statistics of the
// pixel in one cluster: of M photons within the radius R, alpha M are added to the N there are, and R shrinks so that
// the density stays:
//   N' = N + alpha M,  R'^2 = R^2 N' / (N + M),  flux' = (flux + F) R'^2 / R^2.
// The places that a pixel sees share them. unit: power of a quantum.
kernel void gather_to_statistics(PHOTON_MAP_ARGUMENTS, global const VisiblePoint* points,
                                 global PixelStatistics* statistics, uint first_pixel, uint count, float alpha,
                                 float unit) {
  const uint i = work_item();
  if (i >= count) return;
  const VisiblePoint point = points[i];
  if (point.group == NO_PHOTON) return;
  const PhotonMap map = PHOTON_MAP;
  PixelStatistics pixel = statistics[first_pixel + i];
  const Gathered gathered =
      gather_photons(&map, point.position.xyz, point.normal.xyz, point.group, sqrt(pixel.radius2));
  if (gathered.count == 0) return;
  const float found = (float)gathered.count, kept = pixel.count + alpha * found, shrink = kept / (pixel.count + found);
  const float3 flux = convert_float3(gathered.xyz) * point.throughput.xyz * unit;
  pixel.radius2 *= shrink;
  pixel.count = kept;
  pixel.flux[0] = (pixel.flux[0] + flux.x) * shrink;
  pixel.flux[1] = (pixel.flux[1] + flux.y) * shrink;
  pixel.flux[2] = (pixel.flux[2] + flux.z) * shrink;
  statistics[first_pixel + i] = pixel;
}

kernel void start_statistics(global PixelStatistics* statistics, uint pixels, float radius2) {
  const uint i = work_item();
  if (i >= pixels) return;
  const PixelStatistics start = {radius2, 0.0f, {0.0f, 0.0f, 0.0f}};
  statistics[i] = start;
}

// Adds the radiance of a cluster: flux / (pi^2 R^2) over its iterations, whose number differs for the pixels before
// `split` and those after. per_iteration_*: 1 / (pi^2 iterations m^2), m metres a unit of length; 0 for no iterations.
kernel void add_radiance(global const PixelStatistics* statistics, global float* xyz, uint pixels, uint split,
                         float per_iteration_before, float per_iteration_after) {
  const uint i = work_item();
  if (i >= pixels) return;
  const PixelStatistics pixel = statistics[i];
  const float scale = (i < split ? per_iteration_before : per_iteration_after) / pixel.radius2;
  for (int c = 0; c < 3; ++c) xyz[3 * i + c] += pixel.flux[c] * scale;
}
