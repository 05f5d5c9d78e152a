// SPDX-License-Identifier: Apache-2.0
// The number of samples from the eye of each pixel in each pass: one, until the noise shows where more are worth their
// work and where fewer will do.
//
// The mean of a pixel's samples is unbiased, whatever their number, as long as that depends on other samples only. So
// the pixels around it decide, whose random numbers are their own, and not the pixel itself.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "photons/stage.h"
#include "photons/stage_context.h"
#include "tracing/archive.h"
#include "tracing/slices.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::photons {

class SampledPixels {
public:
  /// enough is the most samples of a pixel that shows neither glass nor a mirror, paths the number of paths in one.
  SampledPixels(const StageContext& world, std::int64_t enough, double paths);

  /// The number of passes that may have samples.
  std::int64_t passes() const { return passes_; }
  double fraction_done() const { return taken_ < wanted_ ? double(taken_) / double(wanted_) : 0; }

  /// Calls work(samples, count) for the next samples of the pass, on the device: one of each pixel, then another of
  /// each that has more, ... x is the pixel, y the sample's number in it. Even numbers belong to the film's first half,
  /// odd ones to the second; a meter's replicates each have their turn. True when the pass is complete.
  template <class Work>
  bool advance(std::int64_t pass, const Work& work) {
    take_next(pass, amount_.amount(world_.context.communicator()));
    amount_.timed(static_cast<double>(next_count_), [&] {
      if (!next_.empty()) work(on_device_, static_cast<std::uint32_t>(next_.size()));
    });
    return taken_ == wanted_;
  }

  /// A pixel's samples, as Film::samples.
  std::array<double, 2> samples(std::size_t pixel) const {
    std::array<double, 2> halves{};
    for (std::uint32_t i = 0; i < replicates_; ++i) halves[i % 2] += counts_[pixel * replicates_ + i];
    return halves;
  }

  void share_work(const Noise& noise);
  /// Of all samples, in that of a photon.
  double work() const;

  void serialize(tracing::Archive& archive);

private:
  double samples_of(std::size_t pixel) const {
    const auto [even, odd] = samples(pixel);
    return even + odd;
  }
  double work_of_a_sample(std::size_t pixel) const {
    return world_.pixels.may_show_glass[pixel] ? paths_through_glass * work_through_glass : paths_ * work_of_a_path;
  }
  std::int64_t samples_in(std::size_t pixel, std::int64_t pass) const;
  void take_next(std::int64_t pass, double amount);

  const StageContext& world_;
  std::int64_t enough_;
  double paths_;
  std::int64_t passes_;
  std::uint32_t replicates_;            ///< of the film: two halves at least
  std::vector<std::uint32_t> counts_;   ///< [pixel][replicate]: samples in its passes
  std::vector<std::int16_t> rates_;     ///< [pixel]: n > 0: n samples a pass; n < 0: one sample in every -n passes
  std::vector<std::uint8_t> left_;      ///< [pixel]: samples that it still has in the current pass
  std::int64_t taken_ = 0, wanted_ = 0; ///< samples of all pixels in it
  std::int64_t next_pixel_ = 0;
  std::vector<shared::uint2> next_; ///< this rank's part of the next samples
  std::size_t next_count_ = 0;      ///< next samples of all ranks
  compute::Buffer<shared::uint2> on_device_;
  tracing::SliceSize amount_{1024};
};

} // namespace nephroid::photons
