// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/material_picture.h"

#include "image/image.h"
#include "ui/widgets/theme.h"

namespace nephroid::ui {

void MaterialPictures::draw(MaterialBalls& balls, const std::string& material, float edge, WidgetPlaces& places,
                            const std::string& widget) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size{edge, edge};
  ImGui::Dummy(size);
  if (!ImGui::IsItemVisible()) return;
  ImGui::GetWindowDrawList()->AddRectFilled(corner, corner + size, colour::surround);
  const std::shared_ptr<const job::Picture> picture = balls.of(material);
  if (!picture) return;
  Drawn& drawn = drawn_[material];
  if (std::exchange(drawn.picture, picture) != picture) {
    auto to = drawn.texture.edit(picture->width, picture->height).begin();
    for (std::size_t i = 0; const float value : picture->rgb) {
      *to++ = image::shown(value, 1);
      if (++i % 3 == 0) *to++ = 255;
    }
  }
  drawn.texture.draw(corner, corner + size, false);
  places.note(widget, "A ball of this material, or a cylinder with its texture");
}

} // namespace nephroid::ui
