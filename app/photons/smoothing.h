// SPDX-License-Identifier: Apache-2.0
// Caustics of few photons made smooth: the light of every pixel is spread over as many pixels around it as make its
// noise small enough.
//
// Photons on a surface are a sample of a density, and a histogram over pixels is the noisiest estimate of it. This is
// the sample-point estimate with adaptive kernels (Abramson 1982, "On bandwidth variation in kernel estimates"): narrow
// where photons are dense, so that bright lines stay sharp, wide where they are few. A pixel that is not noisy is left
// alone, and in the end none is noisy: the limit is that of the plain film. Power is neither lost nor made.
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nephroid::photons {

/// rgb: [pixel][3]. The mean of R, G and B, at least 0 each.
std::vector<double> light_of(std::span<const float> rgb);

/// Variance over light around each pixel, means of R, G and B: of light that comes in equal portions, one portion. 0 in
/// the dark.
std::vector<double> portions(std::span<const double> light, std::span<const float> error_draw, int width, int height);

class Smoothing {
public:
  /// everywhere: light is spread as far as its noise asks for; where_it_helps: only as much of it as the halves say is
  /// for the better.
  enum class Spread { where_it_helps, everywhere };
  /// What is allowed of noise: the root of the mean variance of R, G and B over the mean of R, G and B. Of grey photons
  /// a kernel holds 1 / noise^2 = 16. A smaller one blurs what need not be.
  static constexpr double noise = 0.25;

  /// The same light as somebody knows it without noise, but not quite right.
  struct BiasedEstimate {
    std::span<const float> rgb; ///< [pixel][3]; empty: nobody does
    double noise;               ///< what is allowed of noise in what is known with what it lacks, as Smoothing::noise
  };

  /// What is looked at: copies of a scene, but for its environment, and of its tree.
  struct View {
    scene::Scene scene;
    scene::Bvh bvh;
  };
  static std::shared_ptr<const View> view_of(const scene::Scene& scene, const scene::Bvh& bvh);

  /// Sends one ray through the middle of every pixel of a picture of width x height, on every core. Light is spread
  /// within one nearly flat part of the diffuse object that the pixel shows, be it directly, in a mirror or through
  /// glass, and along its outline by itself. Where glass or a mirror shows none, or is curved so that neighbours show
  /// places far apart, it is spread within one nearly flat part of the glass or mirror. The rays wait until the first
  /// call of find_surfaces() or spread(), for they would hold up a run's preview: until then it keeps what is looked
  /// at.
  Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread);
  void find_surfaces();

  /// What it takes at most, in bytes.
  static std::uint64_t bytes(const scene::Scene& scene, const scene::Bvh& bvh);

  /// rgb: of caustics alone, [pixel][3] of the camera's size. error_draw: a draw of its error (Picture::error_draw),
  /// which tells how noisy a pixel is; it becomes one of the error of what is spread, the bias included. Values below
  /// 0, of colours outside of sRGB, count as no light when kernels are chosen. Nothing changes where the draw is empty.
  /// known: then each place gets the mixture that the halves say is best (mixture.h) of what is spread, of what is
  /// known, and of that with what it lacks, which is spread until its noise is known.noise.
  void spread(std::vector<float>& rgb, std::vector<float>& error_draw, const BiasedEstimate& known = {});

  /// Of the pixels within reach of one, nearest first, those that its light may be spread over: a bit each, from the
  /// lowest of the first.
  using Level = std::array<std::uint64_t, 2>;

private:
  int width_, height_;
  Spread spread_;
  std::shared_ptr<const View> view_; ///< null: the surfaces are found
  std::vector<Level> level_;         ///< [pixel]
};

} // namespace nephroid::photons
