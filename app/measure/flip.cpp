// SPDX-License-Identifier: Apache-2.0
#include "measure/flip.h"

#include "base/parallel.h"

#include <FLIP.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#undef Max // FLIP.h's
#undef Min

namespace nephroid::measure {
namespace {

using ColourImage = FLIP::image<FLIP::color3>;

/// FLIP's filters reach no further than this: 3 standard deviations of the widest, the yellow-blue one, are 9.1 pixels.
constexpr int filter_rows = 10;

/// Rows of the pictures: those of which the error is wanted, and all that the filters see for them.
struct Strip {
  int begin, end, first, last;
};

/// Strips of the picture for every core. The errors do not depend on how the picture is cut.
std::vector<Strip> strips(int height) {
  constexpr int smallest = 32; // below, the rows that strips share cost more than a further core gains
  const int wanted = 2 * static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int rows = std::max(smallest, (height + wanted - 1) / wanted);
  std::vector<Strip> result;
  for (int begin = 0; begin < height; begin += rows) {
    const int end = std::min(height, begin + rows);
    result.push_back({begin, end, std::max(0, begin - filter_rows), std::min(height, end + filter_rows)});
  }
  return result;
}

/// The strip's values, each given to `change` first.
template <class Change>
ColourImage cut(const Pixels& picture, const Strip& strip, const Change& change) {
  ColourImage image(picture.width, strip.last - strip.first);
  const float* value = picture.rgb.data() +
                       std::size_t{3} * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(strip.first);
  for (int y = 0; y < image.getHeight(); ++y)
    for (int x = 0; x < image.getWidth(); ++x, value += 3)
      image.set(x, y, {change(value[0]), change(value[1]), change(value[2])});
  return image;
}

/// Raises map to the error of the strip between the two, which are linear, 0..1, and used up.
void raise_to_error(std::vector<float>& map, const Strip& strip, ColourImage& picture, ColourImage& reference) {
  const std::size_t bytes = sizeof(FLIP::color3) * static_cast<std::size_t>(picture.getWidth()) *
                            static_cast<std::size_t>(picture.getHeight());
  if (std::memcmp(picture.getHostData(), reference.getHostData(), bytes) == 0)
    return; // black or white alike: the error is 0
  FLIP::image<float> error(picture.getWidth(), picture.getHeight());
  error.LDR_FLIP(reference, picture, FLIP::Parameters().PPD);
  float* raised = map.data() + static_cast<std::size_t>(picture.getWidth()) * static_cast<std::size_t>(strip.begin);
  for (int y = strip.begin; y < strip.end; ++y)
    for (int x = 0; x < picture.getWidth(); ++x, ++raised) *raised = std::max(*raised, error.get(x, y - strip.first));
}

} // namespace

Exposures hdr_exposures(std::span<const float> reference_rgb) {
  std::vector<float> luminances(reference_rgb.size() / 3);
  for (std::size_t p = 0; p < luminances.size(); ++p) {
    const auto at = [&](std::size_t c) { return std::max(0.0f, reference_rgb[3 * p + c]); };
    luminances[p] = FLIP::color3::linearRGBToLuminance({at(0), at(1), at(2)});
  }
  const auto median = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), median, luminances.end());
  constexpr float darkest = std::numeric_limits<float>::epsilon(), brightest = std::numeric_limits<float>::max();
  const float largest =
      std::clamp(*std::max_element(median, luminances.end()), darkest, brightest); // the sum may round to infinity
  // Where the tone curve reaches .85: the positive root of a x^2 + b x + c, 2.11887.
  const float* const t = FLIP::ToneMappingCoefficients[1];
  const float a = t[0] - 0.85f * t[3], b = t[1] - 0.85f * t[4], c = t[2] - 0.85f * t[5];
  const float shown = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  Exposures exposures;
  exposures.start = std::log2(shown / largest);
  exposures.stop = std::log2(shown / std::max(darkest, *median));
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

std::vector<float> flip_map(const Pixels& picture, const Pixels& reference) {
  const std::vector<Strip> all = strips(picture.height);
  const auto clip = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  std::vector<float> map(picture.rgb.size() / 3);
  for_blocks(all.size(), [&](std::size_t i) {
    ColourImage a = cut(picture, all[i], clip), b = cut(reference, all[i], clip);
    raise_to_error(map, all[i], a, b);
  });
  return map;
}

std::vector<float> hdr_flip_map(const Pixels& picture, const Pixels& reference) {
  const std::vector<Strip> all = strips(picture.height);
  const Exposures exposures = hdr_exposures(reference.rgb);
  const float step = (exposures.stop - exposures.start) / static_cast<float>(exposures.count - 1);
  std::vector<float> map(picture.rgb.size() / 3);
  for_blocks(all.size(), [&](std::size_t i) {
    for (int e = 0; e < exposures.count; ++e) {
      const float scale = std::exp2(exposures.start + static_cast<float>(e) * step);
      // The tone curve is at white long before 1e6, and its squares must not overflow.
      const auto expose = [scale](float v) { return std::min(scale * std::max(v, 0.0f), 1e6f); };
      ColourImage a = cut(picture, all[i], expose), b = cut(reference, all[i], expose);
      for (ColourImage* image : {&a, &b}) {
        image->toneMap("aces");
        image->clamp();
      }
      raise_to_error(map, all[i], a, b);
    }
  });
  return map;
}

std::array<float, 3> magma(double position) {
  const double entry = 255 * std::clamp(position, 0.0, 1.0);
  const auto below = static_cast<std::size_t>(std::min(entry, 254.0));
  const auto share = static_cast<float>(entry - static_cast<double>(below));
  const FLIP::color3 &low = FLIP::MapMagma[below], &high = FLIP::MapMagma[below + 1];
  return {std::lerp(low.r, high.r, share), std::lerp(low.g, high.g, share), std::lerp(low.b, high.b, share)};
}

} // namespace nephroid::measure
