// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/profile.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace nephroid::image {
namespace {

using Profile = std::unique_ptr<void, decltype(&cmsCloseProfile)>;
using Transform = std::unique_ptr<void, decltype(&cmsDeleteTransform)>;

Profile opened(const std::string& bytes) {
  return {cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())), cmsCloseProfile};
}

Profile linear_srgb() {
  const cmsCIExyY white{0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
  const std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)> line(cmsBuildGamma(nullptr, 1), cmsFreeToneCurve);
  const std::array<cmsToneCurve*, 3> curves{line.get(), line.get(), line.get()};
  return {cmsCreateRGBProfile(&white, &primaries, curves.data()), cmsCloseProfile};
}

/// Three floats a colour on both sides; of grey the first counts. Null where the profile gives none.
Transform to_linear_srgb(cmsHPROFILE from) {
  constexpr cmsUInt32Number first_of_three =
      FLOAT_SH(1) | COLORSPACE_SH(PT_GRAY) | EXTRA_SH(2) | CHANNELS_SH(1) | BYTES_SH(4);
  const cmsUInt32Number format = cmsGetColorSpace(from) == cmsSigGrayData ? first_of_three : TYPE_RGB_FLT;
  return {cmsCreateTransform(from, format, linear_srgb().get(), TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC,
                             cmsFLAGS_NOCACHE),
          cmsDeleteTransform};
}

} // namespace

ProfileUse profile_use(const std::string& profile, bool grey) {
  const Profile from = opened(profile);
  if (!from) return ProfileUse::none;
  const cmsColorSpaceSignature space = cmsGetColorSpace(from.get());
  if (space != cmsSigRgbData && !(grey && space == cmsSigGrayData)) return ProfileUse::none;
  const Transform transform = to_linear_srgb(from.get());
  if (!transform) return ProfileUse::none;
  constexpr std::array<float, 15> codes{1,    1,    1,    0.5f, 0.5f, 0.5f, 0.2f, 0.2f,
                                        0.2f, 0.8f, 0.5f, 0.2f, 0.2f, 0.5f, 0.8f};
  constexpr float alike = 1e-3f;
  std::array<float, codes.size()> linear{}, of_srgb{};
  const Profile srgb(cmsCreate_sRGBProfile(), cmsCloseProfile);
  cmsDoTransform(transform.get(), codes.data(), linear.data(), codes.size() / 3);
  cmsDoTransform(to_linear_srgb(srgb.get()).get(), codes.data(), of_srgb.data(), codes.size() / 3);
  const auto last = linear.begin() + (grey ? 9 : codes.size());
  const bool is_srgb =
      std::equal(linear.begin(), last, of_srgb.begin(), [](float a, float b) { return std::abs(a - b) < alike; });
  return is_srgb ? ProfileUse::srgb : ProfileUse::other;
}

void apply_profile(const std::string& profile, std::vector<float>& rgb) {
  const Transform transform = to_linear_srgb(opened(profile).get());
  constexpr std::size_t most = std::size_t{1} << 24; // lcms counts in 32 bits
  for (std::size_t first = 0, pixels = rgb.size() / 3; first < pixels; first += most)
    cmsDoTransform(transform.get(), &rgb[3 * first], &rgb[3 * first],
                   static_cast<cmsUInt32Number>(std::min(most, pixels - first)));
}

} // namespace nephroid::image
