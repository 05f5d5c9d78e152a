// SPDX-License-Identifier: Apache-2.0
// A quadrilateral over a grid of square cells, which are pixels or texels, and the area of each cell that it covers.

typedef struct {
  float4 x, y;  // its corners, around it, in cells relative to `middle`
  float4 slope; // dx / dy of the edge from each corner to the next; 0: level
  float2 middle;
  float area; // in cells, signed by its orientation
} Footprint;

static inline float least(float4 v) { return fmin(fmin(v.x, v.y), fmin(v.z, v.w)); }
static inline float greatest(float4 v) { return fmax(fmax(v.x, v.y), fmax(v.z, v.w)); }

// The corners' lowest and highest coordinates.
static inline float2 low_corner(const Footprint* f) { return f->middle + (float2)(least(f->x), least(f->y)); }
static inline float2 high_corner(const Footprint* f) { return f->middle + (float2)(greatest(f->x), greatest(f->y)); }

// Works out slopes and area from the corners. False: it has hardly any area.
static inline bool has_area(Footprint* f) {
  const float4 rise = f->y.yzwx - f->y;
  f->slope = select((f->x.yzwx - f->x) / rise, (float4)(0.0f), fabs(rise) < 1e-6f);
  f->area = 0.5f * dot(f->x, f->y.yzwx) - 0.5f * dot(f->y, f->x.yzwx);
  return fabs(f->area) > 1e-6f;
}

// Makes a footprint a point.
static inline void shrink_to_point(Footprint* f) {
  f->x = f->y = f->slope = (float4)(0.0f);
  f->area = 0.0f;
}

// The integral of clamp(x, 0, 1) from 0 to x.
static inline float4 ramp_sum(float4 x) {
  const float4 inside = clamp(x, 0.0f, 1.0f);
  return 0.5f * inside * inside + fmax(x - 1.0f, 0.0f);
}

// The area of the cell at `cell` (its corner relative to the middle) that lies in the footprint, 0..1, signed by its
// orientation: the sum over the edges of what lies beside them.
static inline float covered(const Footprint* f, float2 cell) {
  const float4 x = f->x - cell.x, y = f->y - cell.y, y0 = clamp(y, 0.0f, 1.0f), y1 = y0.yzwx;
  const float4 x0 = x + (y0 - y) * f->slope, x1 = x + (y1 - y) * f->slope, across = x1 - x0;
  const float4 beside =
      select((ramp_sum(x1) - ramp_sum(x0)) / across, clamp(0.5f * (x0 + x1), 0.0f, 1.0f), fabs(across) < 1e-2f);
  return dot(y1 - y0, beside);
}
