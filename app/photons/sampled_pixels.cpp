// SPDX-License-Identifier: Apache-2.0
#include "photons/sampled_pixels.h"

#include "base/parallel.h"
#include "preset/preset.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

namespace nephroid::photons {
namespace {

constexpr double most_samples_a_slice = 1 << 18;

/// The least rate still notices what the first samples have missed; the most leaves photons their turn.
constexpr double least_rate = 1.0 / 31, most_rate = 64;

/// The pass among several in which a pixel has its turn.
std::uint32_t turn_of(std::size_t pixel) {
  const std::uint32_t mixed = static_cast<std::uint32_t>(pixel) * 0x9e3779b9u;
  return (mixed ^ mixed >> 15) >> 4;
}

/// Rounds a rate for SampledPixels. One sample in an odd number of passes serves both halves alike.
std::int16_t whole_rate(double rate) {
  if (rate >= std::sqrt(1.0 / 3))
    return static_cast<std::int16_t>(std::clamp(std::llround(rate), 1LL, static_cast<long long>(most_rate)));
  return static_cast<std::int16_t>(-(2 * std::llround((1 / rate - 1) / 2) + 1));
}

/// The samples of a pixel in a pass, before anything is known of noise. A meter's few cells have as many together as a
/// picture's pixels.
std::int16_t first_rate(const StageContext& world) {
  constexpr std::uint32_t a_pass = 1 << 13;
  if (!world.tables.meter) return 1;
  return static_cast<std::int16_t>(std::clamp<std::uint32_t>(a_pass / world.pixels.count, 1, 255));
}

/// The moments of a sample of a pixel, or the mean of several.
struct SampleMoments {
  double variance = 0, light_squared = 0; ///< sums of R, G and B
};

/// Sums over the pixels around one, without itself, that show glass, or none, as it does: others have other paths.
class Neighbourhood {
public:
  Neighbourhood(const StageContext& world, std::span<const SampleMoments> pixels)
      : width_(world.tables.camera.width), height_(world.tables.camera.height), glass_(world.pixels.may_show_glass),
        pixels_(pixels) {}
  SampleMoments mean(std::size_t pixel, int reach) const {
    const int x = static_cast<int>(pixel) % width_, y = static_cast<int>(pixel) / width_;
    SampleMoments sum;
    int count = 0;
    for (int row = std::max(y - reach, 0); row <= std::min(y + reach, height_ - 1); ++row)
      for (int column = std::max(x - reach, 0); column <= std::min(x + reach, width_ - 1); ++column) {
        const std::size_t i =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
        if (i == pixel || glass_[i] != glass_[pixel]) continue;
        sum.variance += pixels_[i].variance;
        sum.light_squared += pixels_[i].light_squared;
        ++count;
      }
    return {sum.variance / std::max(count, 1), sum.light_squared / std::max(count, 1)};
  }

private:
  int width_, height_;
  const std::vector<bool>& glass_;
  std::span<const SampleMoments> pixels_;
};

} // namespace

SampledPixels::SampledPixels(const StageContext& world, std::int64_t enough, double paths)
    : world_(world), enough_(enough), paths_(paths), passes_(world.pixels.glass.empty() ? enough : preset::max_passes),
      replicates_(std::max(2u, world.halves)), counts_(std::size_t{replicates_} * world.pixels.count),
      rates_(world.pixels.count, first_rate(world)), left_(world.pixels.count),
      on_device_(world.context, "samples", static_cast<std::size_t>(most_samples_a_slice)) {}

std::int64_t SampledPixels::samples_in(std::size_t pixel, std::int64_t pass) const {
  const std::int64_t rate = rates_[pixel];
  const std::int64_t wanted = rate > 0 ? rate : (pass + turn_of(pixel)) % -rate == 0 ? 1 : 0;
  if (world_.pixels.may_show_glass[pixel]) return wanted;
  const std::int64_t replicate = pass % replicates_, most = (enough_ + replicates_ - 1 - replicate) / replicates_;
  return std::clamp<std::int64_t>(most - counts_[pixel * replicates_ + static_cast<std::size_t>(replicate)], 0, wanted);
}

void SampledPixels::take_next(std::int64_t pass, double amount) {
  if (taken_ == wanted_) {
    for (std::size_t pixel = 0; pixel < left_.size(); ++pixel)
      left_[pixel] = static_cast<std::uint8_t>(samples_in(pixel, pass));
    taken_ = next_pixel_ = 0;
    wanted_ = std::reduce(left_.begin(), left_.end(), std::int64_t{0});
  }
  next_.clear();
  const auto most = static_cast<std::size_t>(std::clamp(amount, 1.0, most_samples_a_slice));
  const auto replicate = static_cast<std::uint32_t>(pass % replicates_);
  for (; next_.size() < most && taken_ < wanted_; next_pixel_ = (next_pixel_ + 1) % std::ssize(left_)) {
    const auto pixel = static_cast<std::size_t>(next_pixel_);
    if (left_[pixel] == 0) continue;
    --left_[pixel];
    ++taken_;
    next_.push_back(
        {static_cast<std::uint32_t>(pixel), replicates_ * counts_[pixel * replicates_ + replicate]++ + replicate});
  }
  next_count_ = next_.size();
  world_.context.communicator().keep_own_share(next_);
  if (!next_.empty()) on_device_.write(next_);
}

void SampledPixels::share_work(const Noise& noise) {
  passes_ = preset::max_passes; // for pixels that may now have less than a sample a pass
  std::vector<SampleMoments> pixels(rates_.size());
  for (std::size_t i = 0; i < 3 * pixels.size(); ++i) {
    const double draw = noise.draw[i], light = noise.light[i];
    pixels[i / 3].variance += draw * draw * samples_of(i / 3);
    pixels[i / 3].light_squared += light * light;
  }
  const Neighbourhood around(world_, pixels);
  for_ranges(pixels.size(), 1 << 12, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      // Through glass few samples bring most of the light, so the variance takes many pixels; elsewhere few.
      const bool glass = world_.pixels.may_show_glass[i];
      SampleMoments sampled = around.mean(i, 3);
      if (!glass) {
        const SampleMoments near = around.mean(i, 1);
        sampled = {std::max(near.variance, sampled.variance / 8), near.light_squared};
      }
      const double had = samples_of(i);
      const double light_squared =
          std::max(sampled.light_squared - sampled.variance / std::max(had, 1.0), 0.0); // less the noise's square
      // Noise beyond the light itself counts as that much: what is bright and rare stays noisy whatever is done.
      const double variance = std::min(Noise::noise_beside(light_squared / 3, sampled.variance), 3 * had);
      // n samples, each of the work c, leave the noise v / n, and one more lowers it by v / n^2. For the same work this
      // is to equal what photons gain, at the end of the next passes, which are as many as there were.
      const double wanted = std::sqrt(variance / (work_of_a_sample(i) * noise.photon_gain));
      rates_[i] = whole_rate(std::clamp((2 * wanted - had) / static_cast<double>(noise.passes), least_rate, most_rate));
    }
  });
}

double SampledPixels::work() const {
  double work = 0;
  for (std::size_t i = 0; i < rates_.size(); ++i) work += work_of_a_sample(i) * samples_of(i);
  return work;
}

void SampledPixels::serialize(tracing::Archive& archive) {
  archive.value(passes_);
  archive.value(taken_);
  archive.value(wanted_);
  archive.value(next_pixel_);
  archive.items(counts_);
  archive.items(rates_);
  archive.items(left_);
  if (std::ranges::count(rates_, 0) > 0) throw bad_input("checkpoint.bin", "is of another run");
}

} // namespace nephroid::photons
