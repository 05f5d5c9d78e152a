// SPDX-License-Identifier: Apache-2.0
// Caustics of few photons made smooth: the light of every pixel is spread over as many pixels around it as make its noise small enough.
//
// Photons on a surface are a sample of a density, and a histogram over pixels is the noisiest estimate of it. This is the sample-point
// estimate with adaptive kernels (Abramson 1982, "On bandwidth variation in kernel estimates"): narrow where photons are dense, so that
// bright lines stay sharp, wide where they are few. A pixel that is not noisy is left alone, and in the end none is noisy: the limit is
// that of the plain film. Power is neither lost nor made.
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/sight.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nephroid::spectral {

class Smoothing {
public:
  /// What is allowed of noise: the root of the mean variance of R, G and B over the mean of R, G and B. Of grey photons a kernel holds 1 /
  /// noise^2 = 16. A smaller one blurs what need not be.
  static constexpr double noise = 0.25;

  /// Looks once through the middle of every pixel, on every core. Light is spread within one nearly flat part of the diffuse object that
  /// the pixel shows, be it directly, in a mirror or through glass, and along its outline by itself. Where glass or a mirror shows none, or
  /// is curved so that neighbours show places far apart, it is spread within one nearly flat part of the glass or mirror.
  /// The looks wait until the first call of look() or spread(), for they would hold up a run's first picture: until then it keeps a copy
  /// of what is looked at. everywhere: light is spread as far as its noise asks for; otherwise only as much of it as the halves say is for
  /// the better.
  Smoothing(const scene::Scene& scene, const scene::Bvh& bvh, bool everywhere);
  void look();

  /// What it takes at most, in bytes.
  static std::uint64_t bytes(const scene::Scene& scene, const scene::Bvh& bvh);

  /// rgb: of caustics alone, [pixel][3] of the camera's size. error_draw: a draw of its error (Picture::error_draw), which tells how noisy
  /// a pixel is; it becomes one of the error of what is spread, the bias included. Values below 0, of colours outside of sRGB, count as
  /// no light when kernels are chosen. Nothing changes where the draw is empty.
  void spread(std::vector<float>& rgb, std::vector<float>& error_draw);

private:
  /// What is looked at.
  struct View {
    scene::Scene scene; ///< but for its environment
    scene::Bvh bvh;
  };
  /// What a pixel shows, as far as light may be spread over it.
  struct Seen {
    Sight::Surface surface; ///< the diffuse one at the end of a look, or the first of glass or a mirror
    int first = -1;         ///< the object that is met first; -1: none
    bool at_edge = false;   ///< whether a neighbour shows something else: then the pixel may hold light of that
  };
  void find_edges();
  static bool are_level(const Seen& a, const Seen& b);
  /// Where a pixel's light may go: evenly, but for the outermost ring of pixels, which gets so much less that kernels change without a
  /// step.
  struct Kernel {
    std::vector<std::size_t> pixels; ///< nearest first
    std::size_t inside = 0;          ///< of `pixels`, those before the outermost ring
    double ring_weight = 1;          ///< of a pixel of that ring, 0..1
  };
  /// The one of pixel i that holds `wanted` of `light`, or reaches as far as any may.
  void find_kernel(std::size_t i, double wanted, std::span<const double> light, Kernel& kernel) const;
  /// What says where light goes, [pixel].
  struct Weights {
    std::span<const double> light, wanted; ///< of find_kernel
    std::span<const double> favour;        ///< that a pixel finds in every kernel
  };
  /// Calls give(i, j, part) for the part of its light that each pixel i which is `needed(i)` gives to j: as its kernel has it times
  /// favour[j]; a pixel's parts are 1 together. On every core, each with its own j.
  template <class Needed, class Give>
  void give_parts(const Weights& by, const Needed& needed, const Give& give) const;
  /// Of what a pixel has, `share` is spread; the rest stays. error_draw: may be empty.
  void spread_shares(const Weights& by, std::span<const float> share, std::vector<float>& rgb, std::vector<float>& error_draw) const;
  /// Of each pixel's light, what is for the better spread. rgb_spread: with all of it spread.
  std::vector<float> shares(const Weights& by, const std::vector<float>& rgb, const std::vector<float>& error_draw,
                            const std::vector<float>& rgb_spread) const;

  int width_, height_;
  bool everywhere_;
  std::unique_ptr<const View> view_; ///< null: all looks are taken
  std::vector<Seen> seen_;           ///< [pixel]
};

} // namespace nephroid::spectral
