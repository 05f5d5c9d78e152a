// SPDX-License-Identifier: Apache-2.0
// Nested dielectrics (Schmidt and Budge 2002): the objects that enclose a path, and the one of them that is the medium
// there. An object counts once for each of its surfaces that was entered and not left, so overlapping shells of one
// mesh act as their union. The list is 128 bits, not an array, so that a GPU keeps it in registers.
#include "kernels/tracing/shared_types.h"

#define MEDIUM_MASK ((1ul << MEDIUM_BITS) - 1ul)

static inline bool is_in_air(const Media* media) { return media->latest == 0ul; } // earlier ones come after four others

// The object that was entered last; the list must not be empty.
static inline int latest_medium(const Media* media) { return (int)(media->latest & MEDIUM_MASK) - 1; }

static inline Media without_latest(Media media) {
  const Media rest = {media.latest >> MEDIUM_BITS | media.earlier << (64 - MEDIUM_BITS), media.earlier >> MEDIUM_BITS};
  return rest;
}

// The object whose material fills the place: the one of highest priority, among equals the one entered last; -1: air.
static inline int medium_object(const Media* media, __global const DeviceObject* objects) {
  int best = -1, best_priority = 0;
  for (Media rest = *media; !is_in_air(&rest); rest = without_latest(rest)) {
    const int candidate = latest_medium(&rest), priority = objects[candidate].priority;
    if (best < 0 || priority > best_priority) {
      best = candidate;
      best_priority = priority;
    }
  }
  return best;
}

static inline bool is_inside(const Media* media, int object) {
  for (Media rest = *media; !is_in_air(&rest); rest = without_latest(rest))
    if (latest_medium(&rest) == object) return true;
  return false;
}

// Appends an object. False where the list is full.
static inline bool enter_medium(Media* media, int object) {
  if (media->earlier >> (64 - MEDIUM_BITS)) return false;
  media->earlier = media->earlier << MEDIUM_BITS | media->latest >> (64 - MEDIUM_BITS);
  media->latest = media->latest << MEDIUM_BITS | (ulong)(object + 1);
  return true;
}

// Removes the latest entry of an object, if there is one (an open mesh may have none).
static inline void leave_medium(Media* media, int object) {
  uint place = 0;
  Media rest = *media;
  for (; !is_in_air(&rest) && latest_medium(&rest) != object; rest = without_latest(rest)) place += MEDIUM_BITS;
  if (is_in_air(&rest)) return;
  // Objects entered after it keep their places, the others move up by one.
  const Media moved = without_latest(*media);
  const ulong after = (1ul << (place & 63u)) - 1ul; // the later places in its half
  if (place < 64u) {
    media->latest = (media->latest & after) | (moved.latest & ~after);
    media->earlier = moved.earlier;
  } else
    media->earlier = (media->earlier & after) | (moved.earlier & ~after);
}
