// SPDX-License-Identifier: Apache-2.0
// What the View shows now: the run's picture, the one it is compared with, or the map of their difference; and what it says of a pixel.
#pragma once
#include "ui/state/context.h"

namespace nephroid::ui {

struct ShownPicture {
  std::shared_ptr<const void> owner;   ///< of the pixels below; null: there is nothing to show. Other pixels have another owner.
  std::span<const float> rgb;          ///< linear, to be shown with the look's exposure; or
  std::span<const unsigned char> rgba; ///< as it is, 4 bytes a pixel
  std::array<int, 2> size{1, 1};       ///< the run's picture's, whatever is shown; before the first, the preset's
  std::string label;                   ///< where it is not the run's picture
  std::string hint;                    ///< in the middle of the panel, where there is nothing to show
};

ShownPicture shown_picture(const Context& context);
/// Linear values of a pixel inside of the run's picture, with the luminance that the preset's white makes of them; when comparing, a
/// second line with those of the other picture and a third with the difference. Empty where there is no picture.
std::string pixel_text(const Context& context, const std::array<int, 2>& pixel);

} // namespace nephroid::ui
