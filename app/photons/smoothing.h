// SPDX-License-Identifier: Apache-2.0
// Smooths caustics of few photons: spreads each pixel's light over as many pixels around it as its noise asks for.
//
// Photons on a surface are a sample of a density, and a histogram over pixels is the noisiest estimate of it. This is
// the sample-point estimate with adaptive kernels (Abramson 1982, "On bandwidth variation in kernel estimates"): they
// are narrow where photons are dense, so that bright lines stay sharp, and wide where photons are few. A pixel that is
// not noisy is left alone; in the end none is, so the limit is that of the plain film. Power stays.
#pragma once
#include "photons/kinds_of_pixels.h"
#include "photons/spread_kernels.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace nephroid::photons {

/// The mean of R, G and B of each pixel, at least 0 each. rgb is [pixel][3].
std::vector<double> light_of(std::span<const float> rgb);

/// Variance over light around each pixel, means of R, G and B: for light in equal portions, one portion; 0 in the dark.
std::vector<double> portions(std::span<const double> light, std::span<const float> error_draw, int width, int height);

/// Adds to the draw of what is spread how far light was moved. With r what spreading has changed of the picture and q
/// what it has of the draw, r + q and r - q are what it has changed of two halves with noise of their own, so that
/// around a pixel
///
///   M = sum of (r + q)(r - q)                    is that of the squares of the bias, give or take
///   S^(1/2), S = sum of ((r + q)(r - q))^2,      and
///   g^2 = M / (sum of r^2) / (1 + S / M^2)       the share of r^2 that it is, as far as it stands out,
///
/// and g r a draw of the bias: r is the bias and the noise that was taken away, which is no error of what is spread.
void add_bias(std::span<const float> rgb, std::span<const float> error_draw, std::span<const float> rgb_spread,
              std::vector<float>& draw_spread, int width, int height);

class Smoothing {
public:
  /// everywhere: as far as the noise asks for. where_it_helps: only the part for which the halves show a gain.
  enum class Spread { where_it_helps, everywhere };
  /// The noise that may remain: the root of the mean variance of R, G and B over the mean of R, G and B. A kernel then
  /// holds 1 / noise^2 = 16 grey photons. A smaller value blurs more than it needs to.
  static constexpr double usual_noise = 0.25;

  /// Copies of a scene, but for its environment, and of its tree.
  struct View {
    scene::Scene scene;
    scene::Bvh bvh;
  };
  static std::shared_ptr<const View> view_of(const scene::Scene& scene, const scene::Bvh& bvh);

  /// Sends one ray through the middle of every pixel of a picture of width x height, on every core. Light is spread
  /// within one nearly flat part of the diffuse object that the pixel shows, be it directly, in a mirror or through
  /// glass. Along the object's outline it stays there. Where glass or a mirror shows none, is rough, or pulls
  /// neighbours far apart, light is spread within one nearly flat part of it. The light without a texture of colour is
  /// spread where that is known, else light stays. The rays would hold up a preview, so they wait until the surfaces
  /// are needed. find_texture: makes the colours [pixel][3] of the textures that are seen, linear RGB, not 0.
  using FindTexture = std::function<std::vector<float>()>;
  Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread, FindTexture find_texture);
  /// For light that comes without textures.
  Smoothing(std::shared_ptr<const View> view, int width, int height, Spread spread);
  void find_surfaces();

  /// Divides [pixel][3] by the textures, or multiplies by them again.
  void take_textures_out(std::vector<float>& values);
  void put_textures_in(std::vector<float>& values) const;

  static std::uint64_t bytes(const scene::Scene& scene, const scene::Bvh& bvh);

  /// rgb has a layer alone, [pixel][3] of the camera's size. error_draw is a draw of their error
  /// (Picture::error_draw), from which the noise of a pixel is known. It becomes that of the result, the bias included.
  /// Values below 0 count as no light when kernels are chosen. Nothing changes where the draw is empty. With `known`,
  /// an estimate of the same light that has a bias but no noise, each place gets the mixture of both that the halves
  /// show to be best (mixture.h). noise: as usual_noise, for this light.
  void spread(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> known = {},
              double noise = usual_noise);
  /// The same where textures are taken out.
  void spread_light(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> known = {},
                    double noise = usual_noise);

private:
  int width_, height_;
  Spread spread_;
  std::shared_ptr<const View> view_; ///< null once the surfaces are found
  bool has_textures_ = true;         ///< whether the light that comes has them
  FindTexture find_texture_;
  std::vector<float> texture_; ///< of find_texture_
  KindsOfPixels kinds_;        ///< glass, mirrors and outlines; all else
  SpreadDomain domain_;
  std::vector<std::size_t> lamps_; ///< pixels that may hold light which a lamp sends there itself, and keep it
};

} // namespace nephroid::photons
