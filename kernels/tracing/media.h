// SPDX-License-Identifier: Apache-2.0
// Nested dielectrics (Schmidt and Budge 2002): which objects enclose a path, and which of them is the medium there.
// An object counts once for each of its surfaces that was entered and not left, so overlapping shells of one mesh act as their union.
#ifndef NEPHROID_MEDIA_H
#define NEPHROID_MEDIA_H

#include "kernels/tracing/shared_types.h"

// The object whose material fills the place: the highest priority, of equals the one entered last; -1: air.
static inline int medium_object(const Media* media, __global const DeviceObject* objects)
{
  int best = -1, best_priority = 0;
  for (int i = 0; i < media->count; ++i) {
    const int candidate = media->objects[i];
    const int priority = objects[candidate].priority;
    if (best < 0 || priority >= best_priority) {
      best = candidate;
      best_priority = priority;
    }
  }
  return best;
}

static inline bool is_inside(const Media* media, int object)
{
  for (int i = 0; i < media->count; ++i)
    if (media->objects[i] == object) return true;
  return false;
}

// Appends an object. False where the list is full.
static inline bool enter_medium(Media* media, int object)
{
  if (media->count == MEDIA_DEPTH) return false;
  media->objects[media->count++] = object;
  return true;
}

// Removes the latest entry of an object; nothing happens where it is not there (an open mesh).
static inline void leave_medium(Media* media, int object)
{
  int found = -1;
  for (int i = 0; i < media->count; ++i)
    if (media->objects[i] == object) found = i;
  if (found < 0) return;
  for (int i = found; i + 1 < media->count; ++i) media->objects[i] = media->objects[i + 1];
  --media->count;
}

#endif
