// SPDX-License-Identifier: Apache-2.0
// Nested dielectrics (Schmidt and Budge 2002): which objects enclose a path, and which of them is the medium there.
// An object counts once for each of its surfaces that was entered and not left, so overlapping shells of one mesh act as their union.
#ifndef NEPHROID_MEDIA_H
#define NEPHROID_MEDIA_H

#include "shared_types.h"

// Whether one path can be inside two objects. Where no two can enclose a point, and none can be left without meeting its surface, the
// object entered last and how often it was entered say as much as a list.
#ifndef NEPHROID_NESTED_MEDIA
#define NEPHROID_NESTED_MEDIA 1
#endif

#if NEPHROID_NESTED_MEDIA
typedef Media PathMedia;

static inline PathMedia media_from(const Media* given) { return *given; }

// The object whose material fills the place: the highest priority, of equals the one entered last; -1: air.
static inline int medium_object(const PathMedia* media, __global const DeviceObject* objects)
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

static inline bool is_inside(const PathMedia* media, int object)
{
  for (int i = 0; i < media->count; ++i)
    if (media->objects[i] == object) return true;
  return false;
}

// Appends an object. False where the list is full.
static inline bool enter_medium(PathMedia* media, int object)
{
  if (media->count == MEDIA_DEPTH) return false;
  media->objects[media->count++] = object;
  return true;
}

// Removes the latest entry of an object; nothing happens where it is not there (an open mesh).
static inline void leave_medium(PathMedia* media, int object)
{
  int found = -1;
  for (int i = 0; i < media->count; ++i)
    if (media->objects[i] == object) found = i;
  if (found < 0) return;
  for (int i = found; i + 1 < media->count; ++i) media->objects[i] = media->objects[i + 1];
  --media->count;
}

#else
typedef struct {
  int object;
  int count; // how often it was entered and not left
} PathMedia;

static inline PathMedia media_from(const Media* given)
{
  const PathMedia media = {given->count > 0 ? given->objects[0] : -1, given->count};
  return media;
}

static inline int medium_object(const PathMedia* media, __global const DeviceObject* objects) { return media->count > 0 ? media->object : -1; }

static inline bool is_inside(const PathMedia* media, int object) { return media->count > 0 && media->object == object; }

// Entering another object shows that rounding let the path slip out of the one before.
static inline bool enter_medium(PathMedia* media, int object)
{
  if (media->object != object) media->count = 0;
  if (media->count == MEDIA_DEPTH) return false;
  media->object = object;
  ++media->count;
  return true;
}

static inline void leave_medium(PathMedia* media, int object)
{
  if (is_inside(media, object)) --media->count;
}
#endif

#endif
