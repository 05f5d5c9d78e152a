// SPDX-License-Identifier: Apache-2.0
// What one sample from the eye sees of the environment. A sample stands for a piece of its pixel, which is the smaller
// the more samples there are. Ray differentials (Igehy 1999) say which directions that piece sees through glass and
// mirrors, to first order:
//   d + a u + b v,  0 <= a + at.x < 1,  0 <= b + at.y < 1.
// The environment's mean over them takes two directions, weighted by the balance heuristic (Veach 1997, 9.2.2): the
// sample's own, and one drawn by the map's peaks, which counts if it is among them. So a sun much smaller than the
// piece is there with its share, and what is even is seen as without differentials.
#include "kernels/lights/background.h"
#include "kernels/lights/lights.h"
#include "kernels/tracing/path.h"

typedef struct {
  float3 direction; // d, unit
  float3 u, v;
  float2 at; // the sample's place in its piece
} Piece;

// Edges, in pixels, of the piece for which a pixel's sample `index` stands. The samples 2^m to 2^(m+1) - 1 belong to a
// (0, 2)-sequence (low_discrepancy.h), so each of 2^k equal boxes has 2^(m-k) of them. Several share a piece, k = 2 m /
// 3, because how large each takes its image to be is noise too.
static inline float2 piece_edges(uint index) {
  const uint level = (31u - clz(max(index, 1u))) * 2u / 3u;
  return 1.0f / (float2)((float)(1u << (level + 1u) / 2u), (float)(1u << level / 2u));
}

#if NEPHROID_PLACE_DIFFERENTIALS
// The piece at the end of a path. place: of the sample in its pixel; edges: of its piece, in pixels. Through curved
// glass a long piece is bent: to second order it is wide by the square of its length, and not the line that it is to
// first order near a fold. Longer than a radian, or after surfaces whose derivatives are not finite, it says only that
// much of the sky is seen. All of that vanishes as pieces shrink.
static inline Piece piece_of(const Path* path, float2 place, float2 edges) {
  const float2 at = place / edges;
  Piece piece = {path->direction, edges.x * path->by_place[0].direction, edges.y * path->by_place[1].direction,
                 at - floor(at)};
  // The singular values of (u, v) are the lengths of these.
  float cosine;
  const float sine =
      sincos(0.5f * atan2(2.0f * dot(piece.u, piece.v), dot(piece.u, piece.u) - dot(piece.v, piece.v)), &cosine);
  const float3 along = cosine * piece.u + sine * piece.v, aside = cosine * piece.v - sine * piece.u;
  const float length_along = length(along), length_aside = length(aside), longest = sqrt(fmin(edges.x, 1.0f));
  if (!(length_along < 1e9f)) {
    make_frame(piece.direction, &piece.u, &piece.v);
    piece.u *= longest;
    piece.v *= longest;
  } else if (length_aside > 0.0f) {
    const float new_length = fmin(length_along, longest);
    const float3 p = along * (new_length / length_along),
                 q = aside * (clamp(length_aside, new_length * new_length, longest) / length_aside);
    piece.u = cosine * p - sine * q;
    piece.v = sine * p + cosine * q;
  }
  return piece;
}
#endif

// The density per steradian of sample_peaks. Between the middles of texels it is bilinear in the map, as colours are.
static inline float density_of_peaks(const Sky* sky, float3 direction) {
  const TexelPlace at = texel_place(&sky->size, direction);
  __global const float* cdf = cdf_of_peaks(sky);
  float chance = 0.0f;
  for (int i = 0; i < 2; ++i) {
    const int row = i == 0 ? at.row : at.next_row;
    __global const float* columns = cdf + sky->size.height + (size_t)row * (size_t)sky->size.width;
    const float left = columns[at.column] - chance_before(columns, at.column),
                right = columns[at.next_column] - chance_before(columns, at.next_column);
    chance += (i == 0 ? 1.0f - at.lower_part : at.lower_part) * (cdf[row] - chance_before(cdf, row)) *
              (left + at.right_part * (right - left));
  }
  // A texel's width and height are 2 pi sin(zenith) / columns and pi / rows.
  const float sine = sqrt(direction.x * direction.x + direction.z * direction.z);
  return chance * (float)sky->size.width * (float)sky->size.height / (2.0f * PI_F * PI_F * fmax(sine, 1e-6f));
}

// The number in (-1, 1) whose density is 1 - |x|, from a uniform one.
static inline float tent(float u) { return u < 0.5f ? sqrt(2.0f * u) - 1.0f : 1.0f - sqrt(2.0f - 2.0f * u); }

// A direction about one of the peaks' texels. place: two numbers in [0, 1).
static inline float3 sample_peaks(const Sky* sky, float2 place) {
  const int width = sky->size.width, height = sky->size.height;
  __global const float* cdf = cdf_of_peaks(sky);
  const int row = choose(cdf, height, place.x);
  __global const float* columns = cdf + height + (size_t)row * (size_t)width;
  const int column = choose(columns, width, place.y);
  const float down = place_in_bin(cdf, row, place.x), right = place_in_bin(columns, column, place.y);
  // The first and the last row go on to the poles as they are.
  const bool to_pole = (row == 0 && down < 0.5f) || (row == height - 1 && down >= 0.5f);
  const float zenith = PI_F * ((float)row + 0.5f + (to_pole ? down - 0.5f : tent(down))) / (float)height;
  const float azimuth = 2.0f * PI_F * (((float)column + 0.5f + tent(right)) / (float)width - 0.5f - sky->size.turns);
  const float sine = sin(zenith);
  return (float3)(sine * sin(azimuth), cos(zenith), -sine * cos(azimuth));
}

// The environment's mean over a piece, linear sRGB. place: two numbers in [0, 1). With n = u x v, the tangent plane's
// point d + a u + b v is 1 / c away, where c is the cosine between the direction and d. So the piece's density per
// steradian is 1 / (c^3 |n|), and the weight of a direction with the density p among the peaks is 1 / (1 + p c^3 |n|).
static inline float3 rgb_of_piece(const Sky* sky, const Background* background, const Piece* piece, float2 place) {
  const float3 own = background_rgb(background, piece->direction), n = cross(piece->u, piece->v);
  const float area = length(n);
  if (!sky->size.has_peaks || !(area > 0.0f && area < INFINITY)) return own;
  const float3 sum = own / (1.0f + area * density_of_peaks(sky, piece->direction));
  const float3 drawn = sample_peaks(sky, place);
  const float cosine = dot(drawn, piece->direction);
  const float3 aside = drawn / cosine - piece->direction, across = n / (area * area);
  const float a = dot(cross(aside, piece->v), across) + piece->at.x,
              b = dot(cross(piece->u, aside), across) + piece->at.y;
  if (!(cosine > 0.0f && a >= 0.0f && a < 1.0f && b >= 0.0f && b < 1.0f)) return sum;
  return sum +
         background_rgb(background, drawn) / (1.0f + area * cosine * cosine * cosine * density_of_peaks(sky, drawn));
}
