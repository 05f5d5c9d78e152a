// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/material_picture.h"

#include "image/display.h"
#include "ui/widgets/theme.h"

namespace nephroid::ui {

void MaterialPictures::draw(MaterialBalls& balls, const std::string& material, float edge, WidgetPlaces& places,
                            const std::string& widget) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size{edge, edge};
  ImGui::Dummy(size);
  if (!ImGui::IsItemVisible()) return;
  ImGui::GetWindowDrawList()->AddRectFilled(corner, corner + size, colour::surround);
  const std::shared_ptr<const job::Picture> picture = balls.of(material);
  if (!picture) {
    drawn_.erase(material);
    return;
  }
  Drawn& drawn = drawn_[material];
  if (std::exchange(drawn.picture, picture) != picture) {
    const preset::Display display; // as a new preset shows it
    image::show(picture->rgb, image::showing_of({display.gamut, display.tone}, 0, picture->rgb),
                drawn.texture.edit(picture->width, picture->height));
  }
  drawn.texture.draw(corner, corner + size, false);
  places.note(widget, "A ball of this material, or a cylinder with its texture");
}

} // namespace nephroid::ui
