// SPDX-License-Identifier: Apache-2.0
// Which texels paths from the eye ask for: where light is kept on receivers (app/photons/receivers), and how fine.
#define NEPHROID_PLACE_DIFFERENTIALS 1
#include "kernels/photons/receiver_look.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/branches.h"
#include "kernels/transport/eye_band.h"

// The pages that the first ends of some samples of each pixel ask for. Work items are samples. looks:
// [count][ASKING_SAMPLES][ASKING_ENDS].
ITEM_KERNEL(ask_for_pages, (WORLD_ARGUMENTS, __global const int* receiver_table, DeviceCamera camera,
                            __global const uint* pixels, uint2 seed, uint count, __global DeviceLook* looks),
                           (WORLD_NAMES, receiver_table, camera, pixels, seed, count, looks)) {
  const World world = WORLD;
  if (index >= count * ASKING_SAMPLES) return;
  const Receivers on = receivers_of(receiver_table);
  const DeviceLook none = {NO_PAGE, 0.0f, 0.0f, 0};
  for (uint i = 0; i < ASKING_ENDS; ++i) looks[ASKING_ENDS * index + i] = none;
  const uint pixel = pixels[index / ASKING_SAMPLES], sample = index % ASKING_SAMPLES;
  const float2 place = place_numbers(seed, sample, pixel).xy;
  float3 direction;
  EYE_OF(camera);
  Hit hit = first_hit(&world, eye, pixel, place, seed, sample, &direction);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;
  float chance;
  const Band band = choose_eye_band(&world, ((float)sample + 0.5f) / (float)ASKING_SAMPLES, 1u, &chance);
  const Path path = path_from_eye(eye, direction);
  Visitor visitor;
  begin_branches(&visitor, &path, &band, seed, sample, 0u, 1u, pixel, STREAM_CAMERA);
  for (uint i = 0; i < ASKING_ENDS; ++i) {
    Interaction at;
    int last;
    if (follow_branch(&world, &visitor, &hit, &at, &last) == WALK_AT_BASE && last > 0) {
      const Path* way = &visitor.branch.path;
      const EyeFootprint footprint =
          eye_footprint(eye, way, &at.surface, visitor.branch.spread, place, (float2)(1.0f));
      const ChartLook look = look_on_chart(&on, &at.surface, side_of_arrival(way, &at.surface), footprint.a,
                                           footprint.b, footprint.place);
      const DeviceLook asked = {look.chart, look.middle.x, look.middle.y, look.level};
      if (look.chart != NO_PAGE) looks[ASKING_ENDS * index + i] = asked;
    }
    if (!next_branch(&visitor)) break;
  }
}
