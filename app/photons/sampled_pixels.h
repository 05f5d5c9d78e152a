// SPDX-License-Identifier: Apache-2.0
// Which pixels a stage samples from the eye: all of them until they have enough, then those that may show glass or a mirror, as long as the
// run goes on: what those show takes as many samples as a run can give, for each path from the eye there has one wavelength and one branch
// of each reflection.
#pragma once
#include "photons/tables/device_world.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "tracing/step_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::photons {

class SampledPixels {
public:
  /// enough: samples of a pixel without glass, one a pass; preset::max_passes: all pixels in every pass; 0: those of glass alone.
  SampledPixels(const DeviceWorld& world, std::int64_t enough) : lists_(world.pixels), enough_(enough), steps_(size(0), 1024) {}

  std::int64_t passes() const { return lists_.glass.empty() ? enough_ : preset::max_passes; }
  double part() const { return steps_.part(); }
  /// Of the pass in hand, of all its pixels.
  std::int64_t done() const { return steps_.done(); }
  /// How many a pass has of glass.
  std::int64_t glass() const { return static_cast<std::int64_t>(lists_.glass.size()); }

  /// Those of glass alone are sampled in one of every() passes, an odd number, so that both halves of a film get as many.
  std::int64_t every() const { return every_; }
  void sample_one_pass_in(double passes) { every_ = 2 * std::llround((std::clamp(passes, 1.0, 31.0) - 1) / 2) + 1; }

  /// Calls work(first, count) for the next places in PixelLists::on_device, at most `most`. True when the pass is complete.
  template <class Work>
  bool step(std::int64_t pass, const Work& work, std::int64_t most = std::numeric_limits<std::int64_t>::max())
  {
    in_hand_ = pass;
    if (size(pass) == 0 || (!has_all(pass) && pass % every_ != 0)) return true;
    const std::uint32_t begin = has_all(pass) ? 0 : lists_.count;
    const bool complete = steps_.step(size(pass), most, [&](std::uint32_t first, std::uint32_t count) { work(begin + first, count); });
    if (complete) ++(has_all(pass) ? passes_of_all_ : passes_of_glass_)[half()];
    return complete;
  }

  /// Film::samples of a pixel.
  std::array<double, 2> samples(std::size_t pixel) const
  {
    // Without a pass of all pixels the film is black but for glass, in any number of passes.
    const bool glass = enough_ == 0 || lists_.may_show_glass[pixel];
    std::array<double, 2> counts{};
    for (std::size_t half = 0; half < 2; ++half)
      counts[half] = static_cast<double>(passes_of_all_[half] + (glass ? passes_of_glass_[half] : 0));
    const auto at = static_cast<std::size_t>(steps_.done());
    if (at > 0 && pixel < (has_all(in_hand_) ? at : glass ? lists_.glass[at] : 0)) ++counts[half()];
    return counts;
  }

  void state(tracing::State& state)
  {
    steps_.state(state);
    state.value(every_);
    state.value(in_hand_);
    state.value(passes_of_all_);
    state.value(passes_of_glass_);
  }

private:
  bool has_all(std::int64_t pass) const { return pass < enough_; }
  std::int64_t size(std::int64_t pass) const { return has_all(pass) ? static_cast<std::int64_t>(lists_.count) : glass(); }
  std::size_t half() const { return static_cast<std::size_t>(in_hand_ % 2); }

  const PixelLists& lists_;
  std::int64_t enough_, every_ = 1, in_hand_ = 0;
  std::array<std::int64_t, 2> passes_of_all_{}, passes_of_glass_{}; ///< complete ones, even and odd
  tracing::PixelSteps steps_;
};

} // namespace nephroid::photons
